// Learns a style in the page, and writes the report that the page shows.

#include <algorithm>
#include <cmath>

#include "exports.h"
#include "learn/learn_style.h"
#include "net/safetensors.h"
#include "rig/rig.h"

using namespace panache;
using namespace panache::web;

namespace {

using Json = nlohmann::json;

constexpr const char* kModel = "the model";
constexpr int kShownPoses = 7;

// Positions in the body frame, [21][3], rounded to the millimetre.
Json positions(const Take& take, double seconds) {
  const auto frame = static_cast<size_t>(
      std::clamp(std::lround(seconds * kTakeRate), 0L, static_cast<long>(take.frames() - 1)));
  Json out = Json::array();
  for (const Vec3& p : take.body[frame]) {
    for (const float n : {p.x, p.y, p.z}) out.push_back(std::round(n * 1000) / 1000);
  }
  return out;
}

// The time alignment, and a few pairs of poses, evenly spread over the styled motion.
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

// See LearnReport in the package's index.ts.
Json report_of(const LearntStyle& learnt, const LearnPair& pair) {
  const PairReport& report = learnt.pairs.front();
  std::vector<std::string> warnings = learnt.warnings;
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  const auto measured = [&](double cm) { return learnt.judged ? Json(cm) : Json(); };
  return {{"neutral", report.neutral_name},
          {"styled", report.styled_name},
          {"seconds", report.seconds},
          {"tempo", report.tempo},
          {"match", report.match},
          {"verdict", learnt.judged ? Json(learnt.verdict()) : Json()},
          {"warnings", warnings},
          {"heldBackCm", measured(learnt.held_back_cm)},
          {"meanPostureCm", measured(learnt.mean_posture_cm)},
          {"untouchedCm", measured(learnt.untouched_cm)},
          {"people", report.twin ? Json(report.twin->people) : Json()},
          {"certainty", report.twin ? Json(report.twin->certainty) : Json()},
          {"plot", match_plot(pair, report.instants)}};
}

// A motion of an open file.
struct Motion {
  const Clip& clip;
  Result<Rig> rig;
  std::string name;  // File name, for messages.
};
Motion motion_of(const panache_motion_file* file, int which) {
  const Clip& clip = file->file->clip(which);
  return {clip, Rig::create(clip), file->path};
}

Result<LearnPair> pair_of(const Motion& neutral, const Motion& styled) {
  if (!neutral.rig) return located(neutral.name, neutral.rig.error());
  if (!styled.rig) return located(styled.name, styled.rig.error());
  return make_learn_pair({neutral.clip, *neutral.rig, neutral.name},
                         {styled.clip, *styled.rig, styled.name});
}
Result<LearnPair> pair_of(std::string_view bank, const Motion& styled) {
  const auto people = NeutralBank::parse(bank, "the bank of neutral motion");
  if (!people) return people.error();
  if (!styled.rig) return located(styled.name, styled.rig.error());
  return make_learn_pair({styled.clip, *styled.rig, styled.name}, **people);
}

}  // namespace

// Returns the bytes of a style file, and those of the report in *report. Without a neutral file,
// uses the mean neutral motion in `bank`.
PANACHE_EXPORT panache_bytes* panache_page_learn(
    const char* model, uint32_t model_size, const panache_motion_file* neutral,
    int32_t neutral_clip, const char* bank, uint32_t bank_size, const panache_motion_file* styled,
    int32_t styled_clip, const char* style, panache_bytes** report) {
  const Motion after = motion_of(styled, styled_clip);
  const Result<LearnPair> pair = neutral ? pair_of(motion_of(neutral, neutral_clip), after)
                                         : pair_of(bytes_at(bank, bank_size), after);
  if (!pair) return fail(pair.error());
  const Result<TensorFile> file = parse_safetensors(bytes_at(model, model_size), kModel);
  if (!file) return fail(file.error());
  const Result<LearntStyle> learnt = learn_style(*file, kModel, {&*pair, 1}, style, "");
  if (!learnt) return fail(learnt.error());
  *report = to_bytes(report_of(*learnt, *pair));
  return new panache_bytes{format_safetensors(learnt->file)};
}
