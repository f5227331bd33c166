#include "style/live_stylizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "rig/canonical_skeleton.h"
#include "style/sound_pose.h"

namespace panache {
namespace {

// As in the stylizer: a step over a longer gap, or a leap over the ground this fast, is a cut.
constexpr double kMaxGap = 0.5;        // Seconds.
constexpr float kMaxGroundSpeed = 15;  // m/s

// A cycle is at least this long: a shuffle of two steps takes longer.
constexpr double kShortestCycle = 0.4, kLongestCycle = 2.0;  // Seconds.
// Two moments are the same of a cycle if the joints are that close, in the mean and each. Metres.
// Cycles of one person's walk differ by two to three centimetres in the mean.
constexpr float kAlike = 0.04f, kAlikeEach = 0.15f;
constexpr double kBefore = 0.1;           // Seconds; the moments before must be alike, too.
constexpr double kCandidates = 1.0 / 60;  // Seconds between moments that are compared.
constexpr double kSearchEvery = 0.06;     // Seconds.
constexpr double kBlend = 0.2;            // Seconds from the old head to the new one.
// Time constant of what is foreseen beyond the newest pose: guesses tremble more than motion does.
constexpr float kLeadSeconds = 0.04f;
constexpr float kTurnFades = 1.5f;  // Seconds, as a style's own turns do.

float smooth(double t) { return static_cast<float>(t * t * (3 - 2 * t)); }

// Mean and largest distance of the joints of two bodies, each in its body frame.
struct Unlike {
  float mean = 0, largest = 0;
};
Unlike compare(const HumanPositions& a, const HumanPositions& b) {
  Unlike out;
  for (size_t j = 0; j < a.size(); ++j) {
    const float apart = length(a[j] - b[j]);
    out.mean += apart / static_cast<float>(a.size());
    out.largest = std::max(out.largest, apart);
  }
  return out;
}

Vec3 mid_hip_of(const HumanPositions& body, const Ground& ground) {
  const Vec3 middle =
      (body[index(HumanJoint::left_upper_leg)] + body[index(HumanJoint::right_upper_leg)]) * 0.5f;
  return ground.position + rotate(rotation_y(ground.facing), middle);
}

// What turns the body of `before` into a foreseen one.
BodyChange change_between(const HumanPositions& before, const Ground& ground,
                          const ForeseenBody& after) {
  std::array<Quat, kHumanJoints> from, to;
  canonical_frames(before, 0, from);
  canonical_frames(after.body, 0, to);
  BodyChange change;
  for (size_t j = 0; j < kHumanJoints; ++j) change.rotations[j] = to[j] * conjugate(from[j]);
  change.turn = after.ground.facing - ground.facing;
  change.translation = mid_hip_of(after.body, after.ground) - mid_hip_of(before, ground);
  return change;
}

}  // namespace

LiveStylizer::Timed::Timed(const Rig& rig, std::shared_ptr<const Model> model,
                           const LiveOptions& options)
    : reader(rig),
      // A candidate for a cycle needs what was before it.
      ring(rig.joint_count(), options.max_lag + kBefore + kBlend),
      rotations(rig.joint_count()),
      shown_rotations(rig.joint_count()),
      old_rotations(rig.joint_count()),
      translations(rig.joint_count()),
      shown_translations(rig.joint_count()),
      old_translations(rig.joint_count()) {
  if (options.max_lead > 0) foresight.emplace(std::move(model));
}

Result<void> LiveStylizer::check(const Model& model, const LiveOptions& options) {
  const struct {
    const char* name;
    double value, most;
    const char* expected;
  } ranges[] = {
      {"max_lag", options.max_lag, LiveOptions::kMostLag, "0 to 4"},
      {"max_lead", options.max_lead, Predictor::kMostSeconds, "0 to 0.25"},
  };
  for (const auto& [name, value, most, expected] : ranges) {
    if (!(value >= 0 && value <= most)) {
      return Error{std::string(name) + " of " + std::to_string(value) + " seconds; expected " +
                   expected + " seconds"};
    }
  }
  if (options.max_lead > 0 && !model.predictor()) {
    return Error{
        "max_lead needs a model that foresees input, which this one does not; train it again or "
        "set max_lead to 0"};
  }
  return {};
}

Result<LiveStylizer> LiveStylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                          const LiveOptions& options) {
  if (Result<void> good = check(*model, options); !good) return good.error();
  Result<Stylizer> stylizer = Stylizer::create(model, std::move(rig), options.stylizer);
  if (!stylizer) return stylizer.error();
  return LiveStylizer(*std::move(stylizer), std::move(model), options);
}

LiveStylizer::LiveStylizer(Stylizer stylizer, std::shared_ptr<const Model> model,
                           const LiveOptions& options)
    : options_(options), stylizer_(std::move(stylizer)), head_(options.max_lag, options.max_lead) {
  if (options.max_lag > 0 || options.max_lead > 0) {
    timed_ = std::make_unique<Timed>(stylizer_.rig(), std::move(model), options);
  }
}

void LiveStylizer::reset() noexcept {
  stylizer_.reset();
  head_.reset();
  skipped_ = 0;
  if (!timed_) return;
  timed_->ring.clear();
  if (timed_->foresight) timed_->foresight->reset();
  timed_->started = false;
  timed_->ahead = {};
  timed_->time = timed_->searched = 0;
  timed_->glue = timed_->old_glue = {};
  timed_->blended = 1;
}

void LiveStylizer::take_input(ConstPose in, double seconds) noexcept {
  Timed& t = *timed_;
  take_sound(in, {t.rotations, t.translations});
  t.reader.read({t.rotations, t.translations}, t.now);
  const Ground last = t.ground;
  const Vec3 hips = t.now.positions[0];
  t.ground = {{hips.x, 0, hips.z}, unwrap_angle(t.now.facing, t.started ? last.facing : 0)};
  const float way = length(t.ground.position - last.position);
  if (t.started && way > kMaxGroundSpeed * static_cast<float>(std::max(seconds, 1e-3))) {
    reset();
  }
  t.time += seconds;
  to_body_frame(t.now.positions, t.ground, t.body);
  t.ring.push(t.time, {t.rotations, t.translations}, t.body, t.ground);
  if (t.foresight) t.foresight->push(t.time, t.body, t.ground);
  t.started = true;
}

Ground LiveStylizer::ground_at(double ahead) const noexcept {
  const Timed& t = *timed_;
  if (ahead <= 0) return t.ring.ground(t.time + ahead);
  return {t.ground.position + t.ahead.ground.position, t.ground.facing + t.ahead.ground.facing};
}

void LiveStylizer::look_ahead(double seconds) noexcept {
  Timed& t = *timed_;
  if (!t.foresight) return;
  const ForeseenBody wanted = t.foresight->foresee(std::max(head_.ahead(), 0.0));
  const float gain = 1 - exponential(-static_cast<float>(seconds) / kLeadSeconds);
  for (size_t j = 0; j < t.body.size(); ++j) {
    t.ahead.body[j] += (wanted.body[j] - t.body[j] - t.ahead.body[j]) * gain;
  }
  const Ground way{wanted.ground.position - t.ground.position,
                   wanted.ground.facing - t.ground.facing};
  t.ahead.ground.position += (way.position - t.ahead.ground.position) * gain;
  t.ahead.ground.facing += (way.facing - t.ahead.ground.facing) * gain;
}

// The pose at a play head, on its glue.
void LiveStylizer::pose_at(double ahead, const Glue& glue, Pose out) noexcept {
  Timed& t = *timed_;
  if (ahead > 0) {
    ForeseenBody foreseen{t.body, ground_at(ahead)};
    for (size_t j = 0; j < t.body.size(); ++j) foreseen.body[j] += t.ahead.body[j];
    const BodyChange change = change_between(t.body, t.ground, foreseen);
    t.reader.write({t.rotations, t.translations}, t.now, change, out);
  } else {
    t.ring.pose(t.time + ahead, out);
  }
  if (glue.moved == Vec3{} && glue.turned == 0) return;
  // The whole body, by its root joints: turned where it stands, and moved.
  t.reader.place(glue.turned, ground_at(ahead).position, glue.moved, out);
}

std::optional<double> LiveStylizer::find_cycle(double at, double nearest,
                                               double farthest) const noexcept {
  const InputRing& ring = timed_->ring;
  const HumanPositions here = ring.body(at), before = ring.body(at - kBefore);
  std::optional<double> best;
  float least = kAlike;
  for (double away = nearest; away <= farthest; away += kCandidates) {
    const double to = at + away;
    const Unlike now = compare(here, ring.body(to)),
                 then = compare(before, ring.body(to - kBefore));
    const float mean = (now.mean + then.mean) / 2;
    if (mean >= least || std::max(now.largest, then.largest) > kAlikeEach) continue;
    least = mean;
    best = away;
  }
  return best;
}

// Leaves out a cycle, or plays one again, where that is due and the motion has one.
void LiveStylizer::skip_cycle(double rate) noexcept {
  Timed& t = *timed_;
  if (!options_.skip_cycles || t.blended < 1 || t.time - t.searched < kSearchEvery) return;
  t.searched = t.time;
  const double at = t.time + std::min(head_.ahead(), 0.0);
  std::optional<double> away;
  if (rate < 1) {
    // Late by a cycle: a moment that came later and looks the same.
    away = find_cycle(at, kShortestCycle, std::min(kLongestCycle, t.time - at));
  } else if (head_.room_ahead() < 1) {
    // At the bound: one that came earlier.
    const double oldest = std::max(t.ring.oldest() + kBefore, t.time - options_.max_lag);
    away = find_cycle(at, std::max(-kLongestCycle, oldest - at), -kShortestCycle);
  }
  if (!away) return;
  t.old_ahead = head_.ahead();
  t.old_glue = t.glue;
  const Ground old = ground_at(t.old_ahead), next = ground_at(t.old_ahead + *away);
  t.glue.moved += old.position - next.position;
  t.glue.turned += old.facing - next.facing;
  t.blended = 0;
  head_.leap(*away);
  skipped_ += *away > 0 ? 1 : -1;
}

void LiveStylizer::step(ConstPose in, std::span<const float> strengths, double seconds,
                        Pose out) noexcept {
  if (!timed_) return stylizer_.step(in, strengths, seconds, out);
  Timed& t = *timed_;
  if (!(seconds >= 0)) seconds = 0;
  if (seconds > kMaxGap) reset();
  take_input(in, seconds);

  const double rate = stylizer_.rate();
  const double played = head_.advance(seconds, rate, stylizer_.amount() > 0);
  t.glue.turned *= exponential(-static_cast<float>(seconds) / kTurnFades);
  look_ahead(seconds);
  skip_cycle(rate);

  const Pose shown{t.shown_rotations, t.shown_translations};
  pose_at(head_.ahead(), t.glue, shown);
  if (t.blended < 1) {
    // The head as it was goes on beside the new one until that has taken over.
    t.blended = std::min(1.0, t.blended + seconds / kBlend);
    t.old_ahead = std::clamp(t.old_ahead + played - seconds, -options_.max_lag, options_.max_lead);
    const Pose old{t.old_rotations, t.old_translations};
    pose_at(t.old_ahead, t.old_glue, old);
    const float share = smooth(t.blended);
    for (size_t j = 0; j < shown.rotations.size(); ++j) {
      shown.rotations[j] = nlerp(old.rotations[j], shown.rotations[j], share);
      shown.translations[j] = lerp(old.translations[j], shown.translations[j], share);
    }
  }
  stylizer_.step(shown, strengths, played, seconds, out);
}

}  // namespace panache
