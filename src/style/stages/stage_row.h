#pragma once
// A list of stages that run one after the other.

#include <algorithm>
#include <array>
#include <cstddef>

namespace panache {

// Timing of the stages of a step.

// The number of a stage in kStageNames (style/stages/change_stages.h): these, then the row of
// stages, then the writing of the pose.
enum class Stage : size_t {
  observe,    // Observer
  window,     // InputWindow
  strengths,  // EasedStrengths
  networks,   // StyleNetworks
  first_of_row,
};

// Is notified when each stage of a step is done.
class StageClock {
 public:
  virtual ~StageClock() = default;
  virtual void done(Stage stage) noexcept = 0;
};

// `clock` may be null.
inline void tell(StageClock* clock, Stage stage) noexcept {
  if (clock) clock->done(stage);
}

// A text as a template argument.
template <size_t kSize>
struct StageName {
  constexpr StageName(const char (&name)[kSize]) { std::copy_n(name, kSize, text); }  // NOLINT
  char text[kSize];
};

// A stage and its name.
template <class Memory, StageName kText>
struct Named : Memory {
  using Stage = Memory;
  static constexpr const char* kName = kText.text;
};

// The base of a stage without memory from one step to the next.
struct NoMemory {
  void reset() noexcept {}
  template <class Self, class Visit>
  static void visit_state(Self&, Visit&&) {}
};

// The memory of several stages, each of a different type.
template <class... Stages>
class StageRow : Stages... {
 public:
  static constexpr std::array kNames = {Stages::kName...};

  template <class Stage>
  Stage& get() noexcept {
    return *this;
  }
  template <class Stage>
  const Stage& get() const noexcept {
    return *this;
  }
  // Calls visit(stage) for each, in their order.
  template <class Visit>
  void each(Visit&& visit) noexcept {
    (visit(static_cast<typename Stages::Stage&>(*this)), ...);
  }
  template <class Visit>
  void each(Visit&& visit) const noexcept {
    (visit(static_cast<const typename Stages::Stage&>(*this)), ...);
  }
};

}  // namespace panache
