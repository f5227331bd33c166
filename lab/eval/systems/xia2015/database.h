#pragma once
// The database: windows of neutral motion registered with what a style makes of them, to be
// searched by the window that a character shows.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "eval/systems/table.h"
#include "learn/samples.h"

namespace panache::xia2015 {

// Numbers that a window is compared by, and those of an output.
inline constexpr int kKeySize = 24, kOutputs = StyleDelta::kSize;

// Windows as points: normalised, and projected on the directions in which neutral windows vary
// most.
class WindowKey {
 public:
  // Learnt from the windows of `set`, of which there is at least one.
  explicit WindowKey(const SampleSet& set);
  // `window`: in layout positions, as PoseHistory::window() gives it. out[kKeySize]
  void project(std::span<const float> window, std::span<float> out) const;

 private:
  void normalise(std::span<const float> window, std::span<float> out) const;

  std::vector<float> mean_, scale_;  // Of a pose's numbers.
  std::vector<float> axes_;          // [kKeySize][inputs]
};

// One style's examples.
class Database {
 public:
  struct Example {
    std::array<float, kKeySize> key;
    std::array<float, kOutputs> output;  // The change, in units that weigh the same.
    int before;                          // The example one frame earlier; itself at a beginning.
    float rate;                          // Input seconds per output second.
    std::array<float, kFeet> contacts;   // 0 or 1.
  };
  struct Neighbour {
    const Example* example;
    float distance;  // Squared, of the keys.
  };

  // The samples of `style` (its index in `set`). A styled frame that several windows were laid over
  // counts once, as the window has it in whose middle it is.
  Database(const SampleSet& set, const WindowKey& key, int style);
  ~Database();
  Database(Database&&) noexcept;

  bool empty() const { return examples_.empty(); }
  size_t bytes() const;
  const Example& before(const Example& example) const { return examples_[example.before]; }
  // The nearest ones, nearest first: `count` of them, or as many as there are.
  void find(std::span<const float, kKeySize> key, size_t count, std::vector<Neighbour>& out) const;
  const std::vector<Example>& examples() const { return examples_; }

 private:
  struct Tree;

  std::vector<Example> examples_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace panache::xia2015
