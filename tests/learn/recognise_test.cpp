#include "learn/recognise.h"

#include <gtest/gtest.h>

#include "make_clip.h"
#include "style/model/model.h"
#include "style/play/removal.h"
#include "walker/walker.h"

namespace panache {
namespace {

std::shared_ptr<const Model> shipped_model(const std::string& name) {
  const auto model = Model::load(PANACHE_SOURCE_DIR "/models/" + name);
  EXPECT_TRUE(model.ok()) << (model ? "" : model.error().message);
  return *model;
}

class RecogniseTest : public testing::Test {
 protected:
  // The share of a style; "" is neutral.
  static float share(const std::vector<StyleShare>& shares, const Model& remover,
                     const std::string& style) {
    const int wanted = style.empty() ? -1 : *remover.find_style(style);
    for (const StyleShare& one : shares) {
      if (one.style == wanted) return one.share;
    }
    return -1;
  }
  const std::shared_ptr<const Model> remover_ = shipped_model("remover-int8.safetensors");
  const std::shared_ptr<const Model> model_ = shipped_model("panache-int8.safetensors");
};

TEST_F(RecogniseTest, shares_are_in_order_and_one_together) {
  const Clip clip = test::walking_clip(120);
  const auto shares = recognise_styles(remover_, clip, *Rig::create(clip));
  ASSERT_TRUE(shares.ok()) << shares.error().message;
  EXPECT_EQ(shares->size(), remover_->styles().size());  // Neutral, but not the unknown style.
  float sum = 0;
  for (size_t i = 0; i < shares->size(); ++i) {
    sum += (*shares)[i].share;
    EXPECT_LE((*shares)[i].share, (*shares)[i > 0 ? i - 1 : 0].share);
  }
  // kAnyStyle, which no take shows, keeps a trace.
  EXPECT_NEAR(sum, 1, 0.01);
}

TEST_F(RecogniseTest, a_style_that_is_put_on_is_told_and_one_that_is_taken_off_is_not) {
  const Clip clip = test::walking_clip(180);
  const Rig rig = *Rig::create(clip);
  for (const char* style : {"old", "zombie", "mummy"}) {
    const auto on = restyle(clip, rig, model_, {{*model_->find_style(style), {{0, 1}}}});
    const auto off =
        restyle_without(on->clip, rig, {remover_, *find_removal(*remover_, style)}, model_, {});
    const float before = share(*recognise_styles(remover_, clip, rig), *remover_, style);
    const float with = share(*recognise_styles(remover_, on->clip, rig), *remover_, style);
    const float without = share(*recognise_styles(remover_, off->clip, rig), *remover_, style);
    EXPECT_GT(with, before + 0.2f) << style;
    EXPECT_LT(without, with - 0.2f) << style;
  }
}

TEST_F(RecogniseTest, a_clip_shorter_than_a_window_is_told_too) {
  const Clip clip = test::walking_clip(8);
  EXPECT_TRUE(recognise_styles(remover_, clip, *Rig::create(clip)).ok());
}

TEST_F(RecogniseTest, another_model_recognises_nothing) {
  const Clip clip = test::walking_clip(60);
  const auto shares = recognise_styles(model_, clip, *Rig::create(clip));
  ASSERT_FALSE(shares.ok());
  EXPECT_EQ(shares.error().message,
            "the model recognises no styles; expected one that takes them off");
}

TEST(RecognisedWindows, cover_a_take_and_one_covers_a_short_one) {
  EXPECT_EQ(recognised_windows(5), (std::vector<int>{0}));
  EXPECT_EQ(recognised_windows(75), (std::vector<int>{0, 15}));
}

}  // namespace
}  // namespace panache
