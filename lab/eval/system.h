#pragma once
// The interface of everything that is evaluated: systems that give motion a style.

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
#include "style/model/model.h"
#include "style/restyle.h"

namespace panache {

// Strengths at which every system is run; 1 is the style as captured.
inline constexpr std::array kStrengths = {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};

// A request: strengths of styles, and the style to evaluate the result as.
struct StyleRequest {
  std::string style;
  std::vector<std::pair<std::string, float>> strengths;
  bool timing = true;  // In the style's own tempo; false: frame by frame as the input.
};

// The output for a neutral take. `take.row` names the requested style and the content.
struct StyledTake {
  Take take;
  int input = 0;                     // Index of the neutral take.
  std::vector<float> source_frames;  // Input frame per frame of the take; empty: unknown.
};

// An output and its statistics.
struct RunResult {
  StyledTake output;
  double bone_length_error = 0;  // Largest change of a bone's length, metres.
  double gate = 1;               // Mean share of the style's dynamics let through.
};

// The number of recorded outputs of a system, and how many of them were requested.
struct RecordedCount {
  size_t listed = 0, evaluated = 0;
};

// Facts about a system, if known.
struct SystemFacts {
  std::string recipe;                     // Or empty.
  size_t bytes = 0, parameters = 0;       // 0 if unknown.
  std::optional<RecordedCount> recorded;  // For systems whose outputs are files.
};

// A system's output for single instants, which are requested in order of time. May keep buffers.
class InstantAnswers {
 public:
  virtual ~InstantAnswers() = default;
  // The change for frame `at` of `neutral`, seen as frame `seen_at` of `seen` (features in the
  // system's layout); empty if the style is unknown.
  virtual std::optional<StyleDelta> change(const std::string& style, const Take& seen,
                                           float seen_at, const Take& neutral, float at) = 0;
};

// Thread-safe.
class System {
 public:
  explicit System(std::string name) : name_(std::move(name)) {}
  virtual ~System() = default;

  const std::string& name() const { return name_; }  // As in the report.
  virtual SystemFacts facts() const { return {}; }

  // The available styles.
  virtual std::vector<std::string> styles() const = 0;
  // Whether the request is supported. Default: if it has all the styles.
  virtual bool can_run(const TestInput& input, const StyleRequest& request) const;
  // Runs it on the whole take; the caller sets `output.input`. Fails with a message.
  virtual Result<RunResult> run(const TestInput& input, const StyleRequest& request) const = 0;

  // Its output at one strength, for pose error and disturbances; null if it has none for single
  // instants.
  virtual std::unique_ptr<InstantAnswers> instants(double strength) const;
  // Layout of the windows that these see.
  virtual PoseLayout layout() const { return PoseLayout::positions; }

  // CPU time of one step of one character, microseconds; NaN if it has no steps.
  virtual double step_us(const TestInput& input) const;
  // The model that it runs, or null.
  virtual std::shared_ptr<const Model> model() const { return nullptr; }

 private:
  std::string name_;
};

// The inputs themselves as outputs for each style.
std::vector<StyledTake> untouched(const std::vector<TestInput>& inputs,
                                  const std::vector<std::string>& styles);

// The output of restyle(), for evaluation.
RunResult styled_result(const TestInput& input, const std::string& style, const Restyled& output);

}  // namespace panache
