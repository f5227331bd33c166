#pragma once
// Escapes text for XML and HTML.

#include <string>
#include <string_view>

namespace panache {

// Any UTF-8 `text`, escaped for use between tags and in double quotes: special characters become
// entities, and characters that XML does not allow become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace panache
