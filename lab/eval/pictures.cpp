#include <algorithm>
#include <cmath>

#include "eval/evaluate.h"
#include "takes/load_takes.h"

namespace panache {
namespace {

constexpr size_t kPictures = 8;
constexpr double kSpacing = 0.25;  // Seconds between figures,
constexpr int kFigures = 16;       // and their maximum number.

StripRow strip_row(const std::string& label, const Take& take) {
  StripRow row{label, {}, ""};
  const double step = kSpacing * kTakeRate;
  for (int i = 0; i < kFigures && i * step < take.frames(); ++i) {
    const int frame = std::min(static_cast<int>(std::lround(i * step)), take.frames() - 1);
    row.frames.push_back(world_positions(take, frame));
  }
  return row;
}

}  // namespace

Result<void> add_pictures(const std::vector<const System*>& systems, const TestSet& test_set,
                          Report& report) {
  // One content after the other, each in a different style.
  size_t drawn = 0;
  std::string last;
  for (size_t i = 0; i < test_set.inputs.size() && drawn < kPictures; ++i) {
    const ManifestRow& row = test_set.inputs[i].take.row;
    if (row.content == last) continue;
    const std::string& style = test_set.styles[drawn % test_set.styles.size()];
    const auto real = std::find_if(
        test_set.evaluator.test().begin(), test_set.evaluator.test().end(), [&](const Take& take) {
          return take.row.style == style && take.row.content == row.content;
        });
    if (real == test_set.evaluator.test().end()) continue;
    last = row.content;
    const std::string title = row.content + ", " + style;
    StripReport strip{title, {strip_row("input", test_set.inputs[i].take)}, kSpacing};
    ContactReport contacts{title, {{"input", kTakeRate, test_set.inputs[i].take.contacts}}};
    for (const System* system : systems) {
      const StyleRequest request{style, {{style, 1.0f}}};
      if (!system->can_run(test_set.inputs[i], request)) continue;
      Result<RunResult> run_result = system->run(test_set.inputs[i], request);
      if (!run_result) return run_result.error();
      strip.rows.push_back(strip_row(system->name(), run_result->output.take));
      contacts.rows.push_back({system->name(), kTakeRate, run_result->output.take.contacts});
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
