#pragma once
// The database: windows of neutral motion with the corresponding changes of a style, searched with
// the current window of a character.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "eval/systems/table.h"
#include "learn/samples.h"

namespace panache::xia2015 {

// Dimensions of the search keys, and of the outputs.
inline constexpr int kKeySize = 24, kOutputs = StyleDelta::kSize;

// Search keys of windows: normalised, and projected on the principal components of neutral windows.
class WindowKey {
 public:
  // Learnt from the windows of `set`, which must not be empty.
  explicit WindowKey(const SampleSet& set);
  // `window`: in layout positions, as PoseHistory::window() gives it. out[kKeySize]
  void project(std::span<const float> window, std::span<float> out) const;

 private:
  void normalise(std::span<const float> window, std::span<float> out) const;

  std::vector<float> mean_, scale_;  // Of a pose's features.
  std::vector<float> axes_;          // [kKeySize][inputs]
};

// The examples of one style.
class Database {
 public:
  struct Example {
    std::array<float, kKeySize> key;
    std::array<float, kOutputs> output;  // The change, scaled to equal weights.
    int before;                          // The example one frame earlier; itself at the start.
    float rate;                          // Input seconds per output second.
    std::array<float, kFeet> contacts;   // 0 or 1.
  };
  struct Neighbour {
    const Example* example;
    float distance;  // Squared distance of the keys.
  };

  // The samples of `style` (its index in `set`). A styled frame in several aligned windows counts
  // once, from the window whose centre is closest.
  Database(const SampleSet& set, const WindowKey& key, int style);
  ~Database();
  Database(Database&&) noexcept;

  bool empty() const { return examples_.empty(); }
  size_t bytes() const;
  const Example& before(const Example& example) const { return examples_[example.before]; }
  // The nearest `count` examples, or all if there are fewer; nearest first.
  void find(std::span<const float, kKeySize> key, size_t count, std::vector<Neighbour>& out) const;
  const std::vector<Example>& examples() const { return examples_; }

 private:
  struct Tree;

  std::vector<Example> examples_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace panache::xia2015
