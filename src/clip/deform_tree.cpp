#include "clip/deform_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace panache {
namespace {

// The minimum number of joints of a person; anything smaller is a prop.
constexpr size_t kFewestJoints = 11;
// No character has more; bounds the run time.
constexpr size_t kMaxJoints = 1000;
// Share of the vertices that may be outside the main tree: a prop, a hem.
constexpr float kMaxBeside = 0.25f;
// Frames that are compared to find what moves together.
constexpr int kFramesLookedAt = 16;

float to_segment(Vec3 point, Vec3 begin, Vec3 end) {
  const Vec3 along = end - begin;
  const float square = dot(along, along);
  const float share = square > 0 ? std::clamp(dot(point - begin, along) / square, 0.0f, 1.0f) : 0;
  return length(point - (begin + along * share));
}

// 'l' or 'r' by the last letter or a word (.L, _R, Left), '-' for neither.
char side_of(const std::string& name) {
  if (name.size() > 2 && (name[name.size() - 2] == '.' || name[name.size() - 2] == '_')) {
    const char last = name.back();
    if (last == 'L' || last == 'l') return 'l';
    if (last == 'R' || last == 'r') return 'r';
  }
  if (name.find("eft") != std::string::npos) return 'l';
  return name.find("ight") != std::string::npos ? 'r' : '-';
}

bool is_shoulder(const std::string& name) {
  for (const char* part : {"houlder", "HOULDER", "lavic", "LAVIC"}) {
    if (name.find(part) != std::string::npos) return true;
  }
  return false;
}

class TreeFinder {
 public:
  // clip: motion or rest of the file.
  explicit TreeFinder(const Clip& clip) : clip_(clip), joints_(clip.skeleton.joints) {}

  // Nothing if the joints are connected already.
  std::optional<DeformTree> find() {
    if (!pick_joints()) return std::nullopt;
    find_pieces();
    if (!is_in_pieces()) return std::nullopt;
    look_at_motion();
    pick_carriers();
    if (!is_in_pieces()) return std::nullopt;
    join_pieces();
    return in_order();
  }

 private:
  size_t count() const { return joints_.size(); }

  // Picks the joints with vertices that belong to the character (the tree of one root) with the
  // most of them.
  bool pick_joints() {
    std::vector<int> root(count());
    std::map<int, float> weights;  // By root.
    for (size_t j = 0; j < count(); ++j) {
      const int up = joints_[j].parent;
      root[j] = up < 0 ? static_cast<int>(j) : root[up];
      if (joints_[j].skin >= 0) weights[root[j]] += joints_[j].skin_weight;
    }
    const auto heaviest = std::max_element(weights.begin(), weights.end(),
                                           [](auto& a, auto& b) { return a.second < b.second; });
    if (heaviest == weights.end()) return false;
    picked_.resize(count());
    for (size_t j = 0; j < count(); ++j) {
      picked_[j] = joints_[j].skin >= 0 && root[j] == heaviest->first;
    }
    const auto picked = static_cast<size_t>(std::count(picked_.begin(), picked_.end(), true));
    return picked >= kFewestJoints && picked <= kMaxJoints;
  }

  // parent_ and piece_: the nearest picked joint above each joint, and the topmost.
  void find_pieces() {
    parent_.assign(count(), -1);
    piece_.assign(count(), -1);
    std::vector<int> nearest(count(), -1);  // The joint itself if picked.
    for (size_t j = 0; j < count(); ++j) {
      const int up = joints_[j].parent;
      const int above = up < 0 ? -1 : nearest[up];
      nearest[j] = picked_[j] ? static_cast<int>(j) : above;
      if (!picked_[j]) continue;
      parent_[j] = above;
      piece_[j] = above < 0 ? static_cast<int>(j) : piece_[above];
    }
  }

  bool is_in_pieces() const {
    std::map<int, float> weights;
    float all = 0;
    for (size_t j = 0; j < count(); ++j) {
      if (!picked_[j]) continue;
      weights[piece_[j]] += joints_[j].skin_weight;
      all += joints_[j].skin_weight;
    }
    float max = 0;
    for (const auto& [piece, weight] : weights) max = std::max(max, weight);
    return all - max > kMaxBeside * all;
  }

  void look_at_motion() {
    const int step = std::max(1, clip_.frames / kFramesLookedAt);
    for (int f = 0; f < clip_.frames; f += step) {
      poses_.push_back(world_joints(clip_.skeleton, clip_.pose(f)));
    }
  }

  // Picks joints that deform nothing and carry several pieces: hips outside the skin's list, with
  // legs and spine below. Unlike the root or a control of a rig, they are near their pieces, which
  // keep their positions on them in motion. The lowest come first. A control rig has many such
  // joints, each with a piece or two: none of them is picked.
  void pick_carriers() {
    constexpr int kJointsOfCarrier = 3;  // At most one carrier per this many deforming joints.
    const std::vector<char> deforming = picked_;
    const auto picked = [&] { return std::count(picked_.begin(), picked_.end(), 1); };
    const auto max = picked() + picked() / kJointsOfCarrier;
    const float size = body_size();
    for (size_t j = count(); j-- > 0;) {
      if (picked_[j]) continue;
      std::vector<size_t> between;  // The carrier, and the joints between it and its pieces.
      int pieces = 0;
      for (size_t root = j + 1; root < count(); ++root) {
        if (!picked_[root] || parent_[root] >= 0) continue;
        std::vector<size_t> path;
        if (!hangs_on(root, j, size, path)) continue;
        ++pieces;
        between.insert(between.end(), path.begin(), path.end());
      }
      if (pieces < 2) continue;
      for (const size_t joint : between) picked_[joint] = 1;
      find_pieces();
    }
    if (picked() <= max) return;
    picked_ = deforming;
    find_pieces();
  }

  // Whether the root of a piece keeps its position relative to a near joint above it in motion.
  // `path` gets that joint and the joints between them.
  bool hangs_on(size_t root, size_t above, float size, std::vector<size_t>& path) const {
    constexpr float kStays = 1e-3f, kNear = 0.25f;  // Relative to the body's size.
    for (size_t at = root; at != above;) {
      const int up = joints_[at].parent;
      if (up < 0 || static_cast<size_t>(up) < above) return false;
      const auto parent = static_cast<size_t>(up);
      if (picked_[parent]) return false;
      const Vec3 first = seen_from(poses_.front()[parent], poses_.front()[at].position);
      for (const auto& pose : poses_) {
        const Vec3 position = seen_from(pose[parent], pose[at].position);
        if (length(position - first) > kStays * size) return false;
      }
      path.push_back(parent);
      at = parent;
    }
    const std::vector<Placed>& first = poses_.front();
    return length(first[root].position - first[above].position) <= kNear * size;
  }

  // The largest extent of the deforming joints along one axis.
  float body_size() const {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
    for (size_t j = 0; j < count(); ++j) {
      if (!picked_[j]) continue;
      const Vec3 p = poses_.front()[j].position;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }

  // How badly the root of a piece follows joint `above`, in the file's units: how much its position
  // relative to that joint varies, and how far it is from the limb.
  float cost(size_t root, size_t above) const {
    Vec3 mean{};
    for (const auto& pose : poses_) mean = mean + seen_from(pose[above], pose[root].position);
    mean = mean * (1.0f / static_cast<float>(poses_.size()));
    float varies = 0;
    for (const auto& pose : poses_) {
      varies += length(seen_from(pose[above], pose[root].position) - mean);
    }
    varies /= static_cast<float>(poses_.size());
    const std::vector<Placed>& first = poses_.front();
    float off = length(first[root].position - first[above].position);
    for (const int child : children_[above]) {
      off = std::min(
          off, to_segment(first[root].position, first[above].position, first[child].position));
    }
    constexpr float kDistance = 0.25f, kSameSide = 0.7f, kUnlikely = 3;
    const char side = side_of(joints_[root].name), other = side_of(joints_[above].name);
    const bool same = side != '-' && side == other, across = side != '-' && other != '-' && !same;
    // A single joint (a breast, half a pelvis, a lip) carries no others, except for a shoulder.
    const bool alone = piece_[above] == static_cast<int>(above) && children_[above].empty();
    const bool carries = !alone || (same && is_shoulder(joints_[above].name));
    const float weight = !carries || across ? kUnlikely : same ? kSameSide : 1;
    return varies + kDistance * off * weight;
  }

  // Repeatedly adds to the main piece the one that follows it best, until all are in.
  void join_pieces() {
    children_.assign(count(), {});
    std::vector<size_t> roots;
    for (size_t j = 0; j < count(); ++j) {
      if (!picked_[j]) continue;
      if (parent_[j] >= 0)
        children_[parent_[j]].push_back(static_cast<int>(j));
      else
        roots.push_back(j);
    }
    const size_t main = find_main(roots);
    // For each root, the best joint in the tree so far.
    struct Best {
      float cost = INFINITY;
      size_t above = 0;
    };
    std::vector<Best> best(count());
    std::vector<size_t> waiting, added = members(main);
    std::copy_if(roots.begin(), roots.end(), std::back_inserter(waiting),
                 [&](size_t root) { return root != main; });
    while (!waiting.empty()) {
      for (const size_t root : waiting) {
        for (const size_t above : added) {
          const float now = cost(root, above);
          if (now < best[root].cost) best[root] = {now, above};
        }
      }
      const auto next = std::min_element(waiting.begin(), waiting.end(), [&](size_t a, size_t b) {
        return best[a].cost < best[b].cost;
      });
      const size_t root = *next;
      waiting.erase(next);
      parent_[root] = static_cast<int>(best[root].above);
      added = members(root);
    }
  }

  std::vector<size_t> members(size_t root) const {
    std::vector<size_t> list;
    for (size_t j = 0; j < count(); ++j) {
      if (picked_[j] && piece_[j] == static_cast<int>(root)) list.push_back(j);
    }
    return list;
  }

  // The piece that most others follow better than any third one: the spine.
  size_t find_main(const std::vector<size_t>& roots) const {
    std::map<int, size_t> followers;
    for (const size_t root : roots) {
      float min = INFINITY;
      int followed = piece_[root];
      for (size_t above = 0; above < count(); ++above) {
        if (!picked_[above] || piece_[above] == piece_[root]) continue;
        const float now = cost(root, above);
        if (now < min) min = now, followed = piece_[above];
      }
      ++followers[followed];
    }
    return *std::max_element(roots.begin(), roots.end(), [&](size_t a, size_t b) {
      return followers[static_cast<int>(a)] < followers[static_cast<int>(b)];
    });
  }

  // Parents before children, otherwise in file order.
  DeformTree in_order() const {
    DeformTree tree;
    std::vector<int> new_index(count(), -1);
    const auto total = static_cast<size_t>(std::count(picked_.begin(), picked_.end(), true));
    while (tree.joints.size() < total) {
      for (size_t j = 0; j < count(); ++j) {
        if (!picked_[j] || new_index[j] >= 0) continue;
        const int above = parent_[j] < 0 ? -1 : new_index[parent_[j]];
        if (parent_[j] >= 0 && above < 0) continue;
        new_index[j] = static_cast<int>(tree.joints.size());
        tree.joints.push_back(static_cast<int>(j));
        tree.parents.push_back(above);
      }
    }
    return tree;
  }

  const Clip& clip_;
  const std::vector<Joint>& joints_;
  std::vector<std::vector<Placed>> poses_;  // Of the compared frames.
  std::vector<char> picked_;                // [joints]
  std::vector<int> parent_, piece_;         // [joints]
  std::vector<std::vector<int>> children_;  // [joints] In the pieces.
};

}  // namespace

std::optional<DeformTree> find_deform_tree(const Clip& clip) { return TreeFinder(clip).find(); }

}  // namespace panache
