#include "clip/gltf.h"

#include <cassert>
#include <utility>

#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"

namespace panache {
namespace {

class GltfFile final : public MotionFile {
 public:
  explicit GltfFile(GltfDocument document) : document_(std::move(document)) {}

  std::vector<std::string> clip_names() const override {
    std::vector<std::string> names;
    for (const GltfAnimation& animation : document_.animations) names.push_back(animation.name);
    return names;
  }
  const Clip& clip(int which) const override {
    assert(which >= 0);
    if (document_.animations.empty()) return document_.rest;
    return document_.animations[static_cast<size_t>(which)].clip;
  }
  Clip rest() const override {
    Clip out = document_.rest;
    for (Joint& joint : out.skeleton.joints) joint.can_translate = joint.can_rotate;
    return out;
  }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    return encode_gltf(document_, edits, mode);
  }

 private:
  GltfDocument document_;
};

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_gltf(std::string bytes, const std::string& name) {
  GltfChecker checker(name);
  GltfDocument document;
  if (!read_gltf_container(std::move(bytes), name, checker, document.container) ||
      !read_gltf_nodes(document, checker) || !read_gltf_channels(document, checker) ||
      !build_gltf_skeleton(document, checker) || !read_gltf_clips(document, checker)) {
    return checker.error();
  }
  return std::unique_ptr<MotionFile>(std::make_unique<GltfFile>(std::move(document)));
}

}  // namespace panache
