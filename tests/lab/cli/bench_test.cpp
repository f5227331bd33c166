// panache-lab bench, and that the networks that it times are those that it names.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>
#include <onnx/onnx_pb.h>

#include "bench/int8_layer.h"
#include "bench/measure.h"
#include "bench/motions.h"
#include "bench/networks.h"
#include "bench/onnx_file.h"
#include "bench/published.h"
#include "lab_program.h"
#include "net/dense.h"
#include "net/layer.h"
#include "rig/posed_rig.h"

namespace panache::test {
namespace {

using namespace panache::bench;
using Numbers = std::vector<float>;

class BenchVerb : public LabTest {};

TEST_F(BenchVerb, prints_every_number_that_it_promises) {
  const Ran ran = must("bench --steps 100 --json");
  const auto json = nlohmann::json::parse(ran.out);
  const std::pair<const char*, std::vector<const char*>> expected[] = {
      {"forward_pass_us", {"panache", "panache_half", "read_limit"}},
      {"peers_us", {"pfnn_cubic", "pfnn_constant", "mann", "mason"}},
      {"step_us", {"p50", "p99", "p99_9", "worst", "networks"}},
      {"bytes", {"model", "model_half"}}};
  for (const auto& [group, keys] : expected) {
    for (const char* key : keys) {
      ASSERT_TRUE(json.at(group).at(key).is_number()) << group << " " << key;
      EXPECT_GT(json.at(group).at(key), 0) << group << " " << key;
    }
  }
  for (const char* motion : {"walk", "clap", "crouch"}) {
    EXPECT_GT(json.at("step_over_networks").at(motion), 1) << motion;
  }
  EXPECT_GT(json.at("characters_at_60hz"), 0);
  EXPECT_EQ(json.at("steps"), 100);
  // The sanitizers' allocator does not tell what is in use.
  EXPECT_TRUE(json.at("bytes").at("character").is_number());
  // Libraries of others are there or not, and if not it is said why.
  for (const char* key : {"eigen", "openblas", "onednn", "onednn_int8", "onnxruntime",
                          "onnxruntime_int8", "libtorch"}) {
    const auto& time = json.at("forward_pass_us").at(key);
    EXPECT_TRUE(time.is_number() ? time > 0 : json.at("missing").at(key).is_string()) << key;
  }
}

TEST(BenchMotions, clap_and_crouch_on_84_joints) {
  const std::string walker = PANACHE_SOURCE_DIR "/models/walker.safetensors";
  const Result<Clip> clap = make_clap(walker), crouch = make_crouch(walker);
  ASSERT_TRUE(clap && crouch);
  const auto range = [](const Clip& clip, const auto& value) {
    const Result<Rig> rig = Rig::create(clip);
    EXPECT_TRUE(rig);
    EXPECT_EQ(clip.joints(), 84u);
    PosedRig posed(*rig);
    float low = 1e9f, high = -1e9f;
    for (int f = 0; f < clip.frames; ++f) {
      BodyPose pose;
      posed.read(clip.pose(f), pose);
      low = std::min(low, value(pose.joints)), high = std::max(high, value(pose.joints));
    }
    return std::pair(low, high);
  };
  const auto [together, apart] = range(*clap, [](const HumanPositions& joints) {
    return length(joints[index(HumanJoint::left_hand)] - joints[index(HumanJoint::right_hand)]);
  });
  EXPECT_NEAR(together, 0.1f, 0.02f);
  EXPECT_GT(apart, 0.4f);
  const auto height_of = [&](HumanJoint joint) {
    return range(*crouch, [&](const HumanPositions& joints) { return joints[index(joint)].y; });
  };
  EXPECT_NEAR(height_of(HumanJoint::hips).second - height_of(HumanJoint::hips).first, 0.4f, 0.05f);
  const auto [low, high] = height_of(HumanJoint::left_foot);
  EXPECT_LT(high - low, 0.02f);
}

TEST_F(BenchVerb, prints_tables_that_name_what_is_missing) {
  const Ran ran = must("bench --steps 20");
  for (const char* part : {"reading the weights, no more", "mode-adaptive (2018)", "20 steps",
                           "write the pose (rig)", "1,000 ", "a character"}) {
    EXPECT_TRUE(holds(ran.out, part)) << part << "\n" << ran.out;
  }
  const bool missing = ran.out.find("missing: ") != std::string::npos;
  EXPECT_EQ(ran.out.find("./run bench in a checkout") != std::string::npos, missing);
}

TEST_F(BenchVerb, rejects_what_it_does_not_know) {
  expect_rejected("bench --fast", 2, "there is no option '--fast'; see panache-lab bench --help");
  expect_rejected("bench --steps 0", 2, "--steps: expected a number from 1 to 1e+09, found 0");
  expect_rejected("bench --steps 9 --quick", 2,
                  "--steps excludes --quick; see panache-lab bench --help");
  expect_rejected("bench --model none.safetensors", 1,
                  "none.safetensors: cannot be read: No such file or directory");
}

TEST(BenchHistogram, gives_times_to_one_percent) {
  auto times = std::make_unique<Histogram>();
  EXPECT_EQ(times->quantile(0.5), 0);
  for (int64_t ns = 1; ns <= 100'000; ++ns) times->add(ns);
  for (const double at : {0.001, 0.5, 0.99, 0.999}) {
    // A bucket is at most 1/128 wide of the time, and its middle is given.
    EXPECT_NEAR(times->quantile(at), at * 100'000, at * 100'000 / 256 + 1) << at;
  }
  EXPECT_EQ(times->quantile(1), 100'000);
  EXPECT_EQ(times->worst(), 100'000);
  EXPECT_EQ(times->count(), 100'000);
  times->add(int64_t{1} << 62);  // A hundred and forty years still have their place.
  EXPECT_EQ(times->worst(), int64_t{1} << 62);
}

TEST(BenchHistogram, keeps_short_times_exactly) {
  for (int64_t ns = 0; ns < 256; ++ns) {
    auto times = std::make_unique<Histogram>();
    times->add(ns);
    EXPECT_EQ(times->quantile(0.5), static_cast<double>(ns));
  }
}

// The loops of the papers, one number after the other. Bits are the same as those of the kernels,
// which promise the order of the sums.
Layer blended(const BlendedLayer& layer, std::span<const float> shares) {
  Layer out = layer.sets[0];
  const auto blend = [&](auto Layer::*numbers) {
    for (size_t i = 0; i < (out.*numbers).size(); ++i) {
      float sum = 0;
      for (size_t s = 0; s < shares.size(); ++s) {
        sum = sum + shares[s] * (layer.sets[s].*numbers)[i];
      }
      (out.*numbers)[i] = sum;
    }
  };
  blend(&Layer::weights);
  blend(&Layer::bias);
  return out;
}

Numbers through(const Layer& layer, const Numbers& x, bool with_elu = true) {
  Numbers y = layer.bias;
  for (size_t o = 0; o < y.size(); ++o) {
    for (size_t i = 0; i < x.size(); ++i) y[o] = y[o] + x[i] * layer.weights[i * y.size() + o];
  }
  if (with_elu) scalar::elu(y);
  return y;
}

Numbers through(const BlendedLayers& layers, std::span<const float> shares, Numbers x) {
  for (size_t l = 0; l < layers.size(); ++l) {
    x = through(blended(layers[l], shares), x, l + 1 < layers.size());
  }
  return x;
}

TEST(BenchNetworks, slides_networks_have_the_published_size) {
  // 931 KB of floats on the slides, which count 1,024 bytes.
  EXPECT_EQ(4 * parameter_count(slides_networks()), 953'748u);
  EXPECT_EQ(953'748 / 1024, 931);
}

TEST(BenchNetworks, our_evaluation_equals_plain_loops) {
  const std::vector<Network> networks = slides_networks();
  const Numbers x = random_numbers(kSlidesInputs, 7);
  Numbers wanted, found(kSlidesOutputs), plain(kSlidesOutputs);
  for (const Network& network : networks) {
    Numbers y = x;
    for (size_t l = 0; l < network.layers.size(); ++l) {
      y = through(network.layers[l], y, l + 1 < network.layers.size());
    }
    wanted.insert(wanted.end(), y.begin(), y.end());
  }
  auto own = make_own_evaluation(networks, false);
  ASSERT_TRUE(own.ok());
  (*own)->run(x, found);
  EXPECT_EQ(found, wanted);
  run_plainly(networks, x, plain);
  EXPECT_EQ(plain, wanted);
}

TEST(BenchNetworks, int8_is_near_float) {
  const std::vector<Network> networks = slides_networks();
  const Numbers x = random_numbers(kSlidesInputs, 7);
  Numbers wanted(kSlidesOutputs), found(kSlidesOutputs);
  run_plainly(networks, x, wanted);
  auto own = make_own_evaluation(networks, true);
  ASSERT_TRUE(own.ok());
  (*own)->run(x, found);
  EXPECT_NE(found, wanted);
  // Weights are off by at most half of 1/127 of the largest in their column, which is below 3.5
  // deviations: by 0.8 percent of a deviation (0.28 of the half step, evenly spread, is its own
  // deviation). What a layer adds to the error of its outputs, which are of size 1, is as much, and
  // so is what numbers in whole steps between layers add: over four layers 2 * 2 * 0.8 percent, of
  // which five times is never seen.
  for (size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 0.16f) << i;
}

TEST(BenchNetworks, phase_shares_go_through_the_control_points) {
  EXPECT_EQ(phase_shares(0), (std::array<float, 4>{1, 0, 0, 0}));
  EXPECT_EQ(phase_shares(0.25f), (std::array<float, 4>{0, 1, 0, 0}));
  EXPECT_EQ(phase_shares(0.75f), (std::array<float, 4>{0, 0, 0, 1}));
  // Half-way: Catmull and Rom's -1/16, 9/16, 9/16, -1/16.
  EXPECT_EQ(phase_shares(0.125f), (std::array<float, 4>{0.5625f, 0.5625f, -0.0625f, -0.0625f}));
  EXPECT_EQ(phase_shares(0.875f), (std::array<float, 4>{0.5625f, -0.0625f, -0.0625f, 0.5625f}));
}

TEST(BenchNetworks, the_phase_functioned_network_equals_plain_loops) {
  PhaseNetwork network;
  PhaseTable table(network);
  // 342 x 512 + 512 x 512 + 512 x 311 weights and the biases, four and fifty times.
  EXPECT_EQ(network.bytes(), 4u * 4 * (596'480 + 1'335));
  EXPECT_EQ(table.bytes(), 4u * 50 * (596'480 + 1'335));
  const Numbers x = random_numbers(PhaseNetwork::kInputs, 8);
  Numbers y(PhaseNetwork::kOutputs);
  network.run(x, 0.3f, y);
  EXPECT_EQ(y, through(network.layers(), phase_shares(0.3f), x));
  table.run(x, 0.31f, y);
  EXPECT_EQ(y, through(network.layers(), phase_shares(15.0f / 50), x));
  table.run(x, 1, y);  // A phase that was rounded up has its place.
  EXPECT_EQ(y, through(network.layers(), phase_shares(49.0f / 50), x));
}

TEST(BenchNetworks, the_mode_adaptive_network_equals_plain_loops) {
  ModeNetwork network;
  // 480 x 512 + 512 x 512 + 512 x 363 and biases, eight times, and 19 -> 32 -> 32 -> 8.
  EXPECT_EQ(network.bytes(), 4u * (8 * (693'760 + 1'387) + 640 + 1'056 + 264));
  const Numbers x = random_numbers(ModeNetwork::kInputs, 9);
  const auto& gating = network.gating().layers;
  Numbers shares(x.begin(), x.begin() + 19);
  shares = through(gating[2], through(gating[1], through(gating[0], shares)), false);
  const float max = *std::max_element(shares.begin(), shares.end());
  float total = 0;
  for (float& share : shares) total += share = std::exp(share - max);
  for (float& share : shares) share /= total;
  Numbers y(ModeNetwork::kOutputs);
  network.run(x, y);
  EXPECT_EQ(y, through(network.layers(), shares, x));
}

TEST(BenchNetworks, the_network_with_style_adapters_equals_plain_loops) {
  StyleAdapterNetwork network;
  const auto& adapter = network.adapter();
  // As published: 31,352 numbers or 126 KB a style.
  EXPECT_EQ(adapter.parameter_count(), 31'352u);
  const Numbers x = random_numbers(StyleAdapterNetwork::kInputs, 10);
  const auto shares = phase_shares(0.6f);
  const Numbers first = through(blended(network.layers()[0], shares), x);
  Numbers second = through(blended(network.layers()[1], shares), first, false);
  Numbers ranks = through(adapter.in, first, false);
  for (size_t r = 0; r < ranks.size(); ++r) {
    float scale = 0;
    for (size_t s = 0; s < shares.size(); ++s) scale = scale + shares[s] * adapter.scale[s][r];
    ranks[r] *= scale;
  }
  const Numbers added = through(adapter.out, ranks, false);
  for (size_t i = 0; i < second.size(); ++i) second[i] = second[i] + added[i];
  scalar::elu(second);
  Numbers y(StyleAdapterNetwork::kOutputs);
  network.run(x, 0.6f, y);
  EXPECT_EQ(y, through(blended(network.layers()[2], shares), second, false));
}

// The ONNX file of a network of one layer, y0 = x * 2 + 0.5.
struct OnnxFile {
  onnx::ModelProto model;
  std::vector<std::string> nodes;  // "Gemm x weight0_0 bias0_0 -> y0"
  std::map<std::string, std::string> constants;

  explicit OnnxFile(bool int8) {
    const Network network{{{1, 1, {2}, {0.5f}}}};
    EXPECT_TRUE(model.ParseFromString(format_onnx({&network, 1}, int8)));
    for (const onnx::NodeProto& node : model.graph().node()) {
      std::string text = node.op_type();
      for (const std::string& input : node.input()) text += " " + input;
      text += " ->";
      for (const std::string& output : node.output()) text += " " + output;
      nodes.push_back(text);
    }
    for (const onnx::TensorProto& constant : model.graph().initializer()) {
      constants[constant.name()] = constant.raw_data();
    }
  }
};

TEST(BenchNetworks, the_onnx_file_has_a_node_for_each_layer) {
  using namespace std::string_literals;
  const OnnxFile file(false);
  EXPECT_EQ(file.model.ir_version(), 7);
  EXPECT_EQ(file.model.opset_import(0).version(), 11);
  for (const auto* values : {&file.model.graph().input(), &file.model.graph().output()}) {
    ASSERT_EQ(values->size(), 1);
    const auto& type = values->Get(0).type().tensor_type();
    EXPECT_EQ(type.elem_type(), onnx::TensorProto::FLOAT);
    ASSERT_EQ(type.shape().dim_size(), 2);
    EXPECT_EQ(type.shape().dim(0).dim_value(), 1);
    EXPECT_EQ(type.shape().dim(1).dim_value(), 1);
  }
  EXPECT_EQ(file.model.graph().input(0).name(), "x");
  EXPECT_EQ(file.model.graph().output(0).name(), "y0");
  EXPECT_EQ(file.nodes, std::vector{"Gemm x weight0_0 bias0_0 -> y0"s});
  EXPECT_EQ(file.constants, (std::map{std::pair{"weight0_0"s, "\0\0\0\x40"s},
                                      std::pair{"bias0_0"s, "\0\0\0\x3f"s}}));
}

TEST(BenchNetworks, the_onnx_file_in_int8_quantizes_the_input_of_each_layer) {
  using namespace std::string_literals;
  const OnnxFile file(true);
  EXPECT_EQ(file.nodes,
            (std::vector{"DynamicQuantizeLinear x -> x_bytes x_scale x_zero"s,
                         "MatMulInteger x_bytes weight0_0 x_zero -> whole0_0"s,
                         "Cast whole0_0 -> product0_0"s, "Mul x_scale scale0_0 -> unit0_0"s,
                         "Mul product0_0 unit0_0 -> scaled0_0"s, "Add scaled0_0 bias0_0 -> y0"s}));
  EXPECT_EQ(file.model.graph().node(2).attribute(0).name(), "to");
  EXPECT_EQ(file.model.graph().node(2).attribute(0).i(), onnx::TensorProto::FLOAT);
  EXPECT_EQ(file.model.graph().initializer(0).data_type(), onnx::TensorProto::INT8);
  // 127, which is worth 2 / 127.
  EXPECT_EQ(file.constants,
            (std::map{std::pair{"weight0_0"s, "\x7f"s}, std::pair{"scale0_0"s, "\x04\x02\x81\x3c"s},
                      std::pair{"bias0_0"s, "\0\0\0\x3f"s}}));
}

TEST(BenchNetworks, others_get_the_int8_weights_that_ours_have) {
  const Layer layer = random_layer(20, 32, 5);
  TensorFile file;
  file.tensors["a.weight"] = {{20, 32}, layer.weights};
  file.tensors["a.bias"] = {{32}, layer.bias};
  const TensorFile ours = quantize(file);
  const Int8Layer theirs = quantized(layer);
  EXPECT_EQ(Numbers(theirs.weights.begin(), theirs.weights.end()),
            ours.tensors.at("a.weight").values);
  EXPECT_EQ(theirs.scale, ours.tensors.at("a.scale").values);
}

}  // namespace
}  // namespace panache::test
