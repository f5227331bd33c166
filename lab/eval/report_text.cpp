// The report for a terminal: tables of the numbers in report.json.

#include <algorithm>
#include <set>

#include "eval/measure.h"
#include "eval/report_numbers.h"
#include "eval/report_text_table.h"
#include "eval/report_tree.h"

namespace panache {
namespace {

using Json = nlohmann::ordered_json;

// Special values of `digits`, for counts: "1,234", and the same without the comma. 0 is a dash.
constexpr int kCount = -1, kPlainCount = -2;

// A column of numbers, each found by a JSON pointer in its row.
struct Column {
  std::string label, pointer;
  int digits;
};
struct Group {
  std::string label;
  std::vector<Column> columns;
};
using NamedRows = std::vector<std::pair<std::string, Json>>;

std::string cell(const Json& row, const Column& column) {
  const Json::json_pointer pointer(column.pointer);
  if (!row.contains(pointer) || !row[pointer].is_number()) return kDash;
  if (column.digits == kCount) return count_text(row[pointer]);
  if (column.digits == kPlainCount) return row[pointer] == 0 ? kDash : number_text(row[pointer], 0);
  return number_text(row[pointer], column.digits);
}

std::string table(const std::string& names, const std::vector<Group>& groups,
                  const NamedRows& rows) {
  TextTable out(names);
  for (const Group& group : groups) {
    std::vector<std::string> labels;
    for (const Column& column : group.columns) labels.push_back(column.label);
    out.add_columns(group.label, labels);
  }
  for (const auto& [name, row] : rows) {
    std::vector<std::string> cells;
    for (const Group& group : groups) {
      for (const Column& column : group.columns) cells.push_back(cell(row, column));
    }
    out.add_row(name, std::move(cells));
  }
  return out.str();
}

// NamedRows with their names, and a summary row or null.
struct Source {
  std::string label;
  Json rows, total;
  std::vector<Column> columns;
};

// All names in the sources: first those of `order`, then the rest sorted by name.
std::vector<std::string> names_of(const std::vector<Source>& sources,
                                  const std::vector<std::string>& order) {
  std::set<std::string> rest;
  for (const Source& source : sources) {
    for (const auto& [name, row] : source.rows.items()) rest.insert(name);
  }
  std::vector<std::string> names;
  for (const std::string& name : order) {
    if (rest.erase(name) > 0) names.push_back(name);
  }
  names.insert(names.end(), rest.begin(), rest.end());
  return names;
}

// Sources side by side, a row for each name, followed by their totals in the row `total`, unless
// that is empty.
std::string side_by_side(const std::string& names, const std::vector<Source>& sources,
                         const std::vector<std::string>& row_names, const std::string& total) {
  std::vector<Group> groups;
  for (size_t s = 0; s < sources.size(); ++s) {
    groups.push_back({sources[s].label, sources[s].columns});
    for (Column& column : groups.back().columns) {
      column.pointer.insert(0, "/" + std::to_string(s));
    }
  }
  NamedRows rows;
  for (const std::string& name : row_names) {
    Json& row = rows.emplace_back(name, Json::array()).second;
    for (const Source& source : sources) row.push_back(source.rows.value(name, Json()));
  }
  if (!total.empty() && !rows.empty()) {
    Json& row = rows.emplace_back(total, Json::array()).second;
    for (const Source& source : sources) row.push_back(source.total);
  }
  return table(names, groups, rows);
}

// The value of each system at `pointer`, skipping systems where `needed` is empty.
NamedRows of_systems(const Json& report, const std::string& pointer, const std::string& needed) {
  NamedRows rows;
  for (const auto& [name, system] : report["systems"].items()) {
    if (system[Json::json_pointer(needed)].empty()) continue;
    rows.emplace_back(name, system[Json::json_pointer(pointer)]);
  }
  return rows;
}

// A title and its body; empty without a body.
std::string titled(const std::string& title, const std::string& body) {
  return body.empty() ? "" : title + "\n" + body + "\n";
}

// Breaks a text into lines at spaces.
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

Column measured(const std::string& label, const std::string& key) {
  return {label, "/" + key, find_measure(key).digits};
}

std::string overall(const Json& report) {
  Group group;
  for (const Measure& measure : measures()) {
    group.columns.push_back(measured(measure.label, measure.key));
  }
  NamedRows rows = of_systems(report, "/seen", "/seen");
  rows.insert(rows.begin(), {{"real takes", report["real"]}, {"input", report["input"]}});
  return table("", {group}, rows);
}

std::string by_content(const Json& report) {
  const std::vector<Column> columns = {
      measured("style", "style_accuracy"), measured("content", "content_accuracy"),
      measured("jerk", "jerk_ratio"), measured("deg", "pose_error_deg")};
  std::vector<Source> systems;
  for (const auto& [name, rows] : of_systems(report, "/seen_by_content", "/seen")) {
    systems.push_back({name, rows, {}, columns});
  }
  const std::vector<std::string> names = names_of(systems, report["contents"]);
  systems.insert(systems.begin(),
                 {"real takes", report["real_by_content"], {}, {columns[0], columns[1]}});
  return side_by_side("content", systems, names, "");
}

// One number of each system, with strengths from left to right.
std::string strengths(const Json& report, const std::string& measure) {
  const NamedRows rows = of_systems(report, "/strength", "/strength");
  Group group;
  for (const auto& [name, row] : rows) {
    for (const auto& [strength, metrics] : row.items()) {
      const auto is_same = [&](const Column& column) { return column.label == strength; };
      if (std::ranges::any_of(group.columns, is_same)) continue;
      group.columns.push_back(measured(strength, measure));
      group.columns.back().pointer.insert(0, "/" + strength);
    }
  }
  return table("", {group}, rows);
}

std::string unseen(const Json& report, const Json& split) {
  const std::vector<Column> columns = {measured("style", "style_accuracy"),
                                       measured("content", "content_accuracy"),
                                       measured("jerk", "jerk_ratio")};
  const Json& means = split["means"];
  const std::vector<Source> sources = {
      {"unseen", split, split["mean"], columns},
      {"seen", split["seen"], means["seen"], columns},
      {"real, blind", split["blind"], means["blind"], columns},
      {"mean posture", split["mean_posture"], means["mean_posture"], columns}};
  Json contents;
  for (const std::string name : split["contents"]) contents[name] = split[name];
  return side_by_side("content", sources, names_of({{"", contents, {}, {}}}, report["contents"]),
                      "mean");
}

const Column kClips = {"clips", "/clips", kPlainCount},
             kRecognised = {"recognised", "/recognised", 2}, kOfReal = {"of real", "/of_real", 2},
             kCm = {"cm", "/cm", 1}, kHandSpeed = {"hands' speed", "/hand_speed", 2},
             kHandSharpness = {"hands' sharpness", "/hand_sharpness", 2};

// Clips classified by performer, for each style (or `by_content`) and in total.
Source clips(const std::string& label, const Json& from, const std::vector<Column>& columns,
             const std::string& by = "by_style") {
  return {label, from[by], from["all"], columns};
}

std::string own_clips(const Json& report) {
  std::vector<Source> sources = {
      clips("real takes", report["performers"]["own"], {kClips, kRecognised, kCm})};
  for (const auto& [name, own] : of_systems(report, "/performers/own", "/seen")) {
    sources.push_back(clips(name, own, {kClips, kRecognised, kOfReal, kCm}));
  }
  return side_by_side("style", sources, names_of(sources, {}), "all styles");
}

// The same for motion of performers other than the style's, and for shared styles.
std::string clips_across(const Json& report) {
  std::vector<Source> sources;
  const auto add = [&](const std::string& name, const Json& performers) {
    sources.push_back(clips(name, performers["across"], {kClips, kRecognised}));
    sources.push_back(clips("own judge: " + name, performers["shared"], {kClips, kRecognised}));
  };
  add("real takes", report["performers"]);
  bool any = false;
  for (const auto& [name, performers] : of_systems(report, "/performers", "/seen")) {
    any = any || performers["across"]["all"]["clips"] > 0;
    add(name, performers);
  }
  return any ? side_by_side("style", sources, names_of(sources, {}), "all styles") : "";
}

std::string unseen_clips(const Json& performers) {
  const std::vector<Column> all = {kClips, kRecognised, kOfReal, kCm, kHandSpeed, kHandSharpness};
  const std::vector<Source> sources = {
      clips("unseen", performers["unseen"], all, "by_content"),
      clips("mean posture", performers["mean_posture"], all, "by_content"),
      clips("real takes", performers["real"], {kClips, kRecognised, kCm}, "by_content"),
      clips("real, blind", performers["blind"], {kClips, kRecognised}, "by_content")};
  return side_by_side("content", sources, names_of(sources, {}), "all styles");
}

std::string ood(const Json& report) {
  return table("",
               {{"", {{"clips", "/clips", kCount}}},
                {"jerk / input",
                 {{"median", "/jerk_ratio/median", 2},
                  {"90%", "/jerk_ratio/p90", 2},
                  {"largest", "/jerk_ratio/max", 2}}},
                {"correlation",
                 {{"median", "/velocity_correlation/median", 3},
                  {"lowest 10%", "/velocity_correlation/p10", 3}}},
                {"",
                 {{"moved cm", "/distance_cm/mean", 2},
                  {"beyond limits", "/beyond_limits/mean", 4},
                  {"under floor", "/under_floor/mean", 4},
                  {"jumps", "/jumps/frames", kCount},
                  {"turned deg", "/turned_deg/mean", 1},
                  {"drift m", "/drift_m/max", 2},
                  {"gate", "/gate/mean", 3}}}},
               of_systems(report, "/foreign/summary", "/foreign/rows"));
}

std::string shots(const Json& report) {
  std::vector<Group> groups;
  for (const std::string key : kShotKeys) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    groups.push_back({name,
                      {{"median", "/" + key + "/median", 1},
                       {"90%", "/" + key + "/p90", 1},
                       {">2", "/" + key + "/over_2", 3}}});
  }
  return table("", groups, of_systems(report, "/foreign/shot", "/foreign/rows"));
}

std::string ood_styles(const Json& report) {
  NamedRows rows = of_systems(report, "/foreign/summary", "/foreign/rows");
  if (rows.empty()) return "";
  const Json& reference = report["foreign_reference"];
  rows.insert(rows.begin(), {{"real takes", reference["real"]},
                             {"real takes of unseen actions", reference["real_unseen"]},
                             {"input", reference["input"]}});
  return table(
      "",
      {{"style recognised", {{"networks", "/style_robust", 3}, {"LDA", "/style_lda", 3}}},
       {"forced choice", {{"networks", "/forced_mlp", 3}, {"LDA", "/forced_lda", 3}}},
       {"signature", {{"sign", "/signature_sign", 3}, {"amount", "/signature_amount", 3}}}},
      rows);
}

std::string disturbances(const Json& report) {
  std::vector<Source> systems;
  std::vector<std::string> order;
  for (const auto& [name, rows] : of_systems(report, "/disturbances", "/disturbances")) {
    systems.push_back({"", rows, {}, {{name, "/cm", 2}}});
    for (const auto& [disturbance, row] : rows.items()) order.push_back(disturbance);
  }
  return side_by_side("disturbance", systems, names_of(systems, order), "");
}

std::string arrival(const Json& system) {
  NamedRows rows;
  if (system["arrival"]["by_style"].empty()) return "";
  for (const char* walks : {"real", "own", "others", "walker"}) {
    rows.emplace_back(walks, system["arrival"][walks]);
  }
  return table("walks",
               {{"movement",
                 {{"median", "/median", 2},
                  {"below half", "/below_half", 2},
                  {"wrong sign", "/wrong_sign", 2}}},
                {"", {{"side", "/side", 2}}},
                {"", {{"styles in step", "/styles_in_step", 0}}}},
               rows);
}

std::string prediction(const Json& contents) {
  std::vector<Group> groups;
  for (const double seconds : kPredictionSeconds) {
    const std::string time = number_text(seconds, 2);
    groups.push_back({time + " s ahead, cm",
                      {{"predicted", "/" + time + "/predicted_cm", 2},
                       {"velocity", "/" + time + "/velocity_cm", 2},
                       {"held", "/" + time + "/held_cm", 2}}});
  }
  NamedRows rows;
  for (const auto& [content, row] : contents.items()) rows.emplace_back(content, row);
  return table("content", groups, rows);
}

std::string persons(const Json& of) {
  if (of.is_null()) return "";
  return table("people",
               {{"apart, cm", {{"median", "/median_cm", 2}, {"90 %", "/p90_cm", 2}}},
                {"", {{"told", "/told", 3}}},
                {"", {{"outside", "/outside", 3}}}},
               {{"real", of["real"]}, {"seeds", of["seeds"]}}) +
         "\n" +
         table("seeds",
               {{"styles told",
                 {{"with a person", "/styled/told", 3}, {"without", "/styled/told_without", 3}}},
                {"on other motion",
                 {{"jerk", "/others/jerk_median", 2},
                  {"90 %", "/others/jerk_p90", 2},
                  {"beyond limits", "/others/beyond_limits", 4},
                  {"jumps", "/others/jumps", 3}}}},
               {{"all", of}});
}

std::string removal_text(const Json& removal) {
  const auto rows_of = [&](const std::vector<std::pair<std::string, const char*>>& names) {
    NamedRows rows;
    for (const auto& [name, key] : names) {
      const Json& row = removal[key];
      if (row["clips"] != 0 || row.value("neutral_clips", 0) != 0) rows.emplace_back(name, row);
    }
    return rows;
  };
  const std::string removed = table("removed",
                                    {{"",
                                      {{"clips", "/clips", 0},
                                       {"neutral before", "/before", 2},
                                       {"neutral", "/neutral", 2},
                                       {"content kept", "/content", 2},
                                       {"cm", "/cm", 1},
                                       {"cm, relative", "/cm_ratio", 2},
                                       {"jerk", "/jerk_ratio", 2},
                                       {"jumps", "/jumps", 0}}}},
                                    rows_of({{"test takes, by name", "named"},
                                             {"test takes, any style", "any"},
                                             {"restyled others", "restyled"},
                                             {"others as they are", "original"}}));
  const std::string recognised =
      table("recognised",
            {{"",
              {{"clips", "/clips", 0},
               {"first", "/first", 2},
               {"in three", "/third", 2},
               {"neutral clips", "/neutral_clips", 0},
               {"told neutral", "/neutral", 2}}}},
            rows_of({{"test takes", "recognition"}, {"others", "others"}}));
  return titled("Styles taken off", removed) + titled("Styles recognised", recognised);
}

}  // namespace

std::string report_text(const Report& of) {
  const Json report = report_tree(of);
  if (report.contains("removal")) return removal_text(report["removal"]);
  std::string text =
      titled("Overall: held-out takes, means over styles and contents", overall(report));
  for (const std::string note : report["notes"]) text += wrapped(note) + "\n\n";
  for (const auto& [name, system] : report["systems"].items()) {
    if (!system.contains("recorded")) continue;
    const Json& recorded = system["recorded"];
    text += cut_text(name + ": " + recorded["judged"].dump() + " of " + recorded["listed"].dump() +
                         " recorded outputs judged",
                     kTextWidth) +
            "\n\n";
  }
  text += titled("By content: style, content, jerk against real takes, pose error in degrees",
                 by_content(report));
  text += titled("Whole clips before the judge of their performer", own_clips(report));
  text +=
      titled("Motion of other performers, before the judge of the style's performer and their own",
             clips_across(report));
  const auto beside_real = [&](const std::string& title, const std::string& key) {
    return titled(title + " (real takes: " + cell(report["real"], measured("", key)) + ")",
                  strengths(report, key));
  };
  text += beside_real("Style recognised by strength", "style_accuracy");
  text += beside_real("Content kept by strength", "content_accuracy");
  text += titled("Jerk against real takes by strength", strengths(report, "jerk_ratio"));
  for (const auto& [name, system] : report["systems"].items()) {
    for (const auto& [split, found] : system["unseen_splits"].items()) {
      text += titled(
          cut_text("Contents left out of training: " + name + ", split " + split, kTextWidth),
          unseen(report, found));
      text += titled("The same clips before the judges of their performers",
                     unseen_clips(found["performers"]));
    }
  }
  text += titled("Out-of-distribution motion: every clip in every style", ood(report));
  text += titled("The same: how much of the style there is", ood_styles(report));
  text += titled("The same: feet, seats and hands in cm (turn in degrees)", shots(report));
  text += titled("Disturbed windows: pose error in cm", disturbances(report));
  for (const auto& [name, system] : report["systems"].items()) {
    text +=
        titled(cut_text("What arrives of a style on walks: " + name, kTextWidth), arrival(system));
  }
  for (const auto& [name, system] : report["systems"].items()) {
    text += titled(cut_text("Input prediction, constant velocity, held: " + name, kTextWidth),
                   prediction(system["foresight"]));
  }
  for (const auto& [name, system] : report["systems"].items()) {
    text += titled(cut_text("Persons: " + name, kTextWidth), persons(system["persons"]));
  }
  return text;
}

}  // namespace panache
