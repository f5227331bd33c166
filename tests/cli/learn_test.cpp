// panache learn: what it says and writes, and what it rejects, word for word. How well it learns is
// tests/learn.

#include <cmath>
#include <regex>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "clip/make_character.h"

namespace panache::test {
namespace {

using Names = std::vector<std::string>;
using nlohmann::json;

constexpr float kBend = 0.5f;  // Of the spine in the style, radians.

class LearnVerb : public ProgramTest {
 protected:
  // A walk of 4 s at 30 frames a second, and the same bent forward.
  void SetUp() override {
    ProgramTest::SetUp();
    make_walk("walk.bvh", "4", "1.4");
    write_clip("bent.bvh", bent(clip_of("walk.bvh")));
  }

  void make_walk(const std::string& name, const std::string& seconds, const std::string& speed) {
    const Ran ran =
        must({"walker", "-o", name, "--seconds", seconds, "--speed", speed, "--fps", "30"});
  }
  Clip clip_of(const std::string& name) const { return open(name)->clip(); }
  void write_clip(const std::string& name, const Clip& clip) const {
    write(name, format_bvh(clip));
  }
  // From the model that is shipped, where --into names none that is there.
  Ran learn(const Words& arguments) const { return run("learn" + arguments, ""); }
  Ran learn_bent(const std::string& into) const {
    return learn({"walk.bvh", "bent.bvh", "--name", "bent", "--into", into});
  }
  void expect_rejected(const Words& arguments, int exit, const std::string& message) const {
    ProgramTest::expect_rejected("learn" + arguments, exit, message, "");
  }
  json styles_of(const std::string& model) const {
    return json::parse(run({"styles", model, "--json"}, "").out)["styles"];
  }

  static size_t spine_of(const Clip& clip) {
    const auto& joints = clip.skeleton.joints;
    return static_cast<size_t>(std::ranges::find(joints, std::string("spine"), &Joint::name) -
                               joints.begin());
  }
  static Clip bent(Clip clip) {
    const size_t spine = spine_of(clip);
    for (int f = 0; f < clip.frames; ++f) {
      Quat& q = clip.pose(f).rotations[spine];
      q = axis_angle(Vec3{1, 0, 0}, kBend) * q;
    }
    return clip;
  }
  static Clip cut(const Clip& clip, int frames) {
    Clip out{clip.skeleton, clip.frame_time, 0, {}, {}};
    out.resize(frames);
    std::copy_n(clip.rotations.begin(), out.rotations.size(), out.rotations.begin());
    std::copy_n(clip.translations.begin(), out.translations.size(), out.translations.begin());
    return out;
  }
  // How far the spine leans forward from the second second on, where a style has set in, radians.
  static double lean(const Clip& clip) {
    double sum = 0;
    for (int f = 30; f < clip.frames; ++f) {
      const Vec3 up = rotate(clip.pose(f).rotations[spine_of(clip)], Vec3{0, 1, 0});
      sum += std::atan2(up.z, up.y);
    }
    return sum / (clip.frames - 30);
  }
  // Styles a walk of another speed, and tells how much further it leans.
  double learnt_lean(const std::string& model) {
    make_walk("other.bvh", "4", "1.1");
    const Ran ran = must({"stylize", "other.bvh", "--style", "bent=1", "-o", "out.bvh", "--force",
                          "--model", model});
    return ran.exit == 0 ? lean(clip_of("out.bvh")) - lean(clip_of("other.bvh")) : 0;
  }
};

TEST_F(LearnVerb, a_pair_becomes_a_style_of_a_new_model) {
  const json shipped = json::parse(run("styles --json", "").out);
  const std::string shipped_path = shipped["model"];
  const std::string before = read_file(shipped_path).value();
  const Ran ran = learn_bent("mine.safetensors");
  EXPECT_EQ(ran.exit, 0);
  EXPECT_EQ(ran.err, "");
  EXPECT_TRUE(std::regex_match(
      ran.out,
      std::regex(
          "learnt 'bent' in [0-9]+\\.[0-9]{2} s into mine\\.safetensors \\(the style is "
          "[0-9]+\\.[0-9] "
          "KB\\)\n"
          "  walk\\.bvh -> bent\\.bvh: 4\\.0 s, match 0\\.[0-9]{2}, tempo "
          "1\\.00 x\n"
          "  good: joints [0-9]+\\.[0-9] cm off on the held-back quarter \\(mean posture alone "
          "[0-9]+\\.[0-9], no style [0-9]+\\.[0-9]\\)\n")))
      << ran.out;
  EXPECT_EQ(entries(), (Names{"bent.bvh", "mine.safetensors", "model.safetensors", "walk.bvh"}));
  EXPECT_TRUE(read_file(shipped_path).value() == before);

  const json styles = styles_of("mine.safetensors");
  ASSERT_EQ(styles.size(), shipped["styles"].size() + 1);
  EXPECT_EQ(styles.back()["name"], "bent");
  EXPECT_EQ(styles.back()["learnt"], true);
  EXPECT_EQ(styles.back()["origin"], "1 pair, 3.97 s: walk.bvh -> bent.bvh");
  // A quarter of the bend may be lost to the ridge and to what the gate does not know.
  EXPECT_NEAR(learnt_lean("mine.safetensors"), kBend, kBend / 4);
}

TEST_F(LearnVerb, tells_machines_in_json_what_was_learnt) {
  const Ran ran = learn({"walk.bvh", "bent.bvh", "--name", "bent", "--into", "mine.safetensors",
                         "--description", "bent forward", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json out = json::parse(ran.out);
  EXPECT_EQ(out["style"], "bent");
  EXPECT_EQ(out["model"], "mine.safetensors");
  EXPECT_GT(out["bytes"], 0);
  EXPECT_GT(out["seconds"], 0.0);
  EXPECT_LT(out["held_back_cm"], out["untouched_cm"]);
  EXPECT_LT(out["mean_posture_cm"], out["untouched_cm"]);
  ASSERT_EQ(out["pairs"].size(), 1u);
  const json& pair = out["pairs"][0];
  EXPECT_EQ(pair["neutral"], "walk.bvh");
  EXPECT_EQ(pair["styled"], "bent.bvh");
  EXPECT_NEAR(pair["seconds"].get<double>(), 4, 1.01 / 30);  // The file rounds times of frames.
  EXPECT_NEAR(pair["tempo"].get<double>(), 1, 0.03);  // Whole frames, smoothed over 7 of them.
  EXPECT_LT(pair["match"], 0.35);
  EXPECT_EQ(out["verdict"], "good");
  EXPECT_EQ(out["warnings"], json::array());
  EXPECT_EQ(pair["warnings"], json::array());
  EXPECT_EQ(styles_of("mine.safetensors").back()["description"], "bent forward");
}

TEST_F(LearnVerb, the_style_goes_on_a_journey_as_a_file_that_info_knows) {
  ASSERT_EQ(learn_bent("mine.safetensors").exit, 0);
  must("styles mine.safetensors --extract bent -o bent.safetensors");
  const Ran info = must("info bent.safetensors");
  EXPECT_EQ(info.out, run("styles bent.safetensors").out);
  EXPECT_EQ(run("info bent.safetensors --json").out, run("styles bent.safetensors --json").out);
}

TEST_F(LearnVerb, several_pairs_make_one_style) {
  make_walk("run.bvh", "3", "2.8");
  write_clip("bent-run.bvh", bent(clip_of("run.bvh")));
  const Ran ran =
      learn("walk.bvh bent.bvh run.bvh bent-run.bvh --name bent --into mine.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(holds(ran.out, "\n  walk.bvh -> bent.bvh: 4.0 s"));
  EXPECT_TRUE(holds(ran.out, "\n  run.bvh -> bent-run.bvh: 3.0 s"));
  EXPECT_EQ(styles_of("mine.safetensors").back()["origin"],
            "2 pairs, 6.97 s: walk.bvh -> bent.bvh; run.bvh -> bent-run.bvh");
}

TEST_F(LearnVerb, a_styled_walk_alone_is_learnt_beside_other_people) {
  Words arguments = "bent.bvh --name bent --into mine.safetensors";
  Ran ran = learn(arguments);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(holds(ran.out, "\n  neutral people -> bent.bvh: 4.0 s"));
  EXPECT_TRUE(std::regex_search(
      ran.out, std::regex("\n  without a neutral clip: [0-9]+ other people move alike; [0-9]+ % of "
                          "the difference in posture counts as style\n")))
      << ran.out;
  // Part of the bend is taken for how people differ.
  EXPECT_NEAR(learnt_lean("mine.safetensors"), kBend, 0.5 * kBend);
  arguments.insert(arguments.end(), {"--force", "--json"});
  ran = learn(arguments);
  const json pair = json::parse(ran.out)["pairs"][0];
  EXPECT_GE(pair["people"], 5);
  EXPECT_GT(pair["certainty"], 0.5);
  EXPECT_EQ(pair["known"], true);
}

TEST_F(LearnVerb, gltf_files_teach_too_whatever_is_above_their_hips) {
  // Each gets a node above its hips that is called like the file.
  for (const std::string name : {"walk", "bent"}) {
    must({"convert", name + ".bvh", "-o", name + ".glb"});
  }
  const Ran ran = learn("walk.glb bent.glb --name bent --into mine.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NEAR(learnt_lean("mine.safetensors"), kBend, kBend / 4);
}

TEST_F(LearnVerb, a_name_that_is_taken_needs_force) {
  ASSERT_EQ(learn_bent("mine.safetensors").exit, 0);
  const std::string before = read("mine.safetensors");
  const Words again = "walk.bvh bent.bvh --name bent --into mine.safetensors";
  expect_rejected(again, 1,
                  "mine.safetensors: has a style 'bent' already; give another --name, or --force "
                  "to replace it");
  Names forced = again;
  forced.push_back("--force");
  const size_t count = styles_of("mine.safetensors").size();
  const Ran ran = learn(forced);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(styles_of("mine.safetensors").size(), count);
  EXPECT_EQ(styles_of("mine.safetensors").back()["origin"], "1 pair, 3.97 s: walk.bvh -> bent.bvh");
  EXPECT_EQ(entries(), (Names{"bent.bvh", "mine.safetensors", "model.safetensors", "walk.bvh"}));
}

TEST_F(LearnVerb, a_wrong_command_is_rejected) {
  const std::string cure = "; expected STYLED, or NEUTRAL STYLED, or several such pairs";
  expect_rejected("walk.bvh bent.bvh bent.bvh --name bent --into mine.safetensors", 2,
                  "there are 3 clips" + cure);
  expect_rejected("walk.bvh bent.bvh --name bent --into mine.txt", 2,
                  "--into mine.txt: expected a name that ends in .safetensors");
  expect_rejected("walk.bvh bent.bvh --name a=b --into mine.safetensors", 2,
                  "--name: style name 'a=b': holds a '=', which separates names from strengths");
  expect_rejected({"walk.bvh", "bent.bvh", "--name", "", "--into", "mine.safetensors"}, 2,
                  "--name: style name '': is empty");
  expect_rejected("walk.bvh bent.bvh --into mine.safetensors", 2,
                  "--name is required; see panache learn --help");
}

TEST_F(LearnVerb, a_model_that_cannot_learn_says_so) {
  write("smith.safetensors", format_safetensors(make_model({"old"}, 1, test::kSmith2019)));
  for (const std::string model : {"model.safetensors", "smith.safetensors"}) {
    expect_rejected(
        {"walk.bvh", "bent.bvh", "--name", "bent", "--into", model}, 1,
        model +
            ": has no trunk that styles can be learnt on; expected a model of recipe "
            "panache with 'learn.mean' and 'learn.scale', as panache-lab train writes it");
  }
}

TEST_F(LearnVerb, a_file_that_is_no_model_is_rejected) {
  write("none.safetensors", "");
  expect_rejected(
      "walk.bvh bent.bvh --name bent --into none.safetensors", 1,
      "none.safetensors: has 0 bytes; expected a safetensors file, which starts with the "
      "8-byte length of its header");
  must("styles --extract old -o old.safetensors");
  expect_rejected("walk.bvh bent.bvh --name bent --into old.safetensors", 1,
                  "old.safetensors: is a style file, not a model; panache styles MODEL --add FILE "
                  "puts it into one");
}

TEST_F(LearnVerb, a_clip_that_teaches_nothing_is_rejected) {
  const auto reject = [&](const std::string& styled, const std::string& message) {
    expect_rejected({"walk.bvh", styled, "--name", "bent", "--into", "mine.safetensors"}, 1,
                    message);
  };
  reject("missing.bvh", "missing.bvh: cannot be read: No such file or directory");
  write("empty.bvh", "");
  reject("empty.bvh", "empty.bvh:1:1: expected 'HIERARCHY', found the end of the file");
  write_clip("brief.bvh", cut(clip_of("bent.bvh"), 10));
  reject("brief.bvh",
         "brief.bvh: has 0.33 s of motion; a style is learnt from 0.50 s at least, better from 2 "
         "to 3 s; give a longer clip");
  write("hero.glb", to_glb(character()));
  reject("hero.glb",
         "hero.glb: holds 2 motions ('Walk', 'Wave'); expected one; panache convert --clip NAME "
         "takes one out of it");
}

TEST_F(LearnVerb, clips_that_are_no_pair_are_rejected) {
  Clip moved = clip_of("bent.bvh");
  moved.skeleton.joints[index(HumanJoint::left_shoulder)].parent = index(HumanJoint::spine);
  write_clip("moved.bvh", moved);
  expect_rejected("walk.bvh moved.bvh --name bent --into mine.safetensors", 1,
                  "walk.bvh and moved.bvh: have different skeletons (joint 6 is 'leftShoulder' "
                  "and 'rightShoulder'); a pair needs the same joints of the body: leave the "
                  "neutral clip out, or retarget the styled clip onto it (panache retarget STYLED "
                  "--onto NEUTRAL)");
  // Half a second that may advance by 3 frames at a time, and wait twice in a row.
  write_clip("brief.bvh", cut(clip_of("walk.bvh"), 15));
  expect_rejected("brief.bvh bent.bvh --name bent --into mine.safetensors", 1,
                  "brief.bvh and bent.bvh: no match was found between them, as the neutral one is "
                  "too short for the styled one; a pair shows one action, done neutrally and in "
                  "the style");
}

TEST_F(LearnVerb, warnings_are_for_people_and_do_not_stop_it) {
  write_clip("brief.bvh", cut(clip_of("bent.bvh"), 24));
  const Words arguments = "walk.bvh brief.bvh --name bent --into mine.safetensors";
  const std::string warning =
      "brief.bvh: has only 0.80 s; 2 to 3 s of a walk, or the whole of an action, teach more";
  const Ran ran = learn(arguments);
  EXPECT_EQ(ran.exit, 0);
  EXPECT_EQ(ran.err, "panache: warning: " + warning + "\n");
  EXPECT_TRUE(begins(ran.out, "learnt 'bent' in "));
  Names for_machines = arguments;
  for_machines.insert(for_machines.end(), {"--force", "--json"});
  EXPECT_EQ(json::parse(learn(for_machines).out)["pairs"][0]["warnings"], json::array({warning}));
}

TEST_F(LearnVerb, what_is_too_short_to_be_judged_is_learnt_and_not_judged) {
  write_clip("brief.bvh", cut(clip_of("bent.bvh"), 15));
  Words arguments = "walk.bvh brief.bvh --name bent --into mine.safetensors";
  const Ran ran = learn(arguments);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(ran.out.ends_with("  too short to hold a quarter back, so the error is unknown\n"))
      << ran.out;
  arguments.insert(arguments.end(), {"--force", "--json"});
  const json out = json::parse(learn(arguments).out);
  for (const char* key : {"held_back_cm", "mean_posture_cm", "untouched_cm", "verdict"}) {
    EXPECT_TRUE(out[key].is_null()) << key;
  }
}

TEST_F(LearnVerb, a_style_that_is_no_better_than_the_input_says_so) {
  // Upright in the quarter that is held back.
  Clip half = clip_of("bent.bvh");
  const Clip walk = clip_of("walk.bvh");
  const auto from = static_cast<long>(walk.joints() * static_cast<size_t>(walk.frames * 3 / 4));
  std::copy(walk.rotations.begin() + from, walk.rotations.end(), half.rotations.begin() + from);
  write_clip("half.bvh", half);
  Words arguments = "walk.bvh half.bvh --name bent --into mine.safetensors";
  const Ran ran = learn(arguments);
  EXPECT_EQ(ran.exit, 0);
  EXPECT_TRUE(begins(ran.err,
                     "panache: warning: 'bent' is no better than the input on the "
                     "part of the clips that was held back ("));
  EXPECT_TRUE(holds(ran.out, "\n  poor: joints "));
  arguments.insert(arguments.end(), {"--force", "--json"});
  const json out = json::parse(learn(arguments).out);
  EXPECT_EQ(out["verdict"], "poor");
  EXPECT_EQ(out["warnings"].size(), 1u);
}

TEST_F(LearnVerb, a_place_that_takes_no_file_is_told) {
  expect_rejected("walk.bvh bent.bvh --name bent --into walk.bvh/mine.safetensors", 1,
                  "walk.bvh/mine.safetensors: cannot be written: Not a directory");
  const std::string longest = std::string(300, 'x') + ".safetensors";
  expect_rejected({"walk.bvh", "bent.bvh", "--name", "bent", "--into", longest}, 1,
                  longest + ": cannot be written: File name too long");
}

TEST_F(LearnVerb, a_pose_is_a_style) {
  const Ran ran = learn("bent.bvh --pose --name posed --into new.safetensors");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(
      ran.out.ends_with("  standing upright -> bent.bvh: a pose; all motion is changed alike\n"))
      << ran.out;
  const Ran two = learn("walk.bvh bent.bvh --pose --name bent --into new.safetensors --json");
  EXPECT_EQ(json::parse(two.out)["verdict"], json());
  expect_rejected("walk.bvh walk.bvh bent.bvh --pose --name x --into x.safetensors", 2,
                  "--pose: expected POSE or NEUTRAL POSE, found 3 clips");
}

}  // namespace
}  // namespace panache::test
