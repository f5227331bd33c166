// Persons: a few numbers that change all that a character does, in addition to its styles.

#include "style/model/person.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "make_model.h"
#include "style/restyle.h"
#include "style/stylizer.h"
#include "style_checks.h"

namespace panache {
namespace {

using test::same_bits;

constexpr double kSeconds = 1 / 30.0;

TensorFile person_file() {
  TensorFile file = test::make_model({"old", "proud"}, 3);
  test::add_gate(file, 1.5f);
  test::add_persons(file);
  return file;
}

class Persons : public testing::Test {
 protected:
  Clip run(std::span<const float> person, std::vector<float> strengths = {0, 0},
           const TensorFile& file = person_file()) const {
    Stylizer stylizer = *Stylizer::create(read(file), rig_);
    stylizer.set_person(person);
    return played(stylizer, clip_, strengths);
  }

  Clip clip_ = test::walking_clip(90);
  Rig rig_ = *Rig::create(clip_);
};

TEST_F(Persons, with_all_numbers_0_leave_motion_and_styles_as_they_are_bit_for_bit) {
  const std::vector<float> nobody(3);
  EXPECT_TRUE(same_bits(run(nobody), clip_));
  TensorFile without = test::make_model({"old", "proud"}, 3);
  test::add_gate(without, 1.5f);
  EXPECT_TRUE(same_bits(run(nobody, {1, 0.5f}), run({}, {1, 0.5f}, without)));
}

TEST_F(Persons, change_motion_each_number_in_its_own_way) {
  const Clip first = run(std::vector<float>{1, 0, 0}), second = run(std::vector<float>{0, 1, 0});
  EXPECT_FALSE(same_bits(first, clip_));
  EXPECT_FALSE(same_bits(second, clip_));
  EXPECT_FALSE(same_bits(first, second));
  EXPECT_FALSE(same_bits(run(std::vector<float>{1, 0, 0}, {1, 0}), run({}, {1, 0})));
}

// The change of a person is the sum of its axes' changes, each in proportion to its number, and
// adds to that of a style.
TEST_F(Persons, add_up) {
  const auto model = read(person_file());
  const std::vector<float> window = window_of(1, 5);
  const auto answer = [&](std::vector<float> numbers, std::vector<float> strengths) {
    StyleNetworks networks(model);
    networks.set_strengths(strengths);
    networks.set_person(numbers);
    networks.forward(window);
    std::vector<float> out(networks.pose().begin(), networks.pose().end());
    out.push_back(networks.log_rate());
    return out;
  };
  const auto a = answer({1, 0, 0}, {0, 0}), b = answer({0, 1, 0}, {0, 0});
  const auto style = answer({0, 0, 0}, {1, 0}), all = answer({2, -1, 0}, {1, 0});
  double largest = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    // Sums of 51 products of about 1 and 0.3 in single precision.
    EXPECT_NEAR(all[i], 2 * a[i] - b[i] + style[i], 2e-5) << i;
    largest = std::max(largest, std::abs(double{a[i]}));
  }
  EXPECT_GT(largest, 0.01);
}

TEST_F(Persons, keep_their_side_where_a_style_is_mirrored) {
  const auto model = read(person_file());
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1, 6), person = {1, -0.5f, 0.7f};
  const auto pose = [&](float side, bool is_person) {
    networks.set_strengths(std::vector<float>{1, 0}, std::vector<float>{side, 1});
    networks.set_person(is_person ? person : std::vector<float>(3));
    networks.forward(window);
    return std::vector<float>(networks.pose().begin(), networks.pose().end());
  };
  const auto captured = pose(1, true), captured_alone = pose(1, false);
  const auto mirrored = pose(-1, true), mirrored_alone = pose(-1, false);
  for (size_t i = 0; i < captured.size(); ++i) {
    EXPECT_NEAR(captured[i] - captured_alone[i], mirrored[i] - mirrored_alone[i], 2e-5) << i;
  }
}

TEST_F(Persons, ease_in_and_out) {
  Stylizer stylizer = *Stylizer::create(read(person_file()), rig_);
  const std::vector<float> off = {0, 0}, somebody = {2, 1, -1}, nobody = {0, 0, 0};
  Clip out = clip_;
  const auto play = [&](int from, int to) {
    for (int f = from; f < to; ++f) stylizer.step(clip_.pose(f), off, kSeconds, out.pose(f));
  };
  const auto apart = [&](int f) {
    double sum = 0;
    for (size_t j = 0; j < clip_.joints(); ++j) {
      sum += double{
          length(log_rotation(out.pose(f).rotations[j] * conjugate(clip_.pose(f).rotations[j])))};
    }
    return sum;
  };
  play(0, 20);
  stylizer.set_person(somebody);
  play(20, 60);
  EXPECT_GT(apart(20), 0);
  EXPECT_LT(apart(20), 0.5 * apart(59));
  stylizer.set_person(nobody);
  play(60, 90);
  EXPECT_GT(apart(60), 0.3 * apart(59));
}

TEST_F(Persons, ignore_numbers_that_are_not_finite_and_bound_the_others) {
  Stylizer stylizer = *Stylizer::create(read(person_file()), rig_);
  stylizer.set_person(std::vector<float>{1, NAN, 100});
  EXPECT_EQ(stylizer.person()[0], 1);
  EXPECT_EQ(stylizer.person()[1], 0);
  EXPECT_EQ(stylizer.person()[2], kMaxPerson);
}

TEST_F(Persons, are_an_error_on_a_model_without_them) {
  const auto model = read(test::make_model({"old"}));
  EXPECT_EQ(model->persons(), nullptr);
  EXPECT_FALSE(check_has_persons(*model).ok());
  StylizerOptions options;
  options.person[0] = 1;
  const auto made = Stylizer::create(model, rig_, options);
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("has no persons"), std::string::npos);
}

TEST(DrawPerson, draws_the_same_person_for_a_seed_and_another_for_each) {
  std::vector<float> a(8), b(8), c(8);
  draw_person(7, a), draw_person(7, b), draw_person(8, c);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
  EXPECT_EQ(person_seed("mara"), person_seed("mara"));
  EXPECT_NE(person_seed("mara"), person_seed("marb"));
  std::vector<float> all(kMaxPersonAxes);
  draw_person(7, all);
  EXPECT_NE(all.back(), 0);
  EXPECT_EQ(person_seed("7"), 7u);
  EXPECT_EQ(person_seed("010"), 10u);
  EXPECT_EQ(person_seed("4294967295"), 4294967295u);
  for (const char* word : {"4294967296", "-7", "+7", "7up", " 7", ""}) {
    EXPECT_GT(person_seed(word), 100u) << word;
  }
}

// Means and deviations over 4,000 seeds: their errors have deviations of 0.016 and 0.011. Without
// the rarest twentieth the deviation of eight numbers is 0.965: the square root of the chi-squared
// distribution's 0.885 with ten degrees over 0.95 with eight, at 15.507.
TEST(DrawPerson, draws_as_people_are_distributed_without_the_rarest_twentieth) {
  constexpr int kSeeds = 4000, kAxes = 8;
  std::vector<double> sum(kAxes), squares(kAxes);
  for (uint32_t seed = 0; seed < kSeeds; ++seed) {
    std::vector<float> numbers(kAxes);
    draw_person(seed, numbers);
    double square = 0;
    for (int a = 0; a < kAxes; ++a) {
      sum[a] += numbers[a], squares[a] += numbers[a] * numbers[a];
      square += numbers[a] * numbers[a];
    }
    ASSERT_LE(square, 15.508);
  }
  for (int a = 0; a < kAxes; ++a) {
    EXPECT_NEAR(sum[a] / kSeeds, 0, 0.065) << a;
    EXPECT_NEAR(std::sqrt(squares[a] / kSeeds), 0.965, 0.045) << a;
  }
}

// The correlation of 2,000 pairs has a deviation of 0.022.
TEST(DrawPerson, draws_neighbouring_seeds_independently) {
  constexpr int kSeeds = 2000, kAxes = 8;
  for (int shift = -1; shift <= 1; ++shift) {
    double product = 0, count = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      std::vector<float> one(kAxes), next(kAxes);
      draw_person(seed, one), draw_person(seed + 1, next);
      product += one[3] * next[static_cast<size_t>(3 + shift)], ++count;
    }
    EXPECT_NEAR(product / count, 0, 0.09) << shift;
  }
}

TEST(PersonFiles, are_rejected_with_what_is_wrong) {
  TensorFile file = person_file();
  file.tensors["person.head.bias"].values[3] = 1;
  EXPECT_EQ(
      failure(file),
      "m.safetensors: tensor 'person.head.bias' must be zero, so that the mean person changes "
      "nothing");
  file = person_file();
  file.metadata["person_axes"] = "";
  EXPECT_NE(failure(file).find("metadata 'person_axes' has 0 lines; expected 1 to 10"),
            std::string::npos);
  file = person_file();
  file.metadata["person_axes"] = "one\ntwo";
  EXPECT_NE(failure(file).find("person.head"), std::string::npos);
  file = person_file();
  file.tensors.erase("person.reduce.bias");
  EXPECT_NE(failure(file).find("person.reduce"), std::string::npos);
}

}  // namespace
}  // namespace panache
