#include "style/stylizer.h"

#include <cassert>

#include "base/state_bytes.h"

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

}  // namespace panache
