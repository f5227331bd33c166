#include "rig/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "clip/motion_file.h"
#include "rig/joint_name.h"
#include "rig/joint_tree.h"

namespace panache {

JointSubset::JointSubset(const Skeleton& whole, std::span<const int> parents,
                         std::span<const char> taken) {
  const size_t count = whole.joints.size();
  std::vector<int> index(count, -1);
  const auto add = [&](size_t joint, int parent) {
    index[joint] = static_cast<int>(original.size());
    original.push_back(static_cast<int>(joint));
    skeleton.joints.push_back(whole.joints[joint]);
    skeleton.joints.back().parent = parent;
  };
  const auto above = [&](size_t joint) {
    int up = parents[joint];
    while (up >= 0 && !taken[up]) up = parents[up];
    return up;
  };
  // Parents first; each round adds at least the joints whose parents are there.
  for (bool more = true; more;) {
    more = false;
    for (size_t j = 0; j < count; ++j) {
      if (!taken[j] || index[j] >= 0) continue;
      const int parent = above(j);
      if (parent >= 0 && index[parent] < 0) continue;
      add(j, parent < 0 ? -1 : index[parent]);
      more = true;
    }
  }
}

bool JointSubset::has(int joint) const {
  return std::find(original.begin(), original.end(), joint) != original.end();
}

std::vector<JointPositions> JointSubset::poses_of(std::span<const JointPositions> whole) const {
  std::vector<JointPositions> out;
  for (const JointPositions& pose : whole) {
    out.emplace_back();
    for (const int joint : original) out.back().push_back(pose[joint]);
  }
  return out;
}

Result<Mapping> JointSubset::map(std::span<const JointPositions> whole,
                                 const KnownJoints& known) const {
  KnownJoints inside;
  for (const auto& [human, joint] : known) {
    int found = -1;
    for (size_t i = 0; i < original.size(); ++i) {
      if (original[i] == joint) found = static_cast<int>(i);
    }
    if (joint >= 0 && found < 0) {
      return Error{std::string(human_joint_name(human)) +
                   ": expected a joint of the figure that is mapped, found one of another"};
    }
    inside[human] = found;
  }
  Result<Mapping> mapping = map_humanoid(skeleton, poses_of(whole), inside);
  if (!mapping) return mapping;
  for (int& joint : mapping->joint_of) joint = joint < 0 ? -1 : original[joint];
  return mapping;
}

namespace {

// A person has at least so many joints; anything smaller is a prop.
constexpr int kFewestOfPerson = 11;

class FigureFinder {
 public:
  FigureFinder(const Clip& clip, std::span<const JointPositions> poses)
      : poses_(poses), joints_(clip.skeleton.joints), size_(joints_.size(), 1) {
    children_.resize(joints_.size());
    limbs_.resize(joints_.size());
    for (size_t j = joints_.size(); j-- > 0;) {
      note_limbs(static_cast<int>(j));
      const int parent = joints_[j].parent;
      if (parent < 0) continue;
      size_[parent] += size_[j];
      limbs_[parent] |= limbs_[j];
      children_[parent].push_back(static_cast<int>(j));
    }
    std::vector<int> roots;
    for (size_t j = joints_.size(); j-- > 0;) {
      if (joints_[j].parent < 0) roots.push_back(static_cast<int>(j));
    }
    descend(roots, -1);
    if (found_.size() < 2) return;
    std::sort(found_.begin(), found_.end());
    drop_companions();
    std::erase_if(found_,
                  [&](int root) { return !figure_joints(clip.skeleton, root).map(poses, {}); });
  }

  std::vector<Figure> figures() const {
    if (found_.size() < 2) return {};
    std::vector<Figure> out;
    TakenNames taken;
    for (const int root : found_) {
      bool moves = false;
      for (size_t j = 0; j < joints_.size(); ++j) {
        moves = moves || (is_below(static_cast<int>(j), root) && !joints_[j].still);
      }
      out.push_back({root, unique_name(joints_[root].name, taken), moves});
    }
    return out;
  }

 private:
  // A bit per limb that a name below a joint tells.
  void note_limbs(int joint) {
    const Joint& named = joints_[joint];
    const JointName name = parse_joint_name(named.role.empty() ? named.name : named.role);
    if (name.side == Side::none || is_near(name)) return;
    const int side = name.side == Side::left ? 1 : 2;
    if (is_hand(name) || is_forearm(name)) limbs_[joint] |= side;
    if (is_foot(name) || is_shin(name)) limbs_[joint] |= 4 * side;
  }
  bool is_person(int joint) const { return size_[joint] >= kFewestOfPerson && limbs_[joint] == 15; }

  // children: of the joint `top` or below it, on a path without another figure.
  void descend(const std::vector<int>& children, int top) {
    std::vector<int> persons;
    for (const int child : children) {
      if (is_person(child)) persons.push_back(child);
    }
    if (persons.empty()) {
      if (top >= 0) found_.push_back(top);
      return;
    }
    for (const int person : persons) {
      descend(children_[person], persons.size() > 1 || top < 0 ? person : top);
    }
  }

  bool is_below(int joint, int root) const {
    while (joint > root) joint = joints_[joint].parent;
    return joint == root;
  }

  // Leaves out figures that stay with one before them: clothes, or a copy that deforms the mesh.
  void drop_companions() {
    std::vector<int> kept;
    for (const int root : found_) {
      const bool goes_along = std::any_of(kept.begin(), kept.end(),
                                          [&](int other) { return stay_together(other, root); });
      if (!goes_along) kept.push_back(root);
    }
    found_ = kept;
  }
  bool stay_together(int a, int b) const {
    constexpr size_t kCompared = 40;
    constexpr float kTogether = 0.05f;  // Mean distance to the nearest joint, of the body's size.
    const std::vector<int> first = some_joints(a, joints_.size()),
                           second = some_joints(b, kCompared);
    for (const JointPositions& pose : poses_) {
      float sum = 0, size = 0;
      for (const int joint : second) {
        float nearest = INFINITY;
        for (const int other : first)
          nearest = std::min(nearest, length(pose[joint] - pose[other]));
        sum += nearest;
        size = std::max(size, length(pose[joint] - pose[second.front()]));
      }
      if (!(sum / static_cast<float>(second.size()) <= kTogether * size)) return false;
    }
    return true;
  }
  // At most `max` joints of the figure, evenly spread, without its root.
  std::vector<int> some_joints(int root, size_t max) const {
    std::vector<int> all;
    for (size_t j = 0; j < joints_.size(); ++j) {
      const int joint = static_cast<int>(j);
      if (joint != root && is_below(joint, root)) all.push_back(joint);
    }
    std::vector<int> some;
    const size_t count = std::min(max, all.size());
    for (size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
    return some;
  }

  std::span<const JointPositions> poses_;
  const std::vector<Joint>& joints_;
  std::vector<int> size_;   // [joints] with those below.
  std::vector<int> limbs_;  // [joints] named limbs, with those below.
  std::vector<std::vector<int>> children_;
  std::vector<int> found_;
};

}  // namespace

JointSubset figure_joints(const Skeleton& skeleton, int root) {
  const std::vector<Joint>& joints = skeleton.joints;
  std::vector<int> parents;
  std::vector<char> taken;
  for (size_t j = 0; j < joints.size(); ++j) {
    const int parent = joints[j].parent;
    parents.push_back(parent);
    taken.push_back(static_cast<int>(j) == root || (parent >= root && taken[parent]));
  }
  for (int up = joints[root].parent; up >= 0; up = joints[up].parent) taken[up] = 1;
  return {skeleton, parents, taken};
}

std::vector<Figure> find_figures(const Clip& clip, std::span<const JointPositions> poses) {
  return FigureFinder(clip, poses).figures();
}

std::vector<Figure> find_figures(const Clip& clip) { return find_figures(clip, some_poses(clip)); }

namespace {

// CMU's lengths are inches times 0.45.
constexpr std::array<UsualUnit, 6> kUnits = {{{"metres", 1},
                                              {"feet", 0.3048},
                                              {"CMU units", 0.0254 / 0.45},
                                              {"inches", 0.0254},
                                              {"centimetres", 0.01},
                                              {"millimetres", 0.001}}};

}  // namespace

std::optional<UsualUnit> usual_unit(double metres) {
  // The scale is that of canonical legs, and people differ: 1.35 is half-way between the closest
  // neighbours in this list.
  for (const UsualUnit& unit : kUnits) {
    if (std::abs(std::log(metres / unit.metres)) < std::log(1.35)) return unit;
  }
  return std::nullopt;
}

std::optional<Quat> turn_up(std::string_view axis) {
  const float half = std::sqrt(0.5f);
  if (axis == "+X") return Quat{0, 0, half, half};
  if (axis == "-X") return Quat{0, 0, -half, half};
  if (axis == "+Y") return Quat{};
  if (axis == "-Y") return Quat{1, 0, 0, 0};
  if (axis == "+Z") return Quat{-half, 0, 0, half};
  if (axis == "-Z") return Quat{half, 0, 0, half};
  return std::nullopt;
}

}  // namespace panache
