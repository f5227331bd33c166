// The report for a terminal.

#include "eval/report.h"

#include <algorithm>

#include "eval/measure.h"
#include "eval/report_clips.h"
#include "eval/report_numbers.h"
#include "eval/report_ood.h"
#include "eval/report_text_table.h"

namespace panache {
namespace {

const Metrics& line_of(const MetricsTable& table, const std::string& name) {
  static const Metrics kNothing;
  const auto line = table.find(name);
  return line == table.end() ? kNothing : line->second;
}

// A title and what stands under it; nothing without a body.
std::string titled(const std::string& title, const std::string& body) {
  return body.empty() ? "" : title + "\n" + body + "\n";
}

// Broken into lines at spaces.
std::string wrapped(const std::string& text) {
  std::string out;
  for (size_t begin = 0, width = 0; begin < text.size();) {
    const size_t end = std::min(text.find(' ', begin), text.size());
    const bool fits = width + 1 + (end - begin) <= kTextWidth;
    if (!out.empty()) out += fits ? ' ' : '\n';
    width = fits && !out.empty() ? width + 1 + (end - begin) : end - begin;
    out.append(text, begin, end - begin);
    begin = end + 1;
  }
  return out;
}

std::string overall(const Report& report) {
  TextTable table("");
  std::vector<std::string> labels;
  for (const Measure& measure : measures()) labels.emplace_back(measure.label);
  table.add_columns("", labels);
  const auto add = [&](const std::string& name, const Metrics& metrics) {
    std::vector<std::string> cells;
    for (const Measure& measure : measures()) {
      cells.push_back(number_text(metrics[measure.key], measure.digits));
    }
    table.add_row(name, std::move(cells));
  };
  add("real takes", report.real);
  add("input", report.input);
  for (const SystemReport& system : report.systems) add(system.name, system.seen);
  return table.str();
}

// What these measures found.
std::vector<std::string> texts(const Metrics& metrics, const std::vector<const char*>& keys) {
  std::vector<std::string> cells;
  cells.reserve(keys.size());
  for (const char* key : keys) cells.push_back(number_text(metrics[key], find_measure(key).digits));
  return cells;
}

std::vector<std::string> four_numbers(const Metrics& metrics) {
  return texts(metrics, {"style_accuracy", "content_accuracy", "jerk_ratio", "pose_error_deg"});
}

std::string by_content(const Report& report) {
  TextTable table("content");
  table.add_columns("real takes", {"style", "content"});
  std::vector<const MetricsTable*> tables;
  for (const SystemReport& system : report.systems) {
    table.add_columns(system.name, {"style", "content", "jerk", "deg"});
    tables.push_back(&system.by_content);
  }
  for (const std::string& content : names_of(tables, report.contents)) {
    std::vector<std::string> cells =
        texts(line_of(report.real_by_content, content), {"style_accuracy", "content_accuracy"});
    for (const MetricsTable* of : tables) {
      for (const std::string& cell : four_numbers(line_of(*of, content))) cells.push_back(cell);
    }
    table.add_row(content, std::move(cells));
  }
  return table.str();
}

// One number of each system, strengths from left to right.
std::string strengths(const Report& report, const char* measure) {
  std::vector<std::string> keys;
  for (const SystemReport& system : report.systems) {
    for (const auto& [key, metrics] : system.strength) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  TextTable table("");
  table.add_columns("", keys);
  for (const SystemReport& system : report.systems) {
    if (system.strength.empty()) continue;
    std::vector<std::string> cells;
    for (const std::string& key : keys) {
      const auto at = std::find_if(system.strength.begin(), system.strength.end(),
                                   [&](const auto& entry) { return entry.first == key; });
      cells.push_back(at == system.strength.end() ? kDash : texts(at->second, {measure}).front());
    }
    table.add_row(system.name, std::move(cells));
  }
  return table.str();
}

std::string unseen(const Report& report, const UnseenReport& split) {
  const std::vector<std::pair<std::string, const MetricsTable*>> kSources = {
      {"unseen", &split.by_content},
      {"seen", &split.seen_by_content},
      {"real, blind", &split.blind_by_content},
      {"mean posture", &split.mean_posture_by_content}};
  TextTable table("content");
  for (const auto& [name, source] : kSources) {
    table.add_columns(name, {"style", "content", "jerk"});
  }
  const auto add = [&](const std::string& row, const std::vector<Metrics>& of) {
    std::vector<std::string> cells;
    for (const Metrics& metrics : of) {
      for (const std::string& cell :
           texts(metrics, {"style_accuracy", "content_accuracy", "jerk_ratio"})) {
        cells.push_back(cell);
      }
    }
    table.add_row(row, std::move(cells));
  };
  for (const std::string& content : names_of({&split.by_content}, report.contents)) {
    std::vector<Metrics> of;
    of.reserve(kSources.size());
    for (const auto& [name, source] : kSources) of.push_back(line_of(*source, content));
    add(content, of);
  }
  add("mean", {split.mean, mean_metrics(split.seen_by_content),
               mean_metrics(split.blind_by_content), mean_metrics(split.mean_posture_by_content)});
  return table.str();
}

std::string clips(const ClipTable& from) {
  TextTable table(from.names);
  for (const auto& [label, columns] : from.groups) table.add_columns(label, columns);
  for (const auto& [name, cells] : from.rows) {
    std::vector<std::string> texts;
    texts.reserve(cells.size());
    for (const ClipCell& cell : cells) texts.push_back(number_text(cell.value, cell.digits));
    table.add_row(name, std::move(texts));
  }
  return table.str();
}

std::string ood(const Report& report) {
  TextTable table("");
  table.add_columns("", {"clips"});
  table.add_columns("jerk / input", {"median", "90%", "largest"});
  table.add_columns("correlation", {"median", "lowest 10%"});
  table.add_columns(
      "", {"moved cm", "beyond limits", "under floor", "jumps", "turned deg", "drift m", "gate"});
  for (const SystemReport& system : report.systems) {
    if (system.ood.empty()) continue;
    const OodSummary of = summarize_ood(system.ood);
    table.add_row(system.name,
                  {count_text(of.clips), number_text(of.jerk_ratio_median, 2),
                   number_text(of.jerk_ratio_p90, 2), number_text(of.jerk_ratio_max, 2),
                   number_text(of.velocity_correlation_median, 3),
                   number_text(of.velocity_correlation_p10, 3), number_text(of.distance_cm_mean, 2),
                   number_text(of.beyond_limits_mean, 4), number_text(of.under_floor_mean, 4),
                   count_text(of.jumps), number_text(of.turned_deg_mean, 1),
                   number_text(of.drift_m_max, 2), number_text(of.gate_mean, 3)});
  }
  return table.str();
}

std::string shots(const Report& report) {
  TextTable table("");
  for (const char* key : kShotKeys) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    table.add_columns(name, {"median", "90%", ">2"});
  }
  for (const SystemReport& system : report.systems) {
    if (system.ood.empty()) continue;
    std::vector<std::string> cells;
    for (const ShotSummary& of : summarize_shots(system.ood)) {
      cells.insert(cells.end(),
                   {number_text(of.median, 1), number_text(of.p90, 1), number_text(of.over_2, 3)});
    }
    table.add_row(system.name, std::move(cells));
  }
  return table.str();
}

std::string ood_styles(const Report& report) {
  TextTable table("");
  table.add_columns("style recognised", {"networks", "LDA"});
  table.add_columns("forced choice", {"networks", "LDA"});
  table.add_columns("signature", {"sign", "amount"});
  const auto add = [&](const std::string& name, const StyleSummary& of) {
    table.add_row(name, {number_text(of.style_robust, 3), number_text(of.style_lda, 3),
                         number_text(of.forced_mlp, 3), number_text(of.forced_lda, 3),
                         number_text(of.signature_sign, 3), number_text(of.signature_amount, 3)});
  };
  bool any = false;
  for (const SystemReport& system : report.systems) any = any || !system.ood.empty();
  if (!any) return "";
  add("real takes", report.ood_real);
  add("real takes of unseen actions", report.ood_real_unseen);
  add("input", report.ood_input);
  for (const SystemReport& system : report.systems) {
    if (!system.ood.empty()) add(system.name, summarize_styles(system.ood));
  }
  return table.str();
}

std::string disturbances(const Report& report) {
  TextTable table("disturbance");
  std::vector<const SystemReport*> systems;
  std::vector<std::string> names, labels;
  for (const SystemReport& system : report.systems) {
    if (system.disturbances.empty()) continue;
    systems.push_back(&system);
    labels.push_back(system.name);
    for (const DisturbanceRow& row : system.disturbances) {
      if (std::find(names.begin(), names.end(), row.name) == names.end()) names.push_back(row.name);
    }
  }
  table.add_columns("", labels);
  for (const std::string& name : names) {
    std::vector<std::string> cells;
    for (const SystemReport* system : systems) {
      const auto row = std::find_if(system->disturbances.begin(), system->disturbances.end(),
                                    [&](const DisturbanceRow& of) { return of.name == name; });
      cells.push_back(row == system->disturbances.end() ? kDash : number_text(row->cm, 2));
    }
    table.add_row(name, std::move(cells));
  }
  return table.str();
}

std::string prediction(const SystemReport& system) {
  TextTable table("content");
  const auto name = [](double seconds) { return number_text(seconds, 2) + " s ahead, cm"; };
  for (const double seconds : kPredictionSeconds) {
    table.add_columns(name(seconds), {"predicted", "velocity", "held"});
  }
  for (const PredictionRow& row : system.prediction) {
    std::vector<std::string> cells;
    for (size_t h = 0; h < kPredictionSeconds.size(); ++h) {
      for (const double cm : {row.predicted_cm[h], row.velocity_cm[h], row.held_cm[h]}) {
        cells.push_back(number_text(cm, 2));
      }
    }
    table.add_row(row.content, std::move(cells));
  }
  return table.str();
}

std::string removal_text(const RemovalReport& report) {
  TextTable removal("removed");
  removal.add_columns("", {"clips", "neutral before", "neutral", "content kept", "cm",
                           "cm, relative", "jerk", "jumps"});
  const auto add = [&](const std::string& name, const RemovalSummary& of) {
    if (of.clips == 0) return;
    removal.add_row(
        name, {std::to_string(of.clips), number_text(of.before, 2), number_text(of.neutral, 2),
               number_text(of.content, 2), number_text(of.cm, 1), number_text(of.cm_ratio, 2),
               number_text(of.jerk, 2), number_text(of.jumps, 0)});
  };
  add("test takes, by name", report.named);
  add("test takes, any style", report.any);
  add("restyled others", report.restyled);
  add("others as they are", report.original);
  TextTable recognition("recognised");
  recognition.add_columns("", {"clips", "first", "in three", "neutral clips", "told neutral"});
  const auto tell = [&](const std::string& name, const RecognitionSummary& of) {
    if (of.clips + of.neutral_clips == 0) return;
    recognition.add_row(
        name, {std::to_string(of.clips), number_text(of.first, 2), number_text(of.third, 2),
               std::to_string(of.neutral_clips), number_text(of.neutral, 2)});
  };
  tell("test takes", report.recognition);
  tell("others", report.others);
  return titled("Styles taken off", removal.str()) + titled("Styles recognised", recognition.str());
}

}  // namespace

std::string report_text(const Report& report) {
  if (report.removal) return removal_text(*report.removal);
  std::string text =
      titled("Overall: held-out takes, means over styles and contents", overall(report));
  for (const std::string& note : ceiling_notes(report)) text += wrapped(note) + "\n\n";
  for (const SystemReport& system : report.systems) {
    if (!system.recorded) continue;
    text += cut_text(system.name + ": " + std::to_string(system.recorded->evaluated) + " of " +
                         std::to_string(system.recorded->listed) + " recorded outputs judged",
                     kTextWidth) +
            "\n\n";
  }
  text += titled("By content: style, content, jerk against real takes, pose error in degrees",
                 by_content(report));
  text += titled("Whole clips before the judge of their performer", clips(own_clips_table(report)));
  text +=
      titled("Motion of other performers, before the judge of the style's performer and their own",
             clips(clips_across_table(report)));
  const auto beside_real = [&](const std::string& title, const char* key) {
    return titled(title + " (real takes: " + texts(report.real, {key}).front() + ")",
                  strengths(report, key));
  };
  text += beside_real("Style recognised by strength", "style_accuracy");
  text += beside_real("Content kept by strength", "content_accuracy");
  text += titled("Jerk against real takes by strength", strengths(report, "jerk_ratio"));
  for (const SystemReport& system : report.systems) {
    for (const UnseenReport& split : system.unseen) {
      text +=
          titled(cut_text("Contents left out of training: " + system.name + ", split " + split.name,
                          kTextWidth),
                 unseen(report, split));
      text += titled("The same clips before the judges of their performers",
                     clips(unseen_clips_table(split)));
    }
  }
  text += titled("Out-of-distribution motion: every clip in every style", ood(report));
  text += titled("The same: how much of the style there is", ood_styles(report));
  text += titled("The same: feet, seats and hands in cm (turn in degrees)", shots(report));
  text += titled("Disturbed windows: pose error in cm", disturbances(report));
  for (const SystemReport& system : report.systems) {
    text +=
        titled(cut_text("Input prediction, constant velocity, held: " + system.name, kTextWidth),
               prediction(system));
  }
  return text;
}

}  // namespace panache
