#include "png.h"

#include <algorithm>
#include <array>
#include <memory>

#include <librsvg/rsvg.h>
#include <sys/mman.h>
#include <unistd.h>

#include "child_process.h"

#ifdef PANACHE_SANITIZED
// The fonts that fontconfig caches until the program ends are not our leak.
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): the sanitizer's own name.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
#endif

namespace panache::cli {
namespace {

constexpr int kLongestDrawing = 50;  // Seconds.
// Without these, the font libraries leave out text or hang.
constexpr size_t kFontFiles = 8;
constexpr size_t kFontMemory = size_t{128} << 20;
constexpr double kPixels = 2;           // PNG pixels per unit of the drawing, for sharp screens.
constexpr double kLongestSide = 32000;  // Pixels. Cairo's limit is 32,767.

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Handle = std::unique_ptr<RsvgHandle, Destroy<g_object_unref>>;
using Surface = std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Destroy<cairo_destroy>>;

cairo_status_t append(void* out, const unsigned char* bytes, unsigned int size) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
}

constexpr const char* kFailure =
    "the picture could not be drawn; use a name that ends in .svg to write the SVG instead";

bool is_room_for_fonts() {
  std::array<int, kFontFiles> files;
  for (int& file : files) file = ::dup(STDOUT_FILENO);
  void* const memory = ::mmap(nullptr, kFontMemory, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  for (const int file : files) {
    if (file >= 0) ::close(file);
  }
  if (memory == MAP_FAILED) return false;
  ::munmap(memory, kFontMemory);
  return files.back() >= 0;
}

Result<std::string> draw(const std::string& svg, const std::string& path) {
  const Error failure{path + ": " + kFailure};
  if (!is_room_for_fonts()) return failure;
  const Handle drawing(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), nullptr));
  double width = 0, height = 0;
  if (!drawing || !rsvg_handle_get_intrinsic_size_in_pixels(drawing.get(), &width, &height)) {
    return failure;
  }
  const double pixels = std::min(kPixels, kLongestSide / std::max(width, height));
  const Surface surface(cairo_image_surface_create(
      CAIRO_FORMAT_ARGB32, static_cast<int>(width * pixels), static_cast<int>(height * pixels)));
  const Context context(cairo_create(surface.get()));
  cairo_scale(context.get(), pixels, pixels);
  const RsvgRectangle all = {0, 0, width, height};
  if (!rsvg_handle_render_document(drawing.get(), context.get(), &all, nullptr)) return failure;
  std::string png;
  const cairo_status_t written = cairo_surface_write_to_png_stream(surface.get(), append, &png);
  if (written != CAIRO_STATUS_SUCCESS) return failure;
  return png;
}

}  // namespace

Result<std::string> svg_to_png(const std::string& svg, const std::string& path) {
  return run_in_child(kPngDrawer, path, svg, kFailure, kLongestDrawing);
}

int draw_png_as_child(const std::string& path) {
  // Fonts are loaded during drawing.
  return answer_as_child(
      path, [&] { return draw(read_input_as_child(), path); },
      [](const std::string& png) { return Result<std::string>(png); }, kLongestDrawing);
}

}  // namespace panache::cli
