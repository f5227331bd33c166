#include "takes/load_takes.h"

#include <atomic>

#include "base/parallel.h"
#include "clip/motion_file.h"
#include "rig/body_motions.h"

namespace panache {

Result<RiggedClip> load_clip(const std::string& path) {
  Result<std::unique_ptr<MotionFile>> file = read_motion(path);
  if (!file) return file.error();
  const Clip& clip = (*file)->clip(first_body_motion(**file));
  Result<Rig> rig = Rig::create(clip);
  if (!rig) return located(path, rig.error());
  return RiggedClip{clip, *std::move(rig)};
}

Result<Take> load_take(const ManifestRow& row, PoseLayout layout) {
  const Result<RiggedClip> from = load_clip(row.path);
  if (!from) return from.error();
  Take take = make_take(from->clip, from->rig, layout);
  take.row = row;
  return take;
}

Result<std::vector<Take>> load_takes(const std::vector<ManifestRow>& rows, PoseLayout layout,
                                     const std::function<void(int)>& progress) {
  std::atomic<int> done = 0;
  return parallel_results<Take>(rows.size(), [&](int i) {
    Result<Take> take = load_take(rows[i], layout);
    const int count = ++done;
    if (progress) progress(count);
    return take;
  });
}

HumanPositions world_positions(const Take& take, int frame) {
  return to_world(take.body[frame], take.root[frame]);
}

}  // namespace panache
