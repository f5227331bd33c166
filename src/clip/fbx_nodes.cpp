#include "clip/fbx_nodes.h"

#include <algorithm>
#include <cmath>

#include "clip/fbx_document.h"
#include "clip/fbx_encode.h"

namespace panache {
namespace {

// Where InheritType leaves the scale of the parent out, the node undoes it.
FbxTransform transform(const FbxDocument& document, const FbxStack* stack, size_t which,
                       int64_t time) {
  const FbxModel& model = document.models[which];
  const auto place = [&](size_t m) {
    return stack ? stack->place(document, m, time) : document.models[m].place;
  };
  const FbxLocal local = model.local(place(which));
  FbxTransform out{local.translation, local.rotation, local.scale};
  if (model.inherit != FbxModel::Inherit::Rrs || model.parent < 0) return out;
  const Vec3d above = place(static_cast<size_t>(model.parent)).parts[kFbxScale];
  const auto undo = [](double size, double by) { return std::abs(by) > 1e-9 ? size / by : size; };
  out.scale = {undo(out.scale.x, above.x), undo(out.scale.y, above.y), undo(out.scale.z, above.z)};
  return out;
}

}  // namespace

Result<FbxScene> read_fbx_scene(std::string bytes, const std::string& name) {
  const Result<FbxDocument> document = read_fbx_document(std::move(bytes), name, {});
  if (!document) return document.error();
  FbxScene out;
  out.to_y_up = document->settings.to_y_up();
  out.metres = document->settings.centimetres / 100;
  out.has_meshes = document->has_meshes;
  for (size_t m = 0; m < document->models.size(); ++m) {
    const FbxModel& model = document->models[m];
    const FbxLocal& geometry = model.geometry;
    out.nodes.push_back({model.name,
                         model.file_name,
                         model.parent,
                         transform(*document, nullptr, m, 0),
                         {geometry.translation, geometry.rotation, geometry.scale}});
  }
  for (const FbxStack& stack : document->stacks) {
    FbxSceneMotion& motion = out.motions.emplace_back();
    motion.name = stack.name;
    motion.frame_time = stack.clip.frame_time;
    for (size_t m = 0; m < document->models.size(); ++m) {
      const FbxModel& model = document->models[m];
      const auto animates = [&](size_t which) {
        return stack.animates(which, kFbxTranslation) || stack.animates(which, kFbxRotation) ||
               stack.animates(which, kFbxScale);
      };
      const bool follows = model.inherit == FbxModel::Inherit::Rrs && model.parent >= 0 &&
                           stack.animates(static_cast<size_t>(model.parent), kFbxScale);
      if (!animates(m) && !follows) continue;
      std::vector<FbxTransform>& frames = motion.frames[m];
      for (int f = 0; f < stack.clip.frames; ++f) {
        frames.push_back(transform(*document, &stack, m, stack.time_of(f)));
      }
    }
  }
  return out;
}

Result<std::string> fbx_without_motions(std::string bytes, const std::string& name) {
  const Result<FbxDocument> document = read_fbx_document(std::move(bytes), name, {});
  if (!document) return document.error();
  return document->is_version_6() ? document->tree.bytes() : encode_still_fbx(*document);
}

}  // namespace panache
