#include "rig/rig.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "clip/clip.h"
#include "rig/calibration.h"
#include "rig/doubtful.h"
#include "rig/figures.h"
#include "rig/followers.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"
#include "rig/posed_rig.h"
#include "rig/whole_body.h"

namespace panache {
namespace {

constexpr int kGroundPoses = 100;
// The path must be at least so long, in canonical metres, and the hips may stray from the joint by
// this share of it.
constexpr float kShortestPath = 0.3f, kStraysOff = 0.4f;

// The lowest joint above the hips that moves along the ground in the clip and takes the hips along,
// as root motion of games does; -1 if the hips move by themselves.
int find_ground_joint(const Clip& clip, int hips, const Calibration& calibration) {
  const std::vector<Joint>& joints = clip.skeleton.joints;
  for (int joint = joints[hips].parent; joint >= 0; joint = joints[joint].parent) {
    if (!joints[joint].can_translate) continue;
    const int of[] = {joint, hips};
    const int step = std::max(1, clip.frames / kGroundPoses);
    const SampledJoints frames(clip, calibration.first_frame, clip.frames, step, of);
    if (frames.count() < 2) return -1;
    const auto on_ground = [&](int frame, int which) {
      Vec3 p = rotate(calibration.y_up, frames.world(frame).translations[which]);
      p.y = 0;
      return p * calibration.scale;
    };
    float path = 0, strays = 0;
    const Vec3 start = on_ground(0, 0), start_apart = on_ground(0, 1) - start;
    for (int f = 1; f < frames.count(); ++f) {
      const Vec3 here = on_ground(f, 0);
      path = std::max(path, length(here - start));
      strays = std::max(strays, length(on_ground(f, 1) - here - start_apart));
    }
    if (path > kShortestPath && strays < kStraysOff * path) return joint;
  }
  return -1;
}

using enum HumanJoint;

// Finds the joints given in the options, among those of the figure (null: all).
Result<KnownJoints> find_joints(const Skeleton& skeleton, const RigOptions& options,
                                const JointSubset* figure) {
  KnownJoints known = options.joint_indices;
  for (const auto& [human, name] : options.joints) {
    if (options.joint_indices.contains(human)) continue;
    int& found = known[human] = -1;
    if (name.empty()) continue;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name != name || (figure && !figure->has(static_cast<int>(j))))
        continue;
      if (found >= 0) {
        return Error{"more than one joint is called '" + name + "', so it cannot be named as " +
                     std::string(human_joint_name(human))};
      }
      found = static_cast<int>(j);
    }
    if (found < 0) {
      return Error{"there is no joint '" + name + "' that could be " +
                   std::string(human_joint_name(human)) +
                   (figure ? " in the figure that is mapped" : "")};
    }
  }
  return known;
}

// How many of the joints given in the options the figure has.
int count_given(const Skeleton& skeleton, const RigOptions& options, const JointSubset& figure) {
  int count = 0;
  for (const int joint : figure.original) {
    for (const auto& [human, name] : options.joints) count += skeleton.joints[joint].name == name;
    for (const auto& [human, given] : options.joint_indices) count += given == joint;
  }
  return count;
}

// The figure that the options want; nothing if the skeleton has only one.
Result<std::optional<JointSubset>> pick_figure(const Clip& clip, const RigOptions& options,
                                               std::span<const JointPositions> poses,
                                               std::vector<std::string>& notes) {
  const std::vector<Figure> figures = find_figures(clip, poses);
  if (figures.empty()) {
    if (options.figure.empty()) return std::optional<JointSubset>{};
    return Error{"there is one figure, found no choice for '" + options.figure + "'"};
  }
  std::string names;
  for (const Figure& figure : figures) names += (names.empty() ? "'" : ", '") + figure.name + "'";
  const Figure* best = nullptr;
  int max = -1;
  for (const Figure& figure : figures) {
    if (!options.figure.empty() && figure.name != options.figure) continue;
    const int rank =
        2 * count_given(clip.skeleton, options, figure_joints(clip.skeleton, figure.root)) +
        figure.moves;
    if (rank > max) max = rank, best = &figure;
  }
  if (!best) {
    return Error{"there is no figure '" + options.figure + "'; expected one of " + names};
  }
  notes.push_back("there are " + std::to_string(figures.size()) + " figures (" + names + "): '" +
                  best->name + "' is mapped");
  return std::optional(figure_joints(clip.skeleton, best->root));
}

// The mapping of a clip, and the body that it is of, if that is completed.
struct Mapped {
  Mapping mapping;
  std::vector<std::string> remarks;
  std::optional<WholeBody> whole;
};

Result<Mapped> map_clip(const Clip& clip, const RigOptions& options) {
  std::vector<JointPositions> poses = some_poses(clip);
  if (poses.empty()) return Error{"no frame of the motion has finite numbers only"};
  Mapped out;
  const auto figure = pick_figure(clip, options, poses, out.remarks);
  if (!figure) return figure.error();
  const Result<KnownJoints> known =
      find_joints(clip.skeleton, options, *figure ? &**figure : nullptr);
  if (!known) return known.error();
  Result<Mapping> mapping =
      *figure ? (*figure)->map(poses, *known) : map_humanoid(clip.skeleton, poses, *known);
  if (!mapping && !*figure) {
    if (auto whole = complete_body(clip, poses)) {
      const std::vector<JointPositions> all = some_poses(whole->clip);
      const std::vector<char> taken(whole->parents.size(), 1);
      Result<Mapping> again =
          JointSubset(whole->clip.skeleton, whole->parents, taken).map(all, *known);
      if (again) {
        mapping = std::move(again);
        poses = all;
        out.remarks.insert(out.remarks.end(), whole->notes.begin(), whole->notes.end());
        out.whole = std::move(whole);
      }
    }
  }
  if (!mapping) return mapping.error();
  const Clip& body = out.whole ? out.whole->clip : clip;
  take_sides_of_body(body, *known, *mapping, out.remarks);
  if (const std::optional<Error> doubt = find_doubt(body.skeleton, *mapping, *known)) {
    return *doubt;
  }
  if (const std::optional<Error> animal = find_animal(body.skeleton, poses, *mapping, *known)) {
    return *animal;
  }
  if (const auto other = find_other_creature(body.skeleton, poses, *mapping, *known)) return *other;
  out.mapping = *std::move(mapping);
  return out;
}

// All joints, each after its parent and the joint that it follows.
std::vector<int> order_of(const Skeleton& skeleton, const std::vector<int>& followed) {
  std::vector<int> order;
  std::vector<char> placed(skeleton.joints.size());
  for (bool more = true; more;) {
    more = false;
    for (size_t j = 0; j < placed.size(); ++j) {
      const int parent = skeleton.joints[j].parent;
      const bool waits = (parent >= 0 && !placed[parent]) ||
                         (followed[j] >= 0 && !placed[static_cast<size_t>(followed[j])]);
      if (placed[j] || waits) continue;
      placed[j] = more = true;
      order.push_back(static_cast<int>(j));
    }
  }
  return order;
}

}  // namespace

Result<Rig> Rig::create(const Clip& given, const RigOptions& options) {
  if (given.joints() == 0)
    return Error{"no humanoid found: the skeleton has no joints", ErrorKind::not_humanoid};
  if (given.frames < 1) return Error{"expected at least one frame of motion, found none"};
  Result<Mapped> mapped = map_clip(given, options);
  if (!mapped) return mapped.error();
  const Clip& clip = mapped->whole ? mapped->whole->clip : given;
  Result<Calibration> calibration =
      calibrate(clip, mapped->mapping, options.metres_per_unit, options.up_axis);
  if (!calibration) return calibration.error();

  auto shared = std::make_shared<Shared>();
  shared->skeleton = clip.skeleton;
  shared->skeleton.joints.resize(given.joints());
  shared->added.assign(clip.skeleton.joints.begin() + static_cast<std::ptrdiff_t>(given.joints()),
                       clip.skeleton.joints.end());
  shared->mapping = std::move(mapped->mapping);
  shared->calibration = *std::move(calibration);
  shared->unit = shared->calibration.scale;
  const auto usual = usual_unit(shared->unit);
  if (usual && !options.metres_per_unit) shared->unit = static_cast<float>(usual->metres);
  shared->notes = shared->mapping.notes;
  shared->notes.insert(shared->notes.end(), shared->calibration.notes.begin(),
                       shared->calibration.notes.end());
  shared->remarks = std::move(mapped->remarks);
  const std::array<int, kHumanJoints>& joint_of = shared->mapping.joint_of;
  shared->human_of.assign(clip.joints(), -1);
  for (int j = 0; j < kHumanJoints; ++j) {
    const bool is_file = joint_of[j] < static_cast<int>(given.joints());
    shared->file_joints[j] = is_file ? joint_of[j] : -1;
    if (!is_file) shared->mapping.reasons[j] = "missing, and estimated";
    if (joint_of[j] < 0) continue;
    if (!is_file || clip.skeleton.joints[joint_of[j]].can_rotate) {
      shared->human_of[joint_of[j]] = j;
    } else {
      shared->notes.push_back(std::string(human_joint_name(j)) + " cannot rotate in this file");
    }
  }
  const bool is_layer = shared->leave_unkeyed_joints();
  shared->find_movers(clip);
  shared->find_placed();
  // A body without legs, or a layer that does not move them, stays where it is.
  if (is_layer || (mapped->whole && mapped->whole->lacks_legs)) {
    shared->moved_joint = shared->ground_joint = -1;
  }
  shared->notes.insert(shared->notes.end(), shared->remarks.begin(), shared->remarks.end());

  Rig rig;
  // Until a finite pose was read, `first_body` is used instead.
  shared->first_body.facing = shared->calibration.facing;
  rig.shared_ = shared;
  PosedRig reader(rig);
  for (int f = rig.first_frame(); f < given.frames; ++f) {
    BodyPose body;
    if (!reader.read(given.pose(f), body)) continue;
    shared->first_body = body;
    break;
  }
  return rig;
}

// An animation that keys only upper or only lower joints is made to lie over another: its changes
// stay with the joints that it keys. Returns whether it is one that does not move the hips.
bool Rig::Shared::leave_unkeyed_joints() {
  const auto all_unkeyed = [&](HumanJoint first, HumanJoint last) {
    for (int j = index(first); j <= index(last); ++j) {
      if (file_joints[j] >= 0 && !skeleton.joints[file_joints[j]].unkeyed) return false;
    }
    return true;
  };
  bool above = true;  // Hips and all above them.
  for (int j = file_joints[index(hips)]; j >= 0; j = skeleton.joints[j].parent) {
    above = above && skeleton.joints[j].unkeyed;
  }
  const bool lower = above && all_unkeyed(left_upper_leg, right_toes);
  const bool upper = all_unkeyed(spine, right_hand);
  if (lower == upper) return false;  // Neither, or a clip that moves no joint of the body.
  for (size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].unkeyed) human_of[j] = -1;
  }
  remarks.push_back(std::string("the animation has keys for ") + (lower ? "upper" : "lower") +
                    " joints of the body alone, to lie over another: joints without keys get none");
  return lower;
}

// Sets what follows from human_of: the joints that a change reaches, and those that carry the body.
void Rig::Shared::find_movers(const Clip& clip) {
  const std::vector<Joint>& joints = clip.skeleton.joints;
  const std::vector<Follower> followers = find_followers(clip, mapping.joint_of, human_of);
  followed.assign(followers.empty() ? 0 : joints.size(), -1);
  for (const Follower& follower : followers) {
    followed[follower.joint] = follower.to;
    human_of[follower.joint] = follower.human;
  }
  if (!followers.empty()) {
    order = order_of(clip.skeleton, followed);
    remarks.push_back(describe_followers(clip.skeleton, followers));
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    const int inherited = joints[j].parent < 0 ? -1 : moved_by[joints[j].parent];
    moved_by.push_back(human_of[j] < 0 ? inherited : human_of[j]);
  }
  int moved = mapping.joint_of[index(hips)];
  while (moved >= 0 && !joints[moved].can_translate) moved = joints[moved].parent;
  moved_joint = moved;
  if (moved < 0) {
    notes.push_back(
        "neither the hips nor a joint above them are animated (no translation channels)");
    return;
  }
  ground_joint = find_ground_joint(clip, mapping.joint_of[index(hips)], calibration);
  if (ground_joint == moved_joint) ground_joint = -1;
}

// Most joints of a rig are fingers, twists and faces, whose places nobody asks for.
void Rig::Shared::find_placed() {
  const std::vector<Joint>& joints = skeleton.joints;
  std::vector<char> needed(joints.size(), !order.empty());
  const auto need = [&](int joint) {
    for (; joint >= 0 && joint < static_cast<int>(joints.size()); joint = joints[joint].parent) {
      needed[joint] = 1;
    }
  };
  for (const int joint : mapping.joint_of) need(joint);
  for (const Joint& joint : added) need(joint.parent);
  for (const int joint : {moved_joint, ground_joint}) need(joint);
  for (size_t j = 0; j < joints.size(); ++j) {
    if (human_of[j] >= 0) need(static_cast<int>(j));
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    if (needed[j]) placed.push_back({static_cast<int>(j), joints[j].parent});
  }
}

std::vector<JointMatch> Rig::matches() const {
  std::vector<JointMatch> out;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int joint = shared_->file_joints[j];
    out.push_back({std::string(human_joint_name(j)),
                   joint < 0 ? std::string{} : shared_->skeleton.joints[joint].name,
                   shared_->mapping.reasons[j], shared_->mapping.confidence[j]});
  }
  return out;
}

void Rig::transform_root(float turn, Vec3 about, Vec3 move, Pose pose) const noexcept {
  if (turn == 0 && move == Vec3{}) return;
  const Quat file_axes = conjugate(shared_->calibration.y_up);
  const Quat by = in_axes(file_axes, rotation_y(turn));
  const Vec3 centre = rotate(file_axes, about) / shared_->calibration.scale;
  const Vec3 translation = rotate(file_axes, move) / shared_->calibration.scale;
  for (size_t j = 0; j < shared_->skeleton.joints.size(); ++j) {
    if (shared_->skeleton.joints[j].parent >= 0) continue;
    pose.rotations[j] = by * pose.rotations[j];
    pose.translations[j] += rotate_offset(by, pose.translations[j] - centre) + translation;
  }
}

}  // namespace panache
