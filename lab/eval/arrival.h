#pragma once
// How much of each style arrives: the movement and the side of walks that a system restyles,
// relative to those of real takes. See eval/gait_traits.h.

#include <array>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/gait_traits.h"
#include "eval/system.h"
#include "eval/test_input.h"

namespace panache {

inline constexpr const char* kWalk = "walk";  // The content that is measured.

// Whose walks are restyled: the style's own performer's, other people's, the program's walker.
enum class Walks { own, others, walker };
inline constexpr std::array<const char*, 3> kWalksKeys = {"own", "others", "walker"};

// Shares of the real change, 1 as captured; NaN where real takes do not visibly differ from neutral
// ones.
struct ArrivedShares {
  Movement movement;
  double side = kNotMeasured;
  double steps = kNotMeasured;  // Steps a second, median over the takes.
};

struct StyleArrival {
  std::string style;
  Movement change;                  // Of real training takes from the performer's neutral walks.
  double side_cm = 0;               // Size of their side, see side_size().
  double slowest = 0, fastest = 0;  // Steps a second of all real takes.
  ArrivedShares real;               // Of real test takes, on the same scale.
  std::array<ArrivedShares, kWalksKeys.size()> made;
  // Distances of the joints' mean positions and deviations: on the walker's walk from those of the
  // input, and from the nearest other style; and of what training takes change of their performer's
  // neutral walks, from nothing and from that other style's.
  double from_input_cm = kNotMeasured, nearest_cm = kNotMeasured;
  double real_from_neutral_cm = kNotMeasured, real_nearest_cm = kNotMeasured;
  std::string nearest;
};

// The walks of a test set: real ones and inputs.
class WalkSet {
 public:
  // `training`: takes of the training split, with styles renamed; `test`: of the test split;
  // `neutral`: neutral test takes as inputs; `others`: walks of people without styles. Only walks
  // (content "walk") count. `walker`: walks of the program's walker.
  WalkSet(const std::vector<Take>& training, const std::vector<Take>& test,
          const std::vector<TestInput>& neutral, const std::vector<TestInput>& others,
          const std::vector<TestInput>& walker);

  Result<std::vector<StyleArrival>> measure(const System& system) const;

 private:
  struct Real {
    std::string style;
    int performer;  // Set, -1 for several.
    std::vector<const Take*> training, test;
  };
  std::vector<const Take*> neutral_of(const Real& real) const;
  std::vector<const TestInput*> inputs_of(const Real& real, Walks walks) const;

  std::vector<Real> styles_;
  std::vector<const Take*> neutral_;  // Neutral walks, training and test.
  std::vector<const TestInput*> own_, others_, walker_;
};

// Over all shares of movement that count.
struct ArrivalSummary {
  size_t traits = 0;
  double median = kNotMeasured, below_half = kNotMeasured, wrong_sign = kNotMeasured;
  Movement by_trait;  // Medians.
  // Mean over the styles that have one, of which test takes show at least half.
  double side = kNotMeasured;
  size_t sided = 0;    // Number of these.
  size_t in_step = 0;  // Styles whose steps a second are within 0.3 of real takes' range.
};
ArrivalSummary summarize(const std::vector<StyleArrival>& styles,
                         const ArrivedShares& (*shares)(const StyleArrival&));
inline const ArrivedShares& real_shares(const StyleArrival& style) { return style.real; }
template <Walks walks>
const ArrivedShares& made_shares(const StyleArrival& style) {
  return style.made[static_cast<size_t>(walks)];
}

// Inputs of the program's own walker: straight walks at a slow, a usual and a brisk speed;
// `walker_model`: a file.
Result<std::vector<TestInput>> walker_walks(const std::string& walker_model);

}  // namespace panache
