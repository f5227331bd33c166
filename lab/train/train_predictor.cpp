#include "train/train_predictor.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "style/model/predictor_network.h"
#include "train/network.h"

namespace panache {
namespace {

constexpr int kFeatures = PredictorNetwork::kFeatures;
constexpr int kRoot = root_offset(PoseLayout::positions);  // Index of the root features.
constexpr int kAhead = 5;                                  // Length of the roll-out, poses.
constexpr int kPoses = kWindowPoses + kAhead;
constexpr int kInputs = kWindowPoses * kFeatures;
constexpr int kHidden = 48;
constexpr int kBatch = 128;
constexpr float kInputClip = 3;
// Errors are relative to those of holding the pose or of constant velocity, whichever is smaller,
// so that slow actions weigh as much as fast ones; this is the smallest divisor.
constexpr float kMinError = 0.003f;  // Metres.

// Disturbance of the windows: as for the style networks, but with less jitter, which would hide the
// velocities.
constexpr float kScale = 0.08f, kTempoDeviation = 0.2f, kPosture = 0.02f;
constexpr float kMaxJitter = 0.001f;  // Metres; each window has a random share of it.

struct Moment {
  int take;
  int frame;
};

// The body and its root pose at a fractional frame.
struct Instant {
  HumanPositions body;
  RootPose root;
};
Instant instant_at(const Take& take, float frame) {
  frame = std::clamp(frame, 0.0f, static_cast<float>(take.frames() - 1));
  const int a = static_cast<int>(frame), b = std::min(a + 1, take.frames() - 1);
  const float t = frame - static_cast<float>(a);
  return {body_at(take, frame), interpolate(take.root[a], take.root[b], t)};
}

// The joints above the hips, or those of the arms alone, may come from another motion: a network
// that has seen few actions must not infer the arms from the legs.
struct Borrowed {
  int first, last;  // Joints.
  int base;         // The parent that they are relative to.
};
constexpr Borrowed kUpperBodyJoints = {1, 12, 0}, kArmJoints = {5, 12, 2};
constexpr float kBorrows = 0.2f;    // Share of windows, for each of the two.
constexpr float kReversed = 0.15f;  // Share that is played backwards.

struct Draw {
  bool mirrored = false, reversed = false;
  const Borrowed* borrowed = nullptr;
  Moment lender{};
  float scale = 1, tempo = 1, jitter = 0;
  std::array<float, 3 * kHumanJoints> posture{};
};

// Writes kPoses poses, oldest first; `moment` is the window's last. out[kPoses][kFeatures]
void write_poses(const std::vector<Take>& takes, const Moment& moment, const Draw& draw,
                 Random& random, float* out) {
  float spacing = static_cast<float>(kWindowSpacing * kTakeRate) * draw.tempo;
  if (draw.reversed) spacing = -spacing;
  const auto instant = [&](const Moment& from, int pose) {
    const auto age = static_cast<float>(pose - kWindowPoses + 1);
    return instant_at(takes[from.take], static_cast<float>(from.frame) + age * spacing);
  };
  const auto at = [&](int pose) {
    Instant now = instant(moment, pose);
    if (!draw.borrowed) return now;
    const auto [first, last, base] = *draw.borrowed;
    const HumanPositions other = instant(draw.lender, pose).body;
    const Vec3 carried = now.body[base] - other[base];
    for (int j = first; j <= last; ++j) now.body[j] = other[j] + carried;
    return now;
  };
  Instant before = at(-1);
  for (int p = 0; p < kPoses; ++p, out += kFeatures) {
    const Instant now = at(p);
    const HumanPositions body = draw.mirrored ? mirrored(now.body) : now.body;
    for (int j = 0; j < kHumanJoints; ++j) {
      const float position[] = {body[j].x, body[j].y, body[j].z};
      for (int axis = 0; axis < 3; ++axis) {
        float& number = out[3 * j + axis];
        number = position[axis] * draw.scale + draw.posture[3 * j + axis];
        // Jitter is added to the inputs only, not to the targets.
        if (p < kWindowPoses) number += draw.jitter * random.normal();
      }
    }
    float* root = out + 3 * kHumanJoints;
    write_root_features(before.root, now.root, kWindowSpacing,
                        std::span<float, kRootFeatures>(root, kRootFeatures));
    if (draw.mirrored) root[0] = -root[0], root[2] = -root[2];
    root[0] *= draw.scale, root[1] *= draw.scale;
    before = now;
  }
}

class PredictorTraining {
 public:
  PredictorTraining(const std::vector<Take>& takes, int64_t steps, uint64_t seed)
      : takes_(takes), seed_(seed), network_(shape(), optimizer(), steps, seed * 31 + 7) {
    // Enough for the oldest velocity and the newest prediction.
    constexpr int kMargin = static_cast<int>(kWindowPoses * kWindowSpacing * kTakeRate) + 1;
    for (size_t t = 0; t < takes.size(); ++t) {
      const bool validates = t % 20 == 7;
      for (int f = kMargin; f + kMargin < takes[t].frames(); ++f) {
        (validates ? held_ : moments_).push_back({static_cast<int>(t), f});
      }
    }
  }

  bool has_motion() const { return !moments_.empty(); }

  void run(int64_t steps, const std::function<void(double)>& progress,
           std::vector<LossPoint>& losses) {
    Random random(seed_ * 77 + 5);
    const torch::Tensor first = draw_batch(moments_, 4096, false, random);
    measure(first);
    fit_linear(first);
    Random validation_random(9);
    torch::Tensor validation;
    if (!held_.empty()) validation = draw_batch(held_, 1024, false, validation_random);
    const int64_t report = std::max<int64_t>(1, steps / 50);
    double sum = 0;
    for (int64_t step = 0; step < steps; ++step) {
      const torch::Tensor loss = loss_of(draw_batch(moments_, kBatch, true, random), &random);
      sum += loss.item<double>();
      network_.learn(loss);
      if ((step + 1) % report != 0) continue;
      torch::NoGradGuard no_gradients;
      LossPoint point{"predict", step + 1, static_cast<float>(sum / static_cast<double>(report))};
      if (!held_.empty()) point.validation = loss_of(validation, nullptr).item<float>();
      losses.push_back(point);
      sum = 0;
      if (progress) progress(static_cast<double>(step + 1) / static_cast<double>(steps));
    }
  }

  void write(TensorFile& file) const {
    TensorFile own;
    network_.write(own);
    // The network's outputs are in its own units, the file's in metres and seconds.
    const float* unit = unit_.data_ptr<float>();
    for (const char* key : {"predict.head.0.weight", "predict.head.0.bias"}) {
      std::vector<float>& values = own.tensors.at(key).values;
      for (size_t i = 0; i < values.size(); ++i) values[i] /= unit[i % kFeatures];
    }
    // As fp16: the error is a thousandth of the prediction anyway.
    for (auto& [key, tensor] : own.tensors) {
      tensor.half = key.ends_with(".weight");
      file.tensors[key] = std::move(tensor);
    }
    file.tensors["predict.mean"] = to_tensor(mean_.reshape({kFeatures}));
    file.tensors["predict.scale"] = to_tensor(scale_.reshape({kFeatures}));
    file.tensors["predict.linear"] = to_tensor(linear_.reshape({(kWindowPoses - 1) * kFeatures}));
  }

 private:
  static NetworkShape shape() {
    return {"predict", kInputs, kHidden, 1, kFeatures, 1, false, false};
  }
  static OptimizerSettings optimizer() {
    OptimizerSettings settings;
    settings.learning_rate = 0.004f;
    settings.one_cycle = true;
    settings.weight_decay = 0.05f;
    settings.dropout = 0.05f;
    return settings;
  }

  // [rows][kPoses][kFeatures], oldest first.
  torch::Tensor draw_batch(const std::vector<Moment>& moments, int rows, bool disturbed,
                           Random& random) const {
    torch::Tensor out = torch::empty({rows, kPoses, kFeatures});
    float* row = out.data_ptr<float>();
    for (int r = 0; r < rows; ++r, row += kPoses * kFeatures) {
      const Moment& moment = moments[random.below(static_cast<uint32_t>(moments.size()))];
      Draw draw;
      draw.mirrored = random.uniform() < 0.5f;
      if (disturbed) {
        draw.scale = 1 + kScale * random.normal();
        draw.tempo = std::exp(kTempoDeviation * random.normal());
        draw.jitter = kMaxJitter * random.uniform() * random.uniform();
        draw.reversed = random.uniform() < kReversed;
        const float borrows = random.uniform();
        if (borrows < 2 * kBorrows)
          draw.borrowed = borrows < kBorrows ? &kUpperBodyJoints : &kArmJoints;
        draw.lender = moments[random.below(static_cast<uint32_t>(moments.size()))];
        for (float& offset : draw.posture) offset = kPosture * random.normal();
      }
      write_poses(takes_, moment, draw, random, row);
    }
    return out;
  }

  void measure(const torch::Tensor& poses) {
    const torch::Tensor rows = poses.reshape({-1, kFeatures});
    mean_ = rows.mean(0);
    torch::Tensor floor = torch::full({kFeatures}, 0.03f);
    floor.slice(0, kRoot, kRoot + kTurnRate).fill_(0.1f), floor[kRoot + kTurnRate].fill_(0.2f);
    unit_ = torch::empty({kFeatures});
    for (int n = 0; n < kFeatures; ++n) unit_[n] = PredictorNetwork::unit(static_cast<size_t>(n));
    scale_ = ((rows - mean_).square().mean(0) + floor.square()).sqrt();
  }

  // Root mean square of a window's changes in the network's units, as in PredictorNetwork::next().
  // changes[rows][kWindowPoses - 1][kFeatures] -> [rows][1]
  torch::Tensor motion_of(const torch::Tensor& changes) const {
    return (changes * unit_)
        .square()
        .mean(2)
        .mean(1, true)
        .sqrt()
        .clamp_min(PredictorNetwork::kMinMotion);
  }

  // Linear extrapolation per feature: weights of its last changes with the smallest error, relative
  // to the motion.
  void fit_linear(const torch::Tensor& poses) {
    const torch::Tensor changes = poses.slice(1, 1) - poses.slice(1, 0, kPoses - 1);
    linear_ = torch::zeros({kWindowPoses - 1, kFeatures});
    std::vector<torch::Tensor> seen, wanted;
    for (int end = kWindowPoses - 1; end < kPoses - 1; ++end) {
      const torch::Tensor part = changes.slice(1, end - kWindowPoses + 1, end).flip(1);
      const torch::Tensor motion = motion_of(part);
      seen.push_back(part / motion.unsqueeze(1));
      wanted.push_back(changes.select(1, end) / motion);
    }
    const torch::Tensor a = torch::cat(seen).to(torch::kDouble);
    const torch::Tensor b = torch::cat(wanted).to(torch::kDouble);
    for (int n = 0; n < kFeatures; ++n) {
      const torch::Tensor x = a.select(2, n);
      const torch::Tensor square = x.t().matmul(x) + 1e-3 * torch::eye(kWindowPoses - 1);
      linear_.select(1, n).copy_(
          torch::linalg_solve(square, x.t().matmul(b.slice(1, n, n + 1))).squeeze(1));
    }
  }

  // Predicts the poses after a window one by one, each from those before it.
  // window[rows][kWindowPoses][kFeatures], oldest first -> [rows][kAhead][kFeatures]
  torch::Tensor roll_out(torch::Tensor window, Random* random) const {
    std::vector<torch::Tensor> out;
    for (int step = 0; step < kAhead; ++step) {
      const torch::Tensor newest = window.select(1, kWindowPoses - 1);
      const torch::Tensor changes =
          (window.slice(1, 1) - window.slice(1, 0, kWindowPoses - 1)).flip(1);
      const torch::Tensor motion = motion_of(changes);
      const torch::Tensor pose = ((newest - mean_) / scale_).clamp(-kInputClip, kInputClip);
      const torch::Tensor seen = (changes * unit_).reshape({-1, kInputs - kFeatures}) / motion;
      const torch::Tensor answer = network_.forward(torch::cat({pose, seen}, 1), {}, random);
      const torch::Tensor next = newest + (changes * linear_).sum(1) + motion * answer / unit_;
      out.push_back(next);
      window = torch::cat({window.slice(1, 1), next.unsqueeze(1)}, 1);
    }
    return torch::stack(out, 1);
  }

  // The joints of the poses ahead relative to the current body: each pose's own positions, plus the
  // travel so far and, to first order, the turn so far.
  // ahead[rows][kAhead][kFeatures] -> [rows][kAhead][joints][3]
  static torch::Tensor joints_ahead(const torch::Tensor& ahead) {
    const torch::Tensor body = ahead.slice(2, 0, kRoot).reshape({-1, kAhead, kHumanJoints, 3});
    const torch::Tensor root = ahead.slice(2, kRoot).cumsum(1) * kWindowSpacing;
    const torch::Tensor turn = root.select(2, 2).unsqueeze(2);
    const torch::Tensor x =
        body.select(3, 0) + root.select(2, 0).unsqueeze(2) + turn * body.select(3, 2);
    const torch::Tensor z =
        body.select(3, 2) + root.select(2, 1).unsqueeze(2) - turn * body.select(3, 0);
    return torch::stack({x, body.select(3, 1), z}, 3);
  }

  torch::Tensor loss_of(const torch::Tensor& poses, Random* random) const {
    const torch::Tensor window = poses.slice(1, 0, kWindowPoses);
    const torch::Tensor wanted = joints_ahead(poses.slice(1, kWindowPoses));
    const auto error = [&](const torch::Tensor& joints) {
      return (joints - wanted).square().sum(3).mean(2);  // [rows][kAhead]
    };
    const torch::Tensor newest = window.slice(1, kWindowPoses - 1);
    const torch::Tensor held = newest.slice(2, 0, kRoot).reshape({-1, 1, kHumanJoints, 3});
    const torch::Tensor times = torch::arange(1, kAhead + 1).reshape({1, kAhead, 1});
    const torch::Tensor velocity = newest - window.slice(1, kWindowPoses - 2, kWindowPoses - 1);
    const torch::Tensor moved =
        torch::cat({newest.slice(2, 0, kRoot) + times * velocity.slice(2, 0, kRoot),
                    newest.slice(2, kRoot).expand({-1, kAhead, kRootFeatures})},
                   2);
    const torch::Tensor min =
        torch::minimum(error(held.expand_as(wanted)), error(joints_ahead(moved)));
    return (error(joints_ahead(roll_out(window, random))) / (min + kMinError * kMinError))
        .sqrt()
        .mean();
  }

  const std::vector<Take>& takes_;
  uint64_t seed_;
  NetworkTrainer network_;
  std::vector<Moment> moments_, held_;
  torch::Tensor mean_, scale_, unit_;  // [kFeatures]
  torch::Tensor linear_;               // [kWindowPoses - 1][kFeatures], newest change first
};

}  // namespace

void train_predictor(const std::vector<Take>& takes, int64_t steps, uint64_t seed,
                     const std::function<void(double)>& progress, TensorFile& model,
                     std::vector<LossPoint>& losses) {
  PredictorTraining training(takes, steps, seed);
  if (!training.has_motion()) return;
  training.run(steps, progress, losses);
  training.write(model);
}

}  // namespace panache
