#include "rig/body_motions.h"

#include <algorithm>

#include "clip/text_cursor.h"

namespace panache {
namespace {

bool moves(const Joint& joint) { return !joint.still; }

}  // namespace

bool moves_humanoid(const Skeleton& joints, const Rig& rig) {
  for (int joint : rig.joints()) {
    for (; joint >= 0; joint = joints.joints[static_cast<size_t>(joint)].parent) {
      if (moves(joints.joints[static_cast<size_t>(joint)])) return true;
    }
  }
  return false;
}

BodyMotions find_body_motions(const MotionFile& file, const RigOptions& options) {
  BodyMotions out;
  bool all_move = true;
  const int count = static_cast<int>(file.clip_names().size());
  for (int i = 0; i < count; ++i) {
    const std::vector<Joint>& joints = file.clip(i).skeleton.joints;
    if (std::any_of(joints.begin(), joints.end(), moves)) out.clips.push_back(i);
    all_move = all_move && std::all_of(joints.begin(), joints.end(), moves);
  }
  if (all_move) return out;  // No humanoid could tell more.
  for (const int tried : out.clips) {
    const Result<Rig> rig = Rig::create(file.clip(tried), options);
    if (!rig) continue;
    // All motions of a file have the same joints, and so the same humanoid.
    out.humanoid = true;
    std::erase_if(out.clips, [&](int i) { return !moves_humanoid(file.clip(i).skeleton, *rig); });
    break;
  }
  return out;
}

std::string describe_still(const std::vector<std::string>& names, bool humanoid) {
  constexpr size_t kNamed = 4;
  const size_t named = std::min(names.size(), kNamed), more = names.size() - named;
  std::string text;
  for (size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + quoted(names[i]);
  }
  if (more) text += " and " + std::to_string(more) + " more";
  return text + (names.size() == 1 ? " moves" : " move") +
         (humanoid ? " no joint of the humanoid" : " no joint");
}

std::string note_passed_over(const MotionFile& file, const BodyMotions& body) {
  const std::vector<std::string> all = file.clip_names();
  std::vector<std::string> names;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto found = std::find(body.clips.begin(), body.clips.end(), static_cast<int>(i));
    if (found == body.clips.end()) names.push_back(all[i]);
  }
  if (names.empty()) return "";
  return describe_still(names, body.humanoid) +
         (names.size() == 1 ? " and is passed over" : " and are passed over");
}

int first_body_motion(const MotionFile& file, const RigOptions& options) {
  if (file.clip_names().size() < 2) return 0;
  const BodyMotions found = find_body_motions(file, options);
  return found.clips.empty() ? 0 : found.clips.front();
}

}  // namespace panache
