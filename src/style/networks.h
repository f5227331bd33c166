#pragma once
// The networks of a model, evaluated for one character.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "style/model.h"

namespace panache {

// The evaluation of a model for one character. It holds little more than its results; scratch
// memory is on the stack, so that a thousand characters and the model share the caches.
class StyleNetworks {
 public:
  explicit StyleNetworks(std::shared_ptr<const Model> model);

  // Strengths from now on, one per style of the model; above 1 a strength has less effect. A
  // forward pass evaluates only the heads of styles with a nonzero strength.
  void set_strengths(std::span<const float> strengths) noexcept;

  // Evaluates a window as PoseHistory::window() gives it. The results stay until the next call. The
  // gate moves by the share `gate_share` from its last value towards the window's.
  void forward(std::span<const float> window, float gate_share = 1) noexcept;
  // The same for several characters of one model at once, which share the reading of its weights;
  // bit-identical to forward() for each. No character may occur twice. Allocates nothing; uses
  // about 200 KB of stack.
  struct Pass {
    StyleNetworks* networks;
    std::span<const float> window;
    float gate_share = 1;
  };
  static void forward_all(std::span<const Pass> passes) noexcept;
  // How much of the styles' response to this motion is used, instead of their mean: 1 on most
  // motion similar to the training data, towards 0 on out-of-distribution motion. Each learnt style
  // has a gate; this is the mean over the active styles, weighted by strength.
  float gate() const noexcept;
  // The features that styles are learnt on: the activations of all hidden layers of the pose trunk
  // for a window. out.size() = Model::activation_count().
  void activations(std::span<const float> window, std::span<float> out) const noexcept;
  // The pose network's denormalised outputs; Recipe::to_change() converts them. [Recipe::outputs]
  std::span<const float> pose() const { return pose_out_; }
  // The sum of the active styles' stances, weighted by strength.
  Stance stance() const noexcept;
  float log_rate() const { return timing_out_[0]; }  // log of input seconds per output second.
  std::span<const float> contact() const { return contact_out_; }  // Probability per foot [2].

  const Model& model() const { return *model_; }
  // Adds strengths and results.
  void add_memory(Prefetch& prefetch) const noexcept;

  // Calls visit(member) for everything that tells one character from another of this model.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.strengths_), visit(self.pose_out_), visit(self.timing_out_);
    visit(self.contact_out_), visit(self.gate_), visit(self.learnt_gates_);
  }

 private:
  class ScratchArena;
  static void evaluate(std::span<const Pass> passes, std::span<float> numbers) noexcept;
  // Writes the networks' input: the window and further features.
  void write_input(std::span<const float> window, std::span<float> input) const noexcept;
  // Moves the pose trunk's activations towards their mean as the gates close.
  static Rows<const float> shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                  ScratchArena& arena) noexcept;
  // A range that includes all styles with a nonzero strength.
  struct Styles {
    size_t begin, end;
  };
  static Styles styles_in_force(std::span<const Pass> passes) noexcept;
  // Writes the sum of a network's active heads, weighted by strength, to out(character).
  template <class Out>
  static void add_heads(std::span<const Pass> passes, Styles in_force, int network,
                        Rows<const float> hidden, ScratchArena& arena, Out out) noexcept;
  // Adds the outputs of the active learnt styles, from the trunks' activations in `scratch`.
  static void add_learnt(std::span<const Pass> passes, std::span<const float> scratch,
                         ScratchArena& arena);
  // How far a window is from a style's examples; at 1 its gate begins to close. Writes the
  // standardised difference of the activations from their mean to `apart`.
  float leverage(const Model::Learnt& learnt, std::span<const float> activations,
                 std::span<float> apart, ScratchArena& arena) const noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<float> strengths_;
  std::vector<float> pose_out_;
  std::array<float, 1> timing_out_{};
  std::array<float, 2> contact_out_{};
  float gate_ = 1;                   // The built-in styles' gate.
  std::vector<float> learnt_gates_;  // From when each style was last active. [learnt styles]
};

}  // namespace panache
