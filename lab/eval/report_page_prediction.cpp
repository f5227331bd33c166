#include "eval/report_numbers.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

std::string prediction_table(const SystemReport& system) {
  HtmlTable table("content");
  for (const double seconds : kPredictionSeconds) {
    table.add_columns(number_text(seconds, 2) + " s ahead, cm", {"predicted", "velocity", "held"});
  }
  for (const PredictionRow& row : system.prediction) {
    std::vector<HtmlCell> cells;
    for (size_t h = 0; h < kPredictionSeconds.size(); ++h) {
      const std::vector<double> values = {row.predicted_cm[h], row.velocity_cm[h], row.held_cm[h]};
      const std::vector<bool> best = best_of(values, Better::lower, 2);
      for (size_t i = 0; i < values.size(); ++i) {
        cells.push_back({number_text(values[i], 2), best[i]});
      }
    }
    table.add_row(row.content, std::move(cells));
  }
  return table.str(system.name);
}

}  // namespace

std::string page_prediction(const Report& report) {
  std::string out;
  for (const SystemReport& system : report.systems) {
    if (!system.prediction.empty()) out += prediction_table(system);
  }
  return out;
}

}  // namespace panache
