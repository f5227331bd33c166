#include "pose/step_rate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/vec.h"
#include "clip/motion_file.h"
#include "pose/contacts.h"
#include "rig/body_motions.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

// A body that stands on one foot falls away from it: by the linear inverted pendulum, the point
// c - a h / (g + a_up) lies in the foot, where c is the body's centre at height h above the floor
// and a its acceleration (Vukobratovic's zero-moment point). A clip that is played m times too fast
// has accelerations m^2 times too large, and the point flies far off; one that is played too slowly
// has next to none, so the body would hang in the air beside its foot. Both only show where legs
// step: a person who really moves slowly keeps the centre over the foot.
//
// Measured on 4,611 takes of all kinds (bandai, xia, formats, cmu, cmu-styles, cmu-more): at their
// own rate 13 are doubted, all of cmu-more and five of them by one performer.
// Of 89 walks (of bandai, many with four steps only), 98 % are noticed at 4 times their rate, 71 %
// at 2.5 times, 85 % at a quarter and 80 % at 0.4 of it.

constexpr int kMaxFrames = 3000;  // More add nothing.

// Lengths are in those of a leg, and rates in those of a pendulum as long, sqrt(g / leg).
constexpr double kTurn = 0.25;    // How far the feet must move back to count as a step.
constexpr double kStance = 0.06;  // Above the floor, of the lowest foot at most.
constexpr double kLifted = 0.07;  // Difference of both feet's ankle height plus toe height.
constexpr double kAnkle = 0.07;   // Its height where the foot is planted.
constexpr double kHeel = 0.085;   // Behind the ankle.
constexpr double kTip = 0.075;    // Ahead of the toe joint.

// Too fast: more steps than this, the point so far off the foot, and so many times further than at
// 0.4 of the rate. Salsa reaches a rate of 1.3 with steps below 0.45; no steps reach 1.5.
constexpr double kFastRate = 1.0, kFastStep = 0.5, kFastMiss = 0.3, kFastTimes = 2;
constexpr double kWildRate = 1.5, kWildStep = 0.3;
// More than a sprinter's, whatever the balance: a walk made by hand may glide along like a train.
constexpr double kImpossibleRate = 1.4;
// Too slow: fewer steps than this, and the point is not much further off at 2.5 times the rate.
constexpr double kSlowRate = 0.28, kSlowStep = 0.4, kSlowMiss = 0.036, kSlowTimes = 1.25;
constexpr size_t kFastSteps = 4, kSlowSteps = 5;
// So slow that two steps suffice, as in a short clip whose frames became seconds. Those that its
// ends cut off count if they have no more frames than a step at 120 frames a second.
constexpr double kStoppedRate = 0.08;
constexpr size_t kStoppedSteps = 2;
constexpr double kCutFrames = 90;
constexpr double kFaster = 2.5, kSlower = 0.4;

// Shares of a body's mass by joint, those of both sides alike (after Winter's tables).
constexpr float kMass[kHumanJoints] = {.14f, .14f,  .2f,   .03f,  .08f, 0,     .028f,
                                       .03f, .012f, 0,     .028f, .03f, .012f, .05f,
                                       .08f, .035f, .005f, .05f,  .08f, .035f, .005f};

struct Body {
  Vec3d centre;
  Vec3d ankle[kFeet], toe[kFeet];
};

struct Walk {
  std::vector<Body> bodies;  // In lengths of a leg.
  double leg = 0;            // Metres.
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Walk read(const Clip& clip, const Rig& rig) {
  Walk walk;
  PosedRig reader(rig);
  const double unit = static_cast<double>(rig.unit() / rig.scale());
  std::vector<double> legs;
  BodyPose pose;
  const int end = std::min(clip.frames, rig.first_frame() + kMaxFrames);
  for (int f = rig.first_frame(); f < end; ++f) {
    reader.read(clip.pose(f), pose);
    const auto at = [&](HumanJoint joint) {
      return pose.joints[static_cast<size_t>(index(joint))].as<double>();
    };
    Body body;
    double mass = 0;
    for (size_t j = 0; j < pose.joints.size(); ++j) {
      body.centre = body.centre + pose.joints[j].as<double>() * static_cast<double>(kMass[j]);
      mass += static_cast<double>(kMass[j]);
    }
    body.centre = body.centre / mass;
    for (int side = 0; side < kFeet; ++side) {
      const auto s = static_cast<size_t>(side);
      body.ankle[side] = at(kAnkles[s]);
      body.toe[side] = at(kToes[s]);
      legs.push_back(length(at(kUpperLegs[s]) - at(kLowerLegs[s])) +
                     length(at(kLowerLegs[s]) - at(kAnkles[s])));
    }
    walk.bodies.push_back(body);
  }
  if (legs.empty()) return walk;
  const double leg = median(std::move(legs));
  walk.leg = leg * unit;
  for (Body& body : walk.bodies) {
    body.centre = body.centre / leg;
    for (int side = 0; side < kFeet; ++side) {
      body.ankle[side] = body.ankle[side] / leg;
      body.toe[side] = body.toe[side] / leg;
    }
  }
  return walk;
}

// Frames between which the feet change places, fore and aft.
struct Steps {
  struct Step {
    size_t begin, end;
  };
  std::vector<Step> steps;
  double frames = 0, size = 0;  // The medians.
};

// How far the left foot is ahead of the right one, in the heading of the hips.
std::vector<double> separations(const Clip& clip, const Rig& rig, const Walk& walk) {
  std::vector<double> out;
  PosedRig reader(rig);
  BodyPose pose;
  for (size_t f = 0; f < walk.bodies.size(); ++f) {
    reader.read(clip.pose(rig.first_frame() + static_cast<int>(f)), pose);
    const Vec3 left = pose.joints[static_cast<size_t>(index(kUpperLegs[0]))] -
                      pose.joints[static_cast<size_t>(index(kUpperLegs[1]))];
    const Vec3d ahead =
        normalized(Vec3d{static_cast<double>(-left.z), 0, static_cast<double>(left.x)}, {0, 0, 1});
    out.push_back(dot(walk.bodies[f].ankle[0] - walk.bodies[f].ankle[1], ahead));
  }
  return out;
}

// Whether both feet stay below the body's centre, unlike in a cartwheel.
bool is_upright(const Walk& walk, size_t begin, size_t end) {
  return std::all_of(walk.bodies.begin() + static_cast<std::ptrdiff_t>(begin),
                     walk.bodies.begin() + static_cast<std::ptrdiff_t>(end), [](const Body& body) {
                       return std::max(body.ankle[0].y, body.ankle[1].y) < body.centre.y;
                     });
}

// `cut`: steps count too that the ends of the clip cut off.
Steps find_steps(const Walk& walk, const std::vector<double>& ahead, bool cut) {
  struct Extreme {
    size_t frame;
    double value;
  };
  std::vector<Extreme> extremes;
  Extreme low{0, ahead[0]}, high{0, ahead[0]};
  int going = 0;  // 1 up, -1 down.
  for (size_t f = 0; f < ahead.size(); ++f) {
    if (ahead[f] > high.value) high = {f, ahead[f]};
    if (ahead[f] < low.value) low = {f, ahead[f]};
    if (going >= 0 && high.value - ahead[f] > kTurn) {
      if (going > 0 || cut) extremes.push_back(high);
      going = -1;
      low = {f, ahead[f]};
    } else if (going <= 0 && ahead[f] - low.value > kTurn) {
      if (going < 0 || cut) extremes.push_back(low);
      going = 1;
      high = {f, ahead[f]};
    }
  }
  if (cut && going != 0) extremes.push_back(going > 0 ? high : low);
  Steps out;
  std::vector<double> frames, sizes;
  for (size_t i = 1; i < extremes.size(); ++i) {
    const Extreme &a = extremes[i - 1], &b = extremes[i];
    if (a.value * b.value >= 0 || !is_upright(walk, a.frame, b.frame)) continue;
    out.steps.push_back({a.frame, b.frame});
    frames.push_back(static_cast<double>(b.frame - a.frame));
    sizes.push_back((std::abs(a.value) + std::abs(b.value)) / 2);
  }
  if (out.steps.empty()) return out;
  out.frames = median(std::move(frames));
  out.size = median(std::move(sizes));
  return out;
}

// Gaussian, of `deviation` frames.
std::vector<Vec3d> smooth_centres(const Walk& walk, double deviation) {
  const auto reach = static_cast<std::ptrdiff_t>(3 * deviation) + 1;
  const auto count = static_cast<std::ptrdiff_t>(walk.bodies.size());
  std::vector<Vec3d> out;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    Vec3d sum;
    double weights = 0;
    for (std::ptrdiff_t d = -reach; d <= reach; ++d) {
      const double at = static_cast<double>(d) / std::max(deviation, 0.1);
      const double weight = std::exp(-at * at / 2);
      const auto from = static_cast<size_t>(std::clamp<std::ptrdiff_t>(f + d, 0, count - 1));
      sum = sum + walk.bodies[from].centre * weight;
      weights += weight;
    }
    out.push_back(sum / weights);
  }
  return out;
}

class Balance {
 public:
  Balance(const Walk& walk, const Steps& steps, double frame_time)
      : walk_(walk),
        steps_(steps),
        centres_(smooth_centres(walk, steps.frames / 10)),
        gravity_(kGravity / walk.leg * frame_time * frame_time) {
    std::vector<double> heights;
    for (const Body& body : walk.bodies) heights.push_back(std::min(body.toe[0].y, body.toe[1].y));
    const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
    std::nth_element(heights.begin(), low, heights.end());
    floor_ = *low;
  }

  // The mean distance of the point from the supporting foot, if the clip were played `times` as
  // fast; nothing if too few frames stand on one foot.
  std::optional<double> miss(double times) const {
    constexpr int kFewest = 3;
    double sum = 0;
    int count = 0;
    for (const Steps::Step& step : steps_.steps) {
      const size_t end = std::min(step.end, walk_.bodies.size() - 2);
      for (size_t f = std::max<size_t>(step.begin, 2); f < end; ++f) {
        const int foot = stance(walk_.bodies[f]);
        if (foot < 0) continue;
        sum += distance(f, foot, times);
        ++count;
      }
    }
    if (count < kFewest) return std::nullopt;
    return sum / count;
  }

 private:
  // The supporting foot: 0 left, 1 right; -1 for both or if unclear.
  int stance(const Body& body) const {
    const auto lowest = [&](int side) {
      return std::min(body.toe[side].y, body.ankle[side].y - kAnkle);
    };
    if (std::min(lowest(0), lowest(1)) > floor_ + kStance) return -1;
    const double left = body.toe[0].y + body.ankle[0].y, right = body.toe[1].y + body.ankle[1].y;
    if (std::abs(left - right) < kLifted) return -1;
    return left < right ? 0 : 1;
  }

  double distance(size_t f, int foot, double times) const {
    const Vec3d centre = centres_[f];
    const Vec3d acceleration =
        (centres_[f + 1] - centre - (centre - centres_[f - 1])) * (times * times);
    const double push = std::max(gravity_ + acceleration.y, gravity_ / 3);
    const Vec3d point = level(centre - acceleration * ((centre.y - floor_) / push));
    const Vec3d ankle = level(walk_.bodies[f].ankle[foot]), toe = level(walk_.bodies[f].toe[foot]);
    const Vec3d along = normalized(toe - ankle, {0, 0, 1});
    const double at = std::clamp(dot(point - ankle, along), -kHeel, length(toe - ankle) + kTip);
    return length(point - ankle - along * at);
  }
  static Vec3d level(Vec3d v) { return {v.x, 0, v.z}; }

  const Walk& walk_;
  const Steps& steps_;
  std::vector<Vec3d> centres_;
  double gravity_;  // Legs per frame squared.
  double floor_ = 0;
};

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

std::optional<std::string> doubtful_rate(const Clip& clip, const Rig& rig) {
  const Walk walk = read(clip, rig);
  if (walk.bodies.size() < 8 || !(walk.leg > 0)) return std::nullopt;
  const std::vector<double> ahead = separations(clip, rig, walk);
  Steps steps = find_steps(walk, ahead, false);
  if (steps.steps.size() < kStoppedSteps) {
    steps = find_steps(walk, ahead, true);
    if (steps.frames > kCutFrames) return std::nullopt;
  }
  if (steps.steps.size() < kStoppedSteps) return std::nullopt;
  const double a_second = 1 / (steps.frames * clip.frame_time);
  const double rate = a_second * std::sqrt(walk.leg / kGravity);
  const size_t count = steps.steps.size();
  const bool many = count >= kFastSteps && ((rate > kFastRate && steps.size > kFastStep) ||
                                            (rate > kWildRate && steps.size > kWildStep));
  const bool few =
      steps.size > kSlowStep && ((rate < kSlowRate && count >= kSlowSteps) || rate < kStoppedRate);
  if (!many && !few) return std::nullopt;
  const Balance balance(walk, steps, clip.frame_time);
  const auto now = balance.miss(1), other = balance.miss(many ? kSlower : kFaster);
  if (!now || !other) return std::nullopt;
  const bool impossible = rate > kImpossibleRate && steps.size > kFastStep;
  const bool doubtful = many ? impossible || (*now > kFastMiss && *now > kFastTimes * *other)
                             : *now > kSlowMiss && *other < kSlowTimes * *now;
  if (!doubtful) return std::nullopt;
  return "expected steps that legs of " + brief(walk.leg) + " m can take, found " +
         brief(a_second) + " a second, too " + (many ? "fast" : "slow") +
         " to keep balance; if it was not recorded at " + brief(1 / clip.frame_time) +
         " frames a second, " + kGiveRate;
}

std::vector<std::string> motion_notes(const MotionFile& file, const std::string& path) {
  std::vector<std::string> notes = file.notes();
  const std::vector<std::string> names = file.clip_names();
  const BodyMotions body = find_body_motions(file);
  if (const std::string note = note_passed_over(file, body); !note.empty()) {
    notes.push_back(path + ": " + note);
  }
  for (const int clip : body.clips) {
    const std::string& name = names[static_cast<size_t>(clip)];
    const Result<Rig> rig = Rig::create(file.clip(clip));
    if (!rig) continue;  // The caller gets this error with that skeleton.
    if (const auto doubt = doubtful_rate(file.clip(clip), *rig)) {
      notes.push_back(path + ": " + (name.empty() ? "" : name + ": ") + *doubt);
    }
  }
  return notes;
}

}  // namespace panache
