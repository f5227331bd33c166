#include "picture.h"

#include <limits>
#include <memory>

#include <stb_image.h>
#include <stb_image_write.h>

#include "child_process.h"

namespace panache::cli {
namespace {

constexpr int kLongestRead = 60;  // Seconds.
constexpr const char* kFailure = "expected PNG, JPEG, TGA, BMP, PSD or GIF, found another kind";

void append(void* to, void* bytes, int count) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                        static_cast<size_t>(count));
}

Result<std::string> convert(const std::string& picture) {
  if (picture.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
    return Error{kFailure};
  }
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(picture.data()),
                            static_cast<int>(picture.size()), &width, &height, &channels, 0),
      stbi_image_free);
  std::string png;
  if (!pixels || !stbi_write_png_to_func(append, &png, width, height, channels, pixels.get(), 0)) {
    return Error{kFailure};
  }
  return png;
}

}  // namespace

Result<std::string> picture_to_png(const std::string& picture, const std::string& path) {
  Result<std::string> png = run_in_child(kPictureReader, path, picture, kFailure, kLongestRead);
  // The caller adds the picture's name.
  return png ? png : Error{kFailure};
}

int read_picture_as_child(const std::string& path) {
  return answer_as_child(
      path, [] { return Result<std::string>(read_input_as_child()); }, convert, kLongestRead);
}

}  // namespace panache::cli
