#include "learn/neutral_bank.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "make_walks.h"

namespace panache {
namespace {

const std::string kShipped = PANACHE_SOURCE_DIR "/models/neutral.safetensors";

std::shared_ptr<const NeutralBank> shipped_bank() { return NeutralBank::load(kShipped).value(); }

Take take_of(const Clip& clip) {
  return make_take(clip, *Rig::create(clip), PoseLayout::positions);
}

LearnPair alone(const Clip& styled) {
  return make_learn_pair({styled, *Rig::create(styled), "bent.bvh"}, *shipped_bank()).value();
}

// Of the neck before the hips, metres; mean over the take.
double lean(const Take& take) {
  double sum = 0;
  for (const HumanPositions& body : take.body) {
    sum += static_cast<double>(body[index(HumanJoint::neck)].z) / take.frames();
  }
  return sum;
}

// Means over a walk's frames of the product of two takes' strides, left foot ahead of right.
double in_step(const Take& a, const Take& b) {
  const auto ahead = [](const HumanPositions& body) {
    return static_cast<double>(body[index(HumanJoint::left_foot)].z -
                               body[index(HumanJoint::right_foot)].z);
  };
  double both = 0, own = 0, other = 0;
  for (int f = 15; f < std::min(a.frames(), b.frames()) - 15; ++f) {
    both += ahead(a.body[f]) * ahead(b.body[f]);
    own += ahead(a.body[f]) * ahead(a.body[f]);
    other += ahead(b.body[f]) * ahead(b.body[f]);
  }
  return both / std::sqrt(own * other);
}

TEST(NeutralBank, the_twin_of_a_bent_walk_is_an_upright_walk_in_step) {
  const Take bent = take_of(test::bent_walk()), upright = take_of(test::neutral_walk());
  const NeutralTwin twin = shipped_bank()->twin(bent);
  EXPECT_TRUE(twin.facts.is_known);
  EXPECT_GE(twin.facts.people, NeutralBank::kMinPeople);
  EXPECT_EQ(twin.tempo, 1);
  ASSERT_EQ(twin.take.frames(), bent.frames());
  // More than half of the bend is told apart from how people differ.
  EXPECT_LT(lean(twin.take) - lean(upright), 0.5 * (lean(bent) - lean(upright)));
  EXPECT_GT(twin.facts.certainty, 0.5);
  EXPECT_GT(in_step(twin.take, bent), 0.9);
}

TEST(NeutralBank, the_twin_has_the_bones_of_the_canonical_body) {
  const Take bent = take_of(test::bent_walk());
  const NeutralTwin twin = shipped_bank()->twin(bent);
  for (const int joint : {7, 8, 11, 12, 14, 15, 18, 19}) {
    const auto bone = [&](const HumanPositions& body) {
      return length(body[joint] - body[kHumanParent[joint]]);
    };
    // Rounding of positions of about a metre.
    EXPECT_NEAR(bone(twin.take.body[40]), bone(bent.body[40]), 1e-5f) << joint;
  }
}

TEST(NeutralBank, the_same_clip_gives_the_same_twin) {
  const Take bent = take_of(test::bent_walk());
  EXPECT_EQ(shipped_bank()->twin(bent).take.pose_features,
            shipped_bank()->twin(bent).take.pose_features);
}

TEST(NeutralBank, a_style_is_learnt_from_a_walk_alone) {
  const LearntStyle learnt = test::learn({alone(test::bent_walk())});
  ASSERT_TRUE(learnt.pairs[0].twin);
  EXPECT_GE(learnt.pairs[0].twin->people, NeutralBank::kMinPeople);
  EXPECT_EQ(learnt.pairs[0].neutral_name, "neutral people");
  EXPECT_TRUE(learnt.pairs[0].warnings.empty()) << learnt.pairs[0].warnings[0];
  EXPECT_LT(format_safetensors(learnt.file).size(), 90000u);
}

TEST(NeutralBank, motion_that_nobody_does_is_told) {
  // A walker who flies up and down as he turns about himself.
  Clip walk = test::bent_walk();
  for (int f = 0; f < walk.frames; ++f) {
    const auto t = static_cast<float>(f) / 30;
    const Pose pose = walk.pose(f);
    pose.rotations[0] = axis_angle(Vec3{0, 1, 0}, 9 * t) * pose.rotations[0];
    pose.translations[0].y += 0.5f * (1 - std::cos(9 * t));
  }
  LearnPair pair = alone(walk);
  EXPECT_FALSE(pair.twin->is_known);
  pair.twin->trust = 1;  // Were what people do as lively as he.
  const LearntStyle learnt = test::learn({pair}, "flying");
  ASSERT_FALSE(learnt.pairs[0].warnings.empty());
  EXPECT_EQ(learnt.pairs[0].warnings[0],
            "bent.bvh: is unlike the neutral motion that is known, so that what differs from it is "
            "not style alone; give a neutral clip of the action");
}

// Crouches in a guard and punches: once with the right, or with both fists in turn, twice a second.
Clip punch(bool once) {
  using enum HumanJoint;
  Clip clip = test::neutral_walk(3);
  const Pose first = clip.pose(30);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    if (f != 30) std::ranges::copy(first.rotations, pose.rotations.begin());
    pose.translations[0] = first.translations[0];
    const auto turn = [&](HumanJoint joint, Vec3 axis, float angle) {
      pose.rotations[index(joint)] = axis_angle(axis, angle);
    };
    const float t = static_cast<float>(f) / 30, away = (t - 1.5f) / 0.25f;
    const float right = once ? std::exp(-away * away) : (1 + std::sin(12.6f * t)) / 2;
    const float left = once ? 0 : 1 - right;
    turn(spine, {1, 0, 0}, 0.4f);
    turn(left_upper_leg, {1, 0, 0}, -0.7f), turn(right_upper_leg, {1, 0, 0}, -0.5f);
    turn(left_lower_leg, {1, 0, 0}, 0.9f), turn(right_lower_leg, {1, 0, 0}, 0.9f);
    turn(left_upper_arm, {0, 1, 0}, -1.3f), turn(right_upper_arm, {0, 1, 0}, 1.3f);
    turn(left_lower_arm, {0, 1, 0}, -2.4f * (1 - left));
    turn(right_lower_arm, {0, 1, 0}, 2.4f * (1 - right));
  }
  return clip;
}

TEST(NeutralBank, beside_people_who_stand_punches_are_no_style) {
  const LearnPair pair = alone(punch(false));
  EXPECT_EQ(pair.twin->trust, 0);
  EXPECT_EQ(pair.twin->certainty, 0);
  const LearntStyle learnt = test::learn({pair}, "punch");
  ASSERT_FALSE(learnt.pairs[0].warnings.empty());
  EXPECT_EQ(
      learnt.pairs[0].warnings[0],
      "bent.bvh: is unlike the neutral motion that is known, so that only 0 % of what differs "
      "from it counts as style; give a neutral clip of the action");
  // Nothing changes, up to the rounding of 16 bits.
  EXPECT_NEAR(learnt.held_back_cm, learnt.untouched_cm, 0.05);
  EXPECT_STREQ(learnt.verdict(), "poor");
}

LearntStyle learn_trusting(LearnPair pair, double trust) {
  pair.twin->trust = trust;
  return test::learn({pair});
}

TEST(NeutralBank, as_much_is_learnt_as_is_trusted) {
  const LearnPair pair = alone(test::bent_walk());
  EXPECT_EQ(pair.twin->trust, 1);
  const auto gain = [&](double trust) {
    const LearntStyle learnt = learn_trusting(pair, trust);
    return learnt.untouched_cm - learnt.held_back_cm;
  };
  const double whole = gain(1);
  EXPECT_GT(whole, 1);
  EXPECT_NEAR(gain(0.5), whole / 2, 0.15 * whole);  // Joints move along arcs.
}

TEST(NeutralBank, what_an_action_does_that_is_not_trusted_is_no_gesture) {
  const LearnPair pair = alone(punch(true));
  EXPECT_FALSE(learn_trusting(pair, 1).gestures.empty());
  EXPECT_TRUE(learn_trusting(pair, 0.9).gestures.empty());
}

TEST(NeutralBank, a_damaged_file_is_rejected_with_its_tensor) {
  const TensorFile good = parse_safetensors(read_file(kShipped).value(), "bank").value();
  const auto message = [&](auto&& damage) {
    TensorFile file = good;
    damage(file);
    const auto bank = NeutralBank::parse(format_safetensors(file), "bank");
    return bank ? std::string() : bank.error().message;
  };
  EXPECT_EQ(message([](TensorFile&) {}), "");
  EXPECT_EQ(message([](TensorFile& file) { file.metadata["format"] = "panache"; }),
            "bank: is no bank of neutral motion; expected metadata 'format' to be "
            "'panache-neutral'");
  EXPECT_EQ(message([](TensorFile& file) { file.tensors.erase("people"); }),
            "bank: tensor 'people' is missing");
  EXPECT_EQ(message([](TensorFile& file) {
              file.tensors["mean"].shape = {488, 1};
            }),
            "bank: tensor 'mean' has shape [488, 1]; expected [any, 488]");
  EXPECT_EQ(message([](TensorFile& file) { file.tensors["known"].values[0] = std::nanf(""); }),
            "bank: tensor 'known' holds a number that is not finite (number 0)");
  EXPECT_EQ(message([](TensorFile& file) {
              Tensor& people = file.tensors["people"];
              people.shape[0] -= 1;
              people.values.resize(people.values.size() - 8);
            }),
            "bank: its tensors do not belong together; get the file again");
}

}  // namespace
}  // namespace panache
