#include "style/stylizer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "base/bytes.h"

namespace panache {

Result<Stylizer> Stylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                  const StylizerOptions& options) {
  if (Result<void> good = check(options, *model); !good) return good.error();
  return Stylizer(std::move(model), std::move(rig), options);
}

Stylizer::Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options)
    : stepper_(std::move(rig), model->layout(), options), source_(std::move(model), options) {}

void Stylizer::reset() noexcept {
  stepper_.reset();
  source_.reset_gestures();
}

void Stylizer::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(this, sizeof *this);
  stepper_.add_memory(prefetch);
  source_.add_memory(prefetch);
}

template <class Self, class Visit>
void Stylizer::visit_state(Self& self, Visit&& visit) {
  Stepper::visit_state(self.stepper_, visit);
  NetworkSource::visit_state(self.source_, visit);
}

size_t Stylizer::state_size() const noexcept {
  return state_bytes([this](auto&& visit) { visit_state(*this, visit); });
}

void Stylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  write_state(out, [this](auto&& visit) { visit_state(*this, visit); });
}

bool Stylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size() || !is_whole_state(in)) return false;
  read_state(in, [this](auto&& visit) { visit_state(*this, visit); });
  return true;
}

namespace {

// How many of the first members can be stepped together: different characters of one model.
size_t count_together(std::span<const CrowdMember> members) {
  const size_t max = std::min(members.size(), kRowsAtOnce);
  for (size_t i = 1; i < max; ++i) {
    const Stylizer* character = members[i].character;
    const bool seen = std::any_of(members.begin(), members.begin() + i,
                                  [&](const CrowdMember& m) { return m.character == character; });
    if (seen || &character->model() != &members[0].character->model()) return i;
  }
  return max;
}

// Prefetches the memory of a later character, a part at each stage of this one.
class FetchLater final : public StageClock {
 public:
  void begin(const CrowdMember& later, void (*add_memory)(const CrowdMember&, Prefetch&)) {
    prefetch_.emplace();
    add_memory(later, *prefetch_);
  }
  void done(Stage) noexcept override {
    constexpr int kLines = 14;
    if (prefetch_) prefetch_->fetch(kLines);
  }

 private:
  std::optional<Prefetch> prefetch_;
};

}  // namespace

void step_crowd(std::span<const CrowdMember> members, double seconds) noexcept {
  const auto add_memory = [](const CrowdMember& member, Prefetch& prefetch) {
    prefetch.add(member.in.rotations);
    prefetch.add(member.in.translations);
    member.character->add_memory(prefetch);
    prefetch.add(member.out.rotations);
    prefetch.add(member.out.translations);
  };
  while (!members.empty()) {
    const size_t count = count_together(members);
    std::array<std::array<float, InputWindow::kMaxNumbers>, kRowsAtOnce> windows;
    std::array<SourceInput, kRowsAtOnce> inputs;
    std::array<StyleNetworks::Pass, StyleNetworks::kMaxPasses * kRowsAtOnce> passes;
    size_t pass_count = 0;
    std::array<FetchLater, kRowsAtOnce> fetches;
    for (size_t i = 0; i < count; ++i) {
      const auto& [character, in, strengths, out] = members[i];
      if (count + i < members.size()) fetches[i].begin(members[count + i], add_memory);
      // The next character's history arrives from a far cache in time.
      if (i + 1 < members.size()) members[i + 1].character->stepper_.fetch_poses(seconds);
      inputs[i] = character->stepper_.take_in(in, {seconds, seconds}, windows[i], &fetches[i]);
      character->source_.set_strengths(strengths);
      pass_count += character->source_.begin(
          inputs[i], std::span(passes).subspan(pass_count).first<StyleNetworks::kMaxPasses>());
    }
    StyleNetworks::forward_all(std::span(passes).first(pass_count));
    for (size_t i = 0; i < count; ++i) {
      Stylizer& character = *members[i].character;
      character.stepper_.give_out(character.source_.finish(inputs[i]), inputs[i], members[i].out);
    }
    members = members.subspan(count);
  }
}

}  // namespace panache
