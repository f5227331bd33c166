#include "eval/systems/holden2017/holden2017.h"

#include <gtest/gtest.h>

#include "eval/make_swings.h"
#include "takes/manifest.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

using namespace holden2017;

class Holden : public testing::Test {
 protected:
  Holden() {
    EXPECT_TRUE(prepare_matrix_products().ok());
    takes_ = {test::swinging_take("neutral", 150, 0.3f), test::swinging_take("neutral", 150, 0.5f),
              test::swinging_take("old", 150, 0.3f, 1, 0.4f)};
    pairings_ = pair_takes(takes_, {2}, {0, 1});
    for (const Take& take : takes_) rows_.push_back(motion_rows(take));
  }
  std::vector<Take> takes_;
  std::vector<Pairing> pairings_;
  std::vector<torch::Tensor> rows_;
  const AutoencoderSettings small_ = {.units = 48, .steps = 400, .batch = 8};
};

TEST_F(Holden, the_autoencoder_reconstructs_motion) {
  const RowUnits units({rows_[0], rows_[1]});
  const torch::Tensor x = units.normalise(rows_[0]).narrow(1, 10, 96).unsqueeze(0);
  const Windows windows({units.normalise(rows_[0]), units.normalise(rows_[1])});
  const Autoencoder learnt(windows, 1, small_);
  const Autoencoder random(windows, 1, {.units = 48, .steps = 0, .batch = 8});
  const auto share_lost = [&](const Autoencoder& network) {
    return (torch::mse_loss(network.decode(network.encode(x)), x) / x.square().mean())
        .item<double>();
  };
  EXPECT_GT(share_lost(random), 0.7);
  EXPECT_LT(share_lost(learnt), 0.1);
}

TEST_F(Holden, a_network_moves_the_gram_matrix_towards_the_style_and_keeps_the_trajectory) {
  const RowUnits units({rows_[0], rows_[1]});
  const torch::Tensor neutral = units.normalise(rows_[0]), styled = units.normalise(rows_[2]);
  const Autoencoder loss_network(Windows({neutral}), 1, small_);
  const StyleMotion motion{{{{neutral}, {styled}}}};
  const Transfer transfer(loss_network, units, motion, 2, {.units = 32, .steps = 150, .batch = 4});
  const torch::Tensor x = neutral.narrow(1, 20, 96).unsqueeze(0), y = transfer(x);
  const auto gram_of = [&](const torch::Tensor& rows) { return gram(loss_network.encode(rows)); };
  const torch::Tensor wanted = gram_of(styled.narrow(1, 20, 96).unsqueeze(0));
  const double before = torch::mse_loss(gram_of(x), wanted).item<double>();
  EXPECT_LT(torch::mse_loss(gram_of(y), wanted).item<double>(), 0.7 * before);
  const auto root = [&](const torch::Tensor& rows) {
    return units.undo(rows).narrow(1, root_offset(PoseLayout::positions), kRootFeatures);
  };
  EXPECT_LT((root(y) - root(x)).abs().max().item<double>(), 0.5);  // m/s, radians/s.
}

TEST_F(Holden, the_system_bends_a_walk_as_the_style_is_bent_and_follows_from_its_seed) {
  HoldenSettings settings;
  settings.autoencoder = {.units = 48, .steps = 200, .batch = 8};
  settings.transfer = {.units = 32, .steps = 150, .batch = 4, .content = 0.1};
  const std::vector<StyleName> styles = {{"old", {"old"}, ""}};
  // The loss network has to have seen bodies that are bent.
  std::vector<Take> bent;
  for (const float bend : {-0.3f, 0.2f, 0.5f}) {
    bent.push_back(test::swinging_take("neutral", 150, 0.3f, 1, bend));
  }
  const auto make = [&] {
    return *Holden2017::create("holden2017", {takes_, pairings_, styles, 1, bent}, settings);
  };
  const auto system = make();
  const TestInput input = test::swinging_input(90, 0.3f);
  const auto head = [](const Take& take) {  // How far ahead of the hips it is, metres.
    return take.body[45][index(HumanJoint::head)].z - take.body[45][0].z;
  };
  const Take output = system->run(input, {"old", {{"old", 1.0f}}})->output.take;
  const float real = head(takes_[2]) - head(input.take);
  EXPECT_GT(real, 0.1f);
  // The content holds it back, and the Gram matrix counts hidden units, not degrees.
  EXPECT_GT(head(output) - head(input.take), 0.3f * real);
  EXPECT_LT(head(output) - head(input.take), 1.5f * real);
  EXPECT_GT(system->facts().parameters, 10'000u);

  const Take again = make()->run(input, {"old", {{"old", 1.0f}}})->output.take;
  EXPECT_EQ(again.body, output.body);
  const Take none = system->run(input, {"old", {{"old", 0.0f}}})->output.take;
  EXPECT_EQ(none.body, input.take.body);
}

}  // namespace
}  // namespace panache
