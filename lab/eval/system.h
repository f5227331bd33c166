#pragma once
// What the judge compares: anything that gives motion a style.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "eval/metrics.h"
#include "eval/test_input.h"
#include "learn/take.h"
#include "style/model.h"

namespace panache {

// Strengths that every system is asked for; 1 is the style as it was captured.
inline constexpr std::array kStrengths = {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};

// One thing to ask for: strengths of styles, and the style that the result is judged as.
struct StyleRequest {
  std::string style;
  std::vector<std::pair<std::string, float>> strengths;
  bool timing = true;  // With the style's own tempo; off, frame by frame as the input.
};

// What a system made of a neutral take. `take.row` names the style asked for and the content.
struct StyledTake {
  Take take;
  int input = 0;                     // Index of the neutral take.
  std::vector<float> source_frames;  // Frame of the input per frame of the take; empty: unknown.
};

// An output, and what else is known of it.
struct RunResult {
  StyledTake output;
  double bone_length_error = 0;  // Largest change of a bone's length, metres.
  double gate = 1;               // Mean share of the style's dynamics that was let through.
};

// How many outputs there are of a system that cannot be run, and how many were asked for.
struct RecordedCount {
  size_t listed = 0, evaluated = 0;
};

// What a system is, as far as it is known.
struct SystemFacts {
  std::string recipe;                     // Empty where there is none.
  size_t bytes = 0, parameters = 0;       // 0 where nobody knows.
  std::optional<RecordedCount> recorded;  // Of systems whose outputs are files.
};

// A system's answers for single instants. Goes through them one after the other, and may keep
// buffers.
class InstantAnswers {
 public:
  virtual ~InstantAnswers() = default;
  // The change that it makes of frame `at` of `neutral`, seen as frame `seen_at` of `seen` (numbers
  // in the system's layout); nothing where it does not know the style.
  virtual std::optional<StyleDelta> change(const std::string& style, const Take& seen,
                                           float seen_at, const Take& neutral, float at) = 0;
};

// All of it may be asked by several threads at once.
class System {
 public:
  explicit System(std::string name) : name_(std::move(name)) {}
  virtual ~System() = default;

  const std::string& name() const { return name_; }  // In the report.
  virtual SystemFacts facts() const { return {}; }

  // The styles that it can be asked for.
  virtual std::vector<std::string> styles() const = 0;
  // Whether it can be asked for this. By default: where it has all the styles.
  virtual bool can_run(const TestInput& input, const StyleRequest& request) const;
  // What it makes of the whole take; `output.input` is the caller's. Fails with a message.
  virtual Result<RunResult> run(const TestInput& input, const StyleRequest& request) const = 0;

  // Its answers at one strength, for pose error and disturbances; null where it has none for single
  // instants.
  virtual std::unique_ptr<InstantAnswers> instants(double strength) const;
  // Of the windows that they look at.
  virtual PoseLayout layout() const { return PoseLayout::positions; }

  // Processor time of one step of one character, microseconds; NaN where it takes no steps.
  virtual double step_us(const TestInput& input) const;
  // The model that predicts its input; null where it predicts nothing.
  virtual std::shared_ptr<const Model> predicting_model() const { return nullptr; }

 private:
  std::string name_;
};

// The inputs themselves, as if they were the output for each style.
std::vector<StyledTake> untouched(const std::vector<TestInput>& inputs,
                                  const std::vector<std::string>& styles);

}  // namespace panache
