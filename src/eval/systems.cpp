#include "eval/systems.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "clip/motion_file.h"
#include "eval/motion_metrics.h"
#include "style/restyle.h"

namespace panache {
namespace {

Result<TestInput> load_input(const ManifestRow& row) {
  Result<std::unique_ptr<MotionFile>> file = read_motion(row.path);
  if (!file) return file.error();
  const Clip& clip = (*file)->clip();
  Result<Rig> rig = Rig::create(clip);
  if (!rig) return Error{row.path + ": " + rig.error().message};
  Take take = make_take(clip, *rig, PoseLayout::positions);
  take.row = row;
  return TestInput{clip, *std::move(rig), std::move(take)};
}

}  // namespace

double TestInput::take_frame(double clip_frame) const {
  return (clip_frame - rig.first_frame()) * clip.frame_time * kTakeRate;
}

Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows) {
  std::vector<std::optional<Result<TestInput>>> read(rows.size());
  parallel_for(static_cast<int>(rows.size()), [&](int i) { read[i] = load_input(rows[i]); });
  std::vector<TestInput> inputs;
  for (std::optional<Result<TestInput>>& input : read) {
    if (!*input) return input->error();
    inputs.push_back(std::move(*input).value());
  }
  return inputs;
}

std::vector<Take> takes_of(const std::vector<TestInput>& inputs) {
  std::vector<Take> takes;
  for (const TestInput& input : inputs) takes.push_back(input.take);
  return takes;
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
