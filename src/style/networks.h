#pragma once
// The networks of a model, evaluated for one character.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "style/model.h"

namespace panache {

// The evaluation of a model for one character. It holds little more than its results: what it works
// in is on the stack, so that a thousand characters share the caches with the one model.
class StyleNetworks {
 public:
  explicit StyleNetworks(std::shared_ptr<const Model> model);

  // Strengths in force from now on, one per style of the model; above 1 a strength counts less. A
  // forward pass goes through the heads of the styles that are not 0, and through no other.
  void set_strengths(std::span<const float> strengths) noexcept;

  // Evaluates a window as PoseHistory::window() gives it. The results stay until the next call.
  // The gate goes this share of the way from where it was to where the window wants it.
  void forward(std::span<const float> window, float gate_share = 1) noexcept;
  // The same for several characters of one model at once, which reads its weights once for several
  // of them: bit for bit what forward() gives each. No character may come twice. Allocates nothing;
  // works in about 200 KB of the stack.
  struct Pass {
    StyleNetworks* networks;
    std::span<const float> window;
    float gate_share = 1;
  };
  static void forward_all(std::span<const Pass> passes) noexcept;
  // How much of the styles' answer to this very motion is given, beside their mean answer: 1 on
  // most motion like what they were trained or learnt on, towards 0 on motion unlike it. Learnt
  // styles have a gate each; this is the mean over the styles in force, by their strengths.
  float gate() const noexcept;
  // The features that styles are learnt on: the activations of all hidden layers of the pose trunk
  // for a window. out.size() = Model::activation_count().
  void activations(std::span<const float> window, std::span<float> out) const noexcept;
  // The pose network's numbers, in the model's own units undone. What change they are,
  // Recipe::to_change() tells. [Recipe::outputs]
  std::span<const float> pose() const { return pose_out_; }
  // Of the styles in force together, by their strengths.
  Stance stance() const noexcept;
  float log_rate() const { return timing_out_[0]; }  // log of input seconds per output second.
  std::span<const float> contact() const { return contact_out_; }  // Probability per foot [2].

  const Model& model() const { return *model_; }
  // Names strengths and results.
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
  // Writes a window, and what else the networks take in.
  void write_input(std::span<const float> window, std::span<float> input) const noexcept;
  // Draws the pose trunk's activations towards their mean as far as the gates are closed.
  static Rows<const float> shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                  ScratchArena& arena) noexcept;
  // All styles with a strength that is not 0 are among these.
  struct Styles {
    size_t begin, end;
  };
  static Styles styles_in_force(std::span<const Pass> passes) noexcept;
  // The sum of a network's heads in force, each times its strength, into out(character).
  template <class Out>
  static void add_heads(std::span<const Pass> passes, Styles in_force, int network,
                        Rows<const float> hidden, ScratchArena& arena, Out out) noexcept;
  // Adds what the learnt styles in force answer to what the trunks have left in `scratch`.
  static void add_learnt(std::span<const Pass> passes, std::span<const float> scratch,
                         ScratchArena& arena);
  // How far a window is from those that a style was learnt from: 1 where trust in it ends. Leaves
  // the standardised difference of the activations from their mean in `apart`.
  float leverage(const Model::Learnt& learnt, std::span<const float> activations,
                 std::span<float> apart, ScratchArena& arena) const noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<float> strengths_;
  std::vector<float> pose_out_;
  std::array<float, 1> timing_out_{};
  std::array<float, 2> contact_out_{};
  float gate_ = 1;                   // Of the built-in styles.
  std::vector<float> learnt_gates_;  // As it was when the style was last in force. [learnt styles]
};

}  // namespace panache
