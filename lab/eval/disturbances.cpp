#include "eval/disturbances.h"

#include <algorithm>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "learn/samples.h"

namespace panache {
namespace {

constexpr float kRadians = std::numbers::pi_v<float> / 180;

// Mean body of another data set minus that of ours, both on the canonical body: over all 491 frames
// of four walks of the CMU database (02_01, 05_01, 06_01 and 12_01, without their T-pose), minus
// all 4,780 frames of the neutral training walks of Bandai Namco Research Motiondataset 2.
// Centimetres, body frame.
constexpr HumanPositions kOtherPosture_cm = {{
    {0.0f, -1.4f, 0.0f},    // hips
    {-0.6f, -1.6f, -1.7f},  // spine
    {-0.7f, -1.8f, -1.9f},  // chest
    {-0.4f, -2.4f, -1.4f},  // neck
    {-0.3f, -2.4f, -2.3f},  // head
    {-0.5f, -2.4f, -1.5f},  // leftShoulder
    {-0.5f, -2.4f, -1.5f},  // leftUpperArm
    {-5.8f, -4.0f, -5.5f},  // leftLowerArm
    {-4.2f, -4.9f, -5.4f},  // leftHand
    {-0.5f, -2.3f, -1.5f},  // rightShoulder
    {-0.5f, -2.3f, -1.5f},  // rightUpperArm
    {3.4f, -3.3f, -6.0f},   // rightLowerArm
    {2.3f, -4.5f, -6.0f},   // rightHand
    {0.0f, -1.2f, 0.1f},    // leftUpperLeg
    {-3.7f, -1.0f, -2.3f},  // leftLowerLeg
    {-2.9f, -2.0f, -2.2f},  // leftFoot
    {-4.2f, 1.6f, 0.8f},    // leftToes
    {0.1f, -1.5f, 0.1f},    // rightUpperLeg
    {4.4f, -1.0f, -1.2f},   // rightLowerLeg
    {1.7f, -2.0f, -0.7f},   // rightFoot
    {3.4f, 1.9f, 2.4f},     // rightToes
}};

// Applies `change(take, index)` to each take, then recomputes its features.
template <typename Change>
SeenTakes disturbed(const std::vector<Take>& takes, PoseLayout layout, const Change& change) {
  SeenTakes seen{takes, 1};
  parallel_for(static_cast<int>(takes.size()), [&](int i) {
    change(seen.takes[i], i);
    write_numbers(layout, seen.takes[i]);
  });
  return seen;
}

SeenTakes as_they_are(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take&, int) {});
}

SeenTakes other_posture(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int) {
    for (HumanPositions& body : take.body) {
      for (int j = 0; j < kHumanJoints; ++j) body[j] += kOtherPosture_cm[j] * 0.01f;
    }
  });
}

template <int percent>
SeenTakes scaled(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int) {
    constexpr float scale = percent * 0.01f;
    for (HumanPositions& body : take.body) {
      for (Vec3& joint : body) joint = joint * scale;
    }
    for (RootPose& root : take.root) root.position = root.position * scale;
  });
}

template <int cm>
SeenTakes lifted(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int) {
    for (HumanPositions& body : take.body) {
      for (Vec3& joint : body) joint.y += cm * 0.01f;
    }
  });
}

// Rotates the perceived heading of the body by `degrees` to its left.
template <int degrees>
SeenTakes turned(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int) {
    for (int f = 0; f < take.frames(); ++f) {
      take.root[f].facing += degrees * kRadians;
      for (Vec3& joint : take.body[f]) joint = rotate(rotation_y(-degrees * kRadians), joint);
    }
  });
}

SeenTakes noisy(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int index) {
    constexpr float kNoise = 0.01f;  // Standard deviation along each axis, metres.
    Random random(static_cast<uint64_t>(index));
    for (HumanPositions& body : take.body) {
      for (Vec3& joint : body) {
        const float x = random.normal(), y = random.normal(), z = random.normal();
        joint += Vec3{x, y, z} * kNoise;
      }
    }
  });
}

SeenTakes in_place(const std::vector<Take>& takes, PoseLayout layout) {
  return disturbed(takes, layout, [](Take& take, int) {
    for (RootPose& root : take.root) root.position = {};
  });
}

RootPose root_pose_at(const Take& take, float frame) {
  const int a = std::min(static_cast<int>(frame), take.frames() - 1);
  const int b = std::min(a + 1, take.frames() - 1);
  return interpolate(take.root[a], take.root[b], frame - static_cast<float>(a));
}

// Halves or doubles the perceived frame rate of a file.
template <int percent>
SeenTakes faster(const std::vector<Take>& takes, PoseLayout layout) {
  constexpr float speed = percent * 0.01f;
  SeenTakes seen = disturbed(takes, layout, [](Take& take, int) {
    const Take from = take;
    const int frames = 1 + static_cast<int>(static_cast<float>(from.frames() - 1) / speed);
    take.body.resize(frames);
    take.root.resize(frames);
    for (int f = 0; f < frames; ++f) {
      const float at = static_cast<float>(f) * speed;
      take.body[f] = body_at(from, at);
      take.root[f] = root_pose_at(from, at);
    }
  });
  seen.speed = speed;
  return seen;
}

double mean_cm(const PoseErrors& errors) {
  double sum = 0;
  for (const auto& [cell, error] : errors) sum += error.cm;
  return sum / static_cast<double>(errors.size());
}

}  // namespace

const std::vector<Disturbing>& disturbing_inputs() {
  static const std::vector<Disturbing> inputs = {
      {"none", as_they_are},
      {"another data set's mean posture", other_posture},
      {"body scale x 0.8", scaled<80>},
      {"body scale x 1.25", scaled<125>},
      {"floor -5 cm", lifted<-5>},
      {"floor +5 cm", lifted<5>},
      {"facing wrong by 20 degrees", turned<20>},
      {"1 cm noise on every joint", noisy},
      {"in place", in_place},
      {"rate wrong by 2", faster<200>},
      {"facing reversed", turned<180>},
  };
  return inputs;
}

std::vector<DisturbanceRow> measure_disturbances(const AlignedTakes& test, const System& system) {
  if (!system.instants(1)) return {};
  std::vector<DisturbanceRow> rows;
  for (const Disturbing& input : disturbing_inputs()) {
    const PoseErrors errors = test.errors(system, 1, input.see(test.takes(), system.layout()));
    if (errors.empty()) return {};
    rows.push_back({input.name, mean_cm(errors)});
  }
  return rows;
}

}  // namespace panache
