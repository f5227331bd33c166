// Characters stepped together: the bits that each gets alone.

#include "style/stylizer.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "allocations.h"
#include "make_clip.h"
#include "make_model.h"
#include "style_checks.h"
#include "net/layer.h"
#include "style/model/person.h"

namespace panache {
namespace {

constexpr double kSeconds = 1 / 60.0;

// The last two have all that a model may: a gate, reduced heads, a learnt style and persons.
enum class Kind { floats, bytes, gated, smith2019, rich, rich_bytes };
constexpr Kind kKinds[] = {Kind::floats,    Kind::bytes, Kind::gated,
                           Kind::smith2019, Kind::rich,  Kind::rich_bytes};

std::shared_ptr<const Model> make_model(Kind kind) {
  TensorFile file = test::make_model({"old", "proud"}, 3,
                                     kind == Kind::smith2019 ? test::kSmith2019 : test::kPanache);
  const bool is_rich = kind == Kind::rich || kind == Kind::rich_bytes;
  if (kind == Kind::gated || is_rich) test::add_gate(file, 1.5f);
  if (is_rich) {
    test::reduce_heads(file, 0.3f);
    test::add_learnt(file, 0, "limping", "a take");
    test::add_persons(file);
  }
  if (kind == Kind::bytes || kind == Kind::rich_bytes) file = quantize(file);
  return read(file);
}

// A character with a motion of its own, and where its styled poses go.
struct Actor {
  Actor(const std::shared_ptr<const Model>& model, const Clip& clip_, int start_,
        std::vector<float> strengths_)
      : clip(clip_),
        start(start_),
        strengths(std::move(strengths_)),
        stylizer(*Stylizer::create(model, *Rig::create(clip))),
        rotations(clip.joints()),
        translations(clip.joints()) {
    strengths.resize(model->styles().size(), 0.4f);
    // Every third is nobody.
    const auto seed = static_cast<uint32_t>(start);
    if (model->persons() && seed % 3) stylizer.set_person(person_of_seed(*model, seed, 1));
    // Some have one pass, some two.
    if (start % 3 == 1) stylizer.set_side(0, -1);
    if (start % 3 == 2) stylizer.set_side(1, 0.3f);
  }

  ConstPose in(int step) const { return clip.pose((start + step) % clip.frames); }
  CrowdMember member(int step) {
    return {&stylizer, in(step), strengths, {rotations, translations}};
  }
  std::vector<std::byte> state() const {
    std::vector<std::byte> bytes(stylizer.state_size());
    stylizer.save(bytes);
    return bytes;
  }

  Clip clip;
  int start;
  std::vector<float> strengths;
  Stylizer stylizer;
  std::vector<Quat> rotations;
  std::vector<Vec3> translations;
};

bool same_pose(const Actor& a, const Actor& b) {
  return std::memcmp(a.rotations.data(), b.rotations.data(), a.rotations.size() * sizeof(Quat)) ==
             0 &&
         std::memcmp(a.translations.data(), b.translations.data(),
                     a.translations.size() * sizeof(Vec3)) == 0;
}

// Steps a crowd together and its twin one after another, and compares poses and memories.
void expect_same(std::vector<Actor> together, int steps) {
  std::vector<Actor> alone = together;
  for (int step = 0; step < steps; ++step) {
    std::vector<CrowdMember> members;
    for (Actor& actor : together) members.push_back(actor.member(step));
    step_crowd(members, kSeconds);
    for (size_t i = 0; i < alone.size(); ++i) {
      Actor& actor = alone[i];
      actor.stylizer.step(actor.in(step), actor.strengths, kSeconds,
                          {actor.rotations, actor.translations});
      ASSERT_TRUE(same_pose(together[i], actor)) << "character " << i << ", step " << step;
    }
    // Some begin anew in the middle, each at another step.
    const size_t fresh = static_cast<size_t>(step) % (3 * together.size());
    if (fresh < together.size()) together[fresh].stylizer.reset(), alone[fresh].stylizer.reset();
  }
  for (size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(together[i].state(), alone[i].state()) << i;
}

std::vector<Actor> crowd_of(std::shared_ptr<const Model> model, size_t count) {
  const Clip slow = test::walking_clip(120, 60);
  const Clip fast = test::walking_clip(90, 30);
  const std::vector<float> strengths[] = {{1, 0}, {0, 1}, {0.5f, -0.7f}, {0, 0}, {3, 2}};
  std::vector<Actor> actors;
  for (size_t i = 0; i < count; ++i) {
    actors.emplace_back(model, i % 3 ? slow : fast, static_cast<int>(7 * i), strengths[i % 5]);
  }
  return actors;
}

TEST(Crowd, each_character_has_the_bits_that_it_has_alone_whatever_the_size_of_the_crowd) {
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    const auto model = make_model(kind);
    for (size_t count = 1; count <= 17; ++count) expect_same(crowd_of(model, count), 8);
    expect_same(crowd_of(model, 9), 60);
  }
}

TEST(Crowd, characters_of_different_models_may_stand_side_by_side) {
  std::vector<Actor> actors;
  for (const Kind kind : {Kind::floats, Kind::bytes, Kind::floats, Kind::smith2019}) {
    for (Actor& actor : crowd_of(make_model(kind), 3)) actors.push_back(std::move(actor));
  }
  std::swap(actors[1], actors[7]);
  expect_same(std::move(actors), 20);
}

TEST(Crowd, a_pose_that_is_not_finite_is_its_characters_own_affair) {
  for (const Kind kind : {Kind::floats, Kind::bytes, Kind::gated, Kind::rich}) {
    std::vector<Actor> actors = crowd_of(make_model(kind), 10);
    for (Quat& q : actors[2].clip.rotations) q.x = std::nanf("");
    for (Vec3& t : actors[6].clip.translations) t.y = std::numeric_limits<float>::infinity();
    actors[4].strengths[0] = std::nanf("");
    expect_same(std::move(actors), 20);
  }
}

TEST(Crowd, a_character_that_comes_twice_is_stepped_twice) {
  std::vector<Actor> together = crowd_of(make_model(Kind::floats), 3), alone = together;
  const auto member = [](Actor& actor, int step) { return actor.member(step); };
  const CrowdMember members[] = {member(together[0], 0), member(together[1], 0),
                                 member(together[0], 1), member(together[2], 0),
                                 member(together[0], 2)};
  step_crowd(members, kSeconds);
  for (const auto& [i, step] : {std::pair{0, 0}, {1, 0}, {0, 1}, {2, 0}, {0, 2}}) {
    const CrowdMember m = alone[i].member(step);
    m.character->step(m.in, m.strengths, kSeconds, m.out);
  }
  for (size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(together[i].state(), alone[i].state()) << i;
}

TEST(Crowd, poses_may_be_styled_in_place) {
  std::vector<Actor> together = crowd_of(make_model(Kind::floats), 9), alone = together;
  std::vector<CrowdMember> members;
  for (Actor& actor : together) {
    members.push_back({&actor.stylizer, actor.clip.pose(0), actor.strengths, actor.clip.pose(0)});
  }
  step_crowd(members, kSeconds);
  for (size_t i = 0; i < alone.size(); ++i) {
    const CrowdMember m = alone[i].member(-alone[i].start);
    m.character->step(m.in, m.strengths, kSeconds, m.out);
    for (size_t j = 0; j < together[i].clip.joints(); ++j) {
      EXPECT_EQ(together[i].clip.rotations[j], alone[i].rotations[j]) << i << ", joint " << j;
    }
  }
}

TEST(Crowd, of_nobody_allocates_nothing) {
  const long before = test::allocations;
  step_crowd({}, kSeconds);
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace panache
