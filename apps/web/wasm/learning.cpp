#include "learning.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "learn/learn_style.h"
#include "net/safetensors.h"
#include "rig/rig.h"

namespace panache::web {
namespace {

using Json = nlohmann::json;

constexpr const char* kModel = "the model";
constexpr int kShownPoses = 7;

// Positions in the body frame, [21][3], to the millimetre.
Json positions(const Take& take, double seconds) {
  const auto frame = static_cast<size_t>(
      std::clamp(std::lround(seconds * kTakeRate), 0L, static_cast<long>(take.frames() - 1)));
  Json out = Json::array();
  for (const Vec3& p : take.body[frame]) {
    for (const float n : {p.x, p.y, p.z}) out.push_back(std::round(n * 1000) / 1000);
  }
  return out;
}

// What was laid together, and a few poses of both, evenly spread over the styled motion.
Json match_plot(const LearnPair& pair, const std::vector<MatchedInstant>& instants) {
  Json lines = Json::array(), poses = Json::array();
  for (const MatchedInstant& at : instants) {
    lines.push_back({at.styled_seconds, at.neutral_seconds, at.distance});
  }
  for (int i = 0; i < kShownPoses && !instants.empty(); ++i) {
    const MatchedInstant& at = instants[(instants.size() - 1) * static_cast<size_t>(i) /
                                        static_cast<size_t>(kShownPoses - 1)];
    poses.push_back({{"styledSeconds", at.styled_seconds},
                     {"neutralSeconds", at.neutral_seconds},
                     {"styled", positions(pair.styled, at.styled_seconds)},
                     {"neutral", positions(pair.neutral, at.neutral_seconds)}});
  }
  return {{"styledSeconds", pair.styled.frames() / kTakeRate},
          {"neutralSeconds", pair.neutral.frames() / kTakeRate},
          {"instants", lines},
          {"poses", poses}};
}

Result<Learnt> learn_pair(std::string_view model, const Result<LearnPair>& pair,
                          const std::string& style) {
  if (!pair) return pair.error();
  const Result<TensorFile> file = parse_safetensors(model, kModel);
  if (!file) return file.error();
  const Result<LearntStyle> learnt = learn_style(*file, kModel, {&*pair, 1}, style, "");
  if (!learnt) return learnt.error();
  const PairReport& report = learnt->pairs.front();
  std::vector<std::string> warnings = learnt->warnings;
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  const auto measured = [&](double cm) { return learnt->judged ? Json(cm) : Json(); };
  const Json all = {{"neutral", report.neutral_name},
                    {"styled", report.styled_name},
                    {"seconds", report.seconds},
                    {"tempo", report.tempo},
                    {"match", report.match},
                    {"verdict", learnt->judged ? Json(learnt->verdict()) : Json()},
                    {"warnings", warnings},
                    {"heldBackCm", measured(learnt->held_back_cm)},
                    {"meanPostureCm", measured(learnt->mean_posture_cm)},
                    {"untouchedCm", measured(learnt->untouched_cm)},
                    {"people", report.twin ? Json(report.twin->people) : Json()},
                    {"certainty", report.twin ? Json(report.twin->certainty) : Json()},
                    {"plot", match_plot(*pair, report.instants)}};
  // Names are the files', and may be no UTF-8.
  return Learnt{format_safetensors(learnt->file),
                all.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace

Result<Learnt> learn(std::string_view model, const Motion& neutral, const Motion& styled,
                     const std::string& style) {
  const Clip &before = neutral.file.clip(neutral.which), &after = styled.file.clip(styled.which);
  const Result<Rig> before_rig = Rig::create(before), after_rig = Rig::create(after);
  if (!before_rig) return located(neutral.name, before_rig.error());
  if (!after_rig) return located(styled.name, after_rig.error());
  return learn_pair(
      model, make_learn_pair({before, *before_rig, neutral.name}, {after, *after_rig, styled.name}),
      style);
}

Result<Learnt> learn_alone(std::string_view model, std::string_view bank, const Motion& styled,
                           const std::string& style) {
  const auto people = NeutralBank::parse(bank, "the bank of neutral motion");
  if (!people) return people.error();
  const Clip& after = styled.file.clip(styled.which);
  const Result<Rig> rig = Rig::create(after);
  if (!rig) return located(styled.name, rig.error());
  return learn_pair(model, make_learn_pair({after, *rig, styled.name}, **people), style);
}

}  // namespace panache::web
