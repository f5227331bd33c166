#include "clip/fbx_nodes.h"

#include <algorithm>
#include <cmath>

#include "clip/affine.h"
#include "clip/fbx_document.h"
#include "clip/fbx_encode.h"

namespace panache {
namespace {

Affine linear(Quatd rotation, Vec3d scale = {1, 1, 1}) { return affine(rotation, {}, scale); }

bool has_inverse(const Affine& m) {
  const auto& [x, y, z] = m.columns;
  const double max = std::max({length(x), length(y), length(z)});
  return std::abs(dot(cross(x, y), z)) > 1e-9 * max * max * max && max > 1e-6;
}

Vec3d signs_of(Vec3d v) {
  return {v.x < 0 ? -1.0 : 1.0, v.y < 0 ? -1.0 : 1.0, v.z < 0 ? -1.0 : 1.0};
}

// The rotation nearest to a matrix whose determinant is above 0: its polar factor, by Newton's
// iteration (Higham 1986).
Affine nearest_rotation(Affine m) {
  for (int step = 0; step < 20; ++step) {
    const Affine back = inverse(m);
    const Affine across = {{Vec3d{back.columns[0].x, back.columns[1].x, back.columns[2].x},
                            Vec3d{back.columns[0].y, back.columns[1].y, back.columns[2].y},
                            Vec3d{back.columns[0].z, back.columns[1].z, back.columns[2].z}},
                           {}};
    for (size_t c = 0; c < 3; ++c) m.columns[c] = (m.columns[c] + across.columns[c]) * 0.5;
  }
  return m;
}

// Finds transforms of nodes such that each is where InheritType places it. Programs that show nodes
// multiply their transforms, which leaves out shear: a node below one that scales its axes
// differently has the rotation and scale nearest to its own, and the place of its own.
class NodePlacer {
 public:
  NodePlacer(const FbxDocument& document, const FbxStack* stack)
      : document_(document),
        stack_(stack),
        turns_(document.models.size()),
        right_(turns_.size()),
        shown_(turns_.size()),
        channels_(turns_.size()),
        exact_(turns_.size()),
        even_(turns_.size()) {}

  // For a model after its parent, at the same time.
  FbxTransform transform(size_t which, int64_t time) {
    const FbxModel& model = document_.models[which];
    channels_[which] = stack_ ? stack_->channels(document_, which, time) : model.channels;
    const FbxLocal local = model.local(channels_[which]);
    FbxTransform out{local.translation, local.rotation, local.scale};
    const Affine own = linear(local.rotation, local.scale);
    turns_[which] = local.rotation;
    right_[which] = shown_[which] = own;
    exact_[which] = 1;
    even_[which] = is_even(local.scale);
    if (model.parent < 0) return out;
    const auto parent = static_cast<size_t>(model.parent);
    turns_[which] = normalized(turns_[parent] * local.rotation);
    right_[which] = inherited(model, local);
    const bool is_product = model.inherit == FbxModel::Inherit::RSrs;
    exact_[which] = exact_[parent];
    if (even_[parent]) {
      out.scale = scale_of(model, local);
    } else if ((!is_product || !exact_[parent]) && has_inverse(shown_[parent])) {
      fit(which, local, out);
    }
    even_[which] = even_[parent] && is_even(out.scale);
    shown_[which] = shown_[parent] * linear(out.rotation, out.scale);
    return out;
  }

 private:
  static bool is_even(Vec3d scale) { return scale.x == scale.y && scale.y == scale.z; }
  // Without that of the parent where it is not inherited.
  Vec3d scale_of(const FbxModel& model, const FbxLocal& local) const {
    if (model.inherit != FbxModel::Inherit::Rrs) return local.scale;
    const Vec3d above = channels_[static_cast<size_t>(model.parent)].parts[kFbxScale];
    const auto undo = [](double size, double by) { return std::abs(by) > 1e-9 ? size / by : size; };
    return {undo(local.scale.x, above.x), undo(local.scale.y, above.y),
            undo(local.scale.z, above.z)};
  }

  // See FbxPoser::add_joint().
  Affine inherited(const FbxModel& model, const FbxLocal& local) const {
    const auto parent = static_cast<size_t>(model.parent);
    if (model.inherit == FbxModel::Inherit::RSrs) {
      return right_[parent] * linear(local.rotation, local.scale);
    }
    const Affine stretch = linear(conjugate(turns_[parent])) * right_[parent];
    return linear(turns_[parent] * local.rotation) * stretch * linear({}, scale_of(model, local));
  }

  void fit(size_t which, const FbxLocal& local, FbxTransform& out) {
    constexpr double kSame = 1e-9;
    const auto parent = static_cast<size_t>(document_.models[which].parent);
    const Affine up = inverse(shown_[parent]);
    if (!exact_[parent]) out.translation = up.turn(right_[parent].turn(local.translation));
    const Affine wanted = linear(conjugate(local.rotation)) * up * right_[which];
    const Vec3d sign = signs_of({wanted.columns[0].x, wanted.columns[1].y, wanted.columns[2].z});
    const Affine positive = wanted * linear({}, sign);
    const bool can_turn =
        has_inverse(positive) &&
        dot(cross(positive.columns[0], positive.columns[1]), positive.columns[2]) > 0;
    const Affine turn = can_turn ? nearest_rotation(positive) : Affine{};
    const Vec3d scale = {dot(turn.columns[0], positive.columns[0]),
                         dot(turn.columns[1], positive.columns[1]),
                         dot(turn.columns[2], positive.columns[2])};
    out.rotation =
        normalized(local.rotation * from_axes(turn.columns[0], turn.columns[1], turn.columns[2]));
    out.scale = {scale.x * sign.x, scale.y * sign.y, scale.z * sign.z};
    exact_[which] = 1;
    for (size_t c = 0; c < 3; ++c) {
      const Vec3d off = positive.columns[c] - turn.columns[c] * scale[c];
      if (length(off) > kSame * length(positive.columns[c])) exact_[which] = 0;
    }
  }

  const FbxDocument& document_;
  const FbxStack* stack_;
  std::vector<Quatd> turns_;   // The product of the rotations.
  std::vector<Affine> right_;  // The linear part that FBX wants,
  std::vector<Affine> shown_;  // and that the product of transforms gives.
  std::vector<FbxChannels> channels_;
  std::vector<char> exact_;  // Whether both are equal.
  std::vector<char> even_;   // Whether all scales have been the same on all axes.
};

// The models that a motion moves, and how.
class MovedModels {
 public:
  MovedModels(const FbxDocument& document, const FbxStack& stack)
      : document_(document), stack_(stack), kinds_(document.models.size()), needed_(kinds_.size()) {
    std::vector<char> depends(kinds_.size()), moves(kinds_.size());
    size_t further = 0;
    for (size_t m = 0; m < kinds_.size(); ++m) {
      const FbxModel& model = document.models[m];
      const bool is_below = model.parent >= 0;
      const size_t parent = is_below ? static_cast<size_t>(model.parent) : m;
      const bool is_product = model.inherit == FbxModel::Inherit::RSrs;
      depends[m] = is_below && (!is_product || depends[parent]);
      const bool is_animated = stack.animates(m, kFbxScale) || stack.animates(m, kFbxTranslation) ||
                               stack.animates(m, kFbxRotation);
      moves[m] = is_animated || (is_below && moves[parent]);
      if (is_animated) {
        kinds_[m] = model.joint >= 0 ? Kind::moved : Kind::set;
      } else if (depends[m] && moves[m]) {
        further += model.joint < 0;
        kinds_[m] = Kind::follows;
      }
    }
    // Those that are no joints take no bytes of curves (fbx_max_poses()).
    const auto max = static_cast<double>(fbx_max_poses(document.tree.bytes().size()));
    if (static_cast<double>(further) * stack.clip.frames > max) keep_joints();
    for (size_t m = kinds_.size(); m-- > 0;) {
      const int parent = document.models[m].parent;
      if (kinds_[m] == Kind::moved || kinds_[m] == Kind::follows) needed_[m] = 1;
      if (needed_[m] && parent >= 0) needed_[static_cast<size_t>(parent)] = 1;
    }
  }

  // nodes: as the file was saved.
  FbxSceneMotion motion(const std::vector<FbxSceneNode>& nodes) const {
    FbxSceneMotion out;
    out.name = stack_.name;
    out.frame_time = stack_.clip.frame_time;
    NodePlacer placer(document_, &stack_);
    for (int f = 0; f < stack_.clip.frames; ++f) {
      for (size_t m = 0; m < kinds_.size(); ++m) {
        if (f > 0 && !needed_[m]) continue;
        const FbxTransform now = placer.transform(m, stack_.time_of(f));
        if (kinds_[m] != Kind::still && (f == 0 || kinds_[m] != Kind::set)) {
          out.frames[m].push_back(now);
        }
      }
    }
    std::erase_if(out.frames, [&](const auto& frames) {
      return kinds_[frames.first] == Kind::follows &&
             std::ranges::all_of(frames.second, [&](const FbxTransform& now) {
               return is_same(now, nodes[frames.first].local);
             });
    });
    return out;
  }

 private:
  // Set: by curves that do not change, as the model is no joint. Follows: may depend on what moves
  // above it.
  enum class Kind { still, set, follows, moved };

  static bool is_same(const FbxTransform& a, const FbxTransform& b) {
    constexpr double kSame = 1e-9;
    return length(a.translation - b.translation) <= kSame * (1 + length(b.translation)) &&
           length((conjugate(a.rotation) * b.rotation).xyz()) <= kSame &&
           length(a.scale - b.scale) <= kSame * (1 + length(b.scale));
  }
  void keep_joints() {
    for (size_t m = 0; m < kinds_.size(); ++m) {
      if (document_.models[m].joint < 0 && kinds_[m] == Kind::follows) kinds_[m] = Kind::still;
    }
  }

  const FbxDocument& document_;
  const FbxStack& stack_;
  std::vector<Kind> kinds_;   // [models]
  std::vector<char> needed_;  // Those that move, and all above.
};

}  // namespace

Result<FbxScene> read_fbx_scene(std::string bytes, const std::string& name) {
  const Result<FbxDocument> document = read_fbx_document(std::move(bytes), name, {});
  if (!document) return document.error();
  FbxScene out;
  out.to_y_up = document->settings.to_y_up();
  out.metres = document->settings.centimetres / 100;
  out.has_meshes = document->has_meshes;
  NodePlacer placer(*document, nullptr);
  for (size_t m = 0; m < document->models.size(); ++m) {
    const FbxModel& model = document->models[m];
    const FbxLocal& geometry = model.geometry;
    out.nodes.push_back({model.name,
                         model.file_name,
                         model.parent,
                         placer.transform(m, 0),
                         {geometry.translation, geometry.rotation, geometry.scale}});
  }
  for (const FbxStack& stack : document->stacks) {
    out.motions.push_back(MovedModels(*document, stack).motion(out.nodes));
  }
  return out;
}

Result<std::string> fbx_without_motions(std::string bytes, const std::string& name) {
  const Result<FbxDocument> document = read_fbx_document(std::move(bytes), name, {});
  if (!document) return document.error();
  return document->is_version_6() ? document->tree.bytes() : encode_still_fbx(*document);
}

}  // namespace panache
