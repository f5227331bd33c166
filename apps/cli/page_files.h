#pragma once
// The files of the page, in memory, as a server sends them.

#include <map>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache::cli {

// A file as it is sent: its bytes, or the same in gzip.
struct PageFile {
  const char* type = "";           // "text/html; charset=utf-8"
  std::string bytes, bytes_tag;    // The tags name the content, as an ETag does.
  std::string packed, packed_tag;  // Brotli; empty if the build stored no FILE.br.
};

class PageFiles {
 public:
  // Reads all files of a folder and its subfolders. A file NAME.br next to NAME is the same,
  // compressed.
  static Result<PageFiles> read(const std::string& folder);

  // The file at a decoded path of an address: "/assets/main.js"; "/" is "/index.html". Null if
  // there is none.
  const PageFile* find(std::string_view path) const;

 private:
  std::map<std::string, PageFile, std::less<>> files_;
};

}  // namespace panache::cli
