#pragma once
// Everything that one evaluation found, and its forms: a file for machines, a page and a table for
// people.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "eval/clip_verdict.h"
#include "eval/disturbances.h"
#include "eval/metrics.h"
#include "eval/ood.h"
#include "eval/prediction.h"
#include "eval/removal.h"
#include "eval/report_ood.h"
#include "pose/contacts.h"
#include "draw/strip.h"

namespace panache {

// What a system makes of contents that it never saw in a style.
struct UnseenReport {
  std::string name;                      // "A", or the contents joined with "+".
  Metrics mean;                          // Over the unseen contents.
  MetricsTable by_content;               // The unseen contents only.
  MetricsTable seen_by_content;          // The same contents by the model that saw them.
  MetricsTable blind_by_content;         // Real takes, judged by classifiers that never saw them.
  MetricsTable mean_posture_by_content;  // The style's mean posture, for comparison.
  // Clips of the unseen contents before the judges of the performers: outputs, those of the mean
  // posture, and real test takes; and the same real takes before judges that never saw the
  // contents.
  std::vector<ClipVerdict> clips, mean_posture_clips, real_clips, blind_clips;
};

// Half of one style, half of another.
struct MixReport {
  std::string first, second;
  double either = 0;       // Share of windows recognised as one of the two.
  double content = 0;      // Share whose content is kept.
  double correlation = 0;  // Of the share of the second, 0 to 1, with P(second) - P(first).
};

struct SystemReport {
  std::string name;    // "panache", "smith2019", "mean posture", ...; no two systems alike.
  std::string recipe;  // Of the model; empty where there is none.
  Metrics seen;
  MetricsTable by_content, by_style;
  std::vector<std::pair<std::string, Metrics>> strength;                // "0" to "2", in order,
  std::vector<std::pair<std::string, MetricsTable>> strength_by_style;  // and each style's.
  double slider_style = kNotMeasured;     // Rank correlation of strength 0..1 with P(style).
  double slider_distance = kNotMeasured;  // Of strength 0..2 with the distance from the input.
  std::vector<MixReport> mixes;
  std::vector<UnseenReport> unseen;
  // At strength 1: each performer's own motion in each of this performer's styles before the
  // performer's own judge, and other performers' motion in the style before that judge.
  std::vector<ClipVerdict> clips, clips_across;
  std::vector<OodRow> ood;
  std::vector<DisturbanceRow> disturbances;
  std::vector<PredictionRow> prediction;        // Empty where the model predicts nothing.
  double cc = kNotMeasured, sc = kNotMeasured;  // CC and SC++ in file units.
  double bone_length_error_cm = kNotMeasured;   // Largest change of a bone's length.
  double step_us = kNotMeasured;                // Processor time of one step.
  size_t model_bytes = 0, parameters = 0;
  std::optional<RecordedCount> recorded;  // Where the outputs were files.
};

// Input, systems and real take beside each other, for the page.
struct StripReport {
  std::string title;  // "walk, old"
  std::vector<StripRow> rows;
  double seconds_between = 0.25;
};
// When the feet are planted, for the page.
struct ContactRow {
  std::string label;
  double fps = 30;
  std::vector<FootContacts> contacts;  // [frames]
};
struct ContactReport {
  std::string title;
  std::vector<ContactRow> rows;
};

// What a style's real takes agree on, and how well each of their actions does when it is left out.
struct SignatureReport {
  std::string style;
  Signature real;
  SignatureMatch left_out;
};

struct Report {
  std::vector<std::string> trained_on, tested_on;  // Manifests, as they were given.
  std::vector<std::string> styles, contents;
  // Real held-out accuracy below which figures of the classifiers mean little by themselves.
  double style_floor = 0, content_floor = 0;
  Metrics real;   // Real held-out takes of the styles.
  Metrics input;  // The neutral takes themselves, as if they were the output.
  MetricsTable real_by_content, real_by_style;
  MetricsTable input_by_content;
  double cc_floor = kNotMeasured, sc_floor = kNotMeasured;  // Real takes against real takes.
  // Real test takes, neutral ones too, before their performer's judge; styled ones before the
  // judges of other performers who have the style.
  std::vector<ClipVerdict> real_clips, real_clips_across;
  // The judges of out-of-distribution motion: what they say of real test takes, such judges of real
  // takes of actions unseen by them, and the judges of the clips themselves, as if they were the
  // output.
  StyleSummary ood_real, ood_real_unseen, ood_input;
  std::vector<SignatureReport> signatures;
  std::vector<SystemReport> systems;
  std::optional<RemovalReport> removal;
  std::vector<StripReport> strips;
  std::vector<ContactReport> contacts;
  double seconds = 0;  // What the evaluation took.
};

// A sentence for each classifier that recognises too little of real takes: how to read its figures.
std::vector<std::string> ceiling_notes(const Report& report);

// report.json: numbers that were not measured are null. It has all numbers of the page.
std::string report_json(const Report& report);
// One HTML page that needs nothing but itself.
std::string report_page(const Report& report);
// The tables for a terminal.
std::string report_text(const Report& report);
// Writes report.json and index.html into `folder`, which is made where it does not exist.
Result<void> write_report(const Report& report, const std::string& folder);

}  // namespace panache
