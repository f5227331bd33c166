#pragma once
// Addresses of data in glTF files: data URIs and files beside the file.

#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

bool is_data_uri(std::string_view uri);
// The bytes of a data URI; a message without a name if it is invalid.
Result<std::string> decode_data_uri(std::string_view uri);
// "data:TYPE;base64,...".
std::string make_data_uri(std::string_view type, std::string_view bytes);

// The path of the file that the relative `uri` means in a file at `path`. Rejected, with a message
// without a name, is whatever leads out of that file's folder.
Result<std::string> resolve_uri(std::string_view uri, const std::string& path);

}  // namespace panache
