#include "train/fit_walker.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/quat.h"
#include "learn/fit_style.h"
#include "learn/take.h"
#include "rig/canonical_body.h"
#include "takes/load_takes.h"
#include "train/gait_take.h"

namespace panache {
namespace {

enum class Use { none, walk, run };

Use use_of(const ManifestRow& row) {
  if (!row.neutral || row.test) return Use::none;
  const std::string& content = row.content;
  if (content == "walk" || content == "walk-turn-left" || content == "walk-turn-right") {
    return Use::walk;
  }
  if (content == "run" || content == "dash") return Use::run;
  return Use::none;
}

// Which frames show a steady gait, and the priors of its coefficients.
struct GaitRules {
  float reference, slowest, fastest;  // m/s
  // Penalties of the terms 1, u, u^2, turn, turn^2, acceleration: the squared change per term
  // weighs as much as the squared error of that many frames.
  std::array<double, kTerms> penalties;
  float min_stance;  // Of a foot at the reference speed, radians of the cycle.
};
// The speeds of the walks are too similar to fit curvature; the runs do not turn at all.
constexpr GaitRules kWalkRules = {1.1f, 0.6f, 1.5f, {1e-3, 1, 1e5, 30, 30, 100}, 3.8f};
constexpr GaitRules kRunRules = {2.8f, 1.9f, 4.5f, {1e-3, 3, 30, 300, 300, 100}, 0};

constexpr int kMargin = 3;              // Frames at both ends, where speed is least certain.
constexpr double kMaxSideways = 0.3;    // m/s
constexpr float kMaxGaitTurn = 1.75f;   // rad/s
constexpr float kMaxGaitChange = 1.5f;  // m/s^2

struct GaitTake {
  const Take* take;
  std::vector<GaitFrame> frames;
};

// Whether a frame shows the speed of a gait: in a turn, the hips take a shorter path than the feet.
bool is_straight(const GaitFrame& frame) { return std::abs(frame.going.turn) < 0.25f; }

bool is_usable(const GaitTake& take, int f, const GaitRules& rules) {
  if (f < kMargin || f + kMargin >= static_cast<int>(take.frames.size())) return false;
  const GaitFrame& frame = take.frames[f];
  return frame.going.speed > rules.slowest && frame.going.speed < rules.fastest &&
         std::abs(frame.sideways) < kMaxSideways && std::abs(frame.going.turn) < kMaxGaitTurn &&
         std::abs(frame.going.acceleration) < kMaxGaitChange && frame.cadence > 0.3;
}

// Index of a driven joint's rotation in the channels.
std::span<float, 3> rotation_of(Channels& channels, HumanJoint joint) {
  const auto at = std::ranges::find(kDriven, joint) - kDriven.begin();
  return std::span<float, 3>(&channels[static_cast<size_t>(3 + 3 * at)], 3);
}
Quat get(std::span<const float, 3> rotation) {
  return exp_rotation(Vec3{rotation[0], rotation[1], rotation[2]});
}
void set(std::span<float, 3> rotation, Quat q) {
  const Vec3 r = log_rotation(q);
  std::ranges::copy(std::array{r.x, r.y, r.z}, rotation.begin());
}
Quat bend(float angle) { return axis_angle(Vec3{1, 0, 0}, angle); }

// The positions of a skeleton's ankles and toes decide how steep its feet are when standing. The
// walker stands on the canonical body's feet: all feet of these takes are rotated by the mean error
// of the planted ones, and the hips are raised accordingly.
void level_feet(std::vector<GaitTake>& takes) {
  double slope = 0, count = 0;
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      for (int foot = 0; foot < kFeet; ++foot) {
        if (!take.take->contacts[f][foot]) continue;
        const HumanPositions& body = take.take->body[f];
        const Vec3 toes = body[index(kToes[foot])] - body[index(kAnkles[foot])];
        slope += std::asin(static_cast<double>(-toes.y / length(toes)));
        ++count;
      }
    }
  }
  if (count == 0) return;
  const float pitch = kProportions.toe_pitch, own = static_cast<float>(slope / count);
  const float higher =
      (std::sin(pitch) - std::sin(own)) * kProportions.length[index(HumanJoint::left_toes)];
  for (GaitTake& take : takes) {
    for (GaitFrame& frame : take.frames) {
      for (const HumanJoint foot : {HumanJoint::left_foot, HumanJoint::right_foot}) {
        const std::span<float, 3> rotation = rotation_of(frame.channels, foot);
        set(rotation, get(rotation) * bend(pitch - own));
      }
      frame.channels[1] += higher;
    }
  }
}

// A skeleton's spine does not show the person's posture either: makes the mean torso of these walks
// straight and upright; runs keep their lean relative to that.
void straighten(std::vector<GaitTake>& walks, std::vector<GaitTake>& runs) {
  constexpr std::array kTorso = {HumanJoint::hips, HumanJoint::spine, HumanJoint::chest,
                                 HumanJoint::neck};
  std::array<float, kTorso.size()> mean{};
  float frames = 0;
  for (GaitTake& take : walks) {
    for (GaitFrame& frame : take.frames) {
      for (size_t i = 0; i < kTorso.size(); ++i) {
        mean[i] += rotation_of(frame.channels, kTorso[i])[0];
      }
      ++frames;
    }
  }
  for (std::vector<GaitTake>* takes : {&walks, &runs}) {
    for (GaitTake& take : *takes) {
      for (GaitFrame& frame : take.frames) {
        for (size_t i = 0; i < kTorso.size(); ++i) {
          const std::span<float, 3> rotation = rotation_of(frame.channels, kTorso[i]);
          set(rotation, get(rotation) * bend(-mean[i] / frames));
        }
        for (const HumanJoint leg : {HumanJoint::left_upper_leg, HumanJoint::right_upper_leg}) {
          const std::span<float, 3> rotation = rotation_of(frame.channels, leg);
          set(rotation, bend(mean[0] / frames) * get(rotation));
        }
      }
    }
  }
}

constexpr int kUnknowns = kWaves * kTerms;

void add_frame(Ridge& fit, const Gait& gait, double phase, const Going& going,
               const Channels& channels) {
  std::array<float, kTerms> terms;
  std::array<float, kWaves> waves;
  gait_terms(gait, going, terms);
  gait_waves(static_cast<float>(std::remainder(phase, kGaitCycle)), waves);
  std::array<double, kUnknowns> row;
  for (int k = 0; k < kUnknowns; ++k) {
    row[k] = static_cast<double>(waves[k / kTerms]) * static_cast<double>(terms[k % kTerms]);
  }
  std::array<double, kChannels> outputs;
  std::copy(channels.begin(), channels.end(), outputs.begin());
  fit.add(row, outputs);
}

// `prior`: a gait whose turn and acceleration coefficients are used where the data show nothing;
// the other coefficients start at zero.
void fit_coefficients(const std::vector<GaitTake>& takes, const GaitRules& rules, const Gait* prior,
                      Gait& gait) {
  Ridge fit(kUnknowns, kChannels);
  for (const GaitTake& take : takes) {
    for (int f = 0; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules)) continue;
      const GaitFrame& frame = take.frames[f];
      add_frame(fit, gait, frame.phase, frame.going, frame.channels);
      const Going other = {frame.going.speed, -frame.going.turn, frame.going.acceleration};
      add_frame(fit, gait, frame.phase + kGaitCycle / 2, other, mirrored(frame.channels));
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

// log cadence = log a + exponent * log speed. The observations are strides, not frames; one frame
// in each is enough.
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
  // Across people and machines, cadence grows with about the root of walking speed; the penalty
  // weighs as much as a few strides.
  const std::vector<double> weights = fit.solve(std::array{1e-9, 1e-2});
  gait.exponent = static_cast<float>(weights[1]);
  gait.cadence = static_cast<float>(
      std::exp(weights[0] - weights[1] * std::log(static_cast<double>(rules.reference))));
}

// People look ahead when they turn, so the body moves sideways in its own view. speed sideways =
// -lead * speed * turn, fitted to turns; `otherwise` if no take turns.
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

// Whether a foot carries weight: its toe or, after a heel strike, its ankle is low, and slow
// compared with the body. The contacts of the take are stricter, and nearly miss the feet of a fast
// runner. `ankle`: its height at mid-stance.
bool is_down(const Take& take, int f, int foot, float speed, float ankle) {
  constexpr float kMaxHeight = 0.05f, kMaxLift = 0.02f;  // Metres, of the toe and the ankle.
  const float slow = std::max(0.45f, 0.25f * speed);
  const auto rests = [&](HumanJoint joint, float height) {
    const Vec3 before = world_positions(take, f - 1)[index(joint)];
    const Vec3 after = world_positions(take, f + 1)[index(joint)];
    return take.body[f][index(joint)].y < height &&
           length(after - before) * static_cast<float>(kTakeRate) / 2 < slow;
  };
  return rests(kToes[foot], kMaxHeight) || rests(kAnkles[foot], ankle + kMaxLift);
}

// The ankle's mean height in the planted frames of a take; 0 if there are none.
float standing_ankle(const Take& take, int foot) {
  float sum = 0, count = 0;
  for (int f = 0; f < take.frames(); ++f) {
    if (!take.contacts[f][foot]) continue;
    sum += take.body[f][index(kAnkles[foot])].y;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// The phases of touch-down and lift-off, linear in the speed.
void fit_contacts(const std::vector<GaitTake>& takes, const GaitRules& rules, Gait& gait) {
  Ridge lands(2, 1), lifts(2, 1);
  const auto add = [&](Ridge& fit, const GaitTake& take, int f, int foot, double around) {
    // The change happened half a frame ago.
    const double phase =
        (take.frames[f].phase + take.frames[f - 1].phase) / 2 - foot * kGaitCycle / 2;
    const double speed = static_cast<double>(take.frames[f].going.speed - rules.reference);
    fit.add(std::array{1.0, speed},
            std::array{around + std::remainder(phase - around, kGaitCycle)});
  };
  for (const GaitTake& take : takes) {
    const std::array<float, kFeet> ankles = {standing_ankle(*take.take, 0),
                                             standing_ankle(*take.take, 1)};
    for (int f = 1; f < take.take->frames(); ++f) {
      if (!is_usable(take, f, rules) || !is_straight(take.frames[f])) continue;
      for (int foot = 0; foot < kFeet; ++foot) {
        const float body = take.frames[f].going.speed;
        const bool now = is_down(*take.take, f, foot, body, ankles[foot]);
        const bool before = is_down(*take.take, f - 1, foot, body, ankles[foot]);
        if (now && !before) add(lands, take, f, foot, 0.0);
        if (before && !now) add(lifts, take, f, foot, kGaitCycle / 2);
      }
    }
  }
  const std::array<double, 2> penalties = {1e-6, 0.1};
  const std::vector<double> on = lands.solve(penalties), off = lifts.solve(penalties);
  gait.lands = {static_cast<float>(on[0]), static_cast<float>(on[1])};
  gait.lifts = {static_cast<float>(off[0]), static_cast<float>(off[1])};
  // A toe joint leaves the ground before the tip of the toes does. In walking, the stance takes
  // about 60 % of the cycle, less at higher speed.
  if (rules.min_stance > 0 && gait.lifts[0] - gait.lands[0] < rules.min_stance) {
    gait.lifts = {gait.lands[0] + rules.min_stance, gait.lands[1] - 0.44f};
  }
}

struct FittedGait {
  Gait gait;
  int frames = 0;
  double residual = 0;
};

FittedGait fit_gait(const std::vector<GaitTake>& takes, const GaitRules& rules, const Gait* prior) {
  FittedGait out;
  out.gait.reference = rules.reference;
  // The 0.1 % and 99.9 % quantiles of the speed.
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
      evaluate(out.gait, static_cast<float>(std::remainder(frame.phase, kGaitCycle)), frame.going,
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

// Standing: knee flexion, and how far the legs lean forward over the feet. Radians.
constexpr float kKnee = 0.33f, kAhead = 0.08f;

// The standing pose: the upper body as at medium walking speed, on legs that carry it, with feet
// flat and below the hip joints.
Channels make_stand(const Gait& walk) {
  constexpr int kPhases = 64;
  Channels stand{};
  for (int i = 0; i < kPhases; ++i) {
    Channels now;
    evaluate(walk, static_cast<float>(kGaitCycle * i / kPhases), {walk.reference, 0, 0}, now);
    const Channels other = mirrored(now);
    for (int c = 0; c < kChannels; ++c) stand[c] += (now[c] + other[c]) / (2 * kPhases);
  }
  const Quat hips = get(rotation_of(stand, HumanJoint::hips));
  const Quat upper = bend(kAhead - kKnee / 2), lower = bend(kAhead + kKnee / 2);
  for (const HumanJoint leg : {HumanJoint::left_upper_leg, HumanJoint::right_upper_leg}) {
    set(rotation_of(stand, leg), conjugate(hips) * upper);
  }
  for (const HumanJoint leg : {HumanJoint::left_lower_leg, HumanJoint::right_lower_leg}) {
    set(rotation_of(stand, leg), bend(kKnee));
  }
  for (const HumanJoint foot : {HumanJoint::left_foot, HumanJoint::right_foot}) {
    set(rotation_of(stand, foot), conjugate(lower));
  }
  const std::vector<Joint> joints = canonical_skeleton().joints;
  const auto offset = [&](HumanJoint joint) { return joints[index(joint)].offset; };
  const Vec3 ankle = rotate(hips, offset(HumanJoint::left_upper_leg)) +
                     rotate(upper, offset(HumanJoint::left_lower_leg)) +
                     rotate(lower, offset(HumanJoint::left_foot));
  const Vec3 toes = ankle + offset(HumanJoint::left_toes);
  stand[0] = 0;
  stand[1] = -toes.y;
  stand[2] = -(ankle.z + toes.z) / 2;  // Above the middle of the feet.
  return stand;
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
  for (const Take& take : *takes) {
    std::vector<GaitFrame> frames = gait_frames(take);
    if (frames.empty()) continue;
    (use_of(take.row) == Use::walk ? walks : runs).push_back({&take, std::move(frames)});
  }
  level_feet(walks);
  level_feet(runs);
  straighten(walks, runs);
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
  std::map<std::string, std::string> metadata;
  metadata["data"] = data;
  metadata["licence"] = licence;
  return FittedWalker{WalkerModel(walk.gait, run.gait, make_stand(walk.gait), metadata),
                      static_cast<int>(takes->size()),
                      walk.frames,
                      run.frames,
                      walk.residual,
                      run.residual};
}

}  // namespace panache
