#include "formats.h"

#include <vector>

#include "clip/gltf.h"
#include "fbx.h"
#include "glb.h"
#include "input.h"
#include "messages.h"
#include "rig/up_axis.h"

namespace panache::cli {
namespace {

Result<std::unique_ptr<MotionFile>> read_fbx(const std::string& path) {
  Result<std::string> glb = fbx_to_glb(path);
  if (!glb) return glb.error();
  return parse_gltf(*std::move(glb), path);
}

constexpr MotionFormat kFbx = {
    .extension = ".fbx", .read = read_fbx, .encoded_as = ".glb", .fits_into = ".glb"};

// The extensions of the writable formats, the first `skipped` letters left out.
std::string list_without(size_t skipped) {
  std::string list;
  for (const MotionFormat& format : formats()) {
    if (!format.write) continue;
    list += (list.empty() ? "" : " or ") + std::string(format.extension.substr(skipped));
  }
  return list;
}

}  // namespace

std::span<const MotionFormat> formats() {
  static const std::vector<MotionFormat> all = [] {
    std::vector<MotionFormat> list(motion_formats().begin(), motion_formats().end());
    list.push_back(kFbx);
    return list;
  }();
  return all;
}

bool keeps_format(const std::string& input, const std::string& output) {
  if (input == output) return true;
  const MotionFormat* format = find_format(formats(), input);
  return format && !format->fits_into.empty() && format->fits_into == output;
}

Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output) {
  if (extension_of(input) != ".gltf" || extension_of(output) != ".glb") return bytes;
  return gltf_to_glb(bytes, input);
}

bool must_be_encoded(const std::string& extension) {
  const MotionFormat* format = find_format(formats(), extension);
  return format && (!format->in_one_file || format->encoded_as != format->extension);
}

std::string list_writable() { return list_without(0); }
std::string list_writable_names() { return list_without(1); }

bool is_writable(const std::string& extension) {
  const MotionFormat* format = find_format(formats(), extension);
  return format && format->write;
}

Result<void> check_format(const std::string& input, const std::string& output) {
  const std::string from = extension_of(input), to = extension_of(output);
  const MotionFormat* format = find_format(formats(), from);
  if (!format || is_writable(to)) return {};  // Opening the input says what is wrong.
  const bool has_own = format->encoded_as == format->extension;
  if (has_own && to == from) return {};
  return Error{output + ": expected a name that ends in " +
               (has_own && !format->write ? from + ", " : "") + list_writable() +
               ", or a folder (with a '/' at its end)"};
}

Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output) {
  if (clips.size() == 1 || keeps_format(extension_of(input), extension_of(output))) return {};
  return Error{input + ": holds " + plural(clips.size(), "motion") + " (" + list_clips(file) +
               ") and " + output + " takes one; --clip NAME picks it"};
}

Placement placement_of(const Rig& rig) { return {rig.scale(), *turn_up(rig.up_axis())}; }

Placement placement_of(const RigOptions& options) {
  return {options.metres_per_unit.value_or(1),
          turn_up(options.up_axis.value_or("+Y")).value_or(Quat{})};
}

std::string format_clip(const Clip& clip, const std::string& name, const Placement& placement,
                        const std::string& extension) {
  return find_format(formats(), extension)->write(clip, name, placement);
}

}  // namespace panache::cli
