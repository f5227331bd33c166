#include "eval/test_input.h"

#include "base/parallel.h"
#include "takes/load_takes.h"

namespace panache {

double TestInput::take_frame(double clip_frame) const {
  return (clip_frame - rig.first_frame()) * clip.frame_time * kTakeRate;
}

Result<TestInput> load_input(const ManifestRow& row) {
  Result<RiggedClip> from = load_clip(row.path);
  if (!from) return from.error();
  Take take = make_take(from->clip, from->rig, PoseLayout::positions);
  take.row = row;
  return TestInput{std::move(from->clip), std::move(from->rig), std::move(take)};
}

Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows) {
  return parallel_results<TestInput>(rows.size(), [&](int i) { return load_input(rows[i]); });
}

}  // namespace panache
