#include "eval/walker_walks.h"

#include "walker/walker.h"

namespace panache {

Result<std::vector<TestInput>> walker_walks(const std::string& walker_model) {
  Result<std::shared_ptr<const WalkerModel>> model = WalkerModel::load(walker_model);
  if (!model) return model.error();
  std::vector<TestInput> walks;
  for (const float speed : {1.1f, 1.4f, 1.7f}) {
    Clip clip = walk_clip(*model, {.seconds = 6, .fps = 30, .speed = speed});
    Result<Rig> rig = Rig::create(clip);
    if (!rig) return rig.error();
    Take take = make_take(clip, *rig, PoseLayout::positions);
    take.row.path = "walker";
    take.row.content = "walk";
    take.row.neutral = take.row.test = true;
    walks.push_back({std::move(clip), *std::move(rig), std::move(take)});
  }
  return walks;
}

}  // namespace panache
