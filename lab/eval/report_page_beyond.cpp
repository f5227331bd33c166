// Sections of the page: how the systems do on what they were not trained for.

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/xml.h"
#include "eval/report_numbers.h"
#include "eval/report_ood.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

std::string heading(const std::string& text) { return "<h3>" + xml_escaped(text) + "</h3>\n"; }

std::vector<std::string> names_of_systems(const std::vector<const SystemReport*>& systems) {
  std::vector<std::string> names;
  names.reserve(systems.size());
  for (const SystemReport* system : systems) names.push_back(system->name);
  return names;
}

// Systems of which `has` is true.
std::vector<const SystemReport*> systems_with(const Report& report,
                                              const std::function<bool(const SystemReport&)>& has) {
  std::vector<const SystemReport*> systems;
  for (const SystemReport& system : report.systems) {
    if (has(system)) systems.push_back(&system);
  }
  return systems;
}

std::string unseen_table(const Report& report, const UnseenReport& split) {
  // The last row stands in the tables under a name that no content has.
  const std::string kMean = "mean of these";
  MetricsTable unseen = split.by_content, seen = split.seen_by_content;
  MetricsTable blind = split.blind_by_content, posture = split.mean_posture_by_content;
  for (MetricsTable* table : {&seen, &blind, &posture}) {
    if (!table->empty()) (*table)[kMean] = mean_metrics(*table);
  }
  unseen[kMean] = split.mean;
  const std::vector<std::string> contents = names_of({&split.by_content}, report.contents);
  const std::vector<MetricsSource> sources = {
      {"unseen", &unseen}, {"seen", &seen}, {"real, blind", &blind}, {"mean posture", &posture}};
  const std::vector<const char*> kFirst = {"style_accuracy", "content_accuracy", "jerk_ratio",
                                           "pose_error_deg"};
  std::vector<const char*> others;
  for (const Measure& measure : measures()) {
    if (std::none_of(kFirst.begin(), kFirst.end(),
                     [&](std::string_view first) { return first == measure.key; })) {
      others.push_back(measure.key);
    }
  }
  return metrics_matrix("content", contents, sources, kFirst, kMean) +
         html_details("All other numbers of split " + split.name,
                      metrics_matrix("content", contents, sources, others, kMean));
}

std::string ood_table(const std::vector<const SystemReport*>& systems) {
  HtmlTable table("");
  table.add_columns("", {"clips", "pairs"});
  table.add_columns("jerk / input", {"median", "90%", "largest"});
  table.add_columns("velocity correlation", {"median", "lowest 10%"});
  table.add_columns("moved cm", {"mean"});
  table.add_columns("beyond limits", {"frames", "worst pair", "pairs"});
  table.add_columns("under the floor", {"frames", "worst pair", "pairs"});
  table.add_columns("jumps", {"frames", "pairs"});
  table.add_columns("skating", {"output", "input"});
  table.add_columns("turned deg", {"mean"});
  table.add_columns("drift m", {"largest"});
  table.add_columns("gate", {"mean"});
  for (const SystemReport* system : systems) {
    const OodSummary of = summarize_ood(system->ood);
    table.add_row(system->name, {{count_text(of.clips)},
                                 {count_text(of.rows)},
                                 {number_text(of.jerk_ratio_median, 2)},
                                 {number_text(of.jerk_ratio_p90, 2)},
                                 {number_text(of.jerk_ratio_max, 2)},
                                 {number_text(of.velocity_correlation_median, 3)},
                                 {number_text(of.velocity_correlation_p10, 3)},
                                 {number_text(of.distance_cm_mean, 2)},
                                 {number_text(of.beyond_limits_mean, 4)},
                                 {number_text(of.beyond_limits_max, 4)},
                                 {std::to_string(of.beyond_limits_rows)},
                                 {number_text(of.under_floor_mean, 4)},
                                 {number_text(of.under_floor_max, 4)},
                                 {std::to_string(of.under_floor_rows)},
                                 {std::to_string(of.jumps)},
                                 {std::to_string(of.jump_rows)},
                                 {number_text(of.skating_ratio_mean, 3)},
                                 {number_text(of.input_skating_ratio_mean, 3)},
                                 {number_text(of.turned_deg_mean, 1)},
                                 {number_text(of.drift_m_max, 2)},
                                 {number_text(of.gate_mean, 3)}});
  }
  return table.str();
}

std::string ood_styles_table(const Report& report,
                             const std::vector<const SystemReport*>& systems) {
  HtmlTable table("");
  table.add_columns("style recognised by", {"networks", "LDA"});
  table.add_columns("chosen among all styles by", {"networks", "LDA"});
  table.add_columns("signature", {"right sign", "right amount"});
  const auto add = [&](const std::string& name, const StyleSummary& of) {
    std::vector<HtmlCell> cells;
    for (const double share : {of.style_robust, of.style_lda, of.forced_mlp, of.forced_lda,
                               of.signature_sign, of.signature_amount}) {
      cells.push_back({number_text(share, 3), false, share});
    }
    table.add_row(name, std::move(cells), name == "input");
  };
  add("real takes", report.ood_real);
  add("real takes of unseen actions", report.ood_real_unseen);
  for (const SystemReport* system : systems) add(system->name, summarize_styles(system->ood));
  add("input", report.ood_input);
  return table.str();
}

// What a style changes: in real takes, and in a system's outputs. A bar of full length is the
// largest of a column; a dash is a trait that real takes do not agree on.
std::string signatures_table(const Report& report, const SystemReport& system) {
  const auto outputs = signatures_by_style(system.ood);
  HtmlTable table("style");
  std::vector<std::string> sources = {"real", system.name};
  for (const Trait& trait : kTraits) table.add_columns(trait.label, sources);
  table.add_columns("outputs", {"right sign", "right amount"});
  table.add_columns("real, left out", {"right sign", "right amount"});
  Traits largest{};
  for (const SignatureReport& signature : report.signatures) {
    const auto made = outputs.find(signature.style);
    for (size_t t = 0; t < kTraits.size(); ++t) {
      largest[t] = std::max(largest[t], std::abs(signature.real.change[t]));
      if (made != outputs.end())
        largest[t] = std::max(largest[t], std::abs(made->second.mean_change()[t]));
    }
  }
  for (const SignatureReport& signature : report.signatures) {
    const auto made = outputs.find(signature.style);
    if (made == outputs.end()) continue;
    std::vector<HtmlCell> cells;
    const Traits change = made->second.mean_change();
    for (size_t t = 0; t < kTraits.size(); ++t) {
      const bool certain = signature.real.certain[t];
      const double real = certain ? signature.real.change[t] : kNotMeasured;
      const double unit = std::max(largest[t], 1e-9);
      cells.push_back({number_text(real, 1), false, std::abs(real) / unit});
      cells.push_back({number_text(change[t], 1), false, std::abs(change[t]) / unit});
    }
    for (const SignatureMatch* match : {&made->second, &signature.left_out}) {
      for (const double share : {match->sign_share(), match->amount_share()}) {
        cells.push_back({number_text(share, 2), false, share});
      }
    }
    table.add_row(signature.style, std::move(cells));
  }
  return table.str("Signatures: what a style changes, in real takes and in the outputs of " +
                   system.name);
}

// The first rows by `worse`.
std::string worst_rows(std::vector<OodRow> rows,
                       const std::function<bool(const OodRow&, const OodRow&)>& worse,
                       const std::string& caption) {
  constexpr size_t kShown = 8;
  std::stable_sort(rows.begin(), rows.end(), worse);
  if (rows.size() > kShown) rows.resize(kShown);
  HtmlTable table("clip, style");
  table.add_columns(
      "", {"jerk / input", "velocity correlation", "moved cm", "beyond limits", "under the floor",
           "jumps", "skating", "of the input", "turned deg", "drift m", "gate"});
  for (const OodRow& row : rows) {
    table.add_row(row.clip + ", " + row.style, {{number_text(row.jerk_ratio, 2)},
                                                {number_text(row.velocity_correlation, 3)},
                                                {number_text(row.distance_cm, 2)},
                                                {number_text(row.beyond_limits, 3)},
                                                {number_text(row.under_floor, 3)},
                                                {std::to_string(row.jumps)},
                                                {number_text(row.skating_ratio, 3)},
                                                {number_text(row.input_skating_ratio, 3)},
                                                {number_text(row.turned_deg, 1)},
                                                {number_text(row.drift_m, 2)},
                                                {number_text(row.gate, 3)}});
  }
  return table.str(caption);
}

// Means over the styles, clip by clip.
std::string clips_table(const std::vector<const SystemReport*>& systems) {
  const struct {
    const char* label;
    double OodRow::*value;
    int digits;
  } kColumns[] = {{"jerk / input", &OodRow::jerk_ratio, 2},
                  {"velocity correlation", &OodRow::velocity_correlation, 3},
                  {"moved cm", &OodRow::distance_cm, 2},
                  {"under the floor", &OodRow::under_floor, 3},
                  {"gate", &OodRow::gate, 3}};
  HtmlTable table("clip");
  for (const auto& column : kColumns) table.add_columns(column.label, names_of_systems(systems));
  std::vector<std::string> clips;
  for (const SystemReport* system : systems) {
    for (const auto& [clip, rows] : ood_by_clip(system->ood)) {
      if (std::find(clips.begin(), clips.end(), clip) == clips.end()) clips.push_back(clip);
    }
  }
  for (const std::string& clip : clips) {
    std::vector<HtmlCell> cells;
    for (const auto& column : kColumns) {
      for (const SystemReport* system : systems) {
        std::vector<double> values;
        for (const OodRow& row : system->ood) {
          if (row.clip == clip) values.push_back(row.*column.value);
        }
        cells.push_back({number_text(finite_mean(values), column.digits)});
      }
    }
    table.add_row(clip, std::move(cells));
  }
  return table.str();
}

}  // namespace

std::string page_unseen(const Report& report) {
  std::string out;
  for (const SystemReport& system : report.systems) {
    for (const UnseenReport& split : system.unseen) {
      const std::string table = unseen_table(report, split);
      if (table.empty()) continue;
      out += heading(system.name + ", split " + split.name) + table + page_unseen_clips(split);
    }
  }
  return out;
}

std::string page_ood(const Report& report) {
  const auto systems =
      systems_with(report, [](const SystemReport& system) { return !system.ood.empty(); });
  if (systems.empty()) return "";
  std::string out = ood_table(systems) + ood_styles_table(report, systems);
  for (const SystemReport* system : systems) out += signatures_table(report, *system);
  for (const SystemReport* system : systems) {
    out += heading("Worst of " + system->name);
    out += worst_rows(
        system->ood, [](const OodRow& a, const OodRow& b) { return a.jerk_ratio > b.jerk_ratio; },
        "Most jerk against the input");
    out += worst_rows(
        system->ood,
        [](const OodRow& a, const OodRow& b) {
          return a.velocity_correlation < b.velocity_correlation;
        },
        "Least like the input in how hands and feet move");
  }
  return out + html_details("Clip by clip, means over the styles", clips_table(systems));
}

std::string page_disturbances(const Report& report) {
  const auto systems =
      systems_with(report, [](const SystemReport& system) { return !system.disturbances.empty(); });
  HtmlTable table("disturbance");
  table.add_columns("pose error cm", names_of_systems(systems));
  std::vector<std::string> names;
  for (const SystemReport* system : systems) {
    for (const DisturbanceRow& row : system->disturbances) {
      if (std::find(names.begin(), names.end(), row.name) == names.end()) names.push_back(row.name);
    }
  }
  for (const std::string& name : names) {
    std::vector<double> values;
    values.reserve(systems.size());
    for (const SystemReport* system : systems) {
      const auto row =
          std::find_if(system->disturbances.begin(), system->disturbances.end(),
                       [&](const DisturbanceRow& candidate) { return candidate.name == name; });
      values.push_back(row == system->disturbances.end() ? kNotMeasured : row->cm);
    }
    const std::vector<bool> best = best_of(values, Better::lower, 2);
    std::vector<HtmlCell> cells;
    cells.reserve(values.size());
    for (size_t s = 0; s < values.size(); ++s) {
      cells.push_back({number_text(values[s], 2), best[s]});
    }
    table.add_row(name, std::move(cells));
  }
  return table.str();
}

std::string page_mixes(const Report& report) {
  const auto systems =
      systems_with(report, [](const SystemReport& system) { return !system.mixes.empty(); });
  HtmlTable table("half and half");
  for (const SystemReport* system : systems) {
    table.add_columns(system->name, {"either style", "content", "correlation"});
  }
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const SystemReport* system : systems) {
    for (const MixReport& mix : system->mixes) {
      const std::pair pair(mix.first, mix.second);
      if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
  }
  for (const auto& [first, second] : pairs) {
    std::vector<HtmlCell> cells;
    for (const SystemReport* system : systems) {
      const auto mix = std::find_if(
          system->mixes.begin(), system->mixes.end(),
          [&](const MixReport& other) { return other.first == first && other.second == second; });
      const bool has = mix != system->mixes.end();
      const double either = has ? mix->either : kNotMeasured;
      const double content = has ? mix->content : kNotMeasured;
      cells.push_back({number_text(either, 3), false, either});
      cells.push_back({number_text(content, 3), false, content});
      cells.push_back({number_text(has ? mix->correlation : kNotMeasured, 3)});
    }
    table.add_row(first + " + " + second, std::move(cells));
  }
  return table.str();
}

}  // namespace panache
