#include "clip/fbx.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "clip/deform_tree.h"
#include "clip/fbx_document.h"
#include "clip/fbx_encode.h"

namespace panache {
namespace {

class FbxFile final : public MotionFile {
 public:
  explicit FbxFile(FbxDocument document) : document_(std::move(document)) {}

  std::vector<std::string> clip_names() const override {
    std::vector<std::string> names;
    for (const FbxStack& stack : document_.stacks) names.push_back(stack.name);
    return names;
  }
  std::vector<std::string> notes() const override { return document_.notes; }
  const Clip& clip(int which) const override {
    assert(which >= 0);
    return document_.stacks.empty() ? document_.rest
                                    : document_.stacks[static_cast<size_t>(which)].clip;
  }
  Clip rest() const override {
    Clip out = document_.rest;
    for (Joint& joint : out.skeleton.joints) joint.can_translate = true;
    return out;
  }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    if (edits.empty()) return document_.tree.bytes();
    return document_.is_version_6() ? encode_fbx6(document_, edits, mode)
                                    : encode_fbx(document_, edits, mode);
  }

 private:
  FbxDocument document_;
};

}  // namespace

bool FbxDocument::is_version_6() const {
  if (tree.version() >= 7000) return false;
  // A file that does not state its version has numbers as IDs from 7 on.
  return tree.version() > 0 || !std::ranges::any_of(models, [](const FbxModel& model) {
           return model.node->values.size() > 2;
         });
}

Result<FbxDocument> read_fbx_document(std::string bytes, const std::string& name,
                                      std::optional<double> fps) {
  Result<FbxTree> tree = FbxTree::parse(std::move(bytes), name);
  if (!tree) return tree.error();
  FbxDocument document(*std::move(tree));
  if (auto good = read_fbx_models(document); !good) return good.error();
  const auto read = document.is_version_6() ? read_fbx6_takes : read_fbx_stacks;
  if (auto good = read(document); !good) return good.error();
  if (auto good = read_fbx_clips(document, fps); !good) return good.error();
  return document;
}

Result<std::unique_ptr<MotionFile>> parse_fbx(std::string bytes, const std::string& name,
                                              const ReadOptions& options) {
  Result<FbxDocument> document = read_fbx_document(std::move(bytes), name, {});
  if (!document) return document.error();
  if (options.fps && !document->stacks.empty()) {
    if (auto good = check_fps(*options.fps); !good) return located(name, good.error());
    std::vector<double> factors;
    for (const FbxStack& stack : document->stacks) {
      factors.push_back(1 / *options.fps / stack.clip.frame_time);
    }
    if (document->is_version_6()) {
      for (FbxStack& stack : document->stacks) stack.clip.frame_time = 1 / *options.fps;
    } else {
      document =
          read_fbx_document(retime_fbx(*document, factors, *options.fps), name, *options.fps);
      if (!document) return document.error();
    }
  }
  if (document->is_version_6() && document->has_meshes) {
    document->notes.push_back(
        name +
        ": is FBX 6, which is written as FBX 7 with skeleton and motions but without its meshes; "
        "Autodesk's FBX Converter makes FBX 7 of it, which keeps them");
  }
  return join_deforming_joints(std::make_unique<FbxFile>(*std::move(document)));
}

}  // namespace panache
