// Sections of the page: what was judged, and how the systems do on what they were trained for.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "draw/plot.h"
#include "draw/svg.h"
#include "base/xml.h"
#include "eval/measure.h"
#include "eval/report_numbers.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

bool is_accuracy(const Measure& measure) { return measure.better == Better::higher; }

HtmlCell value_cell(const Measure& measure, double value, bool best) {
  return {number_text(value, measure.digits), best, is_accuracy(measure) ? value : kNotMeasured};
}

double value_in(const MetricsTable& table, const std::string& name, const char* measure) {
  const auto row = table.find(name);
  return row == table.end() ? kNotMeasured : row->second[measure];
}

// The cells of one row in the columns of `sources`, the best of those that compete marked.
std::vector<HtmlCell> row_cells(const Measure& measure, const std::string& row,
                                const std::vector<MetricsSource>& sources) {
  std::vector<double> rivals;
  rivals.reserve(sources.size());
  for (const MetricsSource& source : sources) {
    rivals.push_back(source.competes ? value_in(*source.table, row, measure.key) : kNotMeasured);
  }
  const std::vector<bool> best = best_of(rivals, measure.better, measure.digits);
  std::vector<HtmlCell> cells;
  cells.reserve(sources.size());
  for (size_t s = 0; s < sources.size(); ++s) {
    cells.push_back(value_cell(measure, value_in(*sources[s].table, row, measure.key), best[s]));
  }
  return cells;
}

bool measured(const MetricsTable& table, const char* measure) {
  return std::any_of(table.begin(), table.end(),
                     [&](const auto& row) { return std::isfinite(row.second[measure]); });
}

// One row of the overall table.
void add_overall_row(HtmlTable& table, const std::string& name, const Metrics& metrics,
                     const std::vector<bool>& best, bool apart) {
  std::vector<HtmlCell> cells = {{count_text(metrics.takes)}, {count_text(metrics.windows)}};
  for (size_t m = 0; m < measures().size(); ++m) {
    const Measure& measure = measures()[m];
    cells.push_back(value_cell(measure, metrics[measure.key], best[m]));
  }
  table.add_row(name, std::move(cells), apart);
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? kDash : out;
}

void add_fact(std::string& facts, const std::string& term, const std::string& text) {
  facts += "<dt>" + xml_escaped(term) + "</dt><dd>" + xml_escaped(text) + "</dd>\n";
}

// "0.992 (usual: at least 0.950)".
std::string with_floor(double value, double floor) {
  std::string out = number_text(value, 3);
  return out + " (usual: at least " + number_text(floor, 3) + ")";
}

// All measures of each row of one system.
std::string all_numbers(const std::string& rows_are, const MetricsTable& table,
                        const std::vector<std::string>& order) {
  HtmlTable out(rows_are);
  std::vector<std::string> labels = {"takes", "windows"};
  for (const Measure& measure : measures()) labels.emplace_back(measure.label);
  out.add_columns("", labels);
  const std::vector<bool> none(measures().size());
  for (const std::string& name : names_of({&table}, order)) {
    add_overall_row(out, name, table.at(name), none, false);
  }
  return out.str();
}

// The table of the main numbers, and those of all numbers behind it.
std::string by_name(const Report& report, const std::string& rows_are,
                    const std::vector<std::string>& order, const MetricsTable& real,
                    const MetricsTable* input, const MetricsTable SystemReport::*of_system) {
  std::vector<MetricsSource> sources = {{"real", &real}};
  if (input) sources.push_back({"input", input});
  std::vector<const MetricsTable*> tables;
  std::string details;
  for (const SystemReport& system : report.systems) {
    sources.push_back({system.name, &(system.*of_system), true});
    tables.push_back(&(system.*of_system));
    details += html_details("All numbers of " + system.name,
                            all_numbers(rows_are, system.*of_system, order));
  }
  if (names_of(tables, order).empty()) return "";
  tables.push_back(&real);
  const std::vector<std::string> rows = names_of(tables, order);
  // What tells most, in tables that fit a page with three systems in them.
  const std::vector<const char*> recognised = {"style_accuracy", "content_accuracy"};
  const std::vector<const char*> moved = {"jerk_ratio", "skating_ratio", "pose_error_deg"};
  return metrics_matrix(rows_are, rows, sources, recognised) +
         metrics_matrix(rows_are, rows, sources, moved) + details;
}

// The strength that a key names.
double strength_of(const std::string& key) {
  double value = kNotMeasured;
  std::from_chars(key.data(), key.data() + key.size(), value);
  return value;
}

// Empty where no system was measured at any strength.
std::string strength_plot(const Report& report, const std::string& title, const std::string& label,
                          const char* measure) {
  std::vector<PlotSeries> curves;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t s = 0; s < report.systems.size(); ++s) {
    PlotSeries curve{report.systems[s].name, {}, {}, palette(s)};
    for (const auto& [key, metrics] : report.systems[s].strength) {
      if (!std::isfinite(strength_of(key)) || !std::isfinite(metrics[measure])) continue;
      curve.x.push_back(strength_of(key));
      curve.y.push_back(metrics[measure]);
      low = std::min(low, curve.x.back());
      high = std::max(high, curve.x.back());
    }
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  if (curves.empty()) return "";
  if (std::isfinite(report.real[measure])) {
    curves.push_back(
        {"real takes", {low, high}, {report.real[measure], report.real[measure]}, "#8a8a8a"});
  }
  return html_drawing(line_plot(title, "strength", label, curves), title + " over strength");
}

std::string slider_table(const Report& report) {
  HtmlTable table("");
  table.add_columns("rank correlation of strength with", {"style, 0 to 1", "distance, 0 to 2"});
  for (const SystemReport& system : report.systems) {
    if (!std::isfinite(system.slider_style) && !std::isfinite(system.slider_distance)) continue;
    table.add_row(system.name, {{number_text(system.slider_style, 3)},
                                {number_text(system.slider_distance, 3)}});
  }
  return table.str();
}

}  // namespace

std::string metrics_matrix(const std::string& rows_are, const std::vector<std::string>& rows,
                           const std::vector<MetricsSource>& sources,
                           const std::vector<const char*>& keys, const std::string& last_row) {
  HtmlTable table(rows_are);
  std::vector<std::pair<const Measure*, std::vector<MetricsSource>>> groups;
  for (const char* key : keys) {
    const Measure& measure = find_measure(key);
    std::vector<MetricsSource> shown;
    std::vector<std::string> labels;
    for (const MetricsSource& source : sources) {
      if (!measured(*source.table, key)) continue;
      shown.push_back(source);
      labels.push_back(source.name);
    }
    if (shown.empty()) continue;
    table.add_columns(measure.label, labels);
    groups.emplace_back(&measure, shown);
  }
  if (groups.empty()) return "";
  const auto add = [&](const std::string& row, bool apart) {
    std::vector<HtmlCell> cells;
    for (const auto& [measure, shown] : groups) {
      const std::vector<HtmlCell> more = row_cells(*measure, row, shown);
      cells.insert(cells.end(), more.begin(), more.end());
    }
    table.add_row(row, std::move(cells), apart);
  };
  for (const std::string& row : rows) add(row, false);
  if (!last_row.empty()) add(last_row, true);
  return table.str();
}

std::string page_evaluated(const Report& report) {
  std::string facts;
  add_fact(facts, "Evaluated on", joined(report.tested_on));
  add_fact(facts, "Trained on", joined(report.trained_on));
  add_fact(
      facts, "Real takes",
      count_text(report.real.takes) + " held out, " + count_text(report.real.windows) + " windows");
  add_fact(facts, "Styles", joined(report.styles));
  add_fact(facts, "Contents", joined(report.contents));
  add_fact(facts, "Style classifier on real takes",
           with_floor(report.real["style_accuracy"], report.style_floor));
  add_fact(facts, "Content classifier on real takes",
           with_floor(report.real["content_accuracy"], report.content_floor));
  for (const SystemReport& system : report.systems) {
    if (!system.recorded) continue;
    add_fact(facts, "Recorded outputs of " + system.name,
             std::to_string(system.recorded->evaluated) + " of " +
                 std::to_string(system.recorded->listed) + " judged");
  }
  add_fact(facts, "Time taken", duration_text(report.seconds));
  std::string out = "<dl class=\"facts\">\n" + facts + "</dl>\n";
  for (const std::string& note : ceiling_notes(report)) out += html_paragraph(note, "warning");
  return out;
}

std::string page_overall(const Report& report) {
  if (report.systems.empty() && report.real.takes == 0) return "";
  HtmlTable table("");
  std::vector<std::string> labels = {"takes", "windows"};
  std::vector<std::vector<bool>> best(report.systems.size());
  for (const Measure& measure : measures()) {
    labels.emplace_back(measure.label);
    std::vector<double> values;
    values.reserve(report.systems.size());
    for (const SystemReport& system : report.systems) values.push_back(system.seen[measure.key]);
    const std::vector<bool> marks = best_of(values, measure.better, measure.digits);
    for (size_t s = 0; s < marks.size(); ++s) best[s].push_back(marks[s]);
  }
  table.add_columns("", labels);
  const std::vector<bool> none(measures().size());
  add_overall_row(table, "real takes", report.real, none, false);
  add_overall_row(table, "input", report.input, none, false);
  for (size_t s = 0; s < report.systems.size(); ++s) {
    add_overall_row(table, report.systems[s].name, report.systems[s].seen, best[s], s == 0);
  }
  return table.str();
}

std::string page_by_content(const Report& report) {
  return by_name(report, "content", report.contents, report.real_by_content,
                 &report.input_by_content, &SystemReport::by_content);
}

std::string page_by_style(const Report& report) {
  return by_name(report, "style", report.styles, report.real_by_style, nullptr,
                 &SystemReport::by_style);
}

std::string page_strength(const Report& report) {
  std::string plots =
      strength_plot(report, "Style recognised", "share of windows", "style_accuracy") +
      strength_plot(report, "Content kept", "share of windows", "content_accuracy") +
      strength_plot(report, "Jerk", "ratio to real takes", "jerk_ratio") +
      strength_plot(report, "Distance from the input", "cm", "distance_cm");
  if (!plots.empty()) plots = "<div class=\"plots\">\n" + plots + "</div>\n";
  std::vector<std::string> order;
  std::vector<MetricsTable> tables;
  for (const SystemReport& system : report.systems) {
    tables.emplace_back(system.strength.begin(), system.strength.end());
    for (const auto& [key, metrics] : system.strength) {
      if (std::find(order.begin(), order.end(), key) == order.end()) order.push_back(key);
    }
  }
  std::vector<MetricsSource> sources;
  sources.reserve(tables.size());
  for (size_t s = 0; s < tables.size(); ++s) {
    sources.push_back({report.systems[s].name, &tables[s], false});
  }
  const std::string numbers =
      metrics_matrix("strength", order, sources,
                     {"style_accuracy", "content_accuracy", "jerk_ratio", "distance_cm"});
  return plots + slider_table(report) + html_details("The numbers of the curves", numbers);
}

}  // namespace panache
