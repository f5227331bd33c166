// A clip on another skeleton.
#include <array>

#include "stick_api.h"

namespace {

using panache::test::created;
using panache::test::Owned;
using panache::test::rejection;
using panache::test::Walk;

using Joints = std::vector<panache_joint>;

Joints figure() { return {stick_figure, stick_figure + STICK_JOINTS}; }

Owned<panache_skeleton> skeleton_of(const Joints& joints) {
  return created<panache_skeleton>([&](auto** out) {
    return panache_skeleton_create(joints.data(), STICK_JOINTS, nullptr, out);
  });
}

Owned<panache_styled_clip> put(const Walk& walk, const Owned<panache_skeleton>& onto,
                               const panache_retarget_options* options = nullptr) {
  return created<panache_styled_clip>(
      [&](auto** out) { return panache_retarget_clip(&walk.clip, onto.get(), options, out); });
}

class RetargetApi : public panache::test::StickApi {};

TEST_F(RetargetApi, a_larger_figure_goes_further) {
  const Walk walk = clip(90);
  Joints twice = figure();
  for (panache_joint& joint : twice) {
    for (float& x : joint.translation) x *= 2;
  }
  const auto same = put(walk, skeleton_), large = put(walk, skeleton_of(twice));
  ASSERT_EQ(panache_styled_clip_frame_count(same.get()), 90);
  ASSERT_EQ(panache_styled_clip_frame_count(large.get()), 90);
  const float* a = panache_styled_clip_translations(same.get());
  const float* b = panache_styled_clip_translations(large.get());
  float far = 0;
  bool planted = false;
  for (int f = 0; f < 90; ++f) {
    for (int k = 0; k < 3; ++k) {
      const int at = 3 * STICK_JOINTS * f + k;
      EXPECT_NEAR(b[at], 2 * a[at], 2e-3f) << f;
      far = std::max(far, std::abs(a[at] - a[k]));
    }
    EXPECT_EQ(panache_styled_clip_source_frames(large.get())[f], f);
    EXPECT_EQ(panache_styled_clip_gates(large.get())[f], 1);
    planted |= panache_styled_clip_contacts(large.get())[2 * f] == 1;
  }
  EXPECT_GT(far, 0.2f);
  EXPECT_TRUE(planted);
}

// The figure stands with its arms stretched ahead and its hands together.
struct Clap : Walk {
  explicit Clap(const panache_skeleton* skeleton) : Walk(skeleton, 20, false) {
    for (int f = 0; f < 20; ++f) {
      for (int j = 0; j < STICK_JOINTS; ++j) {
        float* q = &rotations[static_cast<size_t>(4 * (STICK_JOINTS * f + j))];
        q[0] = q[1] = q[2] = 0, q[3] = 1;
      }
      // A quarter turn about x brings the arm ahead, then 0.4 rad about y in.
      for (const int j : {5, 8}) {
        const float in = j == 5 ? -0.2f : 0.2f;
        float* q = &rotations[static_cast<size_t>(4 * (STICK_JOINTS * f + j))];
        q[0] = -std::sqrt(0.5f) * std::cos(in), q[1] = std::sqrt(0.5f) * std::sin(in);
        q[2] = std::sqrt(0.5f) * std::sin(in), q[3] = std::sqrt(0.5f) * std::cos(in);
      }
      float* hips = &translations[static_cast<size_t>(3 * STICK_JOINTS * f)];
      hips[1] = 0.95f, hips[2] = 0;
    }
  }
};

std::array<float, 3> rotate(const float* q, std::array<float, 3> v) {
  const auto cross = [](const float* a, const std::array<float, 3>& b) {
    return std::array<float, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                a[0] * b[1] - a[1] * b[0]};
  };
  const std::array<float, 3> t = cross(q, v), u = cross(q, t);
  for (size_t k = 0; k < 3; ++k) v[k] += 2 * (q[3] * t[k] + u[k]);
  return v;
}

// Where a joint of the last frame is.
std::array<float, 3> position(const panache_styled_clip* clip, int joint) {
  const size_t last = STICK_JOINTS * static_cast<size_t>(panache_styled_clip_frame_count(clip) - 1);
  std::array<float, 3> at = {};
  for (; joint >= 0; joint = stick_figure[joint].parent) {
    const size_t which = last + static_cast<size_t>(joint);
    at = rotate(panache_styled_clip_rotations(clip) + 4 * which, at);
    for (size_t k = 0; k < 3; ++k) at[k] += panache_styled_clip_translations(clip)[3 * which + k];
  }
  return at;
}

TEST_F(RetargetApi, hands_meet_and_feet_stand_where_asked_for) {
  const Clap clap(skeleton_.get());
  // Shoulders 12 cm further apart, and legs of which the right one ends 8 cm lower.
  Joints joints = figure();
  joints[5].translation[0] = 0.25f, joints[8].translation[0] = -0.25f;
  joints[12].translation[1] = -0.3f, joints[16].translation[1] = -0.5f;
  constexpr float kFloor = 0.95f - 0.04f - 0.5f - 0.41f - 0.07f;
  const auto other = skeleton_of(joints);
  for (const bool feet : {true, false}) {
    for (const bool hands : {true, false}) {
      const panache_retarget_options options = {sizeof options, feet, hands};
      const auto out = put(clap, other, &options);
      const float apart = position(out.get(), 7)[0] - position(out.get(), 10)[0];
      const float toes = position(out.get(), 18)[1];
      // The arms are stretched, and do not quite reach.
      EXPECT_TRUE(hands ? apart < 0.03f : apart > 0.12f) << feet << hands << ": " << apart;
      EXPECT_TRUE(feet ? std::abs(toes - kFloor) < 1e-3f : toes < kFloor - 0.05f)
          << feet << hands << ": " << toes;
    }
  }
}

TEST_F(RetargetApi, bad_options_and_clips_are_rejected) {
  Walk walk = clip(10);
  const auto message = [&](panache_status status, const panache_retarget_options* options) {
    return rejection<panache_styled_clip>(status, [&](auto** out) {
      return panache_retarget_clip(&walk.clip, skeleton_.get(), options, out);
    });
  };
  const panache_retarget_options zeros = {};
  EXPECT_EQ(message(PANACHE_BAD_ARGUMENT, &zeros),
            "panache_retarget_options: its struct_size is 0, expected "
            "sizeof(panache_retarget_options)");
  walk.clip.frame_count = 0;
  EXPECT_EQ(message(PANACHE_BAD_CLIP, nullptr), "clip: has no frames");
}

}  // namespace
