#include "eval/systems/recorded.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "make_styles.h"
#include "temporary_folder.h"

namespace panache {
namespace {

// Two neutral takes and a styled one, and a folder in which another program has put its outputs.
class RecordedTest : public testing::Test {
 protected:
  RecordedTest() {
    std::filesystem::create_directories(folder_ + "takes/more");
    std::filesystem::create_directories(folder_ + "theirs");
    put("takes/walk.bvh", test::styled_clip("neutral", "walk", 0));
    put("takes/more/walk.bvh", test::styled_clip("neutral", "walk", 1));
    put("takes/old.bvh", test::styled_clip("old", "walk", 0));
    inputs_ = *load_inputs({row("takes/walk.bvh"), row("takes/more/walk.bvh")});
  }
  void put(const std::string& name, const Clip& clip) const {
    EXPECT_TRUE(write_file(folder_ + name, format_bvh(clip), true).ok());
  }
  ManifestRow row(const std::string& name) const {
    ManifestRow row;
    row.path = folder_ + name;
    row.style = "neutral";
    row.content = "walk";
    row.neutral = true;
    return row;
  }
  void write_manifest(const std::string& lines) const {
    const std::string text = "input,style,strength,output\n" + lines;
    EXPECT_TRUE(write_file(folder_ + "theirs/manifest.csv", text, true).ok());
  }
  Result<std::unique_ptr<Recorded>> load(const std::string& lines) const {
    write_manifest(lines);
    const RecordedScope scope = {
        {folder_ + "takes/walk.bvh", folder_ + "takes/./more/walk.bvh", folder_ + "takes/old.bvh"},
        {"old", "proud"}};
    return Recorded::load(folder_ + "theirs", scope);
  }
  std::string rejection(const std::string& lines) const {
    const auto recorded = load(lines);
    if (recorded.ok()) return "accepted";
    std::string message = recorded.error().message;
    for (size_t at; (at = message.find(folder_)) != message.npos;)
      message.erase(at, folder_.size());
    return message;
  }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
  std::vector<TestInput> inputs_;
};

const StyleRequest kOld = {"old", {{"old", 1.0f}}};

TEST_F(RecordedTest, an_output_is_found_by_input_style_and_strength_and_no_other_is) {
  put("theirs/a.bvh", test::styled_clip("old", "walk", 0));
  const auto recorded = load("takes/walk.bvh,old,1,a.bvh\n");
  ASSERT_TRUE(recorded.ok()) << recorded.error().message;
  const Recorded& system = **recorded;
  EXPECT_EQ(system.name(), "theirs");
  EXPECT_EQ(system.styles(), std::vector<std::string>{"old"});
  EXPECT_TRUE(system.can_run(inputs_[0], kOld));
  EXPECT_FALSE(system.can_run(inputs_[1], kOld));
  EXPECT_FALSE(system.can_run(inputs_[0], {"old", {{"old", 0.5f}}}));
  EXPECT_FALSE(system.can_run(inputs_[0], {"proud", {{"proud", 1.0f}}}));
  EXPECT_FALSE(system.can_run(inputs_[0], {"old", {{"old", 0.5f}, {"proud", 0.5f}}}));
  EXPECT_EQ(system.instants(1), nullptr);
}

TEST_F(RecordedTest, what_is_judged_is_the_motion_of_the_file_under_the_names_of_the_request) {
  const Clip clip = test::styled_clip("old", "walk", 0);
  put("theirs/a.bvh", clip);
  const auto recorded = load("walk.bvh,old,1,a.bvh\n");
  EXPECT_FALSE(recorded.ok());  // Two takes are called so.
  const auto system = load("takes/walk.bvh,old,1,a.bvh\n");
  ASSERT_TRUE(system.ok()) << system.error().message;
  const Result<RunResult> run_result = (*system)->run(inputs_[0], kOld);
  ASSERT_TRUE(run_result.ok()) << run_result.error().message;
  const Take& take = run_result->output.take;
  EXPECT_EQ(take.pose_features, load_input(row("theirs/a.bvh"))->take.pose_features);
  EXPECT_EQ(take.row.style, "old");
  EXPECT_EQ(take.row.content, "walk");
  EXPECT_FALSE(take.row.neutral);
  ASSERT_EQ(run_result->output.source_frames.size(), size_t(take.frames()));
  EXPECT_EQ(run_result->output.source_frames[7], 7);
  EXPECT_LT(run_result->bone_length_error, 1e-5);
}

TEST_F(RecordedTest, a_skeleton_of_another_unit_gives_the_same_motion) {
  Clip clip = test::styled_clip("old", "walk", 0);
  put("theirs/a.bvh", clip);
  for (Joint& joint : clip.skeleton.joints) joint.offset = joint.offset * 100;
  for (Vec3& translation : clip.translations) translation = translation * 100;
  put("theirs/b.bvh", clip);
  const auto system = load("takes/walk.bvh,old,1,a.bvh\nmore/walk.bvh,old,1,b.bvh\n");
  ASSERT_TRUE(system.ok()) << system.error().message;
  const Take a = (*system)->run(inputs_[0], kOld)->output.take;
  const Take b = (*system)->run(inputs_[1], kOld)->output.take;
  ASSERT_EQ(a.pose_features.size(), b.pose_features.size());
  // Files have six decimals: of a metre in the one, of a centimetre in the other; velocities are
  // differences over 0.05 s.
  for (size_t i = 0; i < a.pose_features.size(); ++i)
    ASSERT_NEAR(a.pose_features[i], b.pose_features[i], 1e-4) << i;
}

TEST_F(RecordedTest, of_another_length_than_its_input_nobody_knows_which_instant_a_frame_shows) {
  put("theirs/a.bvh", test::styled_clip("old", "walk", 0, 75));
  const auto system = load("takes/walk.bvh,old,1,a.bvh\n");
  ASSERT_TRUE(system.ok()) << system.error().message;
  const Result<RunResult> run_result = (*system)->run(inputs_[0], kOld);
  ASSERT_TRUE(run_result.ok());
  EXPECT_EQ(run_result->output.take.frames(), 75);
  EXPECT_TRUE(run_result->output.source_frames.empty());
  // Where it is compared frame by frame, that is an error.
  const Result<RunResult> rejected = (*system)->run(inputs_[0], {"old", {{"old", 1.0f}}, false});
  ASSERT_FALSE(rejected.ok());
  EXPECT_EQ(rejected.error().message,
            folder_ + "theirs/manifest.csv:2: output " + folder_ +
                "theirs/a.bvh lasts 2.50 s and its input 3.00 s; expected "
                "the same, as they are compared frame by frame");
}

TEST_F(RecordedTest, a_frame_more_or_less_is_rounding) {
  put("theirs/a.bvh", test::styled_clip("old", "walk", 0, 89));
  put("theirs/b.bvh", test::styled_clip("old", "walk", 0, 91));
  const auto system = load("takes/walk.bvh,old,1,a.bvh\nmore/walk.bvh,old,1,b.bvh\n");
  ASSERT_TRUE(system.ok()) << system.error().message;
  for (int i = 0; i < 2; ++i) {
    const Result<RunResult> run_result =
        (*system)->run(inputs_[i], {"old", {{"old", 1.0f}}, false});
    ASSERT_TRUE(run_result.ok()) << run_result.error().message;
    const Take& take = run_result->output.take;
    EXPECT_EQ(take.frames(), inputs_[i].take.frames());
    EXPECT_EQ(take.pose_features.size(), inputs_[i].take.pose_features.size());
    EXPECT_EQ(take.contacts.size(), inputs_[i].take.contacts.size());
  }
}

TEST_F(RecordedTest, what_was_asked_for_is_counted) {
  put("theirs/a.bvh", test::styled_clip("old", "walk", 0));
  const auto system =
      load("takes/walk.bvh,old,1,a.bvh\nmore/walk.bvh,old,1,a.bvh\ntakes/walk.bvh,old,0.5,a.bvh\n");
  ASSERT_TRUE(system.ok()) << system.error().message;
  EXPECT_EQ((*system)->facts().recorded->evaluated, 0u);
  for (int again = 0; again < 2; ++again) ASSERT_TRUE((*system)->run(inputs_[0], kOld).ok());
  EXPECT_EQ((*system)->facts().recorded->listed, 3u);
  EXPECT_EQ((*system)->facts().recorded->evaluated, 1u);
}

TEST_F(RecordedTest, a_wrong_line_is_explained_with_its_number) {
  put("theirs/a.bvh", test::styled_clip("old", "walk", 0));
  EXPECT_EQ(
      rejection("takes/walk.bvh,old,1,a.bvh\ntakes/run.bvh,old,1,a.bvh\n"),
      "theirs/manifest.csv:3: input 'takes/run.bvh' is no take to judge by; expected a path "
      "as in the judge's own manifest (panache-lab eval --requests FILE writes those that there "
      "are)");
  EXPECT_EQ(rejection("walk.bvh,old,1,a.bvh\n"),
            "theirs/manifest.csv:2: input 'walk.bvh' may be takes/more/walk.bvh or "
            "takes/walk.bvh; expected more of the path");
  EXPECT_EQ(rejection("kes/walk.bvh,old,1,a.bvh\n").substr(0, 45),
            "theirs/manifest.csv:2: input 'kes/walk.bvh' i");
  EXPECT_EQ(rejection("takes/walk.bvh,jolly,1,a.bvh\n"),
            "theirs/manifest.csv:2: style 'jolly' is shown by no test take; expected old or proud");
  for (const std::string strength : {"0.3", "full", "", "1x"}) {
    EXPECT_EQ(rejection("takes/walk.bvh,old," + strength + ",a.bvh\n"),
              "theirs/manifest.csv:2: column strength is '" + strength +
                  "'; expected 0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75 or 2");
  }
  EXPECT_EQ(rejection("takes/walk.bvh,old,1,a.bvh\n\ntakes/./walk.bvh,old,1.0,a.bvh\n"),
            "theirs/manifest.csv:4: asks for the same as theirs/manifest.csv:2");
  EXPECT_EQ(rejection(""), "theirs/manifest.csv: lists no outputs");
}

TEST_F(RecordedTest, an_output_that_is_missing_or_no_humanoid_is_explained_with_its_line) {
  EXPECT_EQ(rejection("takes/walk.bvh,old,1,none.bvh\n"),
            "theirs/manifest.csv:2: output theirs/none.bvh: cannot be read: No such file or "
            "directory");
  ASSERT_TRUE(write_file(folder_ + "theirs/box.bvh",
                         "HIERARCHY\nROOT box\n{\n  OFFSET 0 0 0\n  CHANNELS 3 Xposition "
                         "Yposition Zposition\n  End Site\n  {\n    OFFSET 0 1 0\n  }\n}\nMOTION\n"
                         "Frames: 1\nFrame Time: 0.033333\n0 0 0\n",
                         true)
                  .ok());
  const std::string message = rejection("takes/walk.bvh,old,1,box.bvh\n");
  EXPECT_TRUE(message.starts_with("theirs/manifest.csv:2: output theirs/box.bvh: no humanoid "))
      << message;
}

TEST_F(RecordedTest, without_a_manifest_there_is_nothing) {
  const auto recorded = Recorded::load(folder_ + "takes", {});
  ASSERT_FALSE(recorded.ok());
  EXPECT_EQ(recorded.error().message,
            folder_ + "takes/manifest.csv: cannot be read: No such file or directory");
}

TEST(RecordedName, is_that_of_the_folder_however_it_is_written) {
  EXPECT_EQ(Recorded::name_of("results/theirs"), "theirs");
  EXPECT_EQ(Recorded::name_of("results/theirs/"), "theirs");
  EXPECT_EQ(Recorded::name_of("./theirs/."), "theirs");
}

TEST(RecordedRequests, are_each_neutral_take_in_each_style_that_its_own_set_shows) {
  std::vector<ManifestRow> rows;
  const auto add = [&](const std::string& path, const std::string& style, int set) {
    rows.push_back({path, style, "walk", "1", style == "neutral", true, set});
  };
  add("a/walk.bvh", "neutral", 0);
  add("a/old.bvh", "old", 0);
  add("a/proud.bvh", "proud", 0);
  add("b/say \"hi\", walk.bvh", "neutral", 1);
  add("b/old.bvh", "old", 1);
  EXPECT_EQ(recorded_requests(rows),
            "input,style,strength,output\n"
            "\"a/walk.bvh\",\"old\",1,\"1_walk_old.bvh\"\n"
            "\"a/walk.bvh\",\"proud\",1,\"2_walk_proud.bvh\"\n"
            "\"b/say \"\"hi\"\", walk.bvh\",\"old\",1,\"3_say \"\"hi\"\", walk_old.bvh\"\n");
}

}  // namespace
}  // namespace panache
