#include "eval/ood.h"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "eval/make_aligned.h"
#include "make_manifest.h"
#include "temporary_folder.h"

namespace panache {
namespace {

// A take whose frame f is `body(f)` of a walk.
template <typename Change>
Take changed(Take take, const Change& change) {
  for (int f = 0; f < take.frames(); ++f) change(take.body[f], take.root[f], f);
  return take;
}

class CompareForeign : public testing::Test {
 protected:
  const Take walk_ = test::walk_take("neutral", "walk", 90, 0);
};

TEST_F(CompareForeign, the_input_itself_is_perfect) {
  const OodRow row = compare_ood(walk_, walk_);
  EXPECT_DOUBLE_EQ(row.jerk_ratio, 1);
  EXPECT_NEAR(row.velocity_correlation, 1, 1e-9);
  EXPECT_EQ(row.distance_cm, 0);
  EXPECT_EQ(row.beyond_limits, 0);
  EXPECT_EQ(row.under_floor, 0);
  EXPECT_EQ(row.turned_deg, 0);
  EXPECT_EQ(row.drift_m, 0);
  EXPECT_EQ(row.skating_ratio, row.input_skating_ratio);
}

TEST_F(CompareForeign, a_constant_offset_is_distance_and_nothing_else) {
  const Take output = changed(walk_, [](HumanPositions& body, RootPose&, int) {
    for (Vec3& joint : body) joint += Vec3{0, 0, 0.05f};
  });
  const OodRow row = compare_ood(walk_, output);
  EXPECT_NEAR(row.distance_cm, 5, 1e-3);
  EXPECT_NEAR(row.jerk_ratio, 1, 1e-3);
  EXPECT_NEAR(row.velocity_correlation, 1, 1e-6);
}

TEST_F(CompareForeign, trembling_is_jerk_and_costs_correlation) {
  const Take output = changed(walk_, [](HumanPositions& body, RootPose&, int f) {
    for (Vec3& joint : body) joint.y += f % 2 ? 0.03f : 0;
  });
  const OodRow row = compare_ood(walk_, output);
  EXPECT_GT(row.jerk_ratio, 3);
  EXPECT_LT(row.velocity_correlation, 0.95);
}

TEST_F(CompareForeign, velocities_correlate_by_direction_not_by_size) {
  const auto stretched = [&](float factor) {
    return changed(walk_, [&](HumanPositions& body, RootPose&, int) {
      for (Vec3& joint : body) joint = joint * factor;
    });
  };
  EXPECT_NEAR(compare_ood(walk_, stretched(2)).velocity_correlation, 1, 1e-5);
  EXPECT_NEAR(compare_ood(walk_, stretched(-1)).velocity_correlation, -1, 1e-5);
}

TEST_F(CompareForeign, where_nothing_moves_there_is_no_correlation_and_no_jerk) {
  const Take still = changed(walk_, [&](HumanPositions& body, RootPose& root, int) {
    body = walk_.body[0];
    root = {};
  });
  const OodRow row = compare_ood(still, walk_);
  EXPECT_TRUE(std::isnan(row.velocity_correlation));
  EXPECT_TRUE(std::isnan(row.jerk_ratio));
  // What moved and now stands has lost its motion.
  EXPECT_EQ(compare_ood(walk_, still).velocity_correlation, 0);
}

TEST_F(CompareForeign, a_toe_under_the_floor_counts_unless_the_input_put_it_there) {
  const auto lowered = [](const Take& take, float metres) {
    return changed(take, [&](HumanPositions& body, RootPose&, int f) {
      if (f % 3 == 0) {
        for (Vec3& joint : body) joint.y -= metres;
      }
    });
  };
  float lowest = 1;
  for (const HumanPositions& body : walk_.body) {
    lowest = std::min(lowest, body[index(HumanJoint::left_toes)].y);
  }
  ASSERT_NEAR(lowest, 0, 0.05);
  EXPECT_NEAR(compare_ood(walk_, lowered(walk_, 0.3f)).under_floor, 1 / 3.0, 1e-6);
  EXPECT_EQ(compare_ood(lowered(walk_, 0.3f), lowered(walk_, 0.3f)).under_floor, 0);
  EXPECT_EQ(compare_ood(lowered(walk_, 0.3f), lowered(walk_, 0.32f)).under_floor, 0);
}

TEST_F(CompareForeign, a_joint_that_jumps_counts_unless_the_input_jumps_too) {
  const auto jumping = [&](float metres) {
    return changed(walk_, [=](HumanPositions& body, RootPose&, int f) {
      if (f >= 45) body[index(HumanJoint::left_hand)].y += metres;
    });
  };
  EXPECT_EQ(compare_ood(walk_, jumping(0.1f)).jumps, 2);  // The frames before and after.
  EXPECT_EQ(compare_ood(walk_, jumping(0.04f)).jumps, 0);
  EXPECT_EQ(compare_ood(jumping(0.1f), jumping(0.1f)).jumps, 0);
  // More than 6 cm further, but not twice as far.
  EXPECT_EQ(compare_ood(jumping(0.1f), jumping(0.18f)).jumps, 0);
  EXPECT_EQ(compare_ood(jumping(0.1f), jumping(0.25f)).jumps, 2);
  // Twice as far, but not 6 cm further.
  EXPECT_EQ(compare_ood(jumping(0.05f), jumping(0.105f)).jumps, 0);
}

TEST_F(CompareForeign, a_broken_knee_counts_unless_the_input_has_it) {
  const Take broken = changed(walk_, [](HumanPositions& body, RootPose&, int f) {
    if (f < 45) body[index(HumanJoint::left_foot)] += Vec3{0, 0.3f, 0.9f};
  });
  EXPECT_NEAR(compare_ood(walk_, broken).beyond_limits, 0.5, 0.01);
  EXPECT_EQ(compare_ood(broken, broken).beyond_limits, 0);
}

TEST_F(CompareForeign, turned_is_how_far_the_body_faces_aside_whatever_the_side) {
  const Take output = changed(walk_, [](HumanPositions&, RootPose& root, int f) {
    root.facing += (f % 2 ? -0.5f : 0.5f) + 2 * 3.14159265f;
  });
  EXPECT_NEAR(compare_ood(walk_, output).turned_deg, 28.648, 1e-3);
}

TEST_F(CompareForeign, drift_is_where_the_hips_end_on_the_ground) {
  const Take output = changed(walk_, [](HumanPositions& body, RootPose& root, int f) {
    root.position += Vec3{0.03f, 0, 0.04f} * (static_cast<float>(f) / 89);
    body[0].y += 0.2f;
  });
  EXPECT_NEAR(compare_ood(walk_, output).drift_m, 0.05, 1e-5);
}

class OodFiles : public testing::Test {
 protected:
  OodFiles() { test::write_manifest(folder_); }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
};

TEST_F(OodFiles, a_file_a_folder_and_a_manifest_are_listed) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_ + "more");
  fs::copy(folder_ + "old.bvh", folder_ + "more/A.BVH");
  ASSERT_TRUE(write_file(folder_ + "more/none.txt", "", true).ok());
  EXPECT_EQ(*list_ood(folder_ + "old.bvh"), std::vector{folder_ + "old.bvh"});
  EXPECT_EQ(*list_ood(folder_),
            (std::vector{folder_ + "more/A.BVH", folder_ + "neutral.bvh", folder_ + "old.bvh"}));

  fs::rename(folder_ + "more/A.BVH", folder_ + "more/A.GLB");
  EXPECT_EQ(list_ood(folder_ + "more")->size(), 1u);
  fs::rename(folder_ + "more/A.GLB", folder_ + "more/A.BVH");

  // Walk is there in a style; only the bow is foreign.
  const std::string rows =
      "path,style,content,take,neutral,split\nneutral.bvh,normal,walk,001,1,train\n"
      "old.bvh,old,walk,001,0,train\nmore/A.BVH,normal,bow,001,1,train\n";
  ASSERT_TRUE(write_file(folder_ + "bow.csv", rows, true).ok());
  EXPECT_EQ(*list_ood(folder_ + "bow.csv"), std::vector{folder_ + "more/A.BVH"});

  // What is trained on is not out of distribution where a manifest says what is kept for tests.
  const std::string split =
      "path,style,content,take,neutral,split\nneutral.bvh,normal,jump,001,1,train\n"
      "more/A.BVH,normal,jump,002,1,test\n";
  ASSERT_TRUE(write_file(folder_ + "jump.csv", split, true).ok());
  EXPECT_EQ(*list_ood(folder_ + "jump.csv"), std::vector{folder_ + "more/A.BVH"});
}

TEST_F(OodFiles, where_nothing_is_out_of_distribution_a_message_says_so) {
  EXPECT_EQ(list_ood(folder_ + "manifest.csv").error().message,
            folder_ + "manifest.csv: every content exists in a style; none is out of distribution");
  EXPECT_EQ(list_ood("no/such/file.bvh").error().message,
            "no/such/file.bvh: not found; expected a motion file, a folder or a manifest (.csv)");
  std::filesystem::create_directories(folder_ + "empty");
  EXPECT_EQ(list_ood(folder_ + "empty").error().message,
            folder_ + "empty: holds no motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx)");
}

TEST_F(OodFiles, every_file_is_styled_in_every_style) {
  const auto model = *Model::parse(format_safetensors(test::make_model({"old", "sad"})), "m");
  double shown = 0;
  const auto rows =
      measure_ood({folder_ + "old.bvh", folder_ + "neutral.bvh"}, test::as_system(model), nullptr,
                  [&](double share) { shown = std::max(shown, share); });
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  ASSERT_EQ(rows->size(), 4u);
  EXPECT_EQ((*rows)[0].clip, "old");
  EXPECT_EQ((*rows)[0].style, "old");
  EXPECT_EQ((*rows)[1].style, "sad");
  EXPECT_EQ((*rows)[2].clip, "neutral");
  EXPECT_EQ(shown, 1);
  for (const OodRow& row : *rows) {
    EXPECT_GT(row.distance_cm, 0.1);
    EXPECT_GT(row.velocity_correlation, 0.3);
  }
  EXPECT_NE((*rows)[0].distance_cm, (*rows)[1].distance_cm);
}

// Notes what it is shown.
class NotingJudge : public OodJudge {
 public:
  OodVerdict judge(const Take& input, const Take& output, double log_rate,
                   const std::string& style) const override {
    OodVerdict verdict;
    verdict.style_robust = input.frames();
    verdict.style_lda = output.frames() * std::exp(log_rate);
    verdict.style = style == "old" ? 0 : 1;
    verdict.signature.takes = static_cast<size_t>(output.frames());
    return verdict;
  }
};

TEST_F(OodFiles, a_judge_sees_the_output_with_its_own_tempo) {
  TensorFile file = test::make_model({"old", "sad"});
  // Sad is half as fast.
  for (const char* key : {"timing.head.0.weight", "timing.head.1.weight"}) {
    for (float& weight : file.tensors[key].values) weight = 0;
  }
  file.tensors["timing.head.0.bias"].values[0] = 0;
  file.tensors["timing.head.1.bias"].values[0] = std::log(0.5f);
  const auto model = *Model::parse(format_safetensors(file), "m");
  const NotingJudge judge;
  const auto rows = measure_ood({folder_ + "neutral.bvh"}, test::as_system(model), &judge);
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  for (const OodRow& row : *rows) {
    EXPECT_NEAR(row.verdict.style_robust, 150, 1);
    EXPECT_NEAR(row.verdict.style_lda, row.verdict.style_robust, 1);
    EXPECT_NEAR(row.verdict.signature.takes, row.style == "old" ? 150 : 300, 4);
    EXPECT_EQ(row.verdict.style, row.style == "old" ? 0 : 1);
  }
}

TEST_F(OodFiles, a_bend_moves_joints_and_leaves_the_legs_and_the_way_alone) {
  const auto rows =
      measure_ood({folder_ + "neutral.bvh"}, test::as_system(test::bending_model(test::kBend)));
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  const OodRow& row = rows->front();
  EXPECT_GT(row.distance_cm, 3);
  EXPECT_GT(row.velocity_correlation, 0.85);
  EXPECT_NEAR(row.jerk_ratio, 1, 0.2);
  EXPECT_EQ(row.beyond_limits, 0);
  EXPECT_LT(row.drift_m, 0.05);
}

TEST_F(OodFiles, a_bend_that_no_back_survives_is_beyond_human_limits) {
  const auto rows =
      measure_ood({folder_ + "neutral.bvh"}, test::as_system(test::bending_model(-1.8f)));
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  EXPECT_GT(rows->front().beyond_limits, 0.95);
}

TEST_F(OodFiles, a_calibration_pose_in_front_is_not_judged) {
  const Clip walk = test::walking_clip(90);
  Clip posed = walk;
  const size_t joints = walk.joints();
  posed.resize(91);
  std::copy_n(walk.rotations.begin(), 90 * joints, posed.rotations.begin() + joints);
  std::copy_n(walk.translations.begin(), 90 * joints, posed.translations.begin() + joints);
  for (Quat& rotation : posed.pose(0).rotations) rotation = {};  // In T-pose, 5 m away.
  posed.pose(0).translations[0] += Vec3{5, 0, 0};
  ASSERT_EQ(Rig::create(posed)->first_frame(), 1);
  ASSERT_TRUE(write_file(folder_ + "walk.bvh", format_bvh(walk), true).ok());
  ASSERT_TRUE(write_file(folder_ + "posed.bvh", format_bvh(posed), true).ok());
  const auto model = *Model::parse(format_safetensors(test::make_model({"old"})), "m");
  const auto rows =
      measure_ood({folder_ + "walk.bvh", folder_ + "posed.bvh"}, test::as_system(model));
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  const OodRow &plain = (*rows)[0], &with_pose = (*rows)[1];
  // Files have six decimals, and the rig measures its floor on one frame more.
  EXPECT_NEAR(with_pose.distance_cm, plain.distance_cm, 0.05);
  EXPECT_NEAR(with_pose.jerk_ratio, plain.jerk_ratio, 0.02);
  EXPECT_NEAR(with_pose.velocity_correlation, plain.velocity_correlation, 0.01);
  EXPECT_NEAR(with_pose.drift_m, plain.drift_m, 0.02);
}

TEST_F(OodFiles, a_file_that_cannot_be_read_fails_with_its_message) {
  ASSERT_TRUE(write_file(folder_ + "bad.bvh", "HIERARCHY\nnonsense\n", true).ok());
  const auto rows = measure_ood({folder_ + "old.bvh", folder_ + "bad.bvh"},
                                test::as_system(test::bending_model(0)));
  ASSERT_FALSE(rows.ok());
  EXPECT_NE(rows.error().message.find("bad.bvh"), std::string::npos);
}

TEST(OodReal, motion_of_other_makers_can_be_measured) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA names no folder with real motion.";
  const auto files = list_ood(std::string(data) + "/formats");
  ASSERT_TRUE(files.ok()) << files.error().message;
  const auto rows = measure_ood(*files, test::as_system(test::bending_model(0.1f)));
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  for (const OodRow& row : *rows) {
    EXPECT_GT(row.distance_cm, 0.5) << row.clip;
    EXPECT_GT(row.velocity_correlation, 0.7) << row.clip;
    EXPECT_LT(row.drift_m, 0.5) << row.clip;
  }
}

}  // namespace
}  // namespace panache
