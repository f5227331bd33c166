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
  // stylize FILE, whose contents are `bytes`.
  void expect_file_rejected(const std::string& bytes, const std::string& message) {
    write("bad.bvh", bytes);
    expect_rejected("stylize bad.bvh --style old=1 -o out.bvh", 1, message);
  }
  void expect_model_rejected(const TensorFile& model, const std::string& message) {
    write("other.safetensors", format_safetensors(model));
    const Words arguments = "stylize walk.bvh --style old=1 -o out.bvh";
    expect_rejected(arguments + "--model other.safetensors", 1, message);
    expect_rejected(arguments, 1, message, "other.safetensors");
  }
};

const std::string kFormats = ".bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx, .npz";
const std::string kStyleMissing =
    "a style is missing; expected one, as in --style angry=1, or a table of strengths "
    "(--strengths); the model has angry, old, proud and sad";
const std::string kNearest = "unknown style 'olld'; the nearest is old (panache styles lists all)";

TEST_F(Rejection, every_wrong_command_gets_its_message) {
  const struct {
    const char* command;
    std::string message;
  } cases[] = {
      // Styles and their strengths.
      {"stylize walk.bvh --style olld=1 -o out.bvh", kNearest},
      {"stylize walk.bvh --style olld -o out.bvh", kNearest},
      {"stylize walk.bvh --style old -o out.bvh",
       "--style old: expected a name and a strength, as in 'old=1'"},
      {"stylize walk.bvh --style old:1 -o out.bvh",
       "--style old:1: expected a name and a strength, as in 'old=1'"},
      {"stylize walk.bvh --style 1=old -o out.bvh",
       "--style 1=old: expected the name before the strength, as in 'old=1'"},
      {"stylize walk.bvh --style old=1,proud=0.5 -o out.bvh",
       "--style old=1,proud=0.5: expected one style; the others go with an option each, as in "
       "--style old=1 --style proud=0.5"},
      {"stylize walk.bvh --style --force -o out.bvh",
       "--style: expected a name and a strength after it, found '--force'"},
      {"stylize walk.bvh old=1", "old=1: there is no such file; a style is given as --style old=1"},
      {"stylize walk.bvh old -o out.bvh",
       "old: there is no such file; a style is given as --style old=1"},
      {"stylize walk.bvh --style old=1 --style old=2 -o out.bvh",
       "--style old=2: this style has a strength already; expected each style once"},
      {"stylize walk.bvh -o out.bvh", kStyleMissing},
      {"stylize walk.bvh", kStyleMissing},  // Before anything is said about the output.
      // Outputs.
      {"convert walk.bvh walk.glb",
       "walk.glb: there is no such file; an output is given as --output walk.glb"},
      {"styles model.safetensors --remove old -o out.safetensors",
       "--output: goes with --extract; --add, --remove and --rename change MODEL itself"},
      {"stylize walk.bvh --style old=1 -o out.c3d",
       "out.c3d: expected a name that ends in .bvh, .glb, .vrma, .fbx or .npz, or a folder (with a "
       "'/' at its end)"},
      {"stylize walk.vrm --style old=1 -o out.gltf",
       "out.gltf: expected a name that ends in .vrm, .bvh, .glb, .vrma, .fbx or .npz, or a folder "
       "(with a '/' at its end)"},
      {"stylize walk.bvh more/walk.bvh --style old=1 -o out",
       "'walk.bvh' and 'more/walk.bvh' would both be written to out/walk.bvh; expected inputs with "
       "different names"},
      {"stylize walk.bvh more/walk.bvh --style old=1 -o out.bvh",
       "out.bvh: expected a folder for the results of 2 files; call it 'out.bvh/' if it is to be "
       "one"},
      {"stylize walk.bvh other.bvh --style old=1 -o walk.bvh",
       "walk.bvh: is a file; expected a folder for the results of 2 files"},
      // Verbs and options.
      {"stylise walk.bvh",
       "there is no command 'stylise'; the nearest is stylize; expected stylize, learn, retarget, "
       "convert, info, styles, walker, live or view"},
      {"stylize walk.bvh -o out.bvh --style old=1 --froce",
       "there is no option '--froce'; the nearest is --force; see panache stylize --help"},
      {"info walk.bvh --jsn=1",
       "there is no option '--jsn'; the nearest is --json; see panache info --help"},
      {"info walk.bvh --xyz", "there is no option '--xyz'; see panache info --help"},
      {"stylize walk.bvh -o out.bvh --style",
       "--style: expected a value after it; see panache stylize --help"},
      {"walker --speed fast -o out.bvh",
       "--speed: expected a number, found 'fast'; see panache walker --help"},
      {"stylize walk.bvh --style old=1 --posture 3",
       "--posture: expected a number from 0 to 2, found 3; see panache stylize --help"},
      {"walker more -o out.bvh", "unexpected argument 'more'; see panache walker --help"},
      {"walker -o out.bvh --speed 9", "--speed: expected a number from 0 to 4.5, found 9"},
      {"walker -o out.bvh --speed nan", "--speed: expected a number from 0 to 4.5, found nan"},
      {"walker -o out.bvh --seconds 0", "--seconds: expected a number from 0.1 to 600, found 0"},
      {"walker -o out.bvh --fps 1000", "--fps: expected a number from 10 to 240, found 1000"},
      {"walker -o out.bvh --turn -500",
       "--turn: expected a number from -120 to 120, found -500 at --speed 1.4"},
      {"walker -o walk.fbx", "walk.fbx: expected a name that ends in .bvh"},
      {"stylize --style old=1 -o out.bvh", "IN is required; see panache stylize --help"},
      {"learn walk.bvh --nam limp",
       "there is no option '--nam'; the nearest is --name; --name is required; see panache learn "
       "--help"},
      {"--style old=1 walk.bvh", "expected a command first; see panache --help"},
      {"info", "FILE is required; see panache info --help"},
      {"stylize walk.bvh -o out.bvh --style old=1 --jobs -1",
       "--jobs: expected a number from 0 to 1024, found -1"},
  };
  write_walk("more/walk.bvh");
  for (const auto& [command, message] : cases) expect_rejected(command, 2, message);
  EXPECT_EQ(run({}).exit, 2);
  write("table.csv", "seconds,old\n0,1\n");
  expect_rejected("stylize walk.bvh --style old=1 --strengths table.csv -o out.bvh", 2,
                  "style 'old' has strengths both from --style and from table.csv; expected one of "
                  "them");
  std::vector<std::string> many;
  for (char c = 'a'; c < 'o'; ++c) many.emplace_back(1, c);
  write("many.safetensors", format_safetensors(make_model(many)));
  expect_rejected("stylize walk.bvh --model many.safetensors", 2,
                  "a style is missing; expected one, as in --style a=1, or a table of strengths "
                  "(--strengths); the model has a, b, c, d, e, f, g, h, i, j, k, l and 2 more "
                  "(panache styles lists all)");
}

TEST_F(Rejection, a_strength_is_a_finite_number_in_range) {
  for (const std::string strength : {"nan", "NaN", "inf", "-inf", "much", "", "4.1", "-5", "1e40",
                                     "0x1", "1 ", "1,5", "..", "0..", "..1", "0..nan", "1..5"}) {
    expect_rejected({"stylize", "walk.bvh", "--style", "old=" + strength, "-o", "out.bvh"}, 2,
                    "--style old=" + strength +
                        ": expected a strength from -4 to 4 or a change such as '1..0', found '" +
                        strength + "'");
  }
}

TEST_F(Rejection, an_everyday_word_is_told_the_name_of_its_style) {
  TensorFile model = make_model({"angry", "old"});
  model.metadata["style_words"] = "furious\nelderly aged\n";
  write("words.safetensors", format_safetensors(model));
  expect_rejected("stylize walk.bvh --style elderly -o out.bvh", 2,
                  "--style elderly: elderly is old here; expected a name and a strength, as in "
                  "'old=1'",
                  "words.safetensors");
  EXPECT_TRUE(holds(must("stylize walk.bvh --style Elderly=1 -o word.bvh", "words.safetensors").err,
                    "panache: Elderly is old here\n"));
  EXPECT_FALSE(
      holds(must("stylize walk.bvh --style OLD=1 -o name.bvh", "words.safetensors").err, " here"));
  EXPECT_EQ(read("word.bvh"), read("name.bvh"));
}

TEST_F(Rejection, a_wrong_table_is_explained_with_its_line) {
  const std::pair<std::string, std::string> cases[] = {
      {"", ":1: expected the columns 'seconds' and one or more styles, found ''"},
      {"seconds\n1\n",
       ":1: expected the columns 'seconds' and one or more styles, found 'seconds'"},
      {"seconds,olld\n0,1\n", ":1: " + kNearest},
      {"seconds,old,old\n0,1,1\n", ":1: column 'old' is there twice"},
      {"seconds,old\n", ": expected a line of strengths, found none"},
      {"seconds,old\n0,1\n1\n", ":3: has 1 cells; expected 2 as in the first line"},
      {"seconds,old\nnow,1\n", ":2: expected a number of seconds, found 'now'"},
      {"seconds,old\n0,1\n2,1\n1,1\n",
       ":4: expected seconds that rise from line to line, found '1' after a later time"},
      {"seconds,old\n0,nan\n",
       ":2: expected a strength from -4 to 4 in column 'old', found 'nan'"}};
  for (const auto& [table, message] : cases) {
    write("table.csv", table);
    expect_rejected("stylize walk.bvh --strengths table.csv -o out.bvh", 1, "table.csv" + message);
  }
}

TEST_F(Rejection, every_file_that_cannot_be_used_is_named_with_the_reason) {
  expect_file_rejected("", "bad.bvh:1:1: expected 'HIERARCHY', found the end of the file");
  expect_file_rejected(std::string("\x7f"
                                   "ELF\x02\x01\0\0",
                                   8),
                       "bad.bvh:1:1: expected 'HIERARCHY', found '\\x7fELF\\x02\\x01\\x00\\x00'");
  write("walk.c3d", "");
  write("walk", "");
  write("file", "");
  std::filesystem::create_directory(path("folder.bvh"));
  const std::string unread = ": cannot be read: No such file or directory";
  const std::string empty =
      "folder.bvh: holds no motion file, and neither do its folders (" + kFormats + ")";
  const std::string wanted = ": expected a motion file (" + kFormats + "), found ";
  const struct {
    const char* command;
    std::string message;
  } cases[] = {
      {"info none", "none" + unread},
      {"info none.bvh", "none.bvh" + unread},
      {"stylize none.bvh --style old=1 -o out.bvh", "none.bvh" + unread},
      {"styles none.safetensors", "none.safetensors" + unread},
      {"stylize folder.bvh --style old=1 -o out.bvh", empty},
      {"info folder.bvh", empty},
      {"stylize walk.c3d --style old=1 -o out.bvh", "walk.c3d" + wanted + "the extension '.c3d'"},
      {"stylize walk --style old=1 -o out.bvh", "walk" + wanted + "no extension"},
      {"retarget walk.bvh --onto model.safetensors -o out.glb",
       "model.safetensors" + wanted + "the extension '.safetensors', which models and styles have"},
      {"styles walk.bvh",
       "walk.bvh: does not start with the length of a header (at most 4194304 bytes); expected a "
       "safetensors file, as models and styles are"},
      {"walker -o out.bvh --model none.safetensors", "none.safetensors" + unread},
      {"walker -o walk.bvh", "walk.bvh: exists already; --force overwrites it"},
      {"stylize walk.bvh --style old=1 -o file/out.bvh",
       "file/out.bvh: cannot be written: Not a directory"},
      {"stylize walk.bvh --style old=1 -o ./walk.bvh",
       "./walk.bvh: is the input itself; --force overwrites it"},
  };
  for (const auto& [command, message] : cases) expect_rejected(command, 1, message);
}

TEST_F(Rejection, an_unmapped_rig) {
  Skeleton box;
  box.joints.push_back({"Box", -1, {}, {}, true, true, {}, ""});
  box.joints.push_back({"Lid", 0, {0, 1, 0}, {}, true, false, {{0, 1, 0}}, ""});
  expect_file_rejected(
      format_bvh({box, 1.0 / 30, 2, std::vector<Quat>(4), std::vector<Vec3>(4)}),
      "bad.bvh: no humanoid found: leftHand, rightHand, leftFoot, rightFoot, head are missing "
      "among 'Box', 'Lid' (2 joints); expected a person's joints: hips, two legs down to the feet "
      "and two arms down to the forearms");
}

TEST_F(Rejection, force_overwrites_an_output_and_the_input) {
  write("out.bvh", "mine");
  const Words arguments = "stylize walk.bvh --style old=1 -o";
  expect_rejected(arguments + "out.bvh", 1, "out.bvh: exists already; --force overwrites it");
  must(arguments + "out.bvh --force");
  must(arguments + "new.bvh");
  EXPECT_TRUE(read("out.bvh") == read("new.bvh"));
  must(arguments + "walk.bvh --force");
  EXPECT_TRUE(read("walk.bvh") == read("new.bvh"));
}

TEST_F(Rejection, a_model_of_another_version_or_shape) {
  TensorFile model = make_model({"old"});
  model.metadata["format_version"] = "2";
  expect_model_rejected(model,
                        "other.safetensors: is a model of format version 2; this program reads "
                        "version 1; train it again or use the program it came with");
  model = make_model({"old"});
  model.tensors["pose.head.0.weight"] = constant_tensor(3, 0);
  expect_model_rejected(model,
                        "other.safetensors: tensor 'pose.head.0.weight' has shape [3]; expected "
                        "[16, 67]");
}

}  // namespace
}  // namespace panache::test
