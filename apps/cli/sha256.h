#pragma once
// Identifies files by their hash.

#include <string>

namespace panache::cli {

// The SHA-256 of a file in hexadecimal; empty if it cannot be read, or in a build without OpenSSL.
std::string sha256_of_file(const std::string& path);

}  // namespace panache::cli
