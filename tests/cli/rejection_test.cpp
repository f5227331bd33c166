// What the program says to a wrong file or a wrong command, word for word, and its exit code: 1
// where a file is at fault, 2 where the command is.

#include <unistd.h>

#include "cli/program.h"

namespace panache::test {
namespace {

class Rejection : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
  }
  void expect_rejected(const std::vector<std::string>& arguments, int exit,
                       const std::string& message, const std::string& model = "model.safetensors") {
    const Ran ran = run(arguments, model);
    EXPECT_EQ(ran.err, "panache: " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
    EXPECT_EQ(ran.out, "");
  }
  // stylize walk.bvh with `style`, which is rejected before anything is written.
  void expect_style_rejected(const std::string& style, const std::string& message) {
    expect_rejected({"stylize", "walk.bvh", "--style", style, "-o", "out.bvh"}, 2, message);
    EXPECT_FALSE(exists("out.bvh"));
  }
  // stylize FILE, whose contents are `bytes`.
  void expect_file_rejected(const std::string& bytes, const std::string& message) {
    write("bad.bvh", bytes);
    expect_rejected({"stylize", "bad.bvh", "--style", "old=1", "-o", "out.bvh"}, 1, message);
    EXPECT_FALSE(exists("out.bvh"));
  }
  void expect_table_rejected(const std::string& table, const std::string& message) {
    write("table.csv", table);
    expect_rejected({"stylize", "walk.bvh", "--strengths", "table.csv", "-o", "out.bvh"}, 1,
                    message);
  }
  void expect_model_rejected(const TensorFile& model, const std::string& message) {
    write("other.safetensors", format_safetensors(model));
    for (const std::string from : {"argument", "environment"}) {
      std::vector<std::string> arguments = {"stylize", "walk.bvh", "--style",
                                            "old=1",   "-o",       "out.bvh"};
      if (from == "argument") arguments.insert(arguments.end(), {"--model", "other.safetensors"});
      expect_rejected(arguments, 1, message,
                      from == "argument" ? "model.safetensors" : "other.safetensors");
    }
  }
};

TEST_F(Rejection, an_unknown_style_gets_the_nearest_names) {
  expect_style_rejected("olld=1",
                        "unknown style 'olld'; the nearest is old (panache styles lists all)");
}

TEST_F(Rejection, an_everyday_word_is_told_the_name_of_its_style) {
  TensorFile model = make_model({"angry", "old"});
  model.metadata["style_words"] = "furious\nelderly aged\n";
  write("words.safetensors", format_safetensors(model));
  expect_rejected({"stylize", "walk.bvh", "--style", "elderly", "-o", "out.bvh"}, 2,
                  "--style elderly: elderly is old here; expected a name and a strength, as in "
                  "'old=1'",
                  "words.safetensors");
  const Ran by_word =
      run({"stylize", "walk.bvh", "--style", "Elderly=1", "-o", "word.bvh"}, "words.safetensors");
  EXPECT_EQ(by_word.exit, 0);
  EXPECT_NE(by_word.err.find("panache: Elderly is old here\n"), std::string::npos) << by_word.err;
  const Ran by_name =
      run({"stylize", "walk.bvh", "--style", "OLD=1", "-o", "name.bvh"}, "words.safetensors");
  EXPECT_EQ(by_name.err.find(" here"), std::string::npos) << by_name.err;
  EXPECT_EQ(read("word.bvh"), read("name.bvh"));
}

TEST_F(Rejection, a_strength_is_a_finite_number_in_range) {
  for (const std::string strength : {"nan", "NaN", "inf", "-inf", "much", "", "4.1", "-5", "1e40",
                                     "0x1", "1 ", "1,5", "..", "0..", "..1", "0..nan", "1..5"}) {
    expect_style_rejected("old=" + strength, "--style old=" + strength +
                                                 ": expected a strength from -4 to 4 or a change "
                                                 "such as '1..0', found '" +
                                                 strength + "'");
  }
}

TEST_F(Rejection, a_style_needs_a_strength) {
  expect_style_rejected("old", "--style old: expected a name and a strength, as in 'old=1'");
}

TEST_F(Rejection, a_style_has_one_strength) {
  expect_rejected({"stylize", "walk.bvh", "--style", "old=1", "--style", "old=2", "-o", "out.bvh"},
                  2, "--style old=2: this style has a strength already; expected each style once");
  write("table.csv", "seconds,old\n0,1\n");
  expect_rejected(
      {"stylize", "walk.bvh", "--style", "old=1", "--strengths", "table.csv", "-o", "out.bvh"}, 2,
      "style 'old' has strengths both from --style and from table.csv; expected one of "
      "them");
}

TEST_F(Rejection, a_style_is_needed) {
  expect_rejected({"stylize", "walk.bvh", "-o", "out.bvh"}, 2,
                  "a style is missing; expected one, as in --style angry=1, or a table of "
                  "strengths (--strengths); "
                  "the model has angry, old, proud and sad");
  // Before anything is said about the output.
  expect_rejected({"stylize", "walk.bvh"}, 2,
                  "a style is missing; expected one, as in --style angry=1, or a table of "
                  "strengths (--strengths); "
                  "the model has angry, old, proud and sad");
  std::vector<std::string> many;
  for (char c = 'a'; c < 'o'; ++c) many.emplace_back(1, c);
  write("many.safetensors", format_safetensors(make_model(many)));
  expect_rejected(
      {"stylize", "walk.bvh", "--model", "many.safetensors"}, 2,
      "a style is missing; expected one, as in --style a=1, or a table of strengths (--strengths); "
      "the "
      "model has a, b, c, d, e, f, g, h, i, j, k, l and 2 more (panache styles lists all)");
}

TEST_F(Rejection, a_style_that_is_not_written_as_one) {
  expect_rejected({"stylize", "walk.bvh", "old=1"}, 2,
                  "old=1: there is no such file; a style is given as --style old=1");
  expect_rejected({"stylize", "walk.bvh", "old", "-o", "out.bvh"}, 2,
                  "old: there is no such file; a style is given as --style old=1");
  expect_style_rejected("--force",
                        "--style: expected a name and a strength after it, found '--force'");
  expect_style_rejected("old:1", "--style old:1: expected a name and a strength, as in 'old=1'");
  expect_style_rejected("olld",
                        "unknown style 'olld'; the nearest is old (panache styles lists all)");
  expect_style_rejected("1=old",
                        "--style 1=old: expected the name before the strength, as in 'old=1'");
  expect_style_rejected("old=1,proud=0.5",
                        "--style old=1,proud=0.5: expected one style; the others go with an option "
                        "each, as in --style old=1 --style proud=0.5");
}

TEST_F(Rejection, an_output_without_its_option) {
  expect_rejected({"convert", "walk.bvh", "walk.glb"}, 2,
                  "walk.glb: there is no such file; an output is given as --output walk.glb");
  expect_rejected({"styles", "model.safetensors", "--remove", "old", "-o", "out.safetensors"}, 2,
                  "--output: goes with --extract; --add, --remove and --rename change MODEL "
                  "itself");
}

TEST_F(Rejection, a_file_that_holds_no_motion) {
  expect_rejected({"info", "none"}, 1, "none: cannot be read: No such file or directory");
  expect_rejected(
      {"retarget", "walk.bvh", "--onto", "model.safetensors", "-o", "out.glb"}, 1,
      "model.safetensors: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, "
      ".fbx, .npz), found the extension '.safetensors', which models and styles have");
}

TEST_F(Rejection, a_wrong_table_is_explained_with_its_line) {
  expect_table_rejected("",
                        "table.csv:1: expected the columns 'seconds' and one or more styles, "
                        "found ''");
  expect_table_rejected("seconds\n1\n",
                        "table.csv:1: expected the columns 'seconds' and one or more styles, found "
                        "'seconds'");
  expect_table_rejected(
      "seconds,olld\n0,1\n",
      "table.csv:1: unknown style 'olld'; the nearest is old (panache styles lists all)");
  expect_table_rejected("seconds,old,old\n0,1,1\n", "table.csv:1: column 'old' is there twice");
  expect_table_rejected("seconds,old\n", "table.csv: expected a line of strengths, found none");
  expect_table_rejected("seconds,old\n0,1\n1\n",
                        "table.csv:3: has 1 cells; expected 2 as in the first line");
  expect_table_rejected("seconds,old\nnow,1\n",
                        "table.csv:2: expected a number of seconds, found 'now'");
  expect_table_rejected(
      "seconds,old\n0,1\n2,1\n1,1\n",
      "table.csv:4: expected seconds that rise from line to line, found '1' after "
      "a later time");
  expect_table_rejected(
      "seconds,old\n0,nan\n",
      "table.csv:2: expected a strength from -4 to 4 in column 'old', found 'nan'");
}

TEST_F(Rejection, an_empty_file) {
  expect_file_rejected("", "bad.bvh:1:1: expected 'HIERARCHY', found the end of the file");
}

TEST_F(Rejection, a_binary_file) {
  expect_file_rejected(std::string("\x7f"
                                   "ELF\x02\x01\0\0",
                                   8),
                       "bad.bvh:1:1: expected 'HIERARCHY', found '\\x7fELF\\x02\\x01\\x00\\x00'");
}

TEST_F(Rejection, an_unreadable_path) {
  expect_rejected({"stylize", "none.bvh", "--style", "old=1", "-o", "out.bvh"}, 1,
                  "none.bvh: cannot be read: No such file or directory");
  std::filesystem::create_directory(path("folder.bvh"));
  expect_rejected(
      {"stylize", "folder.bvh", "--style", "old=1", "-o", "out.bvh"}, 1,
      "folder.bvh: holds no motion file, and neither do its folders (.bvh, .glb, .gltf, "
      ".vrm, .vrma, .amc, .fbx, .npz)");
  expect_rejected({"info", "folder.bvh"}, 1,
                  "folder.bvh: holds no motion file, and neither do its folders (.bvh, .glb, "
                  ".gltf, .vrm, .vrma, .amc, .fbx, .npz)");
  expect_rejected({"info", "none.bvh"}, 1, "none.bvh: cannot be read: No such file or directory");
}

TEST_F(Rejection, an_unknown_extension) {
  write("walk.c3d", "");
  expect_rejected(
      {"stylize", "walk.c3d", "--style", "old=1", "-o", "out.bvh"}, 1,
      "walk.c3d: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx, .npz), found "
      "the extension "
      "'.c3d'");
  write("walk", "");
  expect_rejected({"stylize", "walk", "--style", "old=1", "-o", "out.bvh"}, 1,
                  "walk: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx, "
                  ".npz), found no extension");
  expect_rejected(
      {"stylize", "walk.bvh", "--style", "old=1", "-o", "out.c3d"}, 2,
      "out.c3d: expected a name that ends in .bvh, .glb, .vrma, .fbx or .npz, or a folder (with a "
      "'/' at its end)");
  expect_rejected({"stylize", "walk.vrm", "--style", "old=1", "-o", "out.gltf"}, 2,
                  "out.gltf: expected a name that ends in .vrm, .bvh, .glb, .vrma, .fbx or .npz, "
                  "or a folder (with a "
                  "'/' at its end)");
}

TEST_F(Rejection, an_unmapped_rig) {
  Skeleton box;
  box.joints.push_back({"Box", -1, {}, {}, true, true, {}, ""});
  box.joints.push_back({"Lid", 0, {0, 1, 0}, {}, true, false, {{0, 1, 0}}, ""});
  Clip clip{box, 1.0 / 30, 2, std::vector<Quat>(4), std::vector<Vec3>(4)};
  write("box.bvh", format_bvh(clip));
  const std::string message =
      "box.bvh: no humanoid found: leftHand, rightHand, leftFoot, rightFoot, head are missing "
      "among 'Box', 'Lid' (2 joints); expected a person's joints: hips, two legs down to the "
      "feet and two arms down to the forearms";
  expect_rejected({"stylize", "box.bvh", "--style", "old=1", "-o", "out.bvh"}, 1, message);
}

TEST_F(Rejection, an_existing_output_without_force) {
  write("out.bvh", "mine");
  const std::vector<std::string> arguments = {"stylize", "walk.bvh", "--style",
                                              "old=1",   "-o",       "out.bvh"};
  expect_rejected(arguments, 1, "out.bvh: exists already; --force overwrites it");
  EXPECT_EQ(read("out.bvh"), "mine");
  std::vector<std::string> forced = arguments;
  forced.push_back("--force");
  EXPECT_EQ(run(forced).exit, 0);
  EXPECT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "-o", "new.bvh"}).exit, 0);
  EXPECT_TRUE(read("out.bvh") == read("new.bvh"));
}

TEST_F(Rejection, the_input_as_output_without_force) {
  const std::string before = read("walk.bvh");
  expect_rejected({"stylize", "walk.bvh", "--style", "old=1", "-o", "./walk.bvh"}, 1,
                  "./walk.bvh: is the input itself; --force overwrites it");
  EXPECT_TRUE(read("walk.bvh") == before);
  EXPECT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "-o", "new.bvh"}).exit, 0);
  EXPECT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "-o", "walk.bvh", "--force"}).exit, 0);
  EXPECT_TRUE(read("walk.bvh") == read("new.bvh"));
}

TEST_F(Rejection, one_output_for_several_inputs) {
  write_walk("more/walk.bvh");
  expect_rejected({"stylize", "walk.bvh", "more/walk.bvh", "--style", "old=1", "-o", "out"}, 2,
                  "'walk.bvh' and 'more/walk.bvh' would both be written to out/walk.bvh; expected "
                  "inputs with different names");
  expect_rejected({"stylize", "walk.bvh", "more/walk.bvh", "--style", "old=1", "-o", "out.bvh"}, 2,
                  "out.bvh: expected a folder for the results of 2 files; call it 'out.bvh/' if it "
                  "is to be one");
  expect_rejected({"stylize", "walk.bvh", "other.bvh", "--style", "old=1", "-o", "walk.bvh"}, 2,
                  "walk.bvh: is a file; expected a folder for the results of 2 files");
}

TEST_F(Rejection, an_output_that_cannot_be_written) {
  write("file", "");
  expect_rejected({"stylize", "walk.bvh", "--style", "old=1", "-o", "file/out.bvh"}, 1,
                  "file/out.bvh: cannot be written: Not a directory");
}

TEST_F(Rejection, a_model_of_another_version) {
  TensorFile model = make_model({"old"});
  model.metadata["format_version"] = "2";
  expect_model_rejected(model,
                        "other.safetensors: is a model of format version 2; this program reads "
                        "version 1; train it again or use the program it came with");
}

TEST_F(Rejection, a_model_with_a_wrong_shape) {
  TensorFile model = make_model({"old"});
  model.tensors["pose.head.0.weight"] = constant_tensor(3, 0);
  expect_model_rejected(model,
                        "other.safetensors: tensor 'pose.head.0.weight' has shape [3]; expected "
                        "[16, 67]");
}

TEST_F(Rejection, a_model_that_is_none) {
  expect_rejected({"styles", "walk.bvh"}, 1,
                  "walk.bvh: does not start with the length of a header (at most 4194304 bytes); "
                  "expected a safetensors file, as models and styles are");
  expect_rejected({"styles", "none.safetensors"}, 1,
                  "none.safetensors: cannot be read: No such file or directory");
}

TEST_F(Rejection, a_verb_that_does_not_exist) {
  expect_rejected({"stylise", "walk.bvh"}, 2,
                  "there is no command 'stylise'; the nearest is stylize; expected stylize, "
                  "learn, retarget, convert, info, styles, walker, live or view");
}

TEST_F(Rejection, an_option_that_does_not_exist) {
  expect_rejected(
      {"stylize", "walk.bvh", "-o", "out.bvh", "--style", "old=1", "--froce"}, 2,
      "there is no option '--froce'; the nearest is --force; see panache stylize --help");
  expect_rejected({"info", "walk.bvh", "--jsn=1"}, 2,
                  "there is no option '--jsn'; the nearest is --json; see panache info --help");
  expect_rejected({"info", "walk.bvh", "--xyz"}, 2,
                  "there is no option '--xyz'; see panache info --help");
}

TEST_F(Rejection, a_command_that_is_incomplete) {
  expect_rejected({"stylize", "walk.bvh", "-o", "out.bvh", "--style"}, 2,
                  "--style: expected a value after it; see panache stylize --help");
  expect_rejected({"walker", "--speed", "fast", "-o", "out.bvh"}, 2,
                  "--speed: expected a number, found 'fast'; see panache walker --help");
  expect_rejected({"stylize", "walk.bvh", "--style", "old=1", "--posture", "3"}, 2,
                  "--posture: expected a number from 0 to 2, found 3; see panache stylize --help");
  expect_rejected({"walker", "more", "-o", "out.bvh"}, 2,
                  "unexpected argument 'more'; see panache walker --help");
  expect_rejected({"stylize", "--style", "old=1", "-o", "out.bvh"}, 2,
                  "IN is required; see panache stylize --help");
  expect_rejected({"learn", "walk.bvh", "--nam", "limp"}, 2,
                  "there is no option '--nam'; the nearest is --name; --name is required; see "
                  "panache learn --help");
  expect_rejected({"--style", "old=1", "walk.bvh"}, 2,
                  "expected a command first; see panache --help");
  expect_rejected({"info"}, 2, "FILE is required; see panache info --help");
  expect_rejected({"stylize", "walk.bvh", "-o", "out.bvh", "--style", "old=1", "--jobs", "-1"}, 2,
                  "--jobs: expected a number from 0 to 1024, found -1");
  EXPECT_EQ(run({}).exit, 2);
}

}  // namespace
}  // namespace panache::test
