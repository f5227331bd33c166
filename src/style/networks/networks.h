#pragma once
// The networks of a model, evaluated for one character.

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "net/dense.h"
#include "style/model/model.h"

namespace panache {

// The evaluation of a model for one character. It holds little more than its results; scratch
// memory is on the stack, so that a thousand characters and the model share the caches.
//
// With networks H and M, which mirrors left and right, the output to a window x of a style with
// side s (find_side()) is
//   (1 + s) / 2 H(x) + (1 - s) / 2 M H(M x).
// Each term takes a pass, unless it is zero in all active styles. Sides, gates and strengths are in
// networks_sides.cpp, learnt styles and persons in networks_learnt.cpp.
class StyleNetworks {
 public:
  enum class Half { captured, mirrored };  // The first and the second term.
  explicit StyleNetworks(std::shared_ptr<const Model> model);

  // Strengths from now on, one per style of the model; above 1 a strength has less effect. A
  // forward pass evaluates only the heads of styles with a nonzero strength. `sides`: likewise, -1
  // to 1; if empty, all are 1, as they always are in models without a head per style.
  void set_strengths(std::span<const float> strengths, std::span<const float> sides = {}) noexcept;
  // The numbers of a person from now on, PersonSpace::axes() or more; all 0 is no person, as at
  // first. Ignored if the model has no persons.
  void set_person(std::span<const float> numbers) noexcept;
  // Moves them towards others by this gain of a filter.
  void ease_person(const PersonNumbers& numbers, float gain) noexcept;
  const PersonNumbers& person() const { return person_; }

  // Evaluates a window as PoseHistory::window() gives it. The results stay until the next call. The
  // gate moves by the share `gate_share` from its last value towards the window's.
  void forward(std::span<const float> window, float gate_share = 1) noexcept;
  // The same for several characters of one model at once, which share the reading of its weights;
  // bit-identical to forward() for each. `passes`: those that passes() gives for each character, in
  // that order. Allocates nothing; uses about 200 KB of stack.
  struct Pass {
    StyleNetworks* networks;
    std::span<const float> window;
    float gate_share = 1;
    Half half = Half::captured;
  };
  static void forward_all(std::span<const Pass> passes) noexcept;
  // Writes the passes that the strengths and sides need for a window, and returns their number: 1,
  // or 2 while an active style is between its sides.
  static constexpr size_t kMaxPasses = 2;
  size_t passes(std::span<const float> window, float gate_share,
                std::span<Pass, kMaxPasses> out) noexcept;
  // How much of the styles' response to this motion is used, instead of their mean: 1 on most
  // motion similar to the training data, towards 0 on out-of-distribution motion. Each learnt style
  // has a gate; this is the mean over the active styles, weighted by strength.
  float gate() const noexcept;
  // The features that styles are learnt on: the activations of all hidden layers of the pose trunk
  // for a window. out.size() = Model::activation_count().
  void activations(std::span<const float> window, std::span<float> out) const noexcept;
  // The pose network's denormalised outputs; Recipe::to_change() converts them. [Recipe::outputs]
  std::span<const float> pose() const { return result().pose; }
  // The sum of the active styles' stances, weighted by strength.
  Stance stance() const noexcept;
  float log_rate() const { return result().timing[0]; }  // log of input seconds per output second.
  std::array<float, 2> contact() const noexcept;         // Probability per foot.

  const Model& model() const { return *model_; }
  // Adds strengths and results.
  void add_memory(Prefetch& prefetch) const noexcept;

  // Calls visit(member) for everything that tells one character from another of this model.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.strengths_), visit(self.sides_), visit(self.person_), visit(self.is_person_);
    for (auto& half : self.halves_) {
      visit(half.runs), visit(half.pose), visit(half.timing), visit(half.contact);
      visit(half.gate), visit(half.learnt_gates);
    }
  }

 private:
  class ScratchArena;
  // The memory of one half. The captured one has the results of both, once they are evaluated.
  struct HalfMemory {
    bool runs = false;        // Whether the last passes() has one of this half.
    std::vector<float> pose;  // [Recipe::outputs]
    std::array<float, 1> timing{};
    std::array<float, 2> contact{};   // Logits.
    float gate = 1;                   // The built-in styles' gate.
    std::vector<float> learnt_gates;  // From when each style was last active. [learnt styles]
  };
  HalfMemory& of(Half half) noexcept { return halves_[static_cast<size_t>(half)]; }
  const HalfMemory& of(Half half) const noexcept { return halves_[static_cast<size_t>(half)]; }
  const HalfMemory& result() const noexcept { return of(Half::captured); }
  static HalfMemory& memory(const Pass& pass) noexcept { return pass.networks->of(pass.half); }
  // The factor of a half in the output of a style,
  float share(Half half, size_t style) const noexcept {
    return (half == Half::captured ? 1 + sides_[style] : 1 - sides_[style]) / 2;
  }
  // and in what no style owns: the mean over the active styles, weighted by strength.
  float share(Half half) const noexcept;
  // Mirrors the results of the mirrored half back, and adds them to those of the captured one.
  void add_mirrored() noexcept;
  static void evaluate(std::span<const Pass> passes, std::span<float> numbers) noexcept;
  // Writes the networks' input: the window, as this half sees it, and further features.
  void write_input(std::span<const float> window, Half half, std::span<float> input) const noexcept;
  // A range that includes all styles with a nonzero strength.
  struct Styles {
    size_t begin, end;
  };
  // Moves the gates; `centred` gets the difference of the pose trunk's last activations from their
  // mean on training motion.
  static void ease_gates(std::span<const Pass> passes, Rows<const float> hidden,
                         Rows<float> centred, ScratchArena& arena) noexcept;
  // Moves the pose trunk's activations towards their mean as the gates close.
  static Rows<const float> shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                  ScratchArena& arena) noexcept;
  // The same as add_heads() for pose heads that read the activations of all layers, in `scratch`.
  static void add_reduced(std::span<const Pass> passes, Styles active,
                          std::span<const float> scratch, ScratchArena& arena) noexcept;
  static Styles active_styles(std::span<const Pass> passes) noexcept;
  // Writes the sum of a network's active heads, weighted by strength, to out(character).
  template <class Out>
  static void add_heads(std::span<const Pass> passes, Styles active, int network,
                        Rows<const float> hidden, ScratchArena& arena, Out out) noexcept;
  // Adds the outputs of the active learnt styles, from the trunks' activations in `scratch`.
  static void add_learnt(std::span<const Pass> passes, std::span<const float> scratch,
                         ScratchArena& arena);
  // Adds the outputs of the characters' persons, likewise.
  static void add_person(std::span<const Pass> passes, std::span<const float> scratch,
                         ScratchArena& arena) noexcept;
  // How far a window is from a style's examples; at 1 its gate begins to close. Writes the
  // standardised difference of the activations from their mean to `apart`.
  float leverage(const Model::Learnt& learnt, std::span<const float> activations,
                 std::span<float> apart, ScratchArena& arena) const noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<float> strengths_, sides_;  // [styles]
  PersonNumbers person_{};
  bool is_person_ = false;  // Whether any of them is not 0.
  std::array<HalfMemory, 2> halves_;
};

// Shared by the sources of StyleNetworks. Private to them.

// Moves a gate by `share` of the way; a share of 1 gives exactly `wanted`.
inline void ease_gate(float wanted, float share, float& open) {
  open = share < 1 ? open + share * (wanted - open) : wanted;
}

// An arena on the stack; allocations are aligned to cache lines.
class StyleNetworks::ScratchArena {
 public:
  explicit ScratchArena(std::span<float> numbers) : remaining_(numbers) {}
  std::span<float> take(size_t numbers) {
    const std::span<float> part = remaining_.first(padded(numbers));
    remaining_ = remaining_.subspan(part.size());
    return part;
  }
  // `count` rows of `numbers` floats.
  Rows<float> rows(size_t count, size_t numbers) {
    return {take(count * padded(numbers)).data(), count, padded(numbers)};
  }
  // The remaining memory, for a nested arena.
  std::span<float> remaining() const { return remaining_; }

 private:
  std::span<float> remaining_;
};

}  // namespace panache
