#include "eval/report_clips.h"

#include <set>

namespace panache {
namespace {

// Of which clips a group of columns tells, and how.
struct Column {
  std::string label;
  int digits = 2;
  double (*value)(const ClipSummary& of, const ClipSummary& real);
};
const Column kClips = {"clips", 0, [](const ClipSummary& of, const ClipSummary&) {
                         return of.clips == 0 ? kNotMeasured : static_cast<double>(of.clips);
                       }};
const Column kRecognised = {
    "recognised", 2, [](const ClipSummary& of, const ClipSummary&) { return of.recognised; }};
const Column kOfReal = {"of real", 2, [](const ClipSummary& of, const ClipSummary& real) {
                          return of.recognised / real.recognised;
                        }};
const Column kCm = {"cm", 1, [](const ClipSummary& of, const ClipSummary&) { return of.cm; }};
const Column kHandSpeed = {"hands' speed", 2,
                           [](const ClipSummary& of, const ClipSummary&) { return of.hand_speed; }};
const Column kHandSharpness = {
    "hands' sharpness", 2,
    [](const ClipSummary& of, const ClipSummary&) { return of.hand_sharpness; }};

struct Source {
  std::string label;
  std::vector<ClipVerdict> clips;
  std::vector<Column> columns;
};

// Every source is set beside `real`, group by group; the last row is of all styled clips.
ClipTable make_table(const std::string& names, std::string ClipVerdict::*name,
                     const std::vector<ClipVerdict>& real, const std::vector<Source>& sources) {
  ClipTable table{names, {}, {}};
  std::set<std::string> groups;
  for (const Source& source : sources) {
    std::vector<std::string> labels;
    for (const Column& column : source.columns) labels.push_back(column.label);
    table.groups.emplace_back(source.label, labels);
    for (const ClipVerdict& clip : source.clips) groups.insert(clip.*name);
  }
  const auto add = [&](const std::string& row, const auto& select) {
    std::vector<ClipCell> cells;
    for (const Source& source : sources) {
      const ClipSummary of = summarize_clips(select(source.clips)),
                        beside = summarize_clips(select(real));
      for (const Column& column : source.columns) {
        const bool is_share = column.label == kRecognised.label;
        cells.push_back({column.value(of, beside), column.digits, is_share});
      }
    }
    table.rows.emplace_back(row, std::move(cells));
  };
  for (const std::string& group : groups) {
    add(group, [&](const std::vector<ClipVerdict>& clips) { return clips_by(name, clips)[group]; });
  }
  if (!groups.empty()) add("all styles", styled_clips);
  return table;
}

}  // namespace

ClipTable own_clips_table(const Report& report) {
  std::vector<Source> sources = {{"real takes", report.real_clips, {kClips, kRecognised, kCm}}};
  for (const SystemReport& system : report.systems) {
    sources.push_back({system.name, system.clips, {kClips, kRecognised, kOfReal, kCm}});
  }
  return make_table("style", &ClipVerdict::style, report.real_clips, sources);
}

ClipTable clips_across_table(const Report& report) {
  std::vector<Source> sources = {{"real takes", report.real_clips_across, {kClips, kRecognised}},
                                 {"own judge: real takes",
                                  shared_clips(report.real_clips, report.real_clips),
                                  {kClips, kRecognised}}};
  bool any = false;
  for (const SystemReport& system : report.systems) {
    any = any || !system.clips_across.empty();
    sources.push_back({system.name, system.clips_across, {kClips, kRecognised}});
    sources.push_back({"own judge: " + system.name,
                       shared_clips(report.real_clips, system.clips),
                       {kClips, kRecognised}});
  }
  if (!any) return {};
  return make_table("style", &ClipVerdict::style, {}, sources);
}

ClipTable unseen_clips_table(const UnseenReport& split) {
  const std::vector<Column> kMeasured = {kClips, kRecognised, kOfReal,
                                         kCm,    kHandSpeed,  kHandSharpness};
  return make_table("content", &ClipVerdict::content, split.real_clips,
                    {{"unseen", split.clips, kMeasured},
                     {"mean posture", split.mean_posture_clips, kMeasured},
                     {"real takes", split.real_clips, {kClips, kRecognised, kCm}},
                     {"real, blind", split.blind_clips, {kClips, kRecognised}}});
}

}  // namespace panache
