// In the place of picture.cpp in a build without stb_image.

#include "messages.h"
#include "picture.h"

namespace panache::cli {

Result<std::string> picture_to_png(const std::string&, const std::string&) {
  return Error{
      "expected PNG or JPEG, found another kind, which this build does not convert; build "
      "with libstb-dev"};
}

int read_picture_as_child(const std::string& path) {
  print_message(picture_to_png("", path).error().message);
  return kBadInput;
}

}  // namespace panache::cli
