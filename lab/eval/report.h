#pragma once
// The results of one evaluation, and their forms: JSON, an HTML page and text tables.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "eval/arrival.h"
#include "eval/clip_verdict.h"
#include "eval/disturbances.h"
#include "eval/metrics.h"
#include "eval/ood.h"
#include "eval/prediction.h"
#include "eval/removal.h"
#include "eval/report_ood.h"
#include "eval/report_persons.h"
#include "pose/contacts.h"
#include "draw/strip.h"

namespace panache {

// The results of a system on contents that it never saw in a style.
struct UnseenReport {
  std::string name;                      // "A", or the contents joined with "+".
  Metrics mean;                          // Over the unseen contents.
  MetricsTable by_content;               // The unseen contents only.
  MetricsTable seen_by_content;          // The same contents by the model trained on them.
  MetricsTable blind_by_content;         // Real takes, classifiers not trained on them.
  MetricsTable mean_posture_by_content;  // The style's mean posture, for comparison.
  // Clips of the unseen contents, classified by their performers' classifiers: outputs, those of
  // the mean posture, real test takes, and the same takes by classifiers that were not trained on
  // these contents.
  std::vector<ClipVerdict> clips, mean_posture_clips, real_clips, blind_clips;
};

// An equal mix of two styles.
struct MixReport {
  std::string first, second;
  double either = 0;       // Share of windows recognised as one of the two.
  double content = 0;      // Share of windows with the content preserved.
  double correlation = 0;  // Of the second style's share, 0 to 1, with P(second) - P(first).
};

struct SystemReport {
  std::string name;    // "panache", "smith2019", "mean posture", ...; unique.
  std::string recipe;  // Of the model, or empty.
  Metrics seen;
  MetricsTable by_content, by_style;
  std::vector<std::pair<std::string, Metrics>> strength;                // "0" to "2", in order,
  std::vector<std::pair<std::string, MetricsTable>> strength_by_style;  // and by style.
  double slider_style = kNotMeasured;     // Rank correlation of strength 0..1 with P(style).
  double slider_distance = kNotMeasured;  // Of strength 0..2 with the distance from the input.
  std::vector<MixReport> mixes;
  std::vector<UnseenReport> unseen;
  // At strength 1: each performer's own motion in each of their styles, classified by that
  // performer's classifier; and other performers' motion in the style, classified by that of the
  // style's performer.
  std::vector<ClipVerdict> clips, clips_across;
  std::vector<StyleArrival> arrival;  // On walks.
  std::vector<OodRow> ood;
  std::vector<DisturbanceRow> disturbances;
  std::vector<PredictionRow> prediction;        // Empty if the model has no predictor.
  std::optional<PersonsReport> persons;         // If the model has them.
  double cc = kNotMeasured, sc = kNotMeasured;  // CC and SC++ in file units.
  double bone_length_error_cm = kNotMeasured;   // Largest change of a bone's length.
  double step_us = kNotMeasured;                // CPU time of one step.
  size_t model_bytes = 0, parameters = 0;
  std::optional<RecordedCount> recorded;  // For systems whose outputs are files.
};

// Input, systems and real take side by side, for the page.
struct StripReport {
  std::string title;  // "walk, old"
  std::vector<StripRow> rows;
  double seconds_between = 0.25;
};
// Foot contacts, for the page.
struct ContactRow {
  std::string label;
  double fps = 30;
  std::vector<FootContacts> contacts;  // [frames]
};
struct ContactReport {
  std::string title;
  std::vector<ContactRow> rows;
};

// The changes that a style's real takes agree on, and the match of each action when left out.
struct SignatureReport {
  std::string style;
  Signature real;
  SignatureMatch left_out;
};

struct Report {
  std::vector<std::string> trained_on, tested_on;  // Manifests as given.
  std::vector<std::string> styles, contents;
  // Accuracies on real held-out takes below which the classifiers are unreliable.
  double style_floor = 0, content_floor = 0;
  Metrics real;   // Real held-out takes of the styles.
  Metrics input;  // The neutral takes themselves as outputs.
  MetricsTable real_by_content, real_by_style;
  MetricsTable input_by_content;
  double cc_floor = kNotMeasured, sc_floor = kNotMeasured;  // Real takes against real takes.
  // Real test takes, including neutral ones, classified by their performer's classifier; and styled
  // ones classified by those of other performers who have the style.
  std::vector<ClipVerdict> real_clips, real_clips_across;
  // The classifiers for out-of-distribution motion on: real test takes; real takes of actions that
  // they were not trained on; and the clips themselves as outputs.
  StyleSummary ood_real, ood_real_unseen, ood_input;
  std::vector<SignatureReport> signatures;
  std::vector<SystemReport> systems;
  std::optional<RemovalReport> removal;
  std::vector<StripReport> strips;
  std::vector<ContactReport> contacts;
  double seconds = 0;  // Duration of the evaluation.
};

// A message for each classifier with low accuracy on real takes: how to read its metrics.
std::vector<std::string> ceiling_notes(const Report& report);

// report.json, with all numbers of the page; null if not measured.
std::string report_json(const Report& report);
// A self-contained HTML page.
std::string report_page(const Report& report);
// Tables for a terminal.
std::string report_text(const Report& report);
// Writes report.json and index.html into `folder`, creating it if necessary.
Result<void> write_report(const Report& report, const std::string& folder);

}  // namespace panache
