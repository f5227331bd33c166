#include "rig/whole_body.h"

#include <algorithm>
#include <array>

#include "rig/humanoid.h"
#include "rig/joint_name.h"
#include "rig/joint_tree.h"
#include "rig/limbs.h"

namespace panache {
namespace {

constexpr std::array<Side, 2> kBothSides = {Side::left, Side::right};
constexpr int kHipsPoses = 40;  // From which directions are measured.

bool is_lower_leg(const JointName& name) { return is_shin(name) && !is_twist(name); }
bool is_lower_arm(const JointName& name) { return is_forearm(name) && !is_twist(name); }

class BodyCompleter {
 public:
  BodyCompleter(const Clip& clip, std::span<const JointPositions> poses)
      : clip_(clip), tree_(clip.skeleton, poses) {
    for (const Joint& joint : clip.skeleton.joints) has_roles_ |= !joint.role.empty();
    for (const Joint& joint : clip.skeleton.joints) {
      names_.push_back(parse_joint_name(has_roles_ ? joint.role : joint.name));
      out_.parents.push_back(joint.parent);
    }
    out_.clip = clip;
  }

  std::optional<WholeBody> complete() {
    for (const size_t side : {0, 1}) {
      arms_[side] = find(side, is_hand);
      if (arms_[side] < 0) arms_[side] = find(side, is_lower_arm);
      shins_[side] = find(side, is_lower_leg);
      feet_[side] = find(side, is_foot);
    }
    if (arms_[0] < 0 || arms_[1] < 0) return std::nullopt;
    const int legs = (shins_[0] >= 0) + (shins_[1] >= 0);
    for (const size_t side : {0, 1}) {
      // A thigh or foot alone is a leg that we do not understand.
      if (shins_[side] < 0 && (feet_[side] >= 0 || has_thigh(side))) return std::nullopt;
      if (shins_[side] >= 0) complete_shin(side);
    }
    if (legs < 2 && !add_legs(legs)) return std::nullopt;
    if (!changed_) return std::nullopt;
    add_frames();
    return std::move(out_);
  }

 private:
  int find(size_t side, bool (*is)(const JointName&)) const {
    return find_named(tree_, names_, kBothSides[side], is);
  }
  bool has_thigh(size_t side) const {
    return find_named(tree_, names_, kBothSides[side], [](const JointName& name) {
             return is_standard_name_of(name, HumanJoint::left_upper_leg) ||
                    is_standard_name_of(name, HumanJoint::right_upper_leg);
           }) >= 0;
  }

  // Gives a shin a foot: one that hangs elsewhere, or a point at its end.
  void complete_shin(size_t side) {
    const int shin = shins_[side], foot = feet_[side];
    const std::string which = side ? "the right" : "the left";
    if (foot >= 0 && tree_.is_above(shin, foot)) return;
    changed_ = true;
    if (foot >= 0) {
      out_.parents[foot] = shin;
      stand_on_shin(foot, shin);
      out_.notes.push_back(which + " foot '" + joints()[foot].name + "' is not below the shin '" +
                           joints()[shin].name + "' and follows its end");
      return;
    }
    add(side ? "RightFoot" : "LeftFoot", side ? "rightFoot" : "leftFoot", shin, shin_end(shin));
    out_.notes.push_back(which + " leg ends at the shin '" + joints()[shin].name + "'");
  }
  // Puts a foot that is elsewhere at rest, as its motion replaces its offset, at the end of its
  // shin.
  void stand_on_shin(int foot, int shin) {
    Clip rest = rest_clip(out_.clip.skeleton);
    world_pose(out_.clip.skeleton, rest.pose(0), rest.pose(0));
    const Vec3 along = shin_end(shin);
    const Vec3 end = rest.translations[shin] + rotate(rest.rotations[shin], along);
    Joint& joint = out_.clip.skeleton.joints[foot];
    const bool is_near = length(rest.translations[foot] - end) < 0.3f * length(along);
    if (is_near || !joint.can_translate) return;
    const bool has_parent = joint.parent >= 0;
    const Quat above = has_parent ? rest.rotations[joint.parent] : Quat{};
    const Vec3 origin = has_parent ? rest.translations[joint.parent] : Vec3{};
    joint.offset = rotate(conjugate(above), end - origin);
  }
  // Where a shin ends, in its space: its farthest child or End Site, else as long as the thigh.
  Vec3 shin_end(int shin) const {
    Vec3 longest;
    const auto note = [&](Vec3 end) {
      if (length(end) > length(longest)) longest = end;
    };
    for (const Vec3 end : joints()[shin].ends) note(end);
    for (const int child : tree_.children(shin)) note(joints()[child].offset);
    const Vec3 thigh = rotate(conjugate(joints()[shin].rest), joints()[shin].offset);
    return length(longest) > 0.3f * length(thigh) ? longest : thigh;
  }

  // Adds the legs that are missing, to the hips: straight down, in proportion to the torso.
  bool add_legs(int there) {
    const int meeting = tree_.meeting(arms_[0], arms_[1]);
    if (meeting < 0) return false;
    int hips = meeting;
    for (int up = meeting; up >= 0; up = tree_.parent(up)) {
      hips = up;
      if (is_pelvis(names_[up])) break;
    }
    const std::array<int, 2> shoulders = {upper_arm(0, meeting), upper_arm(1, meeting)};
    if (shoulders[0] < 0 || shoulders[1] < 0) return false;
    // Directions in the space of the hips, means of the motion.
    const std::array<int, 3> seen = {hips, shoulders[0], shoulders[1]};
    const int step = std::max(1, clip_.frames / kHipsPoses);
    const SampledJoints frames(clip_, 0, clip_.frames, step, seen);
    Vec3d across, up;
    for (int f = 0; f < frames.count(); ++f) {
      const ConstPose world = frames.world(f);
      const Quat to_hips = conjugate(world.rotations[0]);
      const Vec3 left = world.translations[1] - world.translations[0];
      const Vec3 right = world.translations[2] - world.translations[0];
      across += rotate(to_hips, left - right).as<double>();
      up += rotate(to_hips, (left + right) * 0.5f).as<double>();
    }
    if (frames.count() == 0) return false;
    const Vec3 torso = (up / frames.count()).as<float>();
    const Vec3 upwards = normalized(torso);
    Vec3 sideways = across.as<float>();
    sideways = normalized(sideways - upwards * dot(sideways, upwards));
    if (upwards == Vec3{} || sideways == Vec3{}) return false;
    const float size = length(torso) / kProportions.torso;
    for (const size_t side : {0, 1}) {
      if (shins_[side] >= 0) continue;
      const std::string left = side ? "Right" : "Left", role = side ? "right" : "left";
      const Vec3 at = sideways * ((side ? -1 : 1) * kProportions.half_hips * size);
      const Vec3 leg = upwards * (-kProportions.leg * size / 2);
      const int upper = add(left + "UpperLeg", role + "UpperLeg", hips, at);
      const int lower = add(left + "LowerLeg", role + "LowerLeg", upper, leg);
      add(left + "Foot", role + "Foot", lower, leg);
    }
    changed_ = true;
    out_.lacks_legs = there == 0;
    out_.notes.push_back(there == 0 ? "the legs are missing: torso and arms move where they are"
                                    : "one leg is missing");
    return true;
  }
  // The joint of an arm that is farthest from its end and not shared with the other arm: of those
  // away from the middle.
  int upper_arm(size_t side, int meeting) const {
    int joint = arms_[side], found = -1;
    for (; joint >= 0 && joint != meeting; joint = tree_.parent(joint)) found = joint;
    return found;
  }

  int add(const std::string& name, const std::string& role, int parent, Vec3 offset) {
    Joint joint;
    joint.name = name;
    if (has_roles_) joint.role = role;
    joint.parent = parent;
    joint.offset = offset;
    joint.still = true;
    out_.clip.skeleton.joints.push_back(joint);
    out_.parents.push_back(parent);
    return static_cast<int>(out_.clip.skeleton.joints.size()) - 1;
  }

  // Gives the added joints their transforms in all frames.
  void add_frames() {
    const size_t all = joints().size(), old = names_.size();
    if (all == old) return;
    std::vector<Quat> rotations;
    std::vector<Vec3> translations;
    rotations.reserve(out_.clip.frames * all);
    translations.reserve(out_.clip.frames * all);
    for (size_t f = 0; f < static_cast<size_t>(out_.clip.frames); ++f) {
      const auto begin = static_cast<std::ptrdiff_t>(f * old);
      const auto end = static_cast<std::ptrdiff_t>((f + 1) * old);
      rotations.insert(rotations.end(), out_.clip.rotations.begin() + begin,
                       out_.clip.rotations.begin() + end);
      translations.insert(translations.end(), out_.clip.translations.begin() + begin,
                          out_.clip.translations.begin() + end);
      for (size_t j = old; j < all; ++j) {
        rotations.emplace_back();
        translations.push_back(joints()[j].offset);
      }
    }
    out_.clip.rotations = std::move(rotations);
    out_.clip.translations = std::move(translations);
  }

  const std::vector<Joint>& joints() const { return out_.clip.skeleton.joints; }

  const Clip& clip_;  // As in the file: out_ may have joints that its frames do not have yet.
  JointTree tree_;    // Of the joints of the file.
  std::vector<JointName> names_;
  bool has_roles_ = false;
  bool changed_ = false;
  std::array<int, 2> arms_ = {-1, -1}, shins_ = {-1, -1}, feet_ = {-1, -1};
  WholeBody out_;
};

}  // namespace

std::optional<WholeBody> complete_body(const Clip& clip, std::span<const JointPositions> poses) {
  return BodyCompleter(clip, poses).complete();
}

}  // namespace panache
