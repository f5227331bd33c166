#include "takes/signature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_styled_takes.h"

namespace panache {
namespace {

using enum HumanJoint;

size_t trait(const std::string& key) {
  for (size_t t = 0; t < kTraits.size(); ++t) {
    if (kTraits[t].key == key) return t;
  }
  ADD_FAILURE() << key;
  return 0;
}

// The walk with each body changed.
template <typename Change>
Take changed(Take take, const Change& change) {
  for (HumanPositions& body : take.body) change(body);
  return take;
}

TEST(Traits, each_tells_what_it_is_called_after) {
  const Take walk = test::styled_take("neutral", "walk", 0);
  const Traits before = traits(walk);
  const auto difference = [&](const std::string& key, const auto& change) {
    return traits(changed(walk, change))[trait(key)] - before[trait(key)];
  };
  EXPECT_NEAR(difference("stance", [](HumanPositions& body) { body[index(left_foot)].x += 0.05f; }),
              5, 0.01);
  EXPECT_NEAR(difference("hands",
                         [](HumanPositions& body) {
                           body[index(left_hand)].y += 0.1f;
                           body[index(right_hand)].y += 0.2f;
                         }),
              15, 0.01);
  EXPECT_GT(difference("head", [](HumanPositions& body) { body[index(head)].z += 0.05f; }), 5);
  EXPECT_GT(difference("lean", [](HumanPositions& body) { body[index(neck)].z += 0.1f; }), 5);
  EXPECT_LT(difference("lean", [](HumanPositions& body) { body[index(neck)].z -= 0.1f; }), -5);
  const auto straight = [](HumanJoint upper, HumanJoint middle, HumanJoint end) {
    return [=](HumanPositions& body) {
      body[index(end)] = body[index(middle)] * 2.0f - body[index(upper)];
    };
  };
  const Take no_knees = changed(changed(walk, straight(left_upper_leg, left_lower_leg, left_foot)),
                                straight(right_upper_leg, right_lower_leg, right_foot));
  EXPECT_GT(before[trait("knees")], 1);
  EXPECT_NEAR(traits(no_knees)[trait("knees")], 0, 0.2);
  const Take no_elbows = changed(changed(walk, straight(left_upper_arm, left_lower_arm, left_hand)),
                                 straight(right_upper_arm, right_lower_arm, right_hand));
  EXPECT_NEAR(traits(no_elbows)[trait("elbows")], 0, 0.2);
}

TEST(Traits, speed_is_a_percentage_and_sharpness_is_beyond_it) {
  const Take walk = test::styled_take("neutral", "walk", 0);
  // Hands that move ten times as far: speeds and jerks far above what counts as rest.
  const auto swung = [&](float factor) {
    return changed(walk, [&](HumanPositions& body) {
      for (const HumanJoint hand : {left_hand, right_hand}) body[index(hand)].z *= factor;
    });
  };
  const Traits ten = traits(swung(10)), twenty = traits(swung(20));
  EXPECT_NEAR(twenty[trait("speed")] - ten[trait("speed")], 100 * std::log(2), 4);
  EXPECT_NEAR(twenty[trait("sharpness")] - ten[trait("sharpness")], 0, 4);
  Take trembling = walk;
  for (int f = 0; f < walk.frames(); f += 2) trembling.body[f][index(left_hand)].y += 0.02f;
  EXPECT_GT(traits(trembling)[trait("sharpness")], traits(walk)[trait("sharpness")] + 20);
}

class SignaturesTest : public testing::Test {
 protected:
  // Bent forward and leant back, in two actions.
  SignaturesTest() : takes_(test::styled_takes({"neutral", "old", "proud"}, {0, 1})) {
    std::vector<int> styled, neutral;
    for (size_t i = 0; i < takes_.size(); ++i) {
      (takes_[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
    }
    pairings_ = pair_takes(takes_, styled, neutral);
  }
  std::vector<Take> takes_;
  std::vector<Pairing> pairings_;
};

TEST_F(SignaturesTest, what_the_actions_of_a_style_agree_on_is_certain) {
  const Signatures signatures(takes_, pairings_);
  ASSERT_NE(signatures.find("old"), nullptr);
  EXPECT_EQ(signatures.find("neutral"), nullptr);
  const Signature &old = *signatures.find("old"), &proud = *signatures.find("proud");
  EXPECT_TRUE(old.certain[trait("lean")]);
  EXPECT_TRUE(proud.certain[trait("lean")]);
  EXPECT_NEAR(old.change[trait("lean")], 0.5 * 57.3, 12);  // The spine bends, not the hips.
  EXPECT_LT(proud.change[trait("lean")], -10);
  EXPECT_FALSE(old.certain[trait("knees")]);  // Nobody bent them.
  EXPECT_FALSE(old.certain[kTempoTrait]);     // And everybody kept the tempo.
}

TEST_F(SignaturesTest, an_action_without_a_neutral_take_does_not_count) {
  for (Take& take : takes_) {
    if (take.row.style == "old" && take.row.content == takes_[0].row.content) {
      take.row.content = "handstand";
    }
  }
  const Signatures signatures(takes_, pairings_);
  // One action is left, which nothing agrees with.
  EXPECT_EQ(signatures.find("old"), nullptr);
  EXPECT_NE(signatures.find("proud"), nullptr);
}

// The signature of a style that leans forward by so much in each of its actions, and takes 1.2
// seconds for each second of the neutral motion.
Signature of_leans(const std::vector<float>& leans) {
  const Take walk = test::styled_take("neutral", "walk", 0);
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
  for (size_t i = 0; i < leans.size(); ++i) {
    takes.push_back(walk);
    takes.push_back(changed(walk, [&](HumanPositions& body) { body[index(neck)].z += leans[i]; }));
    takes.back().row.neutral = false;
    takes.back().row.style = "old";
    for (Take* take : {&takes[2 * i], &takes[2 * i + 1]}) {
      take->row.content = "action " + std::to_string(i);
    }
    const int neutral = static_cast<int>(2 * i);
    pairings.push_back({neutral + 1, neutral, 0, {0, 1}, {1 / 1.2f, 1 / 1.2f}, 0});
  }
  return *Signatures(takes, pairings).find("old");
}

TEST(Signatures, three_actions_of_four_are_enough_to_be_certain) {
  const size_t lean = trait("lean");
  const Signature max = of_leans({0.2f, 0.2f, 0.2f, -0.05f});
  EXPECT_TRUE(max.certain[lean]);
  EXPECT_FALSE(of_leans({0.3f, 0.3f, -0.05f, -0.05f}).certain[lean]);
  EXPECT_FALSE(of_leans({0.01f, 0.01f, 0.01f, 0.01f}).certain[lean]) << "too little";
  EXPECT_TRUE(of_leans({-0.2f, -0.2f, -0.2f, 0.05f}).certain[lean]);
  // They agree on the tempo, too, and not to the digit on how far they lean.
  EXPECT_NEAR(max.change[kTempoTrait], -100 * std::log(1.2), 1e-4);
  EXPECT_NEAR(max.deviation[kTempoTrait], 0, 1e-4);
  EXPECT_TRUE(max.certain[kTempoTrait]);
  EXPECT_GT(max.deviation[lean], 5);
}

TEST_F(SignaturesTest, outputs_are_told_by_sign_and_amount) {
  Signature signature;
  signature.change = {10, 10, 10};
  signature.certain = {true, true, true};
  SignatureMatch match;
  // Right; right but too little; too little to count; and what nobody is certain of.
  match.add(signature, {12, 4, 0.2, -30});
  EXPECT_EQ(match.traits, 3u);
  EXPECT_DOUBLE_EQ(match.sign_share(), 2 / 3.0);
  EXPECT_DOUBLE_EQ(match.amount_share(), 1 / 3.0);
  match.add(signature, {-10, 10, 10});
  EXPECT_DOUBLE_EQ(match.sign_share(), 4 / 6.0);
  EXPECT_DOUBLE_EQ(match.mean_change()[0], 1);
  // Half and double are right still.
  SignatureMatch ends;
  ends.add(signature, {5, 20, 4.9});
  EXPECT_EQ(ends.amount, 2u);
  ends.add(signature, {5, 20.1, 10});
  EXPECT_EQ(ends.amount, 4u);
  EXPECT_TRUE(std::isnan(SignatureMatch().sign_share()));
}

}  // namespace
}  // namespace panache
