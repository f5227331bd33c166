#include "formats.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"
#include "clip/gltf.h"
#include "clip/smpl.h"
#include "fbx.h"
#include "glb.h"
#include "input.h"
#include "messages.h"
#include "npz.h"
#include "retarget/reference_pose.h"
#include "retarget/retarget.h"
#include "rig/body_mesh.h"
#include "rig/body_motions.h"
#include "rig/figures.h"

namespace panache::cli {
namespace {

// A file with additional notes from its reader.
class NotedFile : public MotionFile {
 public:
  NotedFile(std::unique_ptr<MotionFile> file, std::vector<std::string> notes)
      : file_(std::move(file)), notes_(std::move(notes)) {}

  std::vector<std::string> clip_names() const override { return file_->clip_names(); }
  const Clip& clip(int which) const override { return file_->clip(which); }
  Clip rest() const override { return file_->rest(); }
  std::vector<std::string> notes() const override {
    std::vector<std::string> all = notes_;
    const std::vector<std::string> own = file_->notes();
    all.insert(all.end(), own.begin(), own.end());
    return all;
  }
  bool is_mended() const override { return file_->is_mended(); }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    return file_->encode(edits, mode);
  }

 private:
  std::unique_ptr<MotionFile> file_;
  std::vector<std::string> notes_;
};

// Formats with their own body in T-pose, to which a motion has to be retargeted.
struct OwnBody {
  std::string_view extension;
  Clip (*make)(const Clip& clip, const Rig& rig);
  RetargetOptions retarget_options;
};
constexpr OwnBody kOwnBodies[] = {
    // Arms and legs are as long as the rig's, so directions alone place feet and hands.
    {".vrma", t_pose_body, {.feet = false, .hands = false}},
    {".npz", [](const Clip&, const Rig&) { return smpl_body(); }, {}},
};

std::string write_vrma(const Clip& clip, const std::string& name, const Placement&,
                       const SkinnedBody*) {
  return format_vrma(clip, name);
}

const MotionFormat kNpz = {.extension = ".npz",
                           .parse = parse_npz,
                           .write = kWriteNpz,
                           .encoded_as = ".npz",
                           .one_motion = true};

// The extensions of the writable formats, each without its first `skipped` letters.
std::string list_without(size_t skipped) {
  std::vector<std::string> names;
  for (const MotionFormat& format : formats()) {
    if (format.write) names.emplace_back(format.extension.substr(skipped));
  }
  return one_of(names);
}

// The format for an extension; one without functions if the extension is unknown.
const MotionFormat& format_of(std::string_view extension) {
  static constexpr MotionFormat kNone;
  const MotionFormat* format = find_format(formats(), extension);
  return format ? *format : kNone;
}

// A body with the proportions of the rig of `clip`.
SkinnedBody body_of(const Rig& rig, const Clip& clip) {
  return make_rig_body(rig, clip.pose(std::min(rig.first_frame(), clip.frames - 1)));
}

// The motion retargeted to the format's body.
Result<Clip> put_on(const OwnBody& own, const Clip& clip, const Rig& rig) {
  const Clip body = own.make(clip, rig);
  Result<Rig> onto = Rig::create(body);
  if (!onto) return onto.error();
  Result<Retargeted> done = retarget(clip, rig, body, *onto, own.retarget_options);
  if (!done) return done.error();
  return std::move(done->clip);
}

}  // namespace

std::span<const MotionFormat> formats() {
  static const std::vector<MotionFormat> all = [] {
    std::vector<MotionFormat> list(motion_formats().begin(), motion_formats().end());
    for (MotionFormat& format : list) {
      if (format.extension == ".vrma") format.write = write_vrma;
      if (format.extension == ".fbx") format.fits_into = ".glb";  // See open_motion().
    }
    list.push_back(kNpz);
    return list;
  }();
  return all;
}

bool keeps_format(const std::string& input, const std::string& output) {
  const std::string_view fits_into = format_of(input).fits_into;
  return input == output || (!fits_into.empty() && fits_into == output);
}

Result<std::string> in_container(std::string bytes, const std::string& input,
                                 const std::string& output, const RigOptions& rig, bool no_body) {
  if (extension_of(output) != ".glb") return bytes;
  if (extension_of(input) == ".gltf") {
    Result<std::string> glb = gltf_to_glb(bytes, input);
    if (!glb) return glb;
    bytes = *std::move(glb);
  }
  // A skin that another program made for glTF is left as it is.
  const bool is_fbx = extension_of(input) == ".fbx";
  return whole_character(std::move(bytes), input, is_fbx, [&](const MotionFile& file) {
    std::optional<SkinnedBody> body;
    const bool moves = !file.clip_names().empty();
    const Clip* motion = moves ? &file.clip(first_body_motion(file, rig)) : nullptr;
    if (no_body) return body;
    const Result<std::pair<Clip, Rig>> found = find_body(file.rest(), motion, rig);
    if (found) body = body_of(found->second, found->first);
    return body;
  });
}

bool must_be_encoded(const std::string& extension) {
  const MotionFormat& format = format_of(extension);
  return !format.in_one_file || format.encoded_as != format.extension;
}

std::string list_writable_names() { return list_without(1); }

bool has_writer(const std::string& extension) { return format_of(extension).write; }

bool becomes_glb(const std::string& input, const std::string& output) {
  return extension_of(input) == ".fbx" && extension_of(output) == ".glb";
}

Result<std::unique_ptr<MotionFile>> read_fbx_as_glb(const std::string& path,
                                                    const ReadOptions& options) {
  Result<FbxAsGlb> fbx = fbx_to_glb(path);
  if (!fbx) return fbx.error();
  Result<std::unique_ptr<MotionFile>> file = parse_gltf(std::move(fbx->glb), path, options);
  if (!file || fbx->notes.empty()) return file;
  return std::unique_ptr<MotionFile>(
      std::make_unique<NotedFile>(*std::move(file), std::move(fbx->notes)));
}

Result<void> check_format(const std::string& input, const std::string& output) {
  const std::string from = extension_of(input), to = extension_of(output);
  const MotionFormat* format = find_format(formats(), from);
  if (!format || has_writer(to)) return {};  // Opening the input reports what is wrong.
  const bool has_own = format->encoded_as == format->extension;
  if (has_own && to == from) return {};
  return Error{output + ": expected a name that ends in " +
               (has_own && !format->write ? from + ", " : "") + list_without(0) +
               ", or a folder (with a '/' at its end)"};
}

Result<void> check_fits(const MotionFile& file, std::span<const int> clips,
                        const std::string& input, const std::string& output) {
  if (clips.size() == 1 || keeps_format(extension_of(input), extension_of(output))) return {};
  return Error{input + ": holds " + plural(clips.size(), "motion") + " (" +
               list_clips(file, clips) + ") and " + output + " takes one; --clip NAME picks it"};
}

Placement placement_of(const Rig& rig) { return {rig.unit(), *turn_up(rig.up_axis())}; }

Placement placement_of(const RigOptions& options) {
  return {options.metres_per_unit.value_or(1),
          turn_up(options.up_axis.value_or("+Y")).value_or(Quat{})};
}

bool holds_humanoids(const std::string& extension) {
  return std::any_of(std::begin(kOwnBodies), std::end(kOwnBodies),
                     [&](const OwnBody& own) { return own.extension == extension; });
}

bool holds_one_motion(const std::string& extension) { return format_of(extension).one_motion; }

Result<std::string> format_clip(const Clip& clip, const Rig* rig, const std::string& name,
                                const Placement& placement, const std::string& extension,
                                bool no_body) {
  const MotionFormat* format = find_format(formats(), extension);
  for (const OwnBody& own : kOwnBodies) {
    if (own.extension != extension) continue;
    assert(rig);
    Result<Clip> put = put_on(own, clip, *rig);
    if (!put) return put.error();
    return format->write(*put, name, {}, nullptr);
  }
  if (!rig || !format->has_meshes || no_body) {
    return format->write(clip, name, placement, nullptr);
  }
  const SkinnedBody body = body_of(*rig, clip);
  return format->write(clip, name, placement, &body);
}

}  // namespace panache::cli
