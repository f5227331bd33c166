#pragma once
// Text inside of XML and HTML.

#include <string>
#include <string_view>

namespace panache {

// `text`, UTF-8 of any content, fit to stand between tags and in double quotes: characters that
// mean something are written as entities, what XML cannot hold is replaced by U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace panache
