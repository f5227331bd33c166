#include "bench/steps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include <sys/resource.h>

#include "pose/foot_lock.h"
#include "pose/history.h"
#include "style/pose_change.h"
#include "style/stylizer.h"
#include "walker/walker.h"

namespace panache::bench {
namespace {

constexpr int kParts = 10;
constexpr int64_t kStageShare = 5;  // Of the steps, one in so many is taken apart.
constexpr int kMostColdSteps = 500;
constexpr int64_t kUnseenSteps = 200;

std::vector<float> first_style(const Model& model) {
  std::vector<float> strengths(model.styles().size());
  strengths.front() = 1;
  return strengths;
}

// How often this thread was stopped for another since it began.
int64_t interruptions() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

// A Stylizer and the walk that it steps through.
class Character {
 public:
  Character(const std::shared_ptr<const Model>& model, const Clip& walk, const Rig& rig)
      : walk_(walk),
        out_rotations_(walk.joints()),
        out_translations_(walk.joints()),
        strengths_(first_style(*model)),
        stylizer_(*Stylizer::create(model, rig)) {}

  void step() noexcept {
    stylizer_.step(walk_.pose(frame_), strengths_, walk_.frame_time,
                   Pose{out_rotations_, out_translations_});
    frame_ = (frame_ + 1) % walk_.frames;
  }
  int64_t timed_step() noexcept {
    const int64_t begin = now_ns();
    step();
    return now_ns() - begin;
  }

 private:
  const Clip& walk_;
  std::vector<Quat> out_rotations_;
  std::vector<Vec3> out_translations_;
  std::vector<float> strengths_;
  Stylizer stylizer_;
  int frame_ = 0;
};

// The step as Stylizer makes it, put together of the same public functions, with a look at the
// clock between them. What Stylizer does beside them (easing, the way over the ground) is the
// difference to its own time.
class StepInParts {
 public:
  enum Part { read, window, networks, rotations, floor, feet, write, kCount };
  static constexpr const char* kNames[kCount] = {
      "read the pose (rig)",     "history and window",   "networks, heads and gate",
      "rotations of the change", "keep above the floor", "hold the feet",
      "write the pose (rig)"};

  StepInParts(const std::shared_ptr<const Model>& model, const Clip& walk, const Rig& rig)
      : walk_(walk),
        out_rotations_(walk.joints()),
        out_translations_(walk.joints()),
        window_(size_t(kWindowPoses) * pose_numbers(model->layout())),
        rig_(rig),
        history_(model->layout()),
        networks_(model) {
    networks_.set_strengths(first_style(*model));
  }

  void step() noexcept {
    const ConstPose pose = walk_.pose(frame_);
    const float seconds = static_cast<float>(walk_.frame_time);
    frame_ = (frame_ + 1) % walk_.frames;
    time_ += walk_.frame_time;

    begin_ = now_ns();
    rig_.read(pose, body_);
    done(read);
    const Vec3 hips = body_.positions[0];
    ground_ = {{hips.x, 0, hips.z}, unwrap_angle(body_.facing, ground_.facing)};
    to_body_frame(body_.positions, ground_, seen_);
    history_.push(time_, seen_, ground_);
    history_.window(window_);
    done(window);
    networks_.forward(window_, kGateShare);
    done(networks);
    const Model& model = networks_.model();
    const auto root = std::span(window_).subspan(root_offset(model.layout())).first<kRootNumbers>();
    const StyleDelta delta = model.recipe().to_change(networks_.pose(), seen_, root);
    for (int j = 0; j < kHumanJoints; ++j) change_.rotations[j] = joint_rotation(delta, j);
    change_.translation = {0, delta.hips_height, 0};
    done(rotations);
    HumanPositions joints;
    changed_joints(body_, change_, joints);
    change_.translation.y += floor_depth(body_, joints, change_);
    done(floor);
    feet_.step(body_, joints, networks_.contact().first<kFeet>(), 1, seconds, change_);
    done(feet);
    rig_.write(pose, body_, change_, Pose{out_rotations_, out_translations_});
    done(write);
  }
  // Without what the clock costs.
  double median(Part part) const {
    return std::max(0.0, times_[part].quantile(0.5) - clock_cost_ns());
  }

 private:
  static constexpr float kGateShare = 0.1f;  // Of a frame at 60 Hz.

  void done(Part part) noexcept {
    const int64_t now = now_ns();
    times_[part].add(now - begin_);
    begin_ = now_ns();
  }

  const Clip& walk_;
  std::vector<Quat> out_rotations_;
  std::vector<Vec3> out_translations_;
  std::vector<float> window_;
  Rig rig_;
  PoseHistory history_;
  StyleNetworks networks_;
  FootLock feet_;
  BodyPose body_;
  BodyChange change_;
  Ground ground_;
  HumanPositions seen_;
  int frame_ = 0;
  double time_ = 0;
  int64_t begin_ = 0;
  std::array<Histogram, kCount> times_;
};

}  // namespace

Result<Clip> make_walk(const std::string& walker_model) {
  auto walker = WalkerModel::load(walker_model);
  if (!walker) return walker.error();
  WalkClipOptions options;
  options.seconds = 60;
  options.fps = 60;
  options.turn = 0.35f;
  return walk_clip(*walker, options);
}

StepTimes time_steps(const std::shared_ptr<const Model>& model, const Clip& walk, int64_t steps,
                     const ProgressCall& progress) {
  const Result<Rig> rig = Rig::create(walk);
  assert(rig);
  Character character(model, walk, *rig), beside(model, walk, *rig), cold(model, walk, *rig);
  auto parts = std::make_unique<StepInParts>(model, walk, *rig);
  auto whole = std::make_unique<Histogram>();
  StepTimes times;
  for (int part = 0; part < kParts; ++part) {
    for (int64_t i = 0; i < kUnseenSteps; ++i) character.step();
    const int64_t now = steps * (part + 1) / kParts - steps * part / kParts;
    const int64_t before = interruptions();
    for (int64_t i = 0; i < now; ++i) times.steps.add(character.timed_step());
    times.interruptions += interruptions() - before;
    for (int64_t i = 0; i < std::max<int64_t>(1, now / kStageShare); ++i) {
      parts->step();
      whole->add(beside.timed_step());
    }
    if (progress) progress((part + 1.0) / kParts);
  }
  std::vector<double> single;
  for (int64_t i = 0; i < std::clamp<int64_t>(steps / 100, 1, kMostColdSteps); ++i) {
    evict_caches();
    single.push_back(static_cast<double>(cold.timed_step()));
  }
  for (int p = 0; p < StepInParts::kCount; ++p) {
    const auto part = static_cast<StepInParts::Part>(p);
    times.stages.push_back({StepInParts::kNames[p], parts->median(part)});
  }
  times.networks = parts->median(StepInParts::networks);
  times.whole = std::max(0.0, whole->quantile(0.5) - clock_cost_ns());
  times.cold = std::max(0.0, quantile(single, 0.5) - clock_cost_ns());
  return times;
}

}  // namespace panache::bench
