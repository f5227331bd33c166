#include "eval/systems/xia2015/xia2015.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "recipes/recipe.h"
#include "takes/manifest.h"

namespace panache {
namespace {

using namespace xia2015;

// The recent outputs of a style.
class Recent {
 public:
  void clear() { answers_.clear(); }
  void push(const Output& output, float seconds) {
    time_ += seconds;
    answers_.push_back({time_, output});
    while (answers_.size() > 2 && answers_[1].time <= time_ - kLag) answers_.pop_front();
  }
  // The output one database frame before the next one, which follows after `seconds`; linear
  // between two outputs. Null at the beginning.
  std::optional<Output> before_next(float seconds) const {
    if (answers_.empty()) return std::nullopt;
    const float at = time_ + seconds - kLag;
    size_t later = 0;
    while (later + 1 < answers_.size() && answers_[later].time < at) ++later;
    if (later == 0) return answers_.front().output;
    const Entry &a = answers_[later - 1], &b = answers_[later];
    const float t = std::clamp((at - a.time) / (b.time - a.time), 0.0f, 1.0f);
    Output output;
    for (size_t n = 0; n < output.size(); ++n) output[n] = std::lerp(a.output[n], b.output[n], t);
    return output;
  }

 private:
  static constexpr float kLag = 1 / static_cast<float>(kTakeRate);
  struct Entry {
    float time;
    Output output;
  };
  std::deque<Entry> answers_;
  float time_ = 0;
};

// The active styles, each with its own database and recent output. Mixing their outputs is the same
// as mixing the parameters of their linear maps, because the maps have the same input.
class LocalSource : public ChangeSource {
 public:
  struct Style {
    const Database* database;
    float strength;
    Recent recent;
  };
  LocalSource(const WindowKey& key, std::vector<Style> styles, const LocalSettings& settings)
      : key_(key), styles_(std::move(styles)), settings_(settings) {}

  AskedChange ask(const SourceInput& input) override {
    static const std::vector<float> units = default_recipe().output_scale();
    AskedChange out;
    std::array<float, kOutputs> change{};
    std::array<float, kKeySize> key;
    if (!styles_.empty()) key_.project(input.window, key);
    float total = 0;
    for (Style& style : styles_) {
      if (input.time.first) style.recent.clear();
      const size_t max = std::max<size_t>(1, style.database->examples().size() / 5);
      style.database->find(key, std::min(settings_.neighbours, max), neighbours_);
      const std::optional<Output> recent = style.recent.before_next(input.time.output);
      const LocalAnswer local =
          answer_locally(*style.database, neighbours_, key, recent ? &*recent : nullptr, settings_);
      style.recent.push(local.output, input.time.output);
      for (size_t n = 0; n < change.size(); ++n) {
        change[n] += style.strength * local.output[n] * units[n];
      }
      out.log_rate += style.strength * std::log(local.rate);
      for (size_t f = 0; f < kFeet; ++f) {
        out.contacts[f] += std::abs(style.strength) * local.contacts[f];
      }
      total += std::abs(style.strength);
    }
    out.delta = unpack(change);
    for (float& contact : out.contacts) contact = total > 0 ? contact / total : 0;
    return out;
  }

 private:
  const WindowKey& key_;
  std::vector<Style> styles_;
  LocalSettings settings_;
  std::vector<Database::Neighbour> neighbours_;
};

}  // namespace

Result<std::unique_ptr<Xia2015>> Xia2015::create(const std::string& name, const SystemData& data,
                                                 const LocalSettings& settings) {
  Progress progress("registering the pairs of " + name);
  std::vector<std::string> names;
  names.reserve(data.styles.size());
  for (const StyleName& style : data.styles) names.push_back(style.name);
  const SampleSet set(data.takes, data.pairings, names, default_recipe(), false);
  if (set.samples().empty()) {
    return Error{name + ": there is no pair of a neutral and a styled take to learn from"};
  }
  WindowKey key(set);
  std::vector<std::optional<Database>> made(names.size());
  parallel_for(static_cast<int>(names.size()), [&](int i) { made[i].emplace(set, key, i); });
  std::vector<std::string> styles;
  std::vector<Database> databases;
  for (size_t i = 0; i < names.size(); ++i) {
    if (made[i]->empty()) continue;
    styles.push_back(names[i]);
    databases.push_back(std::move(*made[i]));
  }
  return std::unique_ptr<Xia2015>(
      new Xia2015(name, std::move(styles), std::move(key), std::move(databases), settings));
}

Xia2015::Xia2015(std::string name, std::vector<std::string> styles, WindowKey key,
                 std::vector<Database> databases, const LocalSettings& settings)
    : ChangeSystem(std::move(name), std::move(styles)),
      key_(std::move(key)),
      databases_(std::move(databases)),
      settings_(settings) {}

SystemFacts Xia2015::facts() const {
  SystemFacts facts;
  for (const Database& database : databases_) facts.bytes += database.bytes();
  return facts;
}

std::unique_ptr<ChangeSource> Xia2015::make_source(const Take&, double,
                                                   const Strengths& strengths) const {
  std::vector<LocalSource::Style> styles;
  for (const auto& [style, strength] : strengths) {
    if (strength != 0) styles.push_back({&databases_[style], strength, {}});
  }
  return std::make_unique<LocalSource>(key_, std::move(styles), settings_);
}

}  // namespace panache
