// The numbers of a person, found again in a walk that was made with them.

#include "learn/learn_person.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "make_model.h"
#include "style/restyle.h"
#include "style/style_checks.h"

namespace panache {
namespace {

const std::string kModels = PANACHE_SOURCE_DIR "/models/";

// The numbers learnt from the walk of a person with this carriage.
PersonNumbers learnt(const std::shared_ptr<const Model>& model, size_t axis, float number) {
  const auto bank = *NeutralBank::load(kModels + "neutral.safetensors");
  const Clip walk = walker_walk(480, 1.3f, 0);
  const Rig rig = *Rig::create(walk);
  RestyleOptions options;
  options.timing = false;
  options.stylizer.person[axis] = number;
  const Restyled styled = *restyle(walk, rig, model, {}, options);
  const Take take = make_take(styled.clip, rig, PoseLayout::positions);
  const auto found = learn_person(model, *bank, {&take, 1});
  EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().message);
  return found ? found->numbers : PersonNumbers{};
}

TEST(LearnPerson, finds_the_number_that_a_walk_was_made_with) {
  const auto model = shipped_model();
  const std::vector<std::string>& names = model->persons()->names();
  const auto axis =
      static_cast<size_t>(std::find(names.begin(), names.end(), "carriage") - names.begin());
  ASSERT_LT(axis, names.size());
  const float low = learnt(model, axis, -1.5f)[axis], high = learnt(model, axis, 1.5f)[axis];
  // They differ by 3; a penalty shrinks what is found.
  EXPECT_GT(high - low, 1.5f);
  EXPECT_LT(high - low, 4.5f);
}

TEST(LearnPerson, needs_a_model_with_persons_and_motion_that_others_do) {
  const auto bank = *NeutralBank::load(kModels + "neutral.safetensors");
  const auto without = read(test::make_model({"old"}));
  const Clip walk = walker_walk(480, 1.3f, 0);
  const Take take = make_take(walk, *Rig::create(walk), PoseLayout::positions);
  const auto nobody = learn_person(without, *bank, {&take, 1});
  ASSERT_FALSE(nobody.ok());
  EXPECT_NE(nobody.error().message.find("has no persons"), std::string::npos);
  const auto nothing = learn_person(shipped_model(), *bank, {});
  ASSERT_FALSE(nothing.ok());
  EXPECT_NE(nothing.error().message.find("a plain walk"), std::string::npos);
}

}  // namespace
}  // namespace panache
