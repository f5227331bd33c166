#include "clip/deform_tree.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace panache {
namespace {

// A clip of the file, on the joints of the tree.
Clip on_tree(const Clip& clip, const DeformTree& tree) {
  Clip out;
  out.frame_time = clip.frame_time;
  const auto local = [&](const std::vector<Placed>& placed, size_t j) {
    const Placed& own = placed[tree.joints[j]];
    if (tree.parents[j] < 0) return own;
    const auto above = static_cast<size_t>(tree.joints[tree.parents[j]]);
    return Placed{normalized(conjugate(placed[above].rotation) * own.rotation),
                  seen_from(placed[above], own.position)};
  };
  const Clip rest = rest_clip(clip.skeleton);
  const std::vector<Placed> at_rest = world_joints(clip.skeleton, rest.pose(0));
  for (size_t j = 0; j < tree.joints.size(); ++j) {
    Joint joint = clip.skeleton.joints[tree.joints[j]];
    joint.parent = tree.parents[j];
    joint.can_translate = joint.parent < 0 && joint.can_rotate;
    joint.unkeyed = false;  // Joints that are not in this tree may move it.
    const Placed placed = local(at_rest, j);
    joint.rest = placed.rotation;
    joint.offset = placed.position;
    out.skeleton.joints.push_back(std::move(joint));
  }
  out.resize(clip.frames);
  for (int f = 0; f < clip.frames; ++f) {
    const std::vector<Placed> placed = world_joints(clip.skeleton, clip.pose(f));
    const Pose pose = out.pose(f);
    for (size_t j = 0; j < tree.joints.size(); ++j) {
      const Placed now = local(placed, j);
      pose.rotations[j] = now.rotation;
      pose.translations[j] = now.position;
    }
  }
  mark_still_joints(out);
  return out;
}

class JoinedFile final : public MotionFile {
 public:
  JoinedFile(std::unique_ptr<MotionFile> file, DeformTree tree)
      : file_(std::move(file)), tree_(std::move(tree)), own_rest_(file_->rest()) {
    const size_t count = std::max<size_t>(1, file_->clip_names().size());
    for (size_t i = 0; i < count; ++i) {
      clips_.push_back(on_tree(file_->clip(static_cast<int>(i)), tree_));
    }
    rest_ = on_tree(own_rest_, tree_);
  }

  std::vector<std::string> clip_names() const override { return file_->clip_names(); }
  const Clip& clip(int which) const override { return clips_[which]; }
  Clip rest() const override { return rest_; }
  std::vector<std::string> notes() const override { return file_->notes(); }
  bool is_mended() const override { return file_->is_mended(); }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    std::vector<Clip> changed;
    changed.reserve(edits.size());
    std::vector<ClipEdit> own;
    for (const ClipEdit& edit : edits) {
      changed.push_back(in_file(edit));
      own.push_back(edit);
      own.back().changed = &changed.back();
    }
    return file_->encode(own, mode);
  }

 private:
  // An edited clip, on the file's own skeleton.
  Clip in_file(const ClipEdit& edit) const {
    const bool is_new = edit.clip == kNewClip;
    const Clip& before = is_new ? own_rest_ : file_->clip(edit.clip);
    const Clip& joined = is_new ? rest_ : clip(edit.clip);
    Clip out;
    out.skeleton = before.skeleton;
    out.frame_time = edit.changed->frame_time;
    out.resize(edit.changed->frames);
    std::vector<Quat> rotations(joined.joints());
    std::vector<Vec3> translations(joined.joints());
    const Pose joined_before{rotations, translations};
    for (int f = 0; f < out.frames; ++f) {
      const double source = is_new ? 0 : edit.source_frames[f];
      sample(before, source, out.pose(f));
      sample(joined, source, joined_before);
      write_frame(edit.changed->pose(f), joined_before, out.skeleton, out.pose(f));
    }
    return out;
  }

  // `pose` is initially the file's frame. From the first joint that differs from `joined_before`
  // down the tree, joints move to where `joined` has them.
  void write_frame(ConstPose joined, ConstPose joined_before, const Skeleton& skeleton,
                   Pose pose) const {
    const size_t count = tree_.joints.size();
    std::vector<Placed> wanted(count);
    std::vector<int> place_in_tree(skeleton.joints.size(), -1);
    bool any = false;
    for (size_t j = 0; j < count; ++j) {
      const int parent = tree_.parents[j];
      wanted[j] = below(parent < 0 ? Placed{} : wanted[parent], joined.rotations[j],
                        joined.translations[j]);
      place_in_tree[tree_.joints[j]] = static_cast<int>(j);
      any = any || !(joined.rotations[j] == joined_before.rotations[j]) ||
            !(joined.translations[j] == joined_before.translations[j]);
    }
    if (!any) return;
    std::vector<Placed> placed(skeleton.joints.size());
    for (size_t j = 0; j < placed.size(); ++j) {
      const int up = skeleton.joints[j].parent, in_tree = place_in_tree[j];
      const Placed parent = up < 0 ? Placed{} : placed[up];
      if (in_tree >= 0 && skeleton.joints[j].can_rotate) {
        const Placed& want = wanted[in_tree];
        pose.rotations[j] = normalized(conjugate(parent.rotation) * want.rotation);
        pose.translations[j] = seen_from(parent, want.position);
      }
      placed[j] = below(parent, pose.rotations[j], pose.translations[j]);
    }
  }

  std::unique_ptr<MotionFile> file_;
  DeformTree tree_;
  Clip own_rest_, rest_;
  std::vector<Clip> clips_;
};

}  // namespace

std::unique_ptr<MotionFile> join_deforming_joints(std::unique_ptr<MotionFile> file) {
  // A file that states the roles of its joints has them in one tree.
  const std::vector<Joint>& joints = file->clip(0).skeleton.joints;
  if (std::any_of(joints.begin(), joints.end(), [](auto& joint) { return !joint.role.empty(); })) {
    return file;
  }
  // The first motion shows what moves together.
  std::optional<DeformTree> tree = find_deform_tree(file->clip(0));
  if (!tree) return file;
  return std::make_unique<JoinedFile>(std::move(file), *std::move(tree));
}

}  // namespace panache
