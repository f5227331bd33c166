#include "clip/fbx_document.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace panache {

namespace {

// Bits of KeyAttrFlags.
constexpr int64_t kConstantKey = 0x2, kCubicKey = 0x8;  // And 0x4: a straight line.
constexpr int64_t kConstantNext = 0x100;                // Of a constant key.
constexpr int64_t kUserTangents = 0x400 | 0x800;        // Slopes that the file states.
constexpr int64_t kClampedTangents = 0x1000 | 0x4000;
constexpr int64_t kWeightedRight = 0x1000000, kWeightedNextLeft = 0x2000000;
constexpr float kWholeWeight = 9999;  // Weights are integers.
constexpr double kLargestSlope = 1e12;

// Sorts by time; the last of several keys at one time wins, as a jump has two.
void sort_keys(std::vector<FbxKey>& keys) {
  std::stable_sort(keys.begin(), keys.end(),
                   [](const FbxKey& a, const FbxKey& b) { return a.time < b.time; });
  size_t kept = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i + 1 < keys.size() && keys[i + 1].time == keys[i].time) continue;
    keys[kept++] = keys[i];
  }
  keys.resize(kept);
}

double seconds_between(const FbxKey& a, const FbxKey& b) {
  return static_cast<double>(b.time - a.time) / kFbxSecond;
}

// The slope of a key whose tangents are automatic: parallel to the line between its neighbours.
double auto_slope(const std::vector<FbxKey>& keys, size_t which, bool is_clamped) {
  if (which == 0 || which + 1 == keys.size()) return 0;
  const FbxKey &before = keys[which - 1], &key = keys[which], &after = keys[which + 1];
  const bool is_top = (key.value - before.value) * (after.value - key.value) <= 0;
  if (is_clamped && is_top) return 0;
  return (after.value - before.value) / seconds_between(before, after);
}

// How far along a Bezier curve from 0 to 1 with these inner times `share` is.
double bezier_parameter(double first, double second, double share) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double u = (low + high) / 2, v = 1 - u;
    const double at = 3 * u * v * v * first + 3 * u * u * v * second + u * u * u;
    (at < share ? low : high) = u;
  }
  return (low + high) / 2;
}

double cubic_at(const std::vector<FbxKey>& keys, size_t which, double share) {
  const FbxKey &key = keys[which], &next = keys[which + 1];
  const double span = seconds_between(key, next);
  const double slope = key.is_auto ? auto_slope(keys, which, key.is_clamped) : key.slope;
  const double next_slope =
      key.is_auto ? auto_slope(keys, which + 1, key.is_clamped) : key.next_slope;
  const double first = std::clamp<double>(key.weight, 0, 1);
  const double second = 1 - std::clamp<double>(key.next_weight, 0, 1);
  const bool is_plain = key.weight == FbxKey().weight && key.next_weight == FbxKey().next_weight;
  const double u = is_plain ? share : bezier_parameter(first, second, share), v = 1 - u;
  const double out = key.value + slope * span * first;
  const double in = next.value - next_slope * span * (1 - second);
  return v * v * v * key.value + 3 * u * v * v * out + 3 * u * u * v * in + u * u * u * next.value;
}

float slope_of(double number) {
  return static_cast<float>(std::clamp(number, -kLargestSlope, kLargestSlope));
}

// The attributes of one run of keys.
FbxKey key_like(int64_t flags, const FbxNode* data, const float* floats) {
  FbxKey out;
  if (flags & kConstantKey) {
    out.kind = flags & kConstantNext ? FbxKey::Kind::next : FbxKey::Kind::constant;
  } else if (flags & kCubicKey) {
    out.kind = FbxKey::Kind::cubic;
    out.is_auto = !data || !(flags & kUserTangents);
    out.is_clamped = (flags & kClampedTangents) != 0;
    if (!data) return out;
    out.slope = slope_of(floats[0]);
    out.next_slope = slope_of(floats[1]);
    const uint32_t weights = std::bit_cast<uint32_t>(floats[2]);
    if (flags & kWeightedRight) out.weight = static_cast<float>(weights & 0xffff) / kWholeWeight;
    if (flags & kWeightedNextLeft)
      out.next_weight = static_cast<float>(weights >> 16) / kWholeWeight;
  }
  return out;
}

// Four floats for each run; text files have their bits as integers.
bool read_attributes(const FbxTree& tree, const FbxNode* node, std::vector<float>& out) {
  if (!node) return true;
  std::vector<int64_t> bits;
  if (tree.integers(node, bits)) {
    for (const int64_t b : bits) out.push_back(std::bit_cast<float>(static_cast<uint32_t>(b)));
    return true;
  }
  return tree.raw_floats(node, out);
}

class Fbx7CurveReader {
 public:
  Fbx7CurveReader(const FbxTree& tree, const FbxNode& node) : tree_(tree), node_(node) {}

  Result<FbxCurve> read() {
    std::vector<int64_t> times;
    std::vector<double> values;
    const FbxNode *time_node = node_.child("KeyTime"), *value_node = node_.child("KeyValueFloat");
    if (!tree_.integers(time_node, times)) {
      return tree_.error(*time_node, "whole numbers as the times of keys", "something else");
    }
    if (!tree_.numbers(value_node, values)) {
      return tree_.error(*value_node, "numbers between -1e9 and 1e9 for keys", "something else");
    }
    if (times.size() != values.size()) {
      return tree_.error(
          node_, "a curve with as many values as times",
          std::to_string(times.size()) + " times and " + std::to_string(values.size()) + " values");
    }
    FbxCurve curve;
    curve.keys.resize(times.size());
    for (size_t i = 0; i < times.size(); ++i) {
      if (times[i] > kFbxLatest || times[i] < -kFbxLatest) {
        return tree_.error(*time_node, "a time within 18 days",
                           "'" + std::to_string(times[i]) + "'");
      }
      curve.keys[i].time = times[i];
      curve.keys[i].value = values[i];
    }
    if (auto good = read_kinds(curve); !good) return good.error();
    sort_keys(curve.keys);
    return curve;
  }

 private:
  // Flags and slopes apply to runs of keys.
  Result<void> read_kinds(FbxCurve& curve) const {
    std::vector<int64_t> flags, counts;
    std::vector<float> data;
    const FbxNode* data_node = node_.child("KeyAttrDataFloat");
    if (!tree_.integers(node_.child("KeyAttrFlags"), flags) ||
        !tree_.integers(node_.child("KeyAttrRefCount"), counts) ||
        !read_attributes(tree_, data_node, data)) {
      return tree_.error(node_, "flags of keys that are numbers", "something else");
    }
    size_t k = 0;
    for (size_t run = 0; run < std::min(flags.size(), counts.size()); ++run) {
      const bool has_data = data.size() >= 4 * (run + 1);
      const FbxKey like = key_like(flags[run], has_data ? data_node : nullptr,
                                   data.data() + (has_data ? 4 * run : 0));
      for (int64_t i = 0; i < counts[run] && k < curve.keys.size(); ++i, ++k) {
        const FbxKey key = curve.keys[k];
        curve.keys[k] = like;
        curve.keys[k].time = key.time;
        curve.keys[k].value = key.value;
      }
    }
    return {};
  }

  const FbxTree& tree_;
  const FbxNode& node_;
};

// A key of FBX 6 is its time, its value, a capital letter for the interpolation to the next key
// (Constant, Linear, cUbic), then its details: of a constant key `n` for the next key's value; of a
// cubic one `s` or `b` and the slopes at this key and the next, or else automatic slopes.
FbxKey fbx6_key(const FbxTree& tree, const FbxNode& keys, size_t letter) {
  FbxKey out;
  const std::string kind = tree.text(keys, letter), mode = tree.text(keys, letter + 1);
  if (kind == "C") out.kind = mode == "n" ? FbxKey::Kind::next : FbxKey::Kind::constant;
  if (kind != "U") return out;
  out.kind = FbxKey::Kind::cubic;
  double slope = 0, next_slope = 0;
  out.is_auto = !((mode == "s" || mode == "b") && tree.number(keys, letter + 2, slope) &&
                  tree.number(keys, letter + 3, next_slope));
  out.slope = slope_of(slope);
  out.next_slope = slope_of(next_slope);
  return out;
}

}  // namespace

double FbxCurve::at(int64_t time, double fallback) const {
  if (keys.empty()) return fallback;
  const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                     [](int64_t t, const FbxKey& key) { return t < key.time; });
  if (next == keys.begin()) return keys.front().value;
  const FbxKey& key = next[-1];
  if (next == keys.end() || key.time == time || key.kind == FbxKey::Kind::constant)
    return key.value;
  if (key.kind == FbxKey::Kind::next) return next->value;
  const double share =
      static_cast<double>(time - key.time) / static_cast<double>(next->time - key.time);
  if (key.kind == FbxKey::Kind::linear) return key.value + share * (next->value - key.value);
  return cubic_at(keys, static_cast<size_t>(next - keys.begin()) - 1, share);
}

bool FbxCurve::is_step() const {
  return !keys.empty() && std::all_of(keys.begin(), keys.end(), [](const FbxKey& key) {
    return key.kind == FbxKey::Kind::constant || key.kind == FbxKey::Kind::next;
  });
}

Result<FbxCurve> read_fbx_curve(const FbxTree& tree, const FbxNode& node) {
  return Fbx7CurveReader(tree, node).read();
}

Result<FbxCurve> read_fbx6_channel(const FbxTree& tree, const FbxNode& node) {
  FbxCurve curve;
  const FbxNode *count = node.child("KeyCount"), *keys = node.child("Key");
  if (!count && !keys) return curve;
  for (size_t i = 0; keys && i < keys->values.size(); ++i) {
    const std::string word = keys->values[i].bytes.size() == 1 ? tree.text(*keys, i) : "";
    const bool is_letter = word.size() == 1 && word[0] >= 'A' && word[0] <= 'Z';
    if (!is_letter) continue;
    FbxKey key = fbx6_key(tree, *keys, i);
    if (i < 2) return tree.error(*keys, i, "the time and the value of a key");
    if (!tree.integer(*keys, i - 2, key.time)) {
      return tree.error(*keys, i - 2, "a time, which is a whole number");
    }
    if (key.time > kFbxLatest || key.time < -kFbxLatest) {
      return tree.error(*keys, i - 2, "a time within 18 days");
    }
    if (!tree.number(*keys, i - 1, key.value)) {
      return tree.error(*keys, i - 1, "a number between -1e9 and 1e9 for a key");
    }
    curve.keys.push_back(key);
  }
  int64_t said = -1;
  if (!count || !tree.integer(*count, 0, said) || said != static_cast<int64_t>(curve.keys.size())) {
    return tree.error(count ? *count : node, 0,
                      "a KeyCount of " + std::to_string(curve.keys.size()) + ", as there are keys");
  }
  sort_keys(curve.keys);
  return curve;
}

}  // namespace panache
