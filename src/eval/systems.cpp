#include "eval/systems.h"

#include <algorithm>

#include "base/parallel.h"
#include "clip/motion_file.h"
#include "eval/motion_metrics.h"
#include "style/restyle.h"

namespace panache {

double TestInput::take_frame(double clip_frame) const {
  return (clip_frame - rig.first_frame()) * clip.frame_time * kTakeRate;
}

Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows) {
  std::vector<TestInput> inputs;
  for (const ManifestRow& row : rows) {
    Result<std::unique_ptr<MotionFile>> file = read_motion(row.path);
    if (!file) return file.error();
    Result<Rig> rig = Rig::create((*file)->clip());
    if (!rig) return Error{row.path + ": " + rig.error().message};
    Take take = make_take((*file)->clip(), *rig, PoseLayout::positions);
    take.row = row;
    inputs.push_back({(*file)->clip(), *std::move(rig), std::move(take)});
  }
  return inputs;
}

Result<Played> run_system(std::shared_ptr<const Model> model, const std::vector<TestInput>& inputs,
                          int which, const Request& request, bool timing) {
  const TestInput& input = inputs[which];
  std::vector<StrengthTrack> tracks;
  for (const auto& [style, strength] : request.strengths) {
    Result<int> found = model->find_style(style);
    if (!found) return found.error();
    tracks.push_back({*found, {{0, strength}}});
  }
  RestyleOptions options;
  options.timing = timing;
  Result<Restyled> restyled = restyle(input.clip, input.rig, model, tracks, options);
  if (!restyled) return Error{input.take.row.path + ": " + restyled.error().message};

  Played played;
  played.bone_length_error = bone_length_error(restyled->clip, input.clip, restyled->source_frames,
                                               input.rig.joints()[0]) *
                             input.rig.scale();
  Output& output = played.output;
  output.take = make_take(restyled->clip, input.rig, PoseLayout::positions);
  output.take.row = input.take.row;
  output.take.row.style = request.style;
  output.take.row.neutral = false;
  output.input = which;
  for (int f = 0; f < output.take.frames(); ++f) {
    const double at = input.rig.first_frame() + f / (kTakeRate * input.clip.frame_time);
    const size_t a = std::min(static_cast<size_t>(at), restyled->source_frames.size() - 1);
    const size_t b = std::min(a + 1, restyled->source_frames.size() - 1);
    const double source = std::lerp(restyled->source_frames[a], restyled->source_frames[b],
                                    at - static_cast<double>(a));
    output.source_frames.push_back(static_cast<float>(input.take_frame(source)));
  }
  return played;
}

std::vector<Output> untouched(const std::vector<TestInput>& inputs,
                              const std::vector<std::string>& styles) {
  std::vector<Output> outputs;
  for (size_t i = 0; i < inputs.size(); ++i) {
    for (const std::string& style : styles) {
      Output output{inputs[i].take, static_cast<int>(i), {}};
      output.take.row.style = style;
      for (int f = 0; f < output.take.frames(); ++f) {
        output.source_frames.push_back(static_cast<float>(f));
      }
      outputs.push_back(std::move(output));
    }
  }
  return outputs;
}

}  // namespace panache
