#include "rig/body_motions.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "clip/text_cursor.h"
#include "rig/figures.h"
#include "rig/joint_name.h"

namespace panache {

namespace {

bool moves(const Joint& joint) { return !joint.still; }

// Moves poses from `out.clips` to `out.poses`, unless there is nothing else.
BodyMotions without_poses(const MotionFile& file, BodyMotions out) {
  const std::vector<std::string> names = file.clip_names();
  const auto pose = [&](int i) { return is_pose(names[i], file.clip(i).frames); };
  if (std::all_of(out.clips.begin(), out.clips.end(), pose)) return out;
  std::copy_if(out.clips.begin(), out.clips.end(), std::back_inserter(out.poses), pose);
  std::erase_if(out.clips, pose);
  return out;
}

BodyMotions find_moving(const MotionFile& file, const RigOptions& options) {
  BodyMotions out;
  bool all_move = true;
  const int count = static_cast<int>(file.clip_names().size());
  for (int i = 0; i < count; ++i) {
    const std::vector<Joint>& joints = file.clip(i).skeleton.joints;
    if (std::any_of(joints.begin(), joints.end(), moves)) out.clips.push_back(i);
    all_move = all_move && std::all_of(joints.begin(), joints.end(), moves);
  }
  if (all_move) return out;  // The humanoid makes no difference.
  for (const int tried : out.clips) {
    const Result<Rig> rig = Rig::create(file.clip(tried), options);
    if (!rig) continue;
    // All motions of a file have the same joints, and so the same humanoid.
    out.humanoid = true;
    // But where there are several figures, each motion may move another one.
    const bool one = find_figures(file.clip(tried)).empty();
    std::erase_if(out.clips, [&](int i) {
      const Clip& clip = file.clip(i);
      const Result<Rig> own = one ? rig : Rig::create(clip, options);
      return !own || !moves_humanoid(clip.skeleton, *own);
    });
    break;
  }
  return out;
}

// "'a', 'b' and 3 more".
std::string list_few(const std::vector<std::string>& names) {
  constexpr size_t kNamed = 4;
  const size_t named = std::min(names.size(), kNamed), more = names.size() - named;
  std::string text;
  for (size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + quoted(names[i]);
  }
  if (more) text += " and " + std::to_string(more) + " more";
  return text;
}

}  // namespace

bool moves_humanoid(const Skeleton& joints, const Rig& rig) {
  for (int joint : rig.joints()) {
    for (; joint >= 0; joint = joints.joints[joint].parent) {
      if (moves(joints.joints[joint])) return true;
    }
  }
  return false;
}

bool is_pose(const std::string& name, int frames) {
  if (frames < 2) return true;
  // "pose" after its kind, in one word or two, or just "rest".
  const std::vector<std::string> words = without_number(parse_joint_name(name).words);
  for (size_t i = 0; i < words.size(); ++i) {
    for (const char* kind : {"t", "rest", "bind", "reference"}) {
      if (words[i] == std::string(kind) + "pose") return true;
      if (words[i] == kind && i + 1 < words.size() && words[i + 1] == "pose") return true;
    }
  }
  return words.size() == 1 && (words[0] == "rest" || words[0] == "apose");
}

BodyMotions find_body_motions(const MotionFile& file, const RigOptions& options) {
  return without_poses(file, find_moving(file, options));
}

std::string describe_still(const std::vector<std::string>& names, bool humanoid) {
  return list_few(names) + (names.size() == 1 ? " moves" : " move") +
         (humanoid ? " no joint of the humanoid" : " no joint");
}

std::string note_passed_over(const MotionFile& file, const BodyMotions& body) {
  const std::vector<std::string> all = file.clip_names();
  std::vector<std::string> names, poses;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto is_in = [&](const std::vector<int>& list) {
      return std::find(list.begin(), list.end(), static_cast<int>(i)) != list.end();
    };
    if (!is_in(body.clips)) (is_in(body.poses) ? poses : names).push_back(all[i]);
  }
  std::string text;
  if (!poses.empty()) {
    text = list_few(poses) + (poses.size() == 1 ? " is a pose, not a motion, and is passed over"
                                                : " are poses, not motions, and are passed over");
  }
  if (names.empty()) return text;
  return (text.empty() ? "" : text + "; ") + describe_still(names, body.humanoid) +
         (names.size() == 1 ? " and is passed over" : " and are passed over");
}

int first_body_motion(const MotionFile& file, const RigOptions& options) {
  if (file.clip_names().size() < 2) return 0;
  const BodyMotions found = find_body_motions(file, options);
  return found.clips.empty() ? 0 : found.clips.front();
}

namespace {

// The position of a joint and the rotation of its parent, from the joints above.
struct Placed {
  Quatd above, turn;
  Vec3d position;
};

// The hips and the joints above them, from the top.
std::vector<size_t> chain_to_hips(const Rig& rig, const Clip& clip) {
  std::vector<size_t> chain;
  for (int j = rig.joints()[index(HumanJoint::hips)]; j >= 0;) {
    chain.push_back(static_cast<size_t>(j));
    j = clip.skeleton.joints[chain.back()].parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

Placed below(const Placed& parent, ConstPose pose, size_t joint) {
  const Quatd turn = parent.turn * pose.rotations[joint].as<double>();
  return {parent.turn, turn,
          parent.position + rotate(parent.turn, pose.translations[joint].as<double>())};
}

}  // namespace

void stay_in_place(const Rig& rig, Clip& clip) {
  const std::vector<size_t> chain = chain_to_hips(rig, clip);
  const Quatd to_y_up = turn_up(rig.up_axis()).value_or(Quat{}).as<double>();
  const Vec3d up = rotate(conjugate(to_y_up), Vec3d{0, 1, 0});
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  std::vector<Vec3d> starts;
  for (int f = first; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    Placed parent{};
    for (size_t i = 0; i < chain.size(); ++i) {
      const size_t j = chain[i];
      Placed placed = below(parent, pose, j);
      if (f == first) starts.push_back(placed.position);
      Vec3d path = placed.position - starts[i];
      path = path - up * dot(path, up);
      if (clip.skeleton.joints[j].can_translate && !(path == Vec3d{})) {
        const Vec3d local = rotate(conjugate(placed.above), path);
        pose.translations[j] = (pose.translations[j].as<double>() - local).as<float>();
        placed = below(parent, pose, j);
      }
      parent = placed;
    }
  }
}

}  // namespace panache
