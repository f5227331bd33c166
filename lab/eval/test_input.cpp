#include "eval/test_input.h"

#include <optional>

#include "base/parallel.h"
#include "clip/motion_file.h"
#include "rig/body_motions.h"

namespace panache {

double TestInput::take_frame(double clip_frame) const {
  return (clip_frame - rig.first_frame()) * clip.frame_time * kTakeRate;
}

Result<TestInput> load_input(const ManifestRow& row) {
  Result<std::unique_ptr<MotionFile>> file = read_motion(row.path);
  if (!file) return file.error();
  const Clip& clip = (*file)->clip(first_body_motion(**file));
  Result<Rig> rig = Rig::create(clip);
  if (!rig) return located(row.path, rig.error());
  Take take = make_take(clip, *rig, PoseLayout::positions);
  take.row = row;
  return TestInput{clip, *std::move(rig), std::move(take)};
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

}  // namespace panache
