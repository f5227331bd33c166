// Instead of png.cpp where librsvg is missing.

#include "messages.h"
#include "png.h"

namespace panache::cli {

Result<std::string> svg_to_png(const std::string&, const std::string& path) {
  return Error{path +
               ": this build cannot draw PNG files: librsvg (Debian's librsvg2-dev) was missing "
               "when it was built; expected a name that ends in .svg"};
}

int draw_png_as_child(const std::string& path) {
  print_message(svg_to_png("", path).error().message);
  return kBadInput;
}

}  // namespace panache::cli
