#pragma once
// Addresses of data in glTF files: data URIs and relative files.

#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

bool is_data_uri(std::string_view uri);
// Decodes a data URI; error messages have no name in front.
Result<std::string> decode_data_uri(std::string_view uri);
// "data:TYPE;base64,...".
std::string make_data_uri(std::string_view type, std::string_view bytes);

// The path of the file that the relative `uri` refers to from a file at `path`. References outside
// that file's folder are rejected, with a message without a name.
Result<std::string> resolve_uri(std::string_view uri, const std::string& path);

}  // namespace panache
