#include "learn/neutral_bank.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>

#include "base/file.h"
#include "base/parallel.h"
#include "learn/samples.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr const char* kFormat = "panache-neutral";
constexpr int kRootBegin = root_offset(PoseLayout::positions);
constexpr int kNearest = 6;
constexpr float kNearestFloor = 0.5f;  // Squared distance below which all prototypes count alike.
constexpr int kSmoothed = 7;           // Frames.
// Tempos to try for a style, and the factor by which another than 1 must reduce the distance.
constexpr float kTempos[] = {1, 0.84f, 1.19f, 0.71f, 1.41f};
constexpr float kNearer = 0.93f;
constexpr int kTempoStride = 5;  // One of this many frames is examined.
// The fraction of the deviation between people in a moment that is due to their mean postures.
constexpr float kPostureShare = 0.3f;
// Distances of the nearest prototypes, in units of the known distance, each divided by the fraction
// of the clip's motion that they have: up to the first, all of the difference is style, from the
// second on none. Measured on 206 clips of 80 styles: punches and kicks have 4.4 to 27, jumps 3.4
// to 7.4, walks, runs, bows and waves 0.3 to 4.0.
constexpr double kFar = 3.75, kTooFar = 4.5;
// Weights of the coarse posture and the rig.
constexpr float kCoarse = 0.5f, kRigWeight = 1.5f;

// Frames at which a moment is sampled; and the range of these for the steps.
constexpr std::array kTimes = {-15, -12, -9, -6, -4, -3, -2, -1, 0, 1, 2, 3, 4, 6, 9, 12, 15};
constexpr size_t kFirst = 3, kCount = 11;
// Evenly spaced over the three seconds.
constexpr std::array<size_t, 11> kSpread = {0, 1, 2, 3, 5, 8, 11, 13, 14, 15, 16};
constexpr float kTimeUnit = 3;

struct WeightedJoint {
  HumanJoint joint;
  float weight;  // Highest for the legs: a style changes the steps least.
};
constexpr std::array<WeightedJoint, 12> kWeightedJoints = {{{chest, 0.5f},
                                                            {head, 0.5f},
                                                            {left_lower_arm, 0.35f},
                                                            {left_hand, 0.35f},
                                                            {right_lower_arm, 0.35f},
                                                            {right_hand, 0.35f},
                                                            {left_lower_leg, 1},
                                                            {left_foot, 1},
                                                            {left_toes, 1},
                                                            {right_lower_leg, 1},
                                                            {right_foot, 1},
                                                            {right_toes, 1}}};
constexpr std::array kAmplitudes = {left_lower_leg,  left_foot,      right_lower_leg,
                                    right_foot,      left_lower_arm, left_hand,
                                    right_lower_arm, right_hand,     head};

float bounded(float value, float max) { return std::clamp(value, -max, max); }

// The canonical body nearest to `joints`, whose limb lengths may differ.
HumanPositions whole_body(const HumanPositions& joints) {
  BodyShape shape;
  shape.has.fill(true);
  std::array<Vec3, 2> toes;
  for (int side = 0; side < kFeet; ++side) {
    toes[side] = normalized(joints[index(kToes[side])] - joints[index(kAnkles[side])], {0, 0, 1});
  }
  return canonical_positions(joints, shape, toes);
}

// Moving average over the frames of rows[frames][numbers].
std::vector<float> smoothed(const std::vector<float>& rows, int frames, int numbers) {
  std::vector<float> out(rows.size());
  for (int f = 0; f < frames; ++f) {
    for (int k = -kSmoothed / 2; k <= kSmoothed / 2; ++k) {
      const float* from = &rows[size_t(std::clamp(f + k, 0, frames - 1)) * numbers];
      float* to = &out[size_t(f) * numbers];
      for (int n = 0; n < numbers; ++n) to[n] += from[n] / kSmoothed;
    }
  }
  return out;
}

// The mean position of each joint.
HumanPositions mean_body(const std::vector<HumanPositions>& bodies) {
  HumanPositions mean{};
  for (const HumanPositions& body : bodies) {
    for (int j = 0; j < kHumanJoints; ++j) {
      mean[j] = mean[j] + body[j] / static_cast<float>(bodies.size());
    }
  }
  return mean;
}

// The root mean square distance of the joints from their mean, metres.
double motion_about(const HumanPositions& mean, const std::vector<HumanPositions>& bodies) {
  double sum = 0;
  for (const HumanPositions& body : bodies) {
    for (int j = 0; j < kHumanJoints; ++j) {
      sum += dot(body[j] - mean[j], body[j] - mean[j]);
    }
  }
  return std::sqrt(sum / (kHumanJoints * bodies.size()));
}

}  // namespace

void write_moment(const Take& take, float frame, float tempo, std::span<float> out) {
  std::array<HumanPositions, kTimes.size()> bodies;
  std::array<std::array<float, kRootFeatures>, kTimes.size()> roots;
  std::array<FootContacts, kTimes.size()> contacts;
  const auto last = static_cast<float>(take.frames() - 1);
  for (size_t t = 0; t < kTimes.size(); ++t) {
    const float at =
        std::clamp(frame + kTimeUnit * static_cast<float>(kTimes[t]) / tempo, 0.0f, last);
    bodies[t] = body_at(take, at);
    roots[t] = root_at(take, at);
    for (float& number : roots[t]) number = bounded(number / tempo, 3);
    contacts[t] = take.contacts[std::lround(at)];
  }
  HumanPositions mean{};
  std::array<float, kHumanJoints> amplitude{};
  std::array<float, kRootFeatures> root{};
  std::array<float, kFeet> planted{}, ankle{9, 9}, toe{9, 9};
  constexpr float kShare = 1 / static_cast<float>(kSpread.size());
  for (const size_t t : kSpread) {
    for (int j = 0; j < kHumanJoints; ++j) mean[j] = mean[j] + bodies[t][j] * kShare;
    for (int k = 0; k < kRootFeatures; ++k) root[k] += roots[t][k] * kShare;
    for (int f = 0; f < kFeet; ++f) planted[f] += contacts[t][f] ? kShare : 0;
  }
  for (const HumanPositions& body : bodies) {
    for (int f = 0; f < kFeet; ++f) {
      ankle[f] = std::min(ankle[f], body[index(kAnkles[f])].y);
      toe[f] = std::min(toe[f], body[index(kToes[f])].y);
    }
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    for (const size_t t : kSpread) {
      const Vec3 offset = bodies[t][j] - mean[j];
      amplitude[j] += dot(offset, offset) * kShare;
    }
    amplitude[j] = std::sqrt(amplitude[j]) + 0.05f;
  }

  float* number = out.data();
  const auto put = [&](float value) { *number++ = value; };
  const float each = 1 / std::sqrt(static_cast<float>(kCount));
  for (size_t t = kFirst; t < kFirst + kCount; ++t) {
    for (const auto& [joint, weight] : kWeightedJoints) {
      const int j = index(joint);
      const Vec3 offset = (bodies[t][j] - mean[j]) * (weight * each / amplitude[j]);
      put(offset.x), put(offset.y), put(offset.z);
    }
    put(bounded((bodies[t][0].y - mean[0].y) / 0.05f, 3) * each);
    constexpr std::array<float, kRootFeatures> kWeights = {0.5f, 0.35f, 0.35f};
    for (int k = 0; k < kRootFeatures; ++k) put(roots[t][k] * kWeights[k] * each);
    for (int f = 0; f < kFeet; ++f) put(contacts[t][f] ? 0.5f * each : 0);
  }
  constexpr std::array<float, kRootFeatures> kMeanWeights = {1.4f, 1.05f, 1.05f};
  for (int k = 0; k < kRootFeatures; ++k) put(root[k] * kMeanWeights[k]);
  for (int f = 0; f < kFeet; ++f) put(4 * planted[f]);
  for (const HumanJoint joint : kAmplitudes) put(0.6f * std::log(amplitude[index(joint)]));
  // Distinguishes sitting, lying and fighting from standing, whatever the style.
  const auto coarse = [&](float value, float unit) { put(kCoarse * bounded(value / unit, 4)); };
  const auto at = [&](HumanJoint joint) { return mean[index(joint)]; };
  coarse(at(hips).y, 0.15f);
  coarse(at(neck).x, 0.2f), coarse(at(neck).y - at(hips).y, 0.2f), coarse(at(neck).z, 0.3f);
  coarse(at(left_foot).x - at(right_foot).x, 0.15f);
  coarse(at(left_foot).z - at(right_foot).z, 0.15f);
  for (const HumanJoint hand : {left_hand, right_hand}) {
    coarse(at(hand).y - at(hips).y, 0.3f), coarse(at(hand).z, 0.3f);
  }
  // The height of a planted foot differs between rigs, and with it the whole leg.
  put(bounded(((ankle[0] + ankle[1]) / 2 - 0.07f) / 0.02f, 3) * kRigWeight);
  put(bounded(((toe[0] + toe[1]) / 2 - 0.03f) / 0.02f, 3) * kRigWeight);
  assert(number == out.data() + out.size());
}

Result<std::shared_ptr<const NeutralBank>> NeutralBank::load(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse(*bytes, path);
}

Result<std::shared_ptr<const NeutralBank>> NeutralBank::parse(std::string_view bytes,
                                                              const std::string& name) {
  const Result<TensorFile> file = parse_safetensors(bytes, name);
  if (!file) return file.error();
  const auto format = file->metadata.find("format");
  if (format == file->metadata.end() || format->second != kFormat) {
    return Error{name + ": is no bank of neutral motion; expected metadata 'format' to be '" +
                 kFormat + "'"};
  }
  auto bank = std::make_shared<NeutralBank>();
  std::vector<float> scale, offset, known, people;
  struct Part {
    const char* key;
    int columns;
    std::vector<float>& values;
  };
  for (const auto& [key, columns, values] :
       {Part{"mean", kMomentFeatures, bank->mean_},
        Part{"directions", kDirections, bank->directions_}, Part{"rows", kRow, bank->rows_},
        Part{"rows.scale", kRow, scale}, Part{"rows.offset", kRow, offset},
        Part{"people", kPeople, people}, Part{"known", 1, known}}) {
    constexpr float kTooLarge = 1e4f;
    const auto read = find_tensor(*file, key, {-1, columns}, name, kTooLarge);
    if (!read) return read.error();
    values = (*read)->values;
  }
  const size_t count = people.size() / kPeople;
  if (bank->directions_.size() != size_t(kMomentFeatures) * kDirections ||
      bank->rows_.size() != count * kRow || count < kNearest) {
    return Error{name + ": its tensors do not belong together; get the file again"};
  }
  for (size_t i = 0; i < bank->rows_.size(); ++i) {
    bank->rows_[i] = offset[i % kRow] + scale[i % kRow] * bank->rows_[i];
  }
  bank->people_.assign(people.begin(), people.end());
  bank->known_ = known[0];
  return std::shared_ptr<const NeutralBank>(std::move(bank));
}

void NeutralBank::project(std::span<const float> moment, std::span<float> out) const {
  std::fill(out.begin(), out.end(), 0.0f);
  for (size_t i = 0; i < moment.size(); ++i) {
    const float value = moment[i] - mean_[i];
    for (int d = 0; d < kDirections; ++d) out[d] += value * directions_[i * kDirections + d];
  }
}

void NeutralBank::find(const Take& take, float frame, float tempo, std::span<Near> out) const {
  std::array<float, kMomentFeatures> moment;
  std::array<float, kDirections> position;
  write_moment(take, frame, tempo, moment);
  project(moment, position);
  std::fill(out.begin(), out.end(), Near{1e30f, 0});
  for (size_t p = 0; p < prototypes(); ++p) {
    const float* other = row(static_cast<int>(p));
    float distance = 0;
    for (int d = 0; d < kDirections; ++d) {
      distance += (position[d] - other[d]) * (position[d] - other[d]);
    }
    if (distance >= out.back().distance) continue;
    size_t at = out.size() - 1;
    for (; at > 0 && distance < out[at - 1].distance; --at) out[at] = out[at - 1];
    out[at] = {distance, static_cast<int>(p)};
  }
}

NeutralTwin NeutralBank::twin(const Take& styled, bool is_person) const {
  NeutralTwin out;
  // The tempo at which most people would do it.
  double best = 0, unlike = 0;
  for (const float tempo : kTempos) {
    double sum = 0, count = 0;
    for (int f = 0; f < styled.frames(); f += kTempoStride, ++count) {
      std::array<Near, 1> near;
      find(styled, static_cast<float>(f), tempo, near);
      sum += std::sqrt(near[0].distance);
    }
    const double mean = sum / count;
    if (tempo == 1) {
      best = mean * kNearer;
      unlike = mean / known_;
    } else if (mean < best) {
      best = mean;
      out.tempo = tempo;
    }
  }
  const auto tempo = static_cast<float>(out.tempo);
  const int frames = 1 + static_cast<int>(static_cast<float>(styled.frames() - 1) * tempo);
  constexpr int kNumbers = kPoseNumbers + kHumanJoints;  // A pose, and squared deviations.
  std::vector<float> rows(size_t(frames) * kNumbers);
  std::vector<std::array<Near, kNearest>> nearest(frames);
  parallel_for(frames, [&](int f) {
    find(styled, static_cast<float>(f) / tempo, tempo, nearest[f]);
    float all = 0;
    for (const Near& near : nearest[f]) all += 1 / (near.distance + kNearestFloor);
    float* numbers = &rows[size_t(f) * kNumbers];
    for (const Near& near : nearest[f]) {
      const float share = 1 / (near.distance + kNearestFloor) / all;
      const float* pose = row(near.prototype) + kDirections;
      for (int n = 0; n < kNumbers; ++n) {
        numbers[n] += share * (n < kPoseNumbers ? pose[n] : pose[n] * pose[n]);
      }
    }
  });
  std::set<int> people;
  for (const auto& found : nearest) {
    for (const Near& near : found) {
      const int* of = &people_[size_t(near.prototype) * kPeople];
      std::copy_if(of, of + kPeople, std::inserter(people, people.end()),
                   [](int person) { return person >= 0; });
    }
  }
  out.facts.people = static_cast<int>(people.size());
  rows = smoothed(rows, frames, kNumbers);
  HumanPositions variance{};  // Of each joint, stored in x.
  for (int f = 0; f < frames; ++f) {
    const float* numbers = &rows[size_t(f) * kNumbers];
    out.take.body.push_back(read_positions({numbers, kPoseNumbers}));
    for (int j = 0; j < kHumanJoints; ++j) {
      variance[j].x += numbers[kPoseNumbers + j] / static_cast<float>(frames);
    }
  }
  // A performer differs from the mean of people: a part of the difference in posture that
  // corresponds to the variation between people stays with the twin (Wiener 1949).
  const HumanPositions was = mean_body(out.take.body), is = mean_body(styled.body);
  constexpr double kStill = 1e-3;  // A millimetre.
  const double far =
      unlike * motion_about(is, styled.body) / std::max(motion_about(was, out.take.body), kStill);
  out.facts.trust = std::clamp((kTooFar - far) / (kTooFar - kFar), 0.0, 1.0);
  out.facts.is_known = unlike < 1 && out.facts.trust == 1;
  double style = 0, all = 0;
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 apart = is[j] - was[j];
    const float square = dot(apart, apart), between = is_person ? 0 : kPostureShare * variance[j].x;
    const float kept = between / std::max(square, std::max(between, 1e-9f));
    for (HumanPositions& body : out.take.body) body[j] = body[j] + apart * kept;
    style += (1 - kept) * square;
    all += square;
  }
  out.facts.certainty = all > 0 ? out.facts.trust * style / all : 0;
  RootPose root;
  std::vector<HumanPositions> world;
  for (int f = 0; f < frames; ++f) {
    HumanPositions& body = out.take.body[f];
    body = whole_body(body);
    canonical_frames(body, 0, out.take.rotations.emplace_back());
    const float* numbers = &rows[size_t(f) * kNumbers + kRootBegin];
    if (f > 0) {
      root = move_root(root, std::span<const float, kRootFeatures>(numbers, kRootFeatures),
                       1 / kTakeRate);
    }
    out.take.root.push_back(root);
    world.push_back(to_world(body, root));
  }
  out.take.contacts = detect_contacts(world, kTakeRate);
  write_numbers(PoseLayout::positions, out.take);
  return out;
}

}  // namespace panache
