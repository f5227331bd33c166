#include "style/play/restyle_facts.h"

#include <algorithm>
#include <cmath>

#include "rig/posed_rig.h"

namespace panache {
namespace {

constexpr float kSeated = 0.5f, kTouching = 0.5f;  // Of StageFacts.
constexpr float kStanding = 0.5f;  // m/s; the foot lock lets faster feet of the input go.

using Toes = std::array<Vec3, kFeet>;

Toes toes_of(PosedRig& reader, ConstPose pose) {
  BodyPose body;
  reader.read(pose, body);
  return {body.joints[index(kToes[0])], body.joints[index(kToes[1])]};
}

float over_ground(Vec3 a, Vec3 b) { return std::hypot(b.x - a.x, b.z - a.z); }

// Sets the facts about the feet from frame `first` on.
void measure_feet(const Clip& clip, const Rig& rig, const Restyled& result, int first,
                  RestyleFacts& facts) {
  PosedRig reader(rig);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> translations(clip.joints());
  const Pose pose = {rotations, translations};
  Toes input{}, output{};
  int steps = 0, planted_frames = 0;
  for (int f = first; f < result.clip.frames; ++f) {
    const Toes input_before = input, output_before = output;
    sample(clip, result.source_frames[f], pose);
    input = toes_of(reader, pose);
    output = toes_of(reader, result.clip.pose(f));
    if (f == first) continue;
    const float seconds = static_cast<float>(result.clip.frame_time);
    bool planted = false;
    for (int foot = 0; foot < kFeet; ++foot) {
      if (!result.contacts[f - 1][foot] || !result.contacts[f][foot]) continue;
      const float moved = over_ground(input_before[foot], input[foot]) / seconds;
      if (moved > kStanding) continue;
      planted = true;
      ++steps;
      facts.input_slide += moved;
      facts.slide += over_ground(output_before[foot], output[foot]) / seconds;
    }
    planted_frames += planted;
  }
  if (steps == 0) return;
  facts.input_slide /= static_cast<float>(steps);
  facts.slide /= static_cast<float>(steps);
  facts.planted =
      static_cast<float>(planted_frames) / static_cast<float>(result.clip.frames - 1 - first);
}

}  // namespace

RestyleFacts restyle_facts(const Clip& clip, const Rig& rig, const Restyled& result) {
  RestyleFacts facts;
  facts.unchanged = is_unchanged(clip, result);
  facts.loop = result.loop;
  const int first = std::min(rig.first_frame(), clip.frames - 1);
  const float frames = static_cast<float>(result.clip.frames - first);
  facts.known = 0;
  for (int f = first; f < result.clip.frames; ++f) {
    facts.known += result.gates[f];
    facts.seated += result.stages[f].seated > kSeated;
    facts.touching += result.stages[f].touching > kTouching;
  }
  facts.known /= frames;
  facts.seated /= frames;
  facts.touching /= frames;
  measure_feet(clip, rig, result, first, facts);
  return facts;
}

}  // namespace panache
