#include "rig/body_motions.h"

#include <algorithm>
#include <iterator>

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

}  // namespace panache
