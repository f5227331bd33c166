// Writes the report as JSON.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "eval/measure.h"
#include "eval/report_numbers.h"
#include "eval/report_tree.h"

namespace panache {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Missing sizes (0) are null, too.
Json size(size_t value) { return value > 0 ? Json(value) : Json(nullptr); }

Json metrics_json(const Metrics& metrics) {
  Json out = {{"takes", metrics.takes}, {"windows", metrics.windows}};
  for (const Measure& measure : measures()) out[measure.key] = number(metrics[measure.key]);
  return out;
}

// Names and descriptions of the measures.
Json measures_json() {
  constexpr const char* kBetter[] = {"higher", "lower", "nearest_one", "neither"};
  Json out = Json::array();
  for (const Measure& measure : measures()) {
    out.push_back({{"key", measure.key},
                   {"label", measure.label},
                   {"digits", measure.digits},
                   {"better", kBetter[static_cast<size_t>(measure.better)]},
                   {"meaning", measure.meaning}});
  }
  return out;
}

Json table_json(const MetricsTable& table) {
  Json out = Json::object();
  for (const auto& [name, metrics] : table) out[name] = metrics_json(metrics);
  return out;
}

// `real`: divisor of the recognised shares, in the same groups; null for real takes.
Json clips_json(const std::vector<ClipVerdict>& clips, const std::vector<ClipVerdict>* real) {
  const auto entry = [](const std::vector<ClipVerdict>& of,
                        const std::vector<ClipVerdict>* beside) {
    const ClipSummary summary = summarize_clips(of);
    Json out = {{"clips", summary.clips},
                {"recognised", number(summary.recognised)},
                {"cm", number(summary.cm)},
                {"hand_speed", number(summary.hand_speed)},
                {"hand_sharpness", number(summary.hand_sharpness)}};
    if (beside) out["of_real"] = number(summary.recognised / summarize_clips(*beside).recognised);
    return out;
  };
  const std::vector<ClipVerdict> real_styled = real ? styled_clips(*real) : clips;
  Json out;
  out["all"] = entry(styled_clips(clips), real ? &real_styled : nullptr);
  const struct {
    const char* key;
    std::string ClipVerdict::*name;
  } kGroups[] = {{"by_style", &ClipVerdict::style},
                 {"by_performer", &ClipVerdict::performer},
                 {"by_content", &ClipVerdict::content}};
  for (const auto& [key, name] : kGroups) {
    const bool styles = name == &ClipVerdict::style;  // Includes neutral.
    ClipGroups beside = clips_by(name, real_styled);
    out[key] = Json::object();
    for (const auto& [group, members] : clips_by(name, styles ? clips : styled_clips(clips))) {
      out[key][group] = entry(members, real ? &beside[group] : nullptr);
    }
  }
  out["confusion"] = Json::object();
  for (const auto& [pair, count] : confusion(clips)) {
    out["confusion"][pair.first][pair.second] = count;
  }
  return out;
}

Json mixes_json(const std::vector<MixReport>& mixes) {
  Json out = Json::array();
  for (const MixReport& mix : mixes) {
    out.push_back({{"first", mix.first},
                   {"second", mix.second},
                   {"either", number(mix.either)},
                   {"content", number(mix.content)},
                   {"correlation", number(mix.correlation)}});
  }
  return out;
}

// Each unseen content once, from the first split with it.
Json unseen_json(const std::vector<UnseenReport>& splits) {
  Json out = Json::object();
  for (const UnseenReport& split : splits) {
    for (const auto& [content, metrics] : split.by_content) {
      if (!out.contains(content)) out[content] = metrics_json(metrics);
    }
  }
  return out;
}

Json unseen_splits_json(const std::vector<UnseenReport>& splits) {
  Json out = Json::object();
  for (const UnseenReport& split : splits) {
    // Our own keys come last, so that they override contents of the same name.
    Json entry = table_json(split.by_content);
    entry["mean"] = metrics_json(split.mean);
    entry["seen"] = table_json(split.seen_by_content);
    entry["blind"] = table_json(split.blind_by_content);
    entry["mean_posture"] = table_json(split.mean_posture_by_content);
    entry["means"] = {{"seen", metrics_json(mean_metrics(split.seen_by_content))},
                      {"blind", metrics_json(mean_metrics(split.blind_by_content))},
                      {"mean_posture", metrics_json(mean_metrics(split.mean_posture_by_content))}};
    entry["contents"] = Json::array();
    for (const auto& [content, metrics] : split.by_content) entry["contents"].push_back(content);
    entry["performers"] = {
        {"unseen", clips_json(split.clips, &split.real_clips)},
        {"mean_posture", clips_json(split.mean_posture_clips, &split.real_clips)},
        {"real", clips_json(split.real_clips, nullptr)},
        {"blind", clips_json(split.blind_clips, nullptr)}};
    out[split.name] = std::move(entry);
  }
  return out;
}

Json style_summary_json(const StyleSummary& summary) {
  return {{"style_robust", number(summary.style_robust)},
          {"style_lda", number(summary.style_lda)},
          {"forced_mlp", number(summary.forced_mlp)},
          {"forced_lda", number(summary.forced_lda)},
          {"signature_sign", number(summary.signature_sign)},
          {"signature_amount", number(summary.signature_amount)}};
}

// Changes of each trait; for a signature, only those that are significant.
Json traits_json(const Traits& change, const Signature* signature = nullptr) {
  Json out = Json::object();
  for (size_t t = 0; t < kTraits.size(); ++t) {
    const bool told = !signature || signature->certain[t];
    out[kTraits[t].key] = number(told ? change[t] : kNotMeasured);
  }
  return out;
}

// Mean change per style over the rows with one.
Json signatures_json(const std::vector<OodRow>& rows) {
  std::map<std::string, SignatureMatch> styles;
  for (const OodRow& row : rows) {
    if (row.verdict.signature.takes > 0) styles[row.style] += row.verdict.signature;
  }
  Json out = Json::object();
  for (const auto& [style, match] : styles) {
    out[style] = traits_json(match.mean_change());
    out[style]["sign"] = number(match.sign_share());
    out[style]["amount"] = number(match.amount_share());
  }
  return out;
}

Json ood_summary_json(const std::vector<OodRow>& rows) {
  const auto mean = [&](double OodRow::*value) {
    return number(finite_mean(values_of(rows, value)));
  };
  const auto at = [&](double OodRow::*value, double share) {
    return number(quantile(values_of(rows, value), share));
  };
  // Means of shares of frames, and the number of rows with any such frame.
  const auto shares = [&](double OodRow::*value) {
    const auto any = [&](const OodRow& row) { return row.*value > 0; };
    return Json{{"mean", mean(value)},
                {"max", at(value, 1)},
                {"rows", std::count_if(rows.begin(), rows.end(), any)}};
  };
  int jumps = 0, jump_rows = 0;
  for (const OodRow& row : rows) {
    jumps += row.jumps;
    jump_rows += row.jumps > 0;
  }
  const LegSummary legs = summarize_legs(rows);
  Json out = {
      {"rows", rows.size()},
      {"clips", ood_by_clip(rows).size()},
      {"jerk_ratio",
       {{"median", at(&OodRow::jerk_ratio, 0.5)},
        {"p90", at(&OodRow::jerk_ratio, 0.9)},
        {"max", at(&OodRow::jerk_ratio, 1)}}},
      {"velocity_correlation",
       {{"median", at(&OodRow::velocity_correlation, 0.5)},
        {"p10", at(&OodRow::velocity_correlation, 0.1)}}},
      {"distance_cm", {{"mean", mean(&OodRow::distance_cm)}}},
      {"beyond_limits", shares(&OodRow::beyond_limits)},
      {"legs_beyond",
       {{"upright_thighs", number(legs.upright_thighs)},
        {"upright_knees", number(legs.upright_knees)},
        {"crouching_thighs", number(legs.crouching_thighs)},
        {"crouching_knees", number(legs.crouching_knees)},
        {"worst_deg", number(legs.worst_deg)}}},
      {"under_floor", shares(&OodRow::under_floor)},
      {"jumps", {{"frames", jumps}, {"rows", jump_rows}}},
      {"skating_ratio", {{"mean", mean(&OodRow::skating_ratio)}}},
      {"input_skating_ratio", {{"mean", mean(&OodRow::input_skating_ratio)}}},
      {"turned_deg", {{"mean", mean(&OodRow::turned_deg)}}},
      {"drift_m", {{"max", at(&OodRow::drift_m, 1)}}},
      {"gate", {{"mean", mean(&OodRow::gate)}}},
  };
  out.update(style_summary_json(summarize_styles(rows)));
  return out;
}

// Means over the styles for each clip.
Json ood_by_clip_json(const std::vector<OodRow>& rows) {
  constexpr std::pair<const char*, double OodRow::*> kNumbers[] = {
      {"jerk_ratio", &OodRow::jerk_ratio},
      {"velocity_correlation", &OodRow::velocity_correlation},
      {"distance_cm", &OodRow::distance_cm},
      {"under_floor", &OodRow::under_floor},
      {"gate", &OodRow::gate}};
  Json out = Json::object();
  for (const auto& [clip, of_clip] : ood_by_clip(rows)) {
    for (const auto& [key, value] : kNumbers) {
      out[clip][key] = number(finite_mean(values_of(of_clip, value)));
    }
  }
  return out;
}

// Each shot measure over the applicable frames of all rows.
Json shots_json(const std::vector<OodRow>& rows) {
  Json out;
  for (size_t i = 0; i < kShotKeys.size(); ++i) {
    const std::vector<double> values = shots_of(rows, i);
    std::vector<double> over;
    for (const double value : values) over.push_back(value > 2);
    out[kShotKeys[i]] = {{"frames", values.size()},
                         {"median", number(quantile(values, 0.5))},
                         {"p90", number(quantile(values, 0.9))},
                         {"over_2", number(finite_mean(over))}};
  }
  return out;
}

Json ood_json(const std::vector<OodRow>& rows) {
  Json list = Json::array();
  for (const OodRow& row : rows) {
    list.push_back({{"clip", row.clip},
                    {"style", row.style},
                    {"jerk_ratio", number(row.jerk_ratio)},
                    {"velocity_correlation", number(row.velocity_correlation)},
                    {"distance_cm", number(row.distance_cm)},
                    {"beyond_limits", number(row.beyond_limits)},
                    {"under_floor", number(row.under_floor)},
                    {"jumps", row.jumps},
                    {"skating_ratio", number(row.skating_ratio)},
                    {"input_skating_ratio", number(row.input_skating_ratio)},
                    {"turned_deg", number(row.turned_deg)},
                    {"drift_m", number(row.drift_m)},
                    {"gate", number(row.gate)},
                    {"style_robust", number(row.verdict.style_robust)},
                    {"style_lda", number(row.verdict.style_lda)}});
  }
  Json out;
  out["summary"] = ood_summary_json(rows);
  out["shot"] = shots_json(rows);
  out["signatures"] = signatures_json(rows);
  out["by_clip"] = ood_by_clip_json(rows);
  out["rows"] = std::move(list);
  return out;
}

Json disturbances_json(const std::vector<DisturbanceRow>& rows) {
  Json out = Json::object();
  for (const DisturbanceRow& row : rows) out[row.name]["cm"] = number(row.cm);
  return out;
}

Json movement_json(const Movement& shares) {
  Json out = Json::object();
  for (size_t t = 0; t < shares.size(); ++t) out[kMovementTraits[t].key] = number(shares[t]);
  return out;
}

Json arrival_summary_json(const ArrivalSummary& of) {
  return {{"traits", of.traits},
          {"median", number(of.median)},
          {"below_half", number(of.below_half)},
          {"wrong_sign", number(of.wrong_sign)},
          {"by_trait", movement_json(of.by_trait)},
          {"side", number(of.side)},
          {"styles_with_side", of.sided},
          {"styles_in_step", of.in_step}};
}

// How much of each style's movement and side arrives on walks; real test takes beside.
Json arrival_json(const std::vector<StyleArrival>& styles) {
  Json out;
  out["real"] = arrival_summary_json(summarize(styles, real_shares));
  out["own"] = arrival_summary_json(summarize(styles, made_shares<Walks::own>));
  out["others"] = arrival_summary_json(summarize(styles, made_shares<Walks::others>));
  out["walker"] = arrival_summary_json(summarize(styles, made_shares<Walks::walker>));
  out["by_style"] = Json::object();
  for (const StyleArrival& style : styles) {
    Json& entry = out["by_style"][style.style];
    entry["change"] = movement_json(style.change);
    entry["side_cm"] = number(style.side_cm);
    entry["real_steps"] = {number(style.slowest), number(style.fastest)};
    entry["from_input_cm"] = number(style.from_input_cm);
    entry["nearest"] = style.nearest;
    entry["nearest_cm"] = number(style.nearest_cm);
    const auto add = [&](const char* key, const ArrivedShares& shares) {
      entry[key] = {{"movement", movement_json(shares.movement)},
                    {"side", number(shares.side)},
                    {"steps", number(shares.steps)}};
    };
    add("real", style.real);
    for (size_t w = 0; w < kWalksKeys.size(); ++w) add(kWalksKeys[w], style.made[w]);
  }
  return out;
}

Json prediction_json(const std::vector<PredictionRow>& rows) {
  Json out = Json::object();
  for (const PredictionRow& row : rows) {
    Json& entry = out[row.content];
    entry["instants"] = row.instants;
    for (size_t h = 0; h < kPredictionSeconds.size(); ++h) {
      entry[number_text(kPredictionSeconds[h], 2)] = {{"predicted_cm", number(row.predicted_cm[h])},
                                                      {"velocity_cm", number(row.velocity_cm[h])},
                                                      {"held_cm", number(row.held_cm[h])}};
    }
  }
  return out;
}

Json persons_json(const PersonsReport& persons) {
  const auto spread = [](const PersonSpread& of) {
    return Json{{"median_cm", number(of.median_cm)}, {"p90_cm", number(of.p90_cm)}};
  };
  Json out;
  out["real"] = spread(persons.real.spread);
  out["real"].update({{"people", persons.real.people},
                      {"own_cm", number(persons.real.own_cm)},
                      {"told", number(persons.real.told)},
                      {"told_of", persons.real.told_of},
                      {"kept", number(persons.real.kept)}});
  out["seeds"] = spread(persons.seeds.spread);
  out["seeds"].update({{"seeds", persons.seeds.seeds},
                       {"walks", persons.seeds.walks},
                       {"told", number(persons.seeds.told)},
                       {"outside", number(persons.seeds.outside)}});
  out["styled"] = {{"clips", persons.styled.clips},
                   {"told", number(persons.styled.told)},
                   {"told_without", number(persons.styled.told_without)}};
  out["others"] = {{"clips", persons.others.clips},
                   {"jerk_median", number(persons.others.jerk_median)},
                   {"jerk_p90", number(persons.others.jerk_p90)},
                   {"beyond_limits", number(persons.others.beyond_limits)},
                   {"jumps", number(persons.others.jumps)},
                   {"more_sliding", number(persons.others.more_sliding)},
                   {"cm", number(persons.others.cm)}};
  return out;
}

// The intervals of frames, [first, end), in which a foot is planted.
Json planted_json(const std::vector<FootContacts>& contacts, int foot) {
  Json out = Json::array();
  for (size_t f = 0; f < contacts.size(); ++f) {
    if (!contacts[f][foot]) continue;
    if (out.empty() || out.back()[1] != f) out.push_back({f, f});
    out.back()[1] = f + 1;
  }
  return out;
}

Json contacts_json(const std::vector<ContactReport>& reports) {
  Json out = Json::array();
  for (const ContactReport& report : reports) {
    Json rows = Json::array();
    for (const ContactRow& row : report.rows) {
      rows.push_back({{"label", row.label},
                      {"fps", number(row.fps)},
                      {"frames", row.contacts.size()},
                      {"left", planted_json(row.contacts, 0)},
                      {"right", planted_json(row.contacts, 1)}});
    }
    out.push_back({{"title", report.title}, {"rows", std::move(rows)}});
  }
  return out;
}

// The rows and columns of all confusions.
std::vector<std::string> labels_of(const Report& report) {
  std::vector<ClipVerdict> all = report.real_clips;
  for (const SystemReport& system : report.systems) {
    all.insert(all.end(), system.clips.begin(), system.clips.end());
  }
  return confusion_labels(all);
}

Json system_json(const SystemReport& system, const Report& report) {
  Json out;
  out["recipe"] = system.recipe.empty() ? Json(nullptr) : Json(system.recipe);
  out["seen"] = metrics_json(system.seen);
  out["seen_by_content"] = table_json(system.by_content);
  out["seen_by_style"] = table_json(system.by_style);
  const std::vector<ClipVerdict> shared = shared_clips(report.real_clips, report.real_clips);
  out["performers"] = {
      {"own", clips_json(system.clips, &report.real_clips)},
      {"across", clips_json(system.clips_across, &report.real_clips_across)},
      {"shared", clips_json(shared_clips(report.real_clips, system.clips), &shared)}};
  out["strength"] = Json::object();
  for (const auto& [strength, metrics] : system.strength) {
    out["strength"][strength] = metrics_json(metrics);
  }
  out["strength_by_style"] = Json::object();
  for (const auto& [strength, styles] : system.strength_by_style) {
    out["strength_by_style"][strength] = table_json(styles);
  }
  out["slider"] = {{"style", number(system.slider_style)},
                   {"distance", number(system.slider_distance)}};
  out["mixes"] = mixes_json(system.mixes);
  out["unseen"] = unseen_json(system.unseen);
  out["unseen_splits"] = unseen_splits_json(system.unseen);
  out["foreign"] = ood_json(system.ood);
  out["disturbances"] = disturbances_json(system.disturbances);
  out["arrival"] = arrival_json(system.arrival);
  out["foresight"] = prediction_json(system.prediction);
  out["persons"] = system.persons ? persons_json(*system.persons) : Json(nullptr);
  out["cc"] = number(system.cc);
  out["sc"] = number(system.sc);
  out["bone_length_error_cm"] = number(system.bone_length_error_cm);
  out["step_us"] = number(system.step_us);
  out["model_bytes"] = size(system.model_bytes);
  out["parameters"] = size(system.parameters);
  if (system.recorded) {
    out["recorded"] = {{"listed", system.recorded->listed}, {"judged", system.recorded->evaluated}};
  }
  return out;
}

Json removal_json(const RemovalReport& report) {
  const auto removed = [](const RemovalSummary& of) {
    return Json{{"clips", of.clips},
                {"neutral", number(of.neutral)},
                {"before", number(of.before)},
                {"content", number(of.content)},
                {"cm", number(of.cm)},
                {"cm_ratio", number(of.cm_ratio)},
                {"jerk_ratio", number(of.jerk)},
                {"jumps", number(of.jumps)}};
  };
  const auto recognised = [](const RecognitionSummary& of) {
    return Json{{"clips", of.clips},
                {"neutral_clips", of.neutral_clips},
                {"first", number(of.first)},
                {"third", number(of.third)},
                {"neutral", number(of.neutral)}};
  };
  return {{"named", removed(report.named)},
          {"any", removed(report.any)},
          {"restyled", removed(report.restyled)},
          {"original", removed(report.original)},
          {"recognition", recognised(report.recognition)},
          {"others", recognised(report.others)}};
}

}  // namespace

std::vector<std::string> ceiling_notes(const Report& report) {
  struct Judge {
    const char *name, *key, *figures;
    double floor;
  };
  const Judge judges[] = {{"style", "style_accuracy",
                           "style, style probability, strengths and mixes", report.style_floor},
                          {"content", "content_accuracy", "content and FMD", report.content_floor}};
  std::vector<std::string> notes;
  for (const Judge& judge : judges) {
    const double share = report.real[judge.key];
    if (share >= judge.floor || report.real.takes == 0) continue;
    notes.push_back(std::string("The ") + judge.name + " classifier recognises " +
                    number_text(share, 3) + " of the windows of real held-out takes, less than " +
                    number_text(judge.floor, 3) + ": compare its figures (" + judge.figures +
                    ") with those of the real takes, not with 1.");
  }
  return notes;
}

nlohmann::ordered_json report_tree(const Report& report) {
  Json out;
  out["format"] = "panache report 1";
  out["trained_on"] = report.trained_on;
  out["tested_on"] = report.tested_on;
  out["styles"] = report.styles;
  out["contents"] = report.contents;
  out["measures"] = measures_json();
  out["traits"] = Json::array();
  for (const Trait& trait : kTraits) {
    out["traits"].push_back({{"key", trait.key}, {"label", trait.label}});
  }
  out["seconds"] = number(report.seconds);
  out["style_floor"] = number(report.style_floor);
  out["content_floor"] = number(report.content_floor);
  out["notes"] = ceiling_notes(report);
  out["real"] = metrics_json(report.real);
  out["input"] = metrics_json(report.input);
  out["real_by_content"] = table_json(report.real_by_content);
  out["real_by_style"] = table_json(report.real_by_style);
  out["input_by_content"] = table_json(report.input_by_content);
  out["performers"] = {
      {"own", clips_json(report.real_clips, nullptr)},
      {"across", clips_json(report.real_clips_across, nullptr)},
      {"shared", clips_json(shared_clips(report.real_clips, report.real_clips), nullptr)}};
  out["performers"]["labels"] = labels_of(report);
  out["cc_floor"] = number(report.cc_floor);
  out["sc_floor"] = number(report.sc_floor);
  out["foreign_reference"] = {{"real", style_summary_json(report.ood_real)},
                              {"real_unseen", style_summary_json(report.ood_real_unseen)},
                              {"input", style_summary_json(report.ood_input)}};
  out["signatures"] = Json::object();
  for (const SignatureReport& signature : report.signatures) {
    Json& style = out["signatures"][signature.style];
    style = traits_json(signature.real.change, &signature.real);
    style["left_out_sign"] = number(signature.left_out.sign_share());
    style["left_out_amount"] = number(signature.left_out.amount_share());
  }
  out["systems"] = Json::object();
  for (const SystemReport& system : report.systems) {
    assert(!out["systems"].contains(system.name));
    out["systems"][system.name] = system_json(system, report);
  }
  if (report.removal) out["removal"] = removal_json(*report.removal);
  out["contacts"] = contacts_json(report.contacts);
  return out;
}

std::string report_json(const Report& report) {
  // Names come from files; invalid UTF-8 must not make the report fail.
  return report_tree(report).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace panache
