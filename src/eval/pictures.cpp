#include <algorithm>
#include <cmath>

#include "eval/evaluate.h"

namespace panache {
namespace {

constexpr size_t kPictures = 8;
constexpr double kSpacing = 0.25;  // Seconds from figure to figure,
constexpr int kFigures = 16;       // and at most so many.

StripRow strip_row(const std::string& label, const Take& take) {
  StripRow row{label, {}, ""};
  const double step = kSpacing * kTakeRate;
  for (int i = 0; i < kFigures && i * step < take.frames(); ++i) {
    row.frames.push_back(world_positions(take, static_cast<int>(std::lround(i * step))));
  }
  return row;
}

}  // namespace

Result<void> add_pictures(const std::vector<const System*>& systems, const Bench& bench,
                          Report& report) {
  // One content after the other, each in another style.
  size_t drawn = 0;
  std::string last;
  for (size_t i = 0; i < bench.inputs.size() && drawn < kPictures; ++i) {
    const ManifestRow& row = bench.inputs[i].take.row;
    if (row.content == last) continue;
    const std::string& style = bench.styles[drawn % bench.styles.size()];
    const auto real =
        std::find_if(bench.judge.test().begin(), bench.judge.test().end(), [&](const Take& take) {
          return take.row.style == style && take.row.content == row.content;
        });
    if (real == bench.judge.test().end()) continue;
    last = row.content;
    const std::string title = row.content + ", " + style;
    StripReport strip{title, {strip_row("input", bench.inputs[i].take)}, kSpacing};
    ContactReport contacts{title, {{"input", kTakeRate, bench.inputs[i].take.contacts}}};
    for (const System* system : systems) {
      const Request request{style, {{style, 1.0f}}};
      if (!system->can_run(bench.inputs[i], request)) continue;
      Result<Played> played = system->run(bench.inputs[i], request);
      if (!played) return played.error();
      strip.rows.push_back(strip_row(system->name(), played->output.take));
      contacts.rows.push_back({system->name(), kTakeRate, played->output.take.contacts});
    }
    strip.rows.push_back(strip_row("real " + style, *real));
    contacts.rows.push_back({"real " + style, kTakeRate, real->contacts});
    report.strips.push_back(std::move(strip));
    report.contacts.push_back(std::move(contacts));
    ++drawn;
  }
  return {};
}

}  // namespace panache
