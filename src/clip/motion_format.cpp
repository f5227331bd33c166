#include "clip/motion_format.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/file.h"
#include "base/text.h"
#include "clip/acclaim.h"
#include "clip/bvh.h"
#include "clip/clip.h"
#include "clip/fbx.h"
#include "clip/gltf.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

// Whether the rest pose has the rotations of the first frame, so that the real one is unknown.
bool rests_as_it_starts(const Clip& clip) {
  const ConstPose pose = clip.pose(0);
  for (size_t j = 0; j < clip.joints(); ++j) {
    const Quat rest = clip.skeleton.joints[j].rest;
    if (length((conjugate(rest) * pose.rotations[j]).xyz()) > 1e-5f) return false;
  }
  return true;
}

// The rest pose is that of the skeleton, units and axes are those of the clip. Axes are kept if the
// rest pose is unknown.
std::string write_bvh(const Clip& clip, const std::string&, const Placement&, const SkinnedBody*) {
  Clip out = rests_as_it_starts(clip) ? clip : in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

std::string write_glb(const Clip& clip, const std::string& name, const Placement& placement,
                      const SkinnedBody* body) {
  return format_glb(clip, name, static_cast<double>(placement.metres_per_unit), placement.y_up,
                    body);
}

#ifndef PANACHE_LEAVES_OUT_FBX
std::string write_fbx(const Clip& clip, const std::string& name, const Placement& placement,
                      const SkinnedBody*) {
  return format_fbx(clip.skeleton, {{&clip, name}}, static_cast<double>(placement.metres_per_unit),
                    placement.y_up);
}
#endif

constexpr MotionFormat kFormats[] = {
    {.extension = ".bvh",
     .parse = parse_bvh,
     .write = write_bvh,
     .encoded_as = ".bvh",
     .one_motion = true},
    {.extension = ".glb",
     .parse = parse_gltf,
     .write = write_glb,
     .has_meshes = true,
     .in_metres = true,
     .encoded_as = ".glb"},
    {.extension = ".gltf",
     .parse = parse_gltf,
     .encoded_as = ".gltf",
     .fits_into = ".glb",
     .in_one_file = false},
    {.extension = ".vrm", .parse = parse_gltf, .encoded_as = ".vrm", .fits_into = ".glb"},
    {.extension = ".vrma",
     .parse = parse_vrma,
     .encoded_as = ".vrma",
     .fits_into = ".glb",
     .one_motion = true},
    {.extension = ".amc",
     .parse = parse_amc,
     .encoded_as = ".bvh",
     .fits_into = ".bvh",
     .one_motion = true},
#ifndef PANACHE_LEAVES_OUT_FBX
    {.extension = ".fbx",
     .parse = parse_fbx,
     .write = write_fbx,
     .in_metres = true,
     .encoded_as = ".fbx"},
#endif
};

std::span<const MotionFormat> known_formats = kFormats;

Result<const MotionFormat*> format_of(const std::string& path,
                                      std::span<const MotionFormat> formats) {
  const std::string extension = extension_of(path);
  if (const MotionFormat* format = find_format(formats, extension)) return format;
  return Error{
      path + ": expected a motion file (" + list_extensions(formats) + "), found " +
      (extension.empty() ? "no extension" : "the extension " + panache::quoted(extension)) +
      (extension == ".safetensors" ? ", which models and styles have" : "")};
}

}  // namespace

std::span<const MotionFormat> motion_formats() noexcept { return kFormats; }

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

const MotionFormat* find_format(std::span<const MotionFormat> formats, std::string_view extension) {
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const MotionFormat& format) {
    return format.extension == extension;
  });
  return found == formats.end() ? nullptr : &*found;
}

std::string list_extensions(std::span<const MotionFormat> formats) {
  std::string list;
  for (const MotionFormat& format : formats) {
    list += (list.empty() ? "" : ", ") + std::string(format.extension);
  }
  return list;
}

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                std::span<const MotionFormat> formats,
                                                const ReadOptions& options) {
  Result<const MotionFormat*> format = format_of(path, formats);
  std::error_code status;
  if (!format && !std::filesystem::exists(path, status)) return read_file(path).error();
  if (!format) return format.error();
  if ((*format)->read) return (*format)->read(path, options);
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return (*format)->parse(std::move(*bytes), path, options);
}

Result<std::unique_ptr<MotionFile>> parse_motion(std::string bytes, const std::string& path,
                                                 const ReadOptions& options) {
  Result<const MotionFormat*> format = format_of(path, kFormats);
  if (!format) return format.error();
  if (auto other = find_other_content(bytes, path)) return *other;
  return (*format)->parse(std::move(bytes), path, options);
}

void set_motion_formats(std::span<const MotionFormat> formats) { known_formats = formats; }
std::span<const MotionFormat> known_motion_formats() { return known_formats; }

Result<void> check_fps(double fps) {
  if (fps >= kMinFps && fps <= kMaxFps) return {};
  char found[32];
  std::snprintf(found, sizeof found, "%g", fps);
  return Error{std::string("expected a rate of 0.01 to 10000 frames a second, found ") + found};
}

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                const ReadOptions& options) {
  return read_motion(path, known_formats, options);
}

}  // namespace panache
