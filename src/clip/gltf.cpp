#include "clip/gltf.h"

#include <cassert>
#include <utility>

#include "clip/deform_skeleton.h"
#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"
#include "clip/gltf_figure.h"

namespace panache {
namespace {

class GltfFile final : public MotionFile {
 public:
  GltfFile(GltfDocument document, bool one_motion)
      : document_(std::move(document)), one_motion_(one_motion) {}

  std::vector<std::string> clip_names() const override {
    std::vector<std::string> names;
    names.reserve(document_.animations.size());
    for (const GltfAnimation& animation : document_.animations) names.push_back(animation.name);
    return names;
  }
  std::vector<std::string> notes() const override { return document_.notes; }
  bool is_mended() const override { return !document_.notes.empty(); }
  const Clip& clip(int which) const override {
    assert(which >= 0);
    if (document_.animations.empty()) return document_.rest;
    return document_.animations[which].clip;
  }
  Clip rest() const override {
    Clip out = document_.rest;
    for (Joint& joint : out.skeleton.joints) joint.can_translate = joint.can_rotate;
    return out;
  }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    return encode_gltf(document_, edits, one_motion_ ? EditMode::replace : mode);
  }

 private:
  GltfDocument document_;
  bool one_motion_;
};

Result<GltfDocument> read_once(std::string bytes, const std::string& name,
                               std::optional<double> fps) {
  GltfChecker checker(name);
  GltfDocument document;
  if (!read_gltf_container(std::move(bytes), name, checker, document.container)) {
    return checker.error();
  }
  // Packed meshes alone stay packed in the output.
  std::optional<GltfContainer> plain;
  if (has_packed_data(document.container)) {
    const bool is_needed = has_packed_motion(document.container);
    GltfChecker unpacking(name);
    GltfContainer unpacked;
    if (unpack_gltf(document.container, unpacking, unpacked)) {
      (is_needed ? document.container : plain.emplace()) = std::move(unpacked);
    } else if (is_needed) {
      return unpacking.error();
    }
  }
  if (!read_gltf_nodes(document, checker) || !read_gltf_channels(document, checker)) {
    return checker.error();
  }
  read_gltf_weights(plain ? *plain : document.container, document);
  if (!build_gltf_skeleton(document, checker) || !read_gltf_clips(document, checker, fps)) {
    return checker.error();
  }
  return document;
}

// If keys need other times, rewrites them and reads the file again.
Result<GltfDocument> read_document(std::string bytes, const std::string& name,
                                   const ReadOptions& options) {
  Result<GltfDocument> document = read_once(std::move(bytes), name, {});
  if (!document) return document;
  RetimedGltf retimed;
  GltfChecker checker(name);
  if (!retime_gltf(*document, options.fps, name, checker, retimed)) return checker.error();
  if (retimed.bytes.empty()) return document;
  document = read_once(std::move(retimed.bytes), name, options.fps);
  if (document) document->notes = std::move(retimed.notes);
  return document;
}

std::unique_ptr<MotionFile> make_file(GltfDocument document, bool one_motion) {
  return std::make_unique<GltfFile>(std::move(document), one_motion);
}

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_gltf(std::string bytes, const std::string& name,
                                               const ReadOptions& options) {
  Result<GltfDocument> document = read_document(std::move(bytes), name, options);
  if (!document) return document.error();
  return join_deforming_joints(make_file(*std::move(document), false));
}

Result<std::string> whole_character(
    std::string bytes, const std::string& name, bool completes_skin,
    const std::function<std::optional<SkinnedBody>(const MotionFile&)>& make_body) {
  Result<GltfDocument> document = read_document(bytes, name, {});
  if (!document) return document.error();
  const auto skins = document->container.json.find("skins");
  if (skins != document->container.json.end() && skins->size() == 1) {
    return completes_skin ? with_whole_skin(*document) : bytes;
  }
  if (!lacks_figure(*document)) return bytes;
  const GltfFile file(*document, false);
  const std::optional<SkinnedBody> body = make_body(file);
  return with_figure(*document, body ? &*body : nullptr);
}

Result<std::unique_ptr<MotionFile>> parse_vrma(std::string bytes, const std::string& name,
                                               const ReadOptions& options) {
  Result<GltfDocument> document = read_document(std::move(bytes), name, options);
  if (!document) return document.error();
  const GltfJson::json_pointer hips("/extensions/VRMC_vrm_animation/humanoid/humanBones/hips/node");
  if (!document->container.json.contains(hips)) {
    return Error{name +
                 ": extensions.VRMC_vrm_animation: expected a humanoid with hips, found none; a "
                 "file without it is a .glb"};
  }
  const std::vector<Vec3> offsets = t_pose_offsets(document->rest);
  stand_in_t_pose(offsets, document->rest);
  for (GltfAnimation& animation : document->animations) stand_in_t_pose(offsets, animation.clip);
  return make_file(*std::move(document), true);
}

}  // namespace panache
