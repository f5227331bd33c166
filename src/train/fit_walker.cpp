#include "train/fit_walker.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "learn/ridge.h"
#include "learn/take.h"
#include "train/gait_take.h"

namespace panache {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

enum class Use { none, walk, run, stand };

Use use_of(const ManifestRow& row) {
  if (!row.neutral || row.test) return Use::none;
  const std::string& content = row.content;
  if (content == "walk" || content == "walk-turn-left" || content == "walk-turn-right") {
    return Use::walk;
  }
  if (content == "run" || content == "dash") return Use::run;
  if (content.starts_with("raise-") || content.starts_with("wave-")) return Use::stand;
  return Use::none;
}

// Which frames show a gait going on, and what may be believed of its coefficients.
struct GaitRules {
  float reference, slowest, fastest;  // m/s
  // Penalties of the terms 1, u, u^2, turn, turn^2, acceleration: the squared change per term
  // counts as that many frames' squared error.
  std::array<double, kTerms> penalties;
};
// The walks lie so close together in speed that their curvature would be noise; the runs do not
// turn at all.
constexpr GaitRules kWalkRules = {1.1f, 0.6f, 1.5f, {1e-3, 1, 1e5, 3, 3, 100}};
constexpr GaitRules kRunRules = {2.8f, 1.9f, 4.5f, {1e-3, 3, 30, 300, 300, 100}};

constexpr int kMargin = 3;              // Frames at the ends whose speed is least certain.
constexpr double kMaxSideways = 0.3;    // m/s
constexpr float kMaxGaitTurn = 1.75f;   // rad/s
constexpr float kMaxGaitChange = 1.5f;  // m/s^2

struct GaitTake {
  const Take* take;
  std::vector<GaitFrame> frames;
};

// Whether a frame tells how fast a gait goes: in a turn the hips are on a shorter way than the
// feet.
bool is_straight(const GaitFrame& frame) { return std::abs(frame.going.turn) < 0.25f; }

bool is_usable(const GaitTake& take, int f, const GaitRules& rules) {
  if (f < kMargin || f + kMargin >= static_cast<int>(take.frames.size())) return false;
  const GaitFrame& frame = take.frames[f];
  return frame.going.speed > rules.slowest && frame.going.speed < rules.fastest &&
         std::abs(frame.sideways) < kMaxSideways && std::abs(frame.going.turn) < kMaxGaitTurn &&
         std::abs(frame.going.acceleration) < kMaxGaitChange && frame.cadence > 0.3;
}

constexpr int kUnknowns = kWaves * kTerms;

void add_frame(Ridge& fit, const Gait& gait, double phase, const Going& going,
               const Channels& channels) {
  std::array<float, kTerms> terms;
  std::array<float, kWaves> waves;
  gait_terms(gait, going, terms);
  gait_waves(static_cast<float>(std::remainder(phase, kTurn)), waves);
  std::array<double, kUnknowns> row;
  for (int k = 0; k < kUnknowns; ++k) {
    row[k] = static_cast<double>(waves[k / kTerms]) * static_cast<double>(terms[k % kTerms]);
  }
  std::array<double, kChannels> outputs;
  std::copy(channels.begin(), channels.end(), outputs.begin());
  fit.add(row, outputs);
}

// `prior`: a gait whose coefficients are the best guess where the data say nothing; only its turn
// and acceleration are taken over, the rest starts at zero.
void fit_coefficients(const std::vector<GaitTake>& takes, const GaitRules& rules, const Gait* prior,
                      Gait& gait) {
  Ridge fit(kUnknowns, kChannels);
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules)) continue;
      const GaitFrame& frame = take.frames[f];
      add_frame(fit, gait, frame.phase, frame.going, frame.channels);
      const Going other = {frame.going.speed, -frame.going.turn, frame.going.acceleration};
      add_frame(fit, gait, frame.phase + kTurn / 2, other, mirrored(frame.channels));
    }
  }
  std::vector<double> penalties(kUnknowns), before(size_t(kUnknowns) * kChannels);
  for (int k = 0; k < kUnknowns; ++k) {
    penalties[k] = rules.penalties[k % kTerms];
    if (!prior || k % kTerms < 3) continue;
    for (int c = 0; c < kChannels; ++c) {
      before[k * kChannels + c] = static_cast<double>(prior->coefficients[c * kUnknowns + k]);
    }
  }
  const std::vector<double> weights = fit.solve(penalties, before);
  gait.coefficients.resize(size_t(kChannels) * kUnknowns);
  for (int c = 0; c < kChannels; ++c) {
    for (int k = 0; k < kUnknowns; ++k) {
      gait.coefficients[c * kUnknowns + k] = static_cast<float>(weights[k * kChannels + c]);
    }
  }
}

// log cadence = log a + exponent * log speed. Strides, not frames, are what was observed; one
// frame in each is enough.
void fit_cadence(const std::vector<GaitTake>& takes, const GaitRules& rules, Gait& gait) {
  Ridge fit(2, 1);
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); f += 10) {
      const GaitFrame& frame = take.frames[f];
      if (!is_usable(take, f, rules) || !is_straight(frame)) continue;
      const double log_speed = std::log(static_cast<double>(frame.going.speed / rules.reference));
      fit.add(std::array{1.0, log_speed}, std::array{std::log(frame.cadence)});
    }
  }
  // Across people and machines cadence grows with about the root of the speed when walking; the
  // penalty is a handful of strides' worth.
  const std::vector<double> weights = fit.solve(std::array{1e-9, 1e-2});
  gait.exponent = static_cast<float>(weights[1]);
  gait.cadence = static_cast<float>(
      std::exp(weights[0] - weights[1] * std::log(static_cast<double>(rules.reference))));
}

// Who turns looks ahead: the body goes sideways in its own view. speed sideways = -lead * speed *
// turn, where a turn shows it; `otherwise` where no take turns.
void fit_gaze(const std::vector<GaitTake>& takes, const GaitRules& rules, float otherwise,
              Gait& gait) {
  Ridge fit(1, 1);
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules)) continue;
      const Going& going = take.frames[f].going;
      const double row = static_cast<double>(-going.speed * going.turn);
      fit.add(std::array{row}, std::array{take.frames[f].sideways});
    }
  }
  const std::vector<double> weights =
      fit.solve(std::array{300.0}, std::array{static_cast<double>(otherwise)});
  gait.gaze_lead = static_cast<float>(weights[0]);
}

// Whether a foot carries weight: its toe is low and slow beside the body's speed. The contacts of
// the take are stricter, and hardly know the foot of a fast runner.
bool is_down(const Take& take, int f, int foot, float speed) {
  constexpr float kMaxHeight = 0.05f;  // Metres.
  const Vec3 before = world_positions(take, f - 1)[index(kToes[foot])];
  const Vec3 after = world_positions(take, f + 1)[index(kToes[foot])];
  const float toe_speed = length(after - before) * static_cast<float>(kTakeRate) / 2;
  return take.body[f][index(kToes[foot])].y < kMaxHeight &&
         toe_speed < std::max(0.45f, 0.25f * speed);
}

// The phases at which feet land and lift, as lines over the speed.
void fit_contacts(const std::vector<GaitTake>& takes, const GaitRules& rules, Gait& gait) {
  Ridge lands(2, 1), lifts(2, 1);
  const auto add = [&](Ridge& fit, const GaitTake& take, int f, int foot, double around) {
    // The change happened half-way from the frame before.
    const double phase = (take.frames[f].phase + take.frames[f - 1].phase) / 2 - foot * kTurn / 2;
    const double speed = static_cast<double>(take.frames[f].going.speed - rules.reference);
    fit.add(std::array{1.0, speed}, std::array{around + std::remainder(phase - around, kTurn)});
  };
  for (const GaitTake& take : takes) {
    for (int f = 1; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules) || !is_straight(take.frames[f])) continue;
      for (int foot = 0; foot < kFeet; ++foot) {
        const float body = take.frames[f].going.speed;
        const bool now = is_down(*take.take, f, foot, body);
        const bool before = is_down(*take.take, f - 1, foot, body);
        if (now && !before) add(lands, take, f, foot, 0.0);
        if (before && !now) add(lifts, take, f, foot, kTurn / 2);
      }
    }
  }
  const std::array<double, 2> penalties = {1e-6, 0.1};
  const std::vector<double> on = lands.solve(penalties), off = lifts.solve(penalties);
  gait.lands = {static_cast<float>(on[0]), static_cast<float>(on[1])};
  gait.lifts = {static_cast<float>(off[0]), static_cast<float>(off[1])};
}

struct FittedGait {
  Gait gait;
  int frames = 0;
  double residual = 0;
};

FittedGait fit_gait(const std::vector<GaitTake>& takes, const GaitRules& rules, const Gait* prior) {
  FittedGait out;
  out.gait.reference = rules.reference;
  // Speeds that a tenth of a percent of the frames goes beyond.
  std::vector<float> speeds;
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      if (is_usable(take, f, rules)) speeds.push_back(take.frames[f].going.speed);
    }
  }
  out.frames = static_cast<int>(speeds.size());
  if (speeds.empty()) return out;
  std::sort(speeds.begin(), speeds.end());
  out.gait.slowest = speeds[speeds.size() / 200];
  out.gait.fastest = speeds[speeds.size() - 1 - speeds.size() / 1000];
  fit_coefficients(takes, rules, prior, out.gait);
  fit_cadence(takes, rules, out.gait);
  fit_gaze(takes, rules, prior ? prior->gaze_lead : 0, out.gait);
  fit_contacts(takes, rules, out.gait);

  double sum = 0;
  Channels channels;
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules)) continue;
      const GaitFrame& frame = take.frames[f];
      evaluate(out.gait, static_cast<float>(std::remainder(frame.phase, kTurn)), frame.going,
               channels);
      for (int c = 3; c < kChannels; ++c) {
        const double error = static_cast<double>(channels[c] - frame.channels[c]);
        sum += error * error;
      }
    }
  }
  out.residual = std::sqrt(sum / (3.0 * static_cast<double>(kDriven.size()) * out.frames));
  return out;
}

// Frames at the ends of a gesture in which the arms hang. The takes are cut so close that the hands
// are on their way already.
bool is_standing(const Take& take, int f) {
  if (f + 1 >= take.frames()) return false;
  for (const HumanJoint hand : {HumanJoint::left_hand, HumanJoint::right_hand}) {
    if (take.body[f][index(hand)].y > take.body[f][0].y) return false;
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    if (length(take.body[f + 1][j] - take.body[f][j]) > 0.5f / static_cast<float>(kTakeRate))
      return false;
  }
  return take.contacts[f][0] && take.contacts[f][1];
}

// The mean of the standing frames and their reflections.
int fit_stand(const std::vector<const Take*>& takes, Channels& stand) {
  std::array<double, kChannels> sum{};
  int frames = 0;
  for (const Take* take : takes) {
    for (int f = 0; f < take->frames(); ++f) {
      if (!is_standing(*take, f)) continue;
      const HumanPositions& body = take->body[f];
      // Over the middle of the feet, with which the hips need not be in line.
      const Vec3 feet = (body[index(kToes[0])] + body[index(kToes[1])] + body[index(kAnkles[0])] +
                         body[index(kAnkles[1])]) *
                        0.25f;
      const RootPose& root = take->root[f];
      const Vec3 origin = to_world(Vec3{feet.x, 0, feet.z}, root);
      const Channels channels = gait_channels(*take, f, origin, root.facing);
      const Channels other = mirrored(channels);
      for (int c = 0; c < kChannels; ++c) {
        sum[c] += static_cast<double>(channels[c] + other[c]) / 2;
      }
      ++frames;
    }
  }
  for (int c = 0; c < kChannels && frames > 0; ++c) {
    stand[c] = static_cast<float>(sum[c] / frames);
  }
  return frames;
}

}  // namespace

Result<FittedWalker> fit_walker(const std::vector<ManifestRow>& rows, const std::string& data,
                                const std::string& licence) {
  std::vector<ManifestRow> used;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(used),
               [](const ManifestRow& row) { return use_of(row) != Use::none; });
  Result<std::vector<Take>> takes = load_takes(used, PoseLayout::positions);
  if (!takes) return takes.error();
  std::vector<GaitTake> walks, runs;
  std::vector<const Take*> stands;
  for (const Take& take : *takes) {
    if (use_of(take.row) == Use::stand) {
      stands.push_back(&take);
      continue;
    }
    std::vector<GaitFrame> frames = gait_frames(take);
    if (frames.empty()) continue;
    (use_of(take.row) == Use::walk ? walks : runs).push_back({&take, std::move(frames)});
  }
  const FittedGait walk = fit_gait(walks, kWalkRules, nullptr);
  if (walk.frames < 2 * kUnknowns) {
    return Error{"the manifests hold " + std::to_string(walk.frames) +
                 " frames of neutral walking that are not held out; expected some hundreds"};
  }
  const FittedGait run = fit_gait(runs, kRunRules, &walk.gait);
  if (run.frames < 2 * kUnknowns) {
    return Error{"the manifests hold " + std::to_string(run.frames) +
                 " frames of neutral running that are not held out; expected some hundreds"};
  }
  Channels stand{};
  const int stand_frames = fit_stand(stands, stand);
  if (stand_frames == 0) {
    return Error{
        "the manifests hold no neutral gesture (raise-*, wave-*) that starts or ends "
        "standing still with hanging arms"};
  }
  std::map<std::string, std::string> metadata;
  metadata["data"] = data;
  metadata["licence"] = licence;
  return FittedWalker{WalkerModel(walk.gait, run.gait, stand, metadata),
                      static_cast<int>(takes->size()),
                      walk.frames,
                      run.frames,
                      stand_frames,
                      walk.residual,
                      run.residual};
}

}  // namespace panache
