#include "eval/system.h"

#include <numeric>

#include "base/elementary.h"
#include "eval/motion_metrics.h"

namespace panache {
namespace {

// The frame of the input take for each frame of the output take.
std::vector<float> take_sources(const TestInput& input, const std::vector<double>& source_frames,
                                int frames) {
  std::vector<float> sources;
  for (int f = 0; f < frames; ++f) {
    const double at = input.rig.first_frame() + f / (kTakeRate * input.clip.frame_time);
    sources.push_back(static_cast<float>(input.take_frame(between(source_frames, at))));
  }
  return sources;
}

}  // namespace

RunResult styled_result(const TestInput& input, const std::string& style, const Restyled& output) {
  RunResult run_result;
  run_result.bone_length_error =
      bone_length_error(output.clip, input.clip, output.source_frames, input.rig.joints()[0]) *
      input.rig.scale();
  run_result.gate = std::accumulate(output.gates.begin(), output.gates.end(), 0.0) /
                    static_cast<double>(output.gates.size());
  StyledTake& styled = run_result.output;
  styled.take = make_take(output.clip, input.rig, PoseLayout::positions);
  styled.take.row = input.take.row;
  styled.take.row.style = style;
  styled.take.row.neutral = false;
  styled.source_frames = take_sources(input, output.source_frames, styled.take.frames());
  return run_result;
}

}  // namespace panache
