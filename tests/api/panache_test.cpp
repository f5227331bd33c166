// The C interface: what it promises in panache.h, through the shared library.
#include "panache/panache.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "stick_api.h"

namespace {

using panache::test::created;
using panache::test::model_bytes;
using panache::test::model_of;
using panache::test::Owned;
using panache::test::rejection;
using panache::test::report_of;
using panache::test::text_of;
using panache::test::Walk;
using Api = panache::test::StickApi;

TEST_F(Api, knows_its_styles_by_name_and_place) {
  const panache_model* model = model_.get();
  const int count = panache_model_style_count(model);
  ASSERT_GT(count, 1);
  for (int i = 0; i < count; ++i) EXPECT_EQ(style_of(panache_model_style_name(model, i)), i);
  EXPECT_EQ(style_of("no such style"), -1);
  EXPECT_EQ(panache_model_style_name(model, -1), nullptr);
  EXPECT_EQ(panache_model_style_name(model, count), nullptr);
  EXPECT_EQ(panache_version(), 200);
}

TEST_F(Api, finds_the_humanoid_in_the_skeleton) {
  EXPECT_EQ(panache_skeleton_joint_count(skeleton_.get()), STICK_JOINTS);
  const std::pair<const char*, int> kJoints[] = {
      {"hips", 0}, {"leftHand", 7}, {"rightToes", 18}, {"leftShoulder", -1}, {"tail", -1}};
  for (const auto& [name, joint] : kJoints) {
    EXPECT_EQ(panache_skeleton_find(skeleton_.get(), name), joint) << name;
  }
}

TEST_F(Api, strength_zero_is_the_input_bit_for_bit_and_one_is_not) {
  panache_character* plain = character();
  panache_character* old = character("old");
  std::vector<stick_pose> input(60);
  for (int f = 0; f < 60; ++f) stick_walk(f / 60.0, 0, &input[f]);
  EXPECT_TRUE(same(walk(plain, 60), input));
  EXPECT_FALSE(same(walk(old, 60), input));
  const panache_report report = report_of(old);
  EXPECT_GT(report.rate, 0.5);
  EXPECT_LT(report.rate, 2);
  EXPECT_GE(report.gate, 0);
  EXPECT_LE(report.gate, 1);
}

TEST_F(Api, many_at_once_are_the_same_as_one_after_another) {
  std::vector<panache_character*> one, all;
  for (int i = 0; i < 5; ++i) {
    const char* style = panache_model_style_name(model_.get(), i);
    one.push_back(character(style));
    all.push_back(character(style));
  }
  for (int f = 0; f < 60; ++f) {
    std::vector<stick_pose> poses(5), expected(5);
    std::vector<panache_input_pose> in;
    std::vector<panache_output_pose> out;
    for (int i = 0; i < 5; ++i) {
      stick_walk(f / 60.0, i * 0.2, &poses[i]);
      panache_character_step(one[i], stick_input(&poses[i]), 1 / 60.0, stick_output(&expected[i]));
      in.push_back(stick_input(&poses[i]));
      out.push_back(stick_output(&poses[i]));
    }
    panache_step_many(all.data(), 5, in.data(), 1 / 60.0, out.data());
    ASSERT_TRUE(same(poses, expected)) << "frame " << f;
  }
}

TEST_F(Api, a_crowd_may_be_of_any_size) {
  constexpr int kMany = 520;
  std::vector<panache_character*> all;
  for (int i = 0; i < kMany; ++i) all.push_back(character("old"));
  panache_character* alone = character("old");
  for (int f = 0; f < 3; ++f) {
    stick_pose in, expected;
    stick_walk(f / 60.0, 0, &in);
    panache_character_step(alone, stick_input(&in), 1 / 60.0, stick_output(&expected));
    std::vector<stick_pose> poses(kMany);
    const std::vector<panache_input_pose> from(kMany, stick_input(&in));
    std::vector<panache_output_pose> to;
    for (stick_pose& pose : poses) to.push_back(stick_output(&pose));
    panache_step_many(all.data(), kMany, from.data(), 1 / 60.0, to.data());
    ASSERT_TRUE(same(poses, std::vector<stick_pose>(kMany, expected))) << "frame " << f;
  }
}

TEST_F(Api, characters_outlive_model_and_skeleton_handles) {
  panache_character* old = character("old");
  model_.reset(), skeleton_.reset();
  EXPECT_EQ(walk(old, 30).size(), 30u);
}

TEST_F(Api, a_reset_character_starts_afresh) {
  panache_character* old = character("old");
  // So short a walk that its beginning again is no jump, which would be forgotten anyway.
  const std::vector<stick_pose> first = walk(old, 3);
  EXPECT_FALSE(same(walk(old, 3), first));
  panache_character_reset(old);
  EXPECT_TRUE(same(walk(old, 3), first));
}

TEST_F(Api, a_saved_state_goes_back_and_a_damaged_one_is_rejected) {
  panache_character* old = character("old");
  walk(old, 40);
  std::vector<char> state(panache_character_state_size(old));
  panache_character_save(old, state.data());
  const std::vector<stick_pose> first = walk(old, 40, 0.5);
  ASSERT_EQ(panache_character_restore(old, state.data(), state.size()), PANACHE_OK);
  EXPECT_TRUE(same(walk(old, 40, 0.5), first));
  state[20] ^= 1;
  EXPECT_EQ(panache_character_restore(old, state.data(), state.size()), PANACHE_BAD_STATE);
  EXPECT_NE(std::string(panache_last_error()).find("of a state saved by a character"),
            std::string::npos);
}

TEST_F(Api, bad_poses_and_clocks_never_give_bad_poses) {
  panache_character* old = character("old");
  panache_character_set_strength(old, 0, NAN);
  panache_character_set_strength(old, -1, 1);
  panache_character_set_strength(old, 1000, 1);
  const float bad[] = {NAN, INFINITY, -INFINITY, 1e30f, std::numeric_limits<float>::denorm_min()};
  const double clocks[] = {0, -1, 1e-9, 1e9, NAN, INFINITY, 1 / 60.0};
  for (int f = 0; f < 700; ++f) {
    stick_pose in, out;
    stick_walk(f / 60.0, 0, &in);
    if (f % 3) in.rotations[f % STICK_JOINTS][f % 4] = bad[f % 5];
    if (f % 5) in.translations[f % STICK_JOINTS][f % 3] = bad[(f + 1) % 5];
    panache_character_step(old, stick_input(&in), clocks[f % 7], stick_output(&out));
    for (const auto& q : out.rotations) {
      const double square =
          double(q[0]) * q[0] + double(q[1]) * q[1] + double(q[2]) * q[2] + double(q[3]) * q[3];
      ASSERT_NEAR(square, 1, 0.25) << "frame " << f;
    }
    for (const auto& t : out.translations) {
      for (const float v : t) ASSERT_TRUE(std::isfinite(v)) << "frame " << f;
    }
  }
}

TEST_F(Api, what_is_wrong_is_said_in_a_message_and_nothing_is_created) {
  const std::string message = rejection<panache_model>(
      PANACHE_BAD_MODEL, [](auto** out) { return panache_model_create("no model", 8, out); });
  EXPECT_TRUE(message.starts_with("model: ")) << message;

  using Joints = std::vector<panache_joint>;
  const Joints figure(stick_figure, stick_figure + STICK_JOINTS);
  const auto of_joints = [&](int32_t count, void (*change)(Joints&)) {
    Joints joints = figure;
    change(joints);
    return rejection<panache_skeleton>(PANACHE_BAD_SKELETON, [&](auto** out) {
      return panache_skeleton_create(joints.data(), count, nullptr, out);
    });
  };
  constexpr struct {
    const char* message;
    void (*change)(Joints&);
  } kJoints[] = {
      {"parent is 5; expected a joint before it, or -1", [](Joints& j) { j[3].parent = 5; }},
      {"parent is 3; expected a joint before it, or -1", [](Joints& j) { j[3].parent = 3; }},
      {"parent is -2; expected a joint before it, or -1", [](Joints& j) { j[3].parent = -2; }},
      {"its rest rotation is not a unit quaternion (x, y, z, w)",
       [](Joints& j) { j[3].rotation[3] = 0; }},
      {"its rest translation is not finite", [](Joints& j) { j[3].translation[1] = NAN; }},
  };
  for (const auto& row : kJoints) {
    EXPECT_EQ(of_joints(STICK_JOINTS, row.change), "joint 3 'Neck': " + std::string(row.message));
  }
  const auto none = [](Joints&) {};
  EXPECT_TRUE(of_joints(5, none).starts_with("no humanoid found: leftHand, rightHand"));
  for (const int32_t count : {0, 10'001}) {
    EXPECT_EQ(of_joints(count, none), std::to_string(count) + " joints; expected 1 to 10000");
  }

  using Options = panache_skeleton_options;
  constexpr struct {
    const char* message;
    void (*change)(Options&);
  } kOptions[] = {
      {"expected an up axis from +X to -Z, found 'up'", [](Options& o) { o.up_axis = "up"; }},
      {"expected metres per unit above 0, found -1.000000",
       [](Options& o) { o.metres_per_unit = -1; }},
      {"-1 poses; expected 0 to 10000", [](Options& o) { o.pose_count = -1; }},
      {"10001 poses; expected 0 to 10000", [](Options& o) { o.pose_count = 10'001; }},
  };
  for (const auto& row : kOptions) {
    Options options = PANACHE_SKELETON_OPTIONS;
    row.change(options);
    EXPECT_EQ(rejection<panache_skeleton>(PANACHE_BAD_ARGUMENT,
                                          [&](auto** out) {
                                            return panache_skeleton_create(
                                                figure.data(), STICK_JOINTS, &options, out);
                                          }),
              row.message);
  }
  panache_character_destroy(nullptr);
}

TEST_F(Api, character_options_out_of_their_range_are_rejected) {
  using Options = panache_character_options;
  constexpr struct {
    const char* message;
    void (*change)(Options&);
  } kOptions[] = {
      {"stylizer option of -1.000000 seconds; expected 0 to 10",
       [](Options& o) { o.ease_seconds = -1; }},
      {"max_lag of -1.000000 seconds; expected 0 to 4 seconds", [](Options& o) { o.max_lag = -1; }},
      {"max_speed of -1.000000 m/s; expected more than 0", [](Options& o) { o.max_speed = -1; }},
      {"max_speed of ", [](Options& o) { o.max_speed = NAN; }},
      {"gesture rate of ", [](Options& o) { o.gesture_rate = -1; }},
  };
  for (const auto& row : kOptions) {
    Options options = PANACHE_CHARACTER_OPTIONS;
    row.change(options);
    const std::string message = rejection<panache_character>(PANACHE_BAD_ARGUMENT, [&](auto** out) {
      return panache_character_create(model_.get(), skeleton_.get(), &options, out);
    });
    EXPECT_TRUE(message.starts_with(row.message)) << message;
  }
}

TEST_F(Api, a_character_may_be_late_and_says_by_how_much) {
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.max_lag = 0.5;
  options.max_lead = 0.25;
  panache_character* timed = character("childlike", 1, &options);
  panache_character* again = character("childlike", 1, &options);
  panache_character* plain = character("childlike");
  walk(timed, 600);
  walk(plain, 600);
  EXPECT_NE(report_of(timed).ahead, 0);
  EXPECT_GE(report_of(timed).ahead, -0.5);
  EXPECT_LE(report_of(timed).ahead, 0.25);
  EXPECT_EQ(report_of(plain).ahead, 0);

  // Beside others in a crowd he has the same time.
  panache_character* const crowd[] = {plain, again, plain};
  for (int f = 0; f < 600; ++f) {
    stick_pose in, out[3];
    stick_walk(f / 60.0, 0, &in);
    const panache_input_pose from[] = {stick_input(&in), stick_input(&in), stick_input(&in)};
    const panache_output_pose to[] = {stick_output(&out[0]), stick_output(&out[1]),
                                      stick_output(&out[2])};
    panache_step_many(crowd, 3, from, 1 / 60.0, to);
  }
  EXPECT_EQ(report_of(again).ahead, report_of(timed).ahead);
}

TEST_F(Api, a_limit_of_speed_tells_a_jump_from_a_vehicle) {
  const auto ride = [&](double max_speed) {
    panache_character_options options = PANACHE_CHARACTER_OPTIONS;
    EXPECT_EQ(options.max_speed, 15);
    options.max_speed = max_speed;
    panache_character* one = character("OLD", 1, &options);
    std::vector<stick_pose> out(90);
    for (int f = 0; f < 90; ++f) {
      stick_pose in;
      stick_walk(f / 60.0, 0, &in);
      // Of whatever unit: far beyond 15 m/s.
      in.translations[0][0] += 3000.0f * static_cast<float>(f) / 60;
      panache_character_step(one, stick_input(&in), 1 / 60.0,
                             stick_output(&out[static_cast<size_t>(f)]));
    }
    return out;
  };
  EXPECT_TRUE(same(ride(0), ride(INFINITY)));
  EXPECT_TRUE(same(ride(0), ride(1e5)));
  EXPECT_FALSE(same(ride(0), ride(15)));
}

TEST_F(Api, every_prefix_of_a_model_is_rejected) {
  const std::string bytes = model_bytes();
  for (size_t size = 0; size < bytes.size(); size += 1 + size / 2) {
    panache_model* model = nullptr;
    EXPECT_EQ(panache_model_create(bytes.data(), size, &model), PANACHE_BAD_MODEL) << size;
  }
}

TEST_F(Api, two_threads_style_two_characters_of_one_model) {
  panache_character* one = character("old");
  panache_character* other = character("proud");
  std::vector<stick_pose> first, second;
  std::thread a([&] { first = walk(one, 200); }), b([&] { second = walk(other, 200); });
  a.join();
  b.join();
  panache_character_reset(one);
  panache_character_reset(other);
  EXPECT_TRUE(same(walk(one, 200), first));
  EXPECT_TRUE(same(walk(other, 200), second));
}

TEST_F(Api, learns_a_style_from_a_pair_of_clips) {
  const Walk neutral = clip(180), bent = clip(180, true);
  const panache_pair pair = {neutral.clip, bent.clip};
  const auto learn = [&](const std::string& model, int replace) {
    return [&, replace](panache_learnt** out) {
      return panache_learn(model.data(), model.size(), &pair, 1, "bent", replace, out);
    };
  };
  const std::string bytes = model_bytes();
  const Owned<panache_learnt> learnt = created<panache_learnt>(learn(bytes, 0));
  panache_learnt_report report = PANACHE_LEARNT_REPORT;
  ASSERT_EQ(panache_learnt_get_report(learnt.get(), &report), PANACHE_OK);
  EXPECT_EQ(report.was_tested, 1);
  EXPECT_STREQ(report.warnings, "");
  EXPECT_LT(report.held_back_cm, 0.25 * report.untouched_cm);
  EXPECT_STREQ(panache_learnt_verdict(learnt.get()), "good");

  const std::string with_it = text_of(learnt);
  const int own_styles = panache_model_style_count(model_.get());
  model_ = model_of(with_it);
  EXPECT_EQ(style_of("bent"), own_styles);
  panache_character* learner = character("bent");
  std::vector<stick_pose> out = walk(learner, 120);
  // The joint that was bent is, by nearly as much.
  EXPECT_NEAR(out.back().rotations[1][0], std::sin(0.2f), 0.06);
  EXPECT_GT(report_of(learner).gate, 0.9f);

  // The same again, in the same bytes; and the name is taken now.
  EXPECT_EQ(text_of(created<panache_learnt>(learn(bytes, 0))), with_it);
  EXPECT_EQ(rejection<panache_learnt>(PANACHE_BAD_ARGUMENT, learn(with_it, 0)),
            "the model has a style 'bent' already; give another name, or replace it");
  EXPECT_TRUE(created<panache_learnt>(learn(with_it, 1)));
}

TEST_F(Api, learns_a_style_from_one_clip) {
  const std::string bytes = model_bytes();
  const Walk bent = clip(180, true);
  const auto learn = [&](const std::string& bank) {
    return [&](panache_learnt** out) {
      return panache_learn_alone(bytes.data(), bytes.size(), bank.data(), bank.size(), &bent.clip,
                                 "bent", 0, out);
    };
  };
  const std::string bank = panache::test::file_bytes("neutral.safetensors");
  const Owned<panache_learnt> learnt = created<panache_learnt>(learn(bank));
  panache_learnt_report report = PANACHE_LEARNT_REPORT;
  ASSERT_EQ(panache_learnt_get_report(learnt.get(), &report), PANACHE_OK);
  EXPECT_GE(report.people, 5);
  EXPECT_GT(report.certainty, 0);
  EXPECT_LT(report.certainty, 1);
  EXPECT_EQ(rejection<panache_learnt>(PANACHE_BAD_CLIP, learn(bytes)),
            "the bank of neutral motion: is no bank of neutral motion; expected metadata "
            "'format' to be 'panache-neutral'");
}

TEST_F(Api, says_why_it_cannot_learn) {
  const Walk neutral = clip(180), brief = clip(12, true);
  panache_pair pair = {neutral.clip, brief.clip};
  const auto message = [&](panache_status status, const std::string& model, int pairs) {
    return rejection<panache_learnt>(status, [&](auto** out) {
      return panache_learn(model.data(), model.size(), &pair, pairs, "bent", 0, out);
    });
  };
  const std::string bytes = model_bytes();
  EXPECT_EQ(message(PANACHE_BAD_CLIP, bytes, 0),
            "there is nothing to learn 'bent' from; give a neutral and a styled clip");
  EXPECT_EQ(message(PANACHE_BAD_CLIP, bytes, 1),
            "pair 1, styled: has 0.20 s of motion; a style is learnt from 0.50 s at least, "
            "better from 2 to 3 s; give a longer clip");
  message(PANACHE_BAD_MODEL, "x", 1);
  pair.neutral.translations = nullptr;
  EXPECT_EQ(message(PANACHE_BAD_CLIP, bytes, 1),
            "pair 1, neutral: poses need both rotations and translations");
}

}  // namespace
