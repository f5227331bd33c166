// The models that the repository ships, on a walk made by a formula and on real ones.

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/motion_file.h"
#include "make_clip.h"
#include "net/layer.h"
#include "style/restyle.h"
#include "walker/walker.h"

namespace panache {
namespace {

const std::string kModels = PANACHE_SOURCE_DIR "/models/";

std::shared_ptr<const Model> shipped(const std::string& file) {
  const auto model = Model::load(kModels + file);
  EXPECT_TRUE(model.ok()) << model.error().message;
  return *model;
}

// Mean height and forward place of the head, relative to the hips.
Vec3 mean_head(const Clip& clip) {
  PosedRig rig(*Rig::create(clip));
  BodyPose body;
  Vec3 sum;
  for (int f = 0; f < clip.frames; ++f) {
    rig.read(clip.pose(f), body);
    sum += rotate(rotation_y(-body.facing),
                  body.joints[index(HumanJoint::head)] - body.joints[index(HumanJoint::hips)]);
  }
  return sum / static_cast<float>(clip.frames);
}

TEST(ShippedModels, the_default_is_smaller_than_the_papers) {
  EXPECT_LT(std::filesystem::file_size(kModels + "panache-int8.safetensors"), 931000u);
}

TEST(ShippedModels, all_name_their_data_and_its_licence) {
  for (const char* file :
       {"panache.safetensors", "panache-int8.safetensors", "smith2019.safetensors"}) {
    const auto model = shipped(file);
    EXPECT_TRUE(model->metadata().at("licence").starts_with("Apache-2.0; ")) << file;
    EXPECT_NE(model->metadata().at("data").find("CMU"), std::string::npos) << file;
    EXPECT_NE(model->metadata().at("data").find("NSF EIA-0196217"), std::string::npos) << file;
    for (const StyleInfo& style : model->styles()) EXPECT_FALSE(style.description.empty());
  }
}

// How far forward the head is of a clip in the style old.
float old_head(const std::shared_ptr<const Model>& model, const Clip& clip, float strength) {
  const int old = *model->find_style("old");
  return mean_head(restyle(clip, *Rig::create(clip), model, {{old, {{0, strength}}}})->clip).z;
}

TEST(ShippedModels, an_old_walk_is_bent_forward_and_twice_as_old_more_so) {
  const Clip walk = test::walking_clip(180);
  for (const char* file : {"panache.safetensors", "panache-int8.safetensors"}) {
    const auto model = shipped(file);
    EXPECT_GT(old_head(model, walk, 1), old_head(model, walk, 0) + 0.05f) << file;
    EXPECT_GT(old_head(model, walk, 2), old_head(model, walk, 1) + 0.03f) << file;
  }
}

TEST(ShippedModels, an_old_walk_of_people_is_bent_forward_by_every_model) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set: no real motion to read";
  // A performer's test take, and a walk of somebody whom no model was trained on.
  for (const char* name : {"cmu-styles/137_29b.bvh", "cmu-more/35_28.bvh"}) {
    const auto file = read_motion((std::filesystem::path(data) / name).string());
    ASSERT_TRUE(file.ok()) << file.error().message;
    for (const char* of :
         {"panache.safetensors", "panache-int8.safetensors", "smith2019.safetensors"}) {
      const auto model = shipped(of);
      EXPECT_GT(old_head(model, (*file)->clip(), 1), old_head(model, (*file)->clip(), 0) + 0.1f)
          << of << " on " << name;
    }
  }
}

TEST(ShippedModels, the_int8_one_is_the_default_quantized) {
  const std::string whole = *read_file(kModels + "panache.safetensors");
  const std::string int8 = *read_file(kModels + "panache-int8.safetensors");
  EXPECT_LE(int8.size(), whole.size() / 2);
  EXPECT_TRUE(format_safetensors(quantize(*parse_safetensors(whole, "whole"))) == int8)
      << "made of another model; panache-lab quantize makes it anew";
}

TEST(ShippedModels, the_int8_one_styles_like_the_float_one) {
  const Clip walk = test::walking_clip(180);
  const auto whole = shipped("panache.safetensors"), int8 = shipped("panache-int8.safetensors");
  for (int s = 0; s < static_cast<int>(whole->styles().size()); ++s) {
    const auto styled = [&](const auto& model) {
      RestyleOptions options;
      options.timing = false;  // So that frames stand side by side.
      options.loop = LoopMode::off;
      options.stylizer.gesture_rate = 0;
      return restyle(walk, *Rig::create(walk), model, {{s, {{0, 1}}}}, options)->clip;
    };
    const Clip a = styled(whole), b = styled(int8);
    PosedRig rig(*Rig::create(walk));
    double apart = 0, changed = 0;
    for (int f = 0; f < walk.frames; ++f) {
      BodyPose in, one, other;
      rig.read(walk.pose(f), in);
      rig.read(a.pose(f), one);
      rig.read(b.pose(f), other);
      for (int j = 0; j < kHumanJoints; ++j) {
        const auto from_hips = [&](const BodyPose& body) {
          return body.joints[j] - body.joints[0];
        };
        apart += static_cast<double>(length(from_hips(one) - from_hips(other)));
        changed += static_cast<double>(length(from_hips(one) - from_hips(in)));
      }
    }
    // Weights are off by a hundredth of their usual size in five layers, one after another, and the
    // smallest changes are mostly of the feet (pigeon-toed, 0.067).
    EXPECT_LT(apart, 0.08 * changed) << whole->styles()[static_cast<size_t>(s)].name;
  }
}

TEST(ShippedModels, every_style_keeps_the_feet_on_the_ground_and_the_body_whole) {
  const Clip walk = test::walking_clip(180);
  const Rig rig = *Rig::create(walk);
  const auto model = shipped("panache-int8.safetensors");
  PosedRig reader(rig);
  BodyPose body;
  for (size_t s = 0; s < model->styles().size(); ++s) {
    const auto styled = restyle(walk, rig, model, {{static_cast<int>(s), {{0, 1.5f}}}});
    for (int f = 0; f < styled->clip.frames; ++f) {
      reader.read(styled->clip.pose(f), body);
      for (const HumanJoint toe : kToes) {
        ASSERT_GT(body.joints[index(toe)].y, -0.025f) << model->styles()[s].name << ", frame " << f;
      }
      // A gorilla's is at 0.49 m, as its takes are bent and its strength is 1.5.
      ASSERT_GT(body.joints[index(HumanJoint::head)].y, 0.45f) << model->styles()[s].name;
    }
  }
}

// `old` shortens a brisk walk by more than its steps, unless the body goes on with its feet: then
// they slide at 0.44 m/s.
TEST(ShippedModels, planted_feet_do_not_slide_where_a_style_slows_a_brisk_walk) {
  const auto walker = WalkerModel::load(kModels + "walker.safetensors");
  ASSERT_TRUE(walker.ok()) << walker.error().message;
  WalkClipOptions options;
  options.seconds = 8;
  options.speed = 1.4f;
  const Clip walk = walk_clip(*walker, options);
  const Rig rig = *Rig::create(walk);
  const auto model = shipped("panache-int8.safetensors");
  for (const char* style : {"old", "depressed", "duck-footed"}) {
    const auto styled = restyle(walk, rig, model, {{*model->find_style(style), {{0, 1}}}});
    EXPECT_LT(restyle_facts(walk, rig, *styled).slide, 0.3f) << style;
  }
}

}  // namespace
}  // namespace panache
