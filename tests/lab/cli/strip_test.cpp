// panache-lab strip: motion as a picture.

#include <array>

#include "cli/no_lock.h"
#include "clip/make_character.h"
#include "lab_program.h"

namespace panache::test {
namespace {

class Strip : public LabTest {
 protected:
  void SetUp() override {
    LabTest::SetUp();
    write_walk("walk.bvh", 100);
  }
  // How often the picture holds `part`.
  size_t count(const std::string& part) const {
    const std::string svg = read("out.svg");
    size_t found = 0;
    for (size_t at = 0; (at = svg.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
  }
};

// Width and height of a PNG, which stand at its bytes 16 to 23.
std::array<int, 2> size_of(const std::string& png) {
  EXPECT_TRUE(begins(png, "\x89PNG\r\n")) << png.size();
  if (png.size() < 24) return {};
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(png[i]); };
  const auto number = [&](size_t i) {
    return byte(i) << 24 | byte(i + 1) << 16 | byte(i + 2) << 8 | byte(i + 3);
  };
  return {number(16), number(20)};
}

TEST_F(Strip, draws_a_row_for_each_file_under_its_name) {
  write_walk("more/run & jump.bvh", 100);
  const Ran ran = must({"strip", "walk.bvh", "more/run & jump.bvh", "-o", "out.svg"});
  EXPECT_EQ(ran.out, "drew 2 rows into out.svg\n");
  EXPECT_EQ(count("<svg "), 1u);
  EXPECT_EQ(count(">walk<"), 1u);
  EXPECT_EQ(count(">run &amp; jump<"), 1u);
}

TEST_F(Strip, draws_a_head_for_each_moment_asked_for) {
  must("strip walk.bvh -o out.svg --from 1 --to 2 --every 0.2 --label mine");
  EXPECT_EQ(count(">mine<"), 1u);
  const size_t marks = count("<circle");
  // 1, 1.2, ... 2 s.
  EXPECT_EQ(marks % 6, 0u);
  run("strip walk.bvh -o out.svg --from 1 --to 2 --every 0.5 --force");
  EXPECT_EQ(count("<circle"), marks / 2);
  // To the end of the clip, 3.3 s, as it has no 4 s more.
  run("strip walk.bvh -o out.svg --from 2.3 --every 0.5 --force");
  EXPECT_EQ(count("<circle"), marks / 2);
}

TEST_F(Strip, draws_any_format_and_believes_what_is_said_of_the_rig) {
  EXPECT_EQ(run_panache("convert walk.bvh -o walk.glb").exit, 0);
  must("strip walk.glb --clip walk -o out.svg");
  const size_t marks = count("<circle");
  must("strip walk.bvh --up y --scale 1 -o out.svg --force");
  EXPECT_EQ(count("<circle"), marks);
  std::filesystem::remove(path("out.svg"));
  expect_rejected("strip walk.bvh --clip run -o out.svg", 1,
                  "walk.bvh: holds one motion, which has no name; expected no --clip, found 'run'");
}

TEST_F(Strip, writes_pixels_where_the_name_says_png) {
  must("strip walk.bvh -o out.svg");
  must("strip walk.bvh -o out.png");
  // Two pixels for each of the drawing's.
  const std::string svg = read("out.svg");
  const double drawn = std::stod(svg.substr(svg.find("width=\"") + 7));
  EXPECT_NEAR(size_of(read("out.png"))[0], 2 * drawn, 2);
}

TEST_F(Strip, draws_as_many_rows_as_are_asked_for) {
  Words arguments = "strip --to 0.2 -o out.png";
  arguments.insert(arguments.end(), 120, "walk.bvh");
  must(arguments);
  EXPECT_NEAR(size_of(read("out.png"))[1], 32000, 1);
}

TEST_F(Strip, draws_from_the_front_when_asked) {
  must("strip walk.bvh -o out.svg");
  const std::string side = read("out.svg");
  must("strip walk.bvh --front -o out.svg --force");
  EXPECT_FALSE(side == read("out.svg"));
  EXPECT_EQ(run("strip walk.bvh --front --travel -o out.svg --force").exit, 2);
}

TEST_F(Strip, rejects_what_makes_no_picture) {
  expect_rejected("strip walk.bvh -o out.jpg", 2,
                  "out.jpg: expected a name that ends in .svg or .png");
  expect_rejected("strip walk.bvh -o out.svg --every 0", 2,
                  "--every: expected a number from 0.01 to 60, found 0");
  expect_rejected("strip walk.bvh -o out.svg --every nan", 2,
                  "--every: expected a number from 0.01 to 60, found nan");
  expect_rejected("strip walk.bvh -o out.svg --from -1", 2,
                  "--from: expected a number from 0 to 86400, found -1");
  expect_rejected("strip walk.bvh -o out.svg --from 2 --to 1", 2,
                  "--to 1: expected a time after --from 2");
  expect_rejected("strip walk.bvh -o out.svg --every 0.01 --to 11", 2,
                  "--every 0.01: expected at most 1000 figures from 0 to 11 s");
  expect_rejected("strip walk.bvh -o out.svg --label a b", 2,
                  "--label: expected one for each of the 1 file, found 2");
  expect_rejected("strip walk.bvh -o out.svg --from 3.5", 1,
                  "walk.bvh: ends at 3.30 s; expected motion from 3.5 s on");
  expect_rejected("strip walk.bvh none.bvh -o out.svg", 1,
                  "none.bvh: cannot be read: No such file or directory");
}

TEST_F(Strip, draws_the_first_clip_of_a_file_unless_another_is_named) {
  write("hero.glb", to_glb(character()));
  ASSERT_EQ(run_panache("stylize hero.glb --clip Walk --style old=1 -o old.glb").exit, 0);
  must("strip old.glb -o out.svg --label a");
  must({"strip", "old.glb", "--clip", "Walk (old 1)", "-o", "named.svg", "--label", "a"});
  EXPECT_TRUE(read("out.svg") == read("named.svg"));
}

TEST_F(Strip, without_a_lock_draws_no_pixels) {
  expect_no_work_without_a_lock(*this, {"strip", "walk.bvh", "-o", "out.png"}, "out.png");
}

TEST_F(Strip, keeps_an_existing_picture_without_force) {
  write("out.svg", "mine");
  const Ran ran = run("strip walk.bvh -o out.svg");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err, "panache-lab: out.svg: exists already; --force overwrites it\n");
  EXPECT_EQ(read("out.svg"), "mine");
}

}  // namespace
}  // namespace panache::test
