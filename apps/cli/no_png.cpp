// Instead of png.cpp where librsvg is missing.

#include "png.h"

namespace panache::cli {

Result<std::string> svg_to_png(const std::string&, const std::string& path) {
  return Error{path +
               ": this build cannot draw PNG files: librsvg (Debian's librsvg2-dev) was missing "
               "when it was built; expected a name that ends in .svg"};
}

}  // namespace panache::cli
