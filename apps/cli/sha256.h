#pragma once
// What tells one file from another.

#include <string>

namespace panache::cli {

// The SHA-256 of a file's bytes in hexadecimal digits; empty where it cannot be read, or where this
// build has no OpenSSL.
std::string sha256_of_file(const std::string& path);

}  // namespace panache::cli
