#pragma once
// A model as a source of change: its networks, weighted by the styles' strengths and sides, and its
// gestures.

#include "style/networks/change_source.h"
#include "style/networks/networks.h"
#include "style/stages/strengths.h"
#include "style/stylizer_options.h"

namespace panache {

// The constructor allocates; nothing else does, and nothing fails.
class NetworkSource final : public ChangeSource {
 public:
  NetworkSource(std::shared_ptr<const Model> model, const StylizerOptions& options);

  // See Stylizer. The strengths are read at the next instant, [styles].
  void set_strengths(std::span<const float> strengths) noexcept { wanted_ = strengths; }
  void set_side(int style, float side) noexcept;
  void set_shape(const Shape& shape) noexcept { shape_ = shape; }
  const Shape& shape() const noexcept { return shape_; }
  const std::vector<float>& sides() const noexcept { return sides_; }
  void set_person(std::span<const float> numbers) noexcept;
  const PersonNumbers& person() const noexcept { return person_; }
  bool trigger(int style, int gesture) noexcept;
  void set_gesture_rate(float rate) noexcept { options_.gesture_rate = rate; }
  void reset_gestures() noexcept { gestures_.reset(options_.gesture_seed); }

  PoseLayout layout() const override { return model().layout(); }
  AskedChange ask(const SourceInput& input) noexcept override;
  // The two parts of ask(); between them, a crowd's networks are evaluated together. Writes the
  // passes to evaluate and returns their number.
  size_t begin(const SourceInput& input,
               std::span<StyleNetworks::Pass, StyleNetworks::kMaxPasses> passes) noexcept;
  AskedChange finish(const SourceInput& input) noexcept;

  // At the last instant; see Stylizer.
  float amount() const noexcept;
  float gate() const noexcept { return networks_.gate(); }
  const GesturePose* gesture() const noexcept { return gestures_.now(); }
  const Model& model() const noexcept { return networks_.model(); }

  // Adds the memory that is used outside this object.
  void add_memory(Prefetch& prefetch) const noexcept { networks_.add_memory(prefetch); }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    EasedStrengths::visit_state(self.strengths_, visit);
    StyleNetworks::visit_state(self.networks_, visit);
    GesturePlayer::visit_state(self.gestures_, visit);
  }

 private:
  void ease_strengths(const SourceInput& input) noexcept;

  struct {
    float gesture_rate;
    uint32_t gesture_seed;
    float ease_seconds;
  } options_;
  std::span<const float> wanted_;
  std::vector<float> sides_;  // As requested. [styles]
  Shape shape_;               // As requested.
  PersonNumbers person_;      // As requested.
  EasedStrengths strengths_;
  StyleNetworks networks_;
  GesturePlayer gestures_;
};

}  // namespace panache
