#pragma once
// A report whose numbers tell where they come from.

#include <algorithm>
#include <string>

#include "eval/measure.h"
#include "eval/report.h"

namespace panache::test {

// A name that breaks a page, a drawing or a file where nobody looks after it.
inline const std::string kRude = "a<b> & \"c\"'s";
inline const std::string kRudeEscaped = "a&lt;b&gt; &amp; &quot;c&quot;'s";

// All numbers of it are different, and tell where they come from.
inline Metrics numbers(double seed) {
  Metrics metrics;
  metrics.takes = static_cast<size_t>(std::max(seed, 0.0) * 100);
  metrics.windows = metrics.takes * 5;
  double step = 0;
  for (const Measure& measure : measures()) metrics[measure.key] = seed + 0.001 * ++step;
  return metrics;
}

inline HumanPositions standing(float along) {
  HumanPositions body = {};
  for (int j = 0; j < kHumanJoints; ++j) body[j] = {0.01f * j, 0.08f * j, along};
  return body;
}

inline SystemReport made_up_system(const std::string& name, double seed) {
  SystemReport system;
  system.name = name;
  system.recipe = "panache";
  system.seen = numbers(seed);
  system.by_content = {{"walk", numbers(seed + 0.01)}, {"run", numbers(seed + 0.02)}};
  system.by_style = {{"old", numbers(seed + 0.03)}};
  system.strength = {{"0", numbers(0.01)}, {"0.25", numbers(0.04)}, {"2", numbers(seed + 0.05)}};
  system.slider_style = 0.97;
  system.slider_distance = 0.99;
  system.mixes = {{"old", "proud", 0.81, 0.72, 0.93}};
  UnseenReport a, b;
  a.name = "A";
  a.mean = numbers(0.61);
  a.by_content = {{"run", numbers(0.62)}};
  a.seen_by_content = {{"run", numbers(0.63)}};
  a.blind_by_content = {{"run", numbers(0.64)}};
  a.mean_posture_by_content = {{"run", numbers(0.65)}};
  b.name = "B";
  b.mean = numbers(0.66);
  b.by_content = {{"run", numbers(0.67)}, {"walk", numbers(0.68)}};
  system.unseen = {a, b};
  for (int i = 0; i < 11; ++i) {
    OodRow row;
    row.clip = i < 6 ? "dance" : "box";
    row.style = "style " + std::to_string(i);
    row.jerk_ratio = 1 + 0.1 * i;
    row.velocity_correlation = 0.5 + 0.04 * i;
    row.distance_cm = i;
    row.beyond_limits = i == 3 ? 0.11 : 0;
    row.under_floor = i >= 9 ? 0.22 : 0;
    row.jumps = i >= 8 ? 2 : 0;
    row.skating_ratio = 0.05;
    row.input_skating_ratio = 0.04;
    row.turned_deg = i;
    row.drift_m = 0.3 * i;
    row.gate = 0.1 * i;
    row.shot[static_cast<size_t>(ShotMeasure::seat_hips)] = {static_cast<float>(i)};
    system.ood.push_back(row);
  }
  system.clips = {{"ann", "ann", "old", "walk", "old", 6.25, 1.5, 0.5},
                  {"ann", "ann", "old", "walk", "proud", 8.25, 0.75, 2},
                  {"bob", "bob", "proud", "walk", "proud", 3.5, 1, 1}};
  system.clips_across = {{"bob", "ann", "old", "walk", "old"}};
  system.unseen[0].clips = {{"ann", "ann", "old", "run", "old", 9.5, 1.25, 1}};
  system.unseen[0].real_clips = {{"ann", "ann", "old", "run", "old", 2.5, 1, 1}};
  system.unseen[0].mean_posture_clips = {{"ann", "ann", "old", "run", "neutral", 12.5, 0.5, 1}};
  system.unseen[0].blind_clips = {{"ann", "ann", "old", "run", "proud", 2.5, 1, 1}};
  system.disturbances = {{"none", 2.25}, {"floor -5 cm", 2.75}};
  system.prediction = {{"walk", 100, {0.5, 1.25, 3.5}, {6.5, 12.5, 30.5}, {1.5, 4.5, 15.5}}};
  system.persons = {{29, {4.125, 6.25}, 1.5, 12, 0.875, 0.75},
                    {20, 3, {4.5, 6.5}, 0.95, 0.04},
                    {176, 0.9375, 0.96875},
                    {262, 0.92, 1.03, 0.0031, 0.024, 0.001, 2.5}};
  system.cc = 8.5;
  system.sc = 63;
  system.bone_length_error_cm = 0.002;
  system.step_us = 6.5;
  system.model_bytes = 868352;
  system.parameters = 216412;
  return system;
}

inline Report made_up_report() {
  Report report;
  report.trained_on = {"one.csv"};
  report.tested_on = {"two.csv"};
  report.styles = {"old", "proud"};
  report.contents = {"walk", "run"};
  report.style_floor = 0.95;
  report.content_floor = 0.9;
  report.real = numbers(0.97);
  report.input = numbers(0.02);
  report.real_by_content = {{"walk", numbers(0.98)}, {"run", numbers(0.96)}};
  report.real_by_style = {{"old", numbers(0.95)}};
  report.input_by_content = {{"walk", numbers(0.03)}};
  report.cc_floor = 4.25;
  report.sc_floor = 55.5;
  report.real_clips = {{"ann", "ann", "neutral", "walk", "neutral", 1.5, 1, 1},
                       {"ann", "ann", "old", "walk", "old", 2.25, 1, 1},
                       {"ann", "ann", "old", "walk", "neutral", 2.75, 1, 1},
                       {"ann", "ann", "proud", "walk", "proud", 2.5, 1, 1},
                       {"bob", "bob", "proud", "walk", "proud", 1.25, 1, 1}};
  report.real_clips_across = {{"bob", "ann", "proud", "walk", "old"}};
  report.systems = {made_up_system("panache", 0.8), made_up_system(kRude, 0.7)};
  report.systems[1].persons.reset();
  report.strips = {{"walk, old", {{"input", {standing(0), standing(1)}, ""}}, 0.25}};
  report.contacts = {{"walk, old", {{"input", 10, {{true, false}, {true, true}, {false, true}}}}}};
  report.seconds = 427;
  return report;
}

}  // namespace panache::test
