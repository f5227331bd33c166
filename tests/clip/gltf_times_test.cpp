// Times of keys that are not as they should be: before 0, or at another rate than the file says.

#include <algorithm>
#include <cmath>

#include "gltf_checks.h"
#include "odd_files.h"

namespace panache {
namespace {

using test::accessor_floats;
using test::GltfParts;
using test::Json;

// A walk and a wave with keys of every kind, and a sampler of an extension, all of them `seconds`
// later; each animation has times of its own.
GltfParts shifted_character(float seconds) {
  GltfParts parts = test::character();
  add_extension_channel(parts);
  for (size_t a = 0; a < parts.json["animations"].size(); ++a) {
    const size_t count = parts.json["animations"][a]["samplers"].size();
    for (size_t s = 0; s < count; ++s) {
      std::vector<float> times =
          accessor_floats(parts, parts.json["animations"][a]["samplers"][s]["input"]);
      for (float& time : times) time += seconds;
      const size_t moved = parts.add_bounded(times, "SCALAR", 1);  // Moves members of the JSON.
      parts.json["animations"][a]["samplers"][s]["input"] = moved;
    }
  }
  return parts;
}

// The first time of each sampler, of all animations.
std::vector<float> begins(const GltfParts& parts) {
  std::vector<float> out;
  for (const Json& animation : parts.json["animations"]) {
    for (const Json& sampler : animation["samplers"]) {
      out.push_back(accessor_floats(parts, sampler["input"]).front());
      EXPECT_EQ(parts.json["accessors"][sampler["input"].get<size_t>()]["min"][0], out.back());
    }
  }
  return out;
}

bool all_from_zero(const std::string& glb) {
  const std::vector<float> all = begins(test::glb_parts(glb));
  return std::all_of(all.begin(), all.end(), [](float time) { return time >= 0; });
}

TEST(GltfTimes, what_is_written_of_keys_before_zero_begins_at_zero) {
  const auto plain = must_read(test::character());
  for (const float seconds : {-0.5f, -0.001f, -1000.0f}) {
    const auto file = must_read(shifted_character(seconds));
    EXPECT_TRUE(file->is_mended());
    ASSERT_EQ(file->notes().size(), 2u);
    // The poses are as they were; far from zero, floats of times are coarse.
    if (seconds > -1) {
      EXPECT_EQ(file->clip(0).rotations, plain->clip(0).rotations);
      EXPECT_EQ(file->clip(1).frames, plain->clip(1).frames);
    }
    // Unchanged, with an animation changed in its place or beside, and with a new one.
    Clip changed = file->clip(1);
    turn(changed, joint_named(changed, "Spine"), 0.2f);
    const ClipEdit added = {kNewClip, &changed, {}, "new"};
    EXPECT_TRUE(all_from_zero(file->encode({}, EditMode::replace)));
    EXPECT_TRUE(all_from_zero(edited(*file, changed, EditMode::replace, 1)));
    EXPECT_TRUE(all_from_zero(edited(*file, changed, EditMode::add_beside, 1)));
    EXPECT_TRUE(all_from_zero(file->encode({&added, 1}, EditMode::add_first)));
    const GltfParts out = test::glb_parts(file->encode({}, EditMode::replace));
    EXPECT_EQ(begins(out)[0], 0);
    // What was written is sound.
    EXPECT_EQ(must_read(out)->notes().size(), 0u);
  }
}

TEST(GltfTimes, all_samplers_of_an_animation_are_moved_together_and_other_animations_not) {
  GltfParts parts = test::character();
  // The first sampler of the first animation alone begins before 0.
  const size_t early = parts.add_bounded(test::key_times(31, 30, -0.25f), "SCALAR", 1);
  parts.json["animations"][0]["samplers"][0]["input"] = early;
  const auto file = must_read(parts);
  EXPECT_EQ(file->notes(),
            std::vector<std::string>{"walk.glb: animations[0]: expected no key before 0 s, found "
                                     "one at -0.25 s; all keys of this animation are read that "
                                     "much later"});
  const GltfParts out = test::glb_parts(file->encode({}, EditMode::replace));
  const Json& samplers = out.json["animations"][0]["samplers"];
  EXPECT_EQ(accessor_floats(out, samplers[0]["input"]).front(), 0);
  for (size_t s = 1; s < samplers.size(); ++s) {
    EXPECT_EQ(accessor_floats(out, samplers[s]["input"]).front(), 0.25f);
  }
  EXPECT_EQ(out.json["animations"][1], parts.json["animations"][1]);
}

TEST(GltfTimes, two_keys_at_one_time_are_read_one_after_the_other) {
  const auto file = test::odd_file("two-keys-one-time.glb");
  const std::string at =
      ": animations[0]: expected times that increase, found two keys at 1.05 s; "
      "the later of such keys is read as the next instant";
  EXPECT_EQ(file->notes(), std::vector{test::odd_path("two-keys-one-time.glb") + at});
  EXPECT_EQ(file->clip(0).frames, 22);
  EXPECT_NEAR(file->clip(0).frame_time, 0.05, 1e-6);
  // All keys twice, the first ones too.
  GltfParts parts = test::character();
  const std::vector<float> once = {0, 0.1f, 0.2f, 0.3f};
  std::vector<float> times, numbers;
  for (const float time : once) {
    for (int i = 0; i < 2; ++i) {
      times.push_back(time);
      numbers.insert(numbers.end(), {time, 1, 0});
    }
  }
  const size_t input = parts.add_bounded(times, "SCALAR", 1);
  const size_t output = parts.add(numbers, "VEC3", 3);
  Json& animation = parts.json["animations"][0];
  animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}};
  animation["samplers"] = {{{"input", input}, {"output", output}}};
  const auto doubled = parse_gltf(test::to_glb(parts), "walk.glb");
  ASSERT_TRUE(doubled.ok()) << doubled.error().message;
  EXPECT_EQ((*doubled)->notes().size(), 1u);
  const Clip& clip = (*doubled)->clip(0);
  const auto joint =
      static_cast<size_t>(test::find_joint_named(clip, parts.json["nodes"][0]["name"]));
  for (int f = 0; f < clip.frames; ++f) {
    EXPECT_NEAR(clip.pose(f).translations[joint].x, f * clip.frame_time, 1e-4) << f;
  }
}

TEST(GltfTimes, text_keeps_its_form_and_gets_the_new_keys_in_it) {
  const auto file = must_read(test::to_gltf_text(shifted_character(-0.5f)));
  const auto again = must_read(file->encode({}, EditMode::replace));
  EXPECT_EQ(again->notes().size(), 0u);
  EXPECT_EQ(again->clip(0).rotations, file->clip(0).rotations);
}

TEST(GltfTimes, a_file_that_begins_at_zero_or_later_is_left_alone) {
  for (const float seconds : {0.0f, 0.5f}) {
    const GltfParts parts = shifted_character(seconds);
    const auto file = must_read(parts);
    EXPECT_FALSE(file->is_mended());
    EXPECT_EQ(test::glb_parts(file->encode({}, EditMode::replace)).json["animations"],
              parts.json["animations"]);
  }
}

TEST(GltfTimes, a_given_rate_sets_the_frames_and_all_keys_with_them) {
  const auto plain = must_read(test::character());
  const std::string bytes = test::to_glb(shifted_character(0));
  for (const double fps : {60.0, 12.5, 29.97, 240.0}) {
    const auto file = parse_gltf(bytes, "walk.glb", {.fps = fps});
    ASSERT_TRUE(file.ok()) << file.error().message;
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ((*file)->clip(i).frame_time, 1 / fps);
      ASSERT_EQ((*file)->clip(i).frames, plain->clip(i).frames);
    }
    // Keys on frames keep their bits, a spline its course between them.
    EXPECT_EQ((*file)->clip(0).rotations, plain->clip(0).rotations);
    for (int f = 0; f < plain->clip(1).frames; ++f) {
      for (size_t j = 0; j < plain->clip(1).joints(); ++j) {
        EXPECT_LT(angle_between((*file)->clip(1).pose(f).rotations[j],
                                plain->clip(1).pose(f).rotations[j]),
                  1e-5);
      }
    }
    // What is written has the rate for everyone; the extension's sampler, too.
    const GltfParts out = test::glb_parts((*file)->encode({}, EditMode::replace));
    for (const Json& animation : out.json["animations"]) {
      for (const Json& channel : animation["channels"]) {
        const Json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
        const std::vector<float> times = accessor_floats(out, sampler["input"]);
        const bool walk = &animation == &out.json["animations"][0];
        if (times.size() == 1) continue;
        EXPECT_NEAR(times.back(), (walk ? 30 : 60) / fps, 1e-5);
      }
    }
  }
}

TEST(GltfTimes, keys_without_a_rate_keep_their_times_when_one_is_given) {
  // Weights alone: nothing says how many frames lie between their keys.
  GltfParts parts = test::character();
  Json& all = parts.json["animations"];
  Json& wave = all[1];
  Json blink = {{"name", "blink"}};
  for (const Json& channel : wave["channels"]) {
    if (channel["target"]["path"] != "weights") continue;
    blink["samplers"].push_back(wave["samplers"][channel["sampler"].get<size_t>()]);
    blink["channels"].push_back({{"sampler", 0}, {"target", channel["target"]}});
  }
  ASSERT_EQ(blink["channels"].size(), 1u);
  all.push_back(blink);
  const auto file = parse_gltf(test::to_glb(parts), "walk.glb", {.fps = 60});
  ASSERT_TRUE(file.ok()) << file.error().message;
  const GltfParts out = test::glb_parts((*file)->encode({}, EditMode::replace));
  EXPECT_EQ(out.json["animations"][2], blink);
  // And no joint is moved by it.
  for (const Joint& joint : (*file)->clip(2).skeleton.joints) EXPECT_TRUE(joint.still);
}

TEST(GltfTimes, samplers_that_are_wrong_and_unused_do_no_harm) {
  GltfParts parts = shifted_character(-0.5f);
  Json& samplers = parts.json["animations"][0]["samplers"];
  samplers.push_back({{"input", 100000}, {"output", 0}});
  samplers.push_back({{"input", -1}});
  samplers.push_back(7);
  EXPECT_TRUE(all_from_zero([&] {
    GltfParts out = test::glb_parts(must_read(parts)->encode({}, EditMode::replace));
    Json& kept = out.json["animations"][0]["samplers"];
    for (int i = 0; i < 3; ++i) kept.erase(kept.size() - 1);
    return test::to_glb(out);
  }()));
}

}  // namespace
}  // namespace panache
