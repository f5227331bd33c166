#include "sha256.h"

#include <array>

#include <openssl/evp.h>

#include "base/file.h"

namespace panache::cli {

std::string sha256_of_file(const std::string& path) {
  const Result<std::string> bytes = read_file(path);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  if (!bytes ||
      EVP_Digest(bytes->data(), bytes->size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    return "";
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < size; ++i) {
    out += {kDigits[digest[i] >> 4], kDigits[digest[i] & 15]};
  }
  return out;
}

}  // namespace panache::cli
