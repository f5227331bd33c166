#include "eval/systems/model_system.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_model.h"
#include "make_styles.h"
#include "temporary_folder.h"

namespace panache {
namespace {

// A model that changes nothing but the tempo.
std::shared_ptr<const Model> tempo_model(float log_rate) {
  TensorFile file = test::make_model({"old"});
  for (const char* name : {"pose.head.0.weight", "pose.head.0.bias", "timing.head.0.weight"}) {
    for (float& value : file.tensors[name].values) value = 0;
  }
  // No foot is planted, so none is held.
  for (const char* name : {"contact.head.0.weight", "contact.head.1.weight"}) {
    for (float& value : file.tensors[name].values) value = 0;
  }
  file.tensors["contact.head.0.bias"] = test::constant_tensor(kFeet, -20);
  file.tensors["contact.head.1.bias"] = test::constant_tensor(kFeet, 0);
  file.tensors["timing.head.0.bias"].values = {log_rate};
  return *Model::parse(format_safetensors(file), "tempo");
}

class ModelSystemTest : public testing::Test {
 protected:
  // A walk and a wave as files of 30 and, so that files and takes count differently, 60 frames a
  // second.
  ModelSystemTest() {
    put("walk", 30);
    put("wave", 60);
    ManifestRow walk, wave;
    walk.path = folder_ + "walk.bvh";
    walk.content = "walk";
    wave.path = folder_ + "wave.bvh";
    wave.content = "wave";
    for (ManifestRow* row : {&walk, &wave}) {
      row->style = "neutral";
      row->neutral = row->test = true;
    }
    inputs_ = *load_inputs({walk, wave});
  }
  void put(const std::string& content, double fps) {
    Clip clip = test::walking_clip(static_cast<int>(3 * fps) + 1, fps);
    if (content == "wave") test::stand_and_wave(clip);
    EXPECT_TRUE(write_file(folder_ + content + ".bvh", format_bvh(clip), true).ok());
  }
  StyledTake run(const std::shared_ptr<const Model>& model, int which, float strength,
                 bool timing = true) const {
    const Result<RunResult> run_result =
        ModelSystem("model", model).run(inputs_[which], {"old", {{"old", strength}}, timing});
    EXPECT_TRUE(run_result.ok()) << run_result.error().message;
    // BVH angles have six digits; joints in the world are metres in single precision.
    EXPECT_LT(run_result->bone_length_error, 1e-5);
    return run_result->output;
  }

  const test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.path();
  std::vector<TestInput> inputs_;
};

TEST_F(ModelSystemTest, at_strength_zero_the_output_is_the_input_take) {
  const auto model = *Model::parse(format_safetensors(test::make_model({"old"})), "model");
  for (int i = 0; i < 2; ++i) {
    const StyledTake output = run(model, i, 0);
    const Take& input = inputs_[i].take;
    ASSERT_EQ(output.take.frames(), input.frames());
    EXPECT_EQ(output.take.pose_features, input.pose_features);
    for (int f = 0; f < input.frames(); ++f) {
      EXPECT_NEAR(output.source_frames[f], f, 1e-3) << "input " << i;
    }
  }
}

TEST_F(ModelSystemTest, an_output_is_labelled_as_the_style_asked_for_and_the_content_of_its_input) {
  const StyledTake output = run(tempo_model(0), 1, 1);
  EXPECT_EQ(output.take.row.style, "old");
  EXPECT_EQ(output.take.row.content, "wave");
  EXPECT_FALSE(output.take.row.neutral);
}

TEST_F(ModelSystemTest, source_frames_follow_the_tempo_where_feet_step) {
  const float walks = 0.8f;
  for (int i = 0; i < 2; ++i) {
    const float rate = i == 0 ? walks : 1;  // Who stands and waves keeps the input's time.
    const StyledTake output = run(tempo_model(std::log(walks)), i, 1);
    EXPECT_NEAR(output.take.frames(), inputs_[i].take.frames() / rate, 3);
    for (int f = 0; f < output.take.frames(); ++f) {
      // The rate is in force from the third frame of the file on.
      EXPECT_NEAR(output.source_frames[f], rate * static_cast<float>(f), 0.5) << "input " << i;
    }
    // The body shown is that of the input at the source frame: a straight line between its frames.
    const Take& input = inputs_[i].take;
    for (int f = 5; f < output.take.frames() - 5; ++f) {
      const int a = static_cast<int>(output.source_frames[f]);
      const float t = output.source_frames[f] - static_cast<float>(a);
      for (int j = 0; j < kHumanJoints; ++j) {
        const Vec3 expected = lerp(input.body[a][j], input.body[a + 1][j], t);
        // A hand that turns by a tenth of a radian between frames leaves its chord by a millimetre.
        ASSERT_LT(length(output.take.body[f][j] - expected), 5e-3f) << f << ", joint " << j;
      }
    }
  }
}

TEST_F(ModelSystemTest, without_timing_source_frames_are_the_frames) {
  for (int i = 0; i < 2; ++i) {
    const StyledTake output = run(tempo_model(std::log(0.8f)), i, 1, false);
    ASSERT_EQ(output.take.frames(), inputs_[i].take.frames());
    for (int f = 0; f < output.take.frames(); ++f) {
      EXPECT_NEAR(output.source_frames[f], f, 1e-3) << "input " << i;
    }
  }
}

TEST_F(ModelSystemTest, a_style_that_the_model_lacks_is_rejected) {
  const ModelSystem system("tempo", tempo_model(0));
  const StyleRequest request{"sad", {{"sad", 1}}};
  EXPECT_FALSE(system.can_run(inputs_[0], request));
  EXPECT_TRUE(system.can_run(inputs_[0], {"old", {{"old", 1}}}));
  EXPECT_FALSE(system.can_run(inputs_[0], {"old", {{"old", 0.5f}, {"sad", 0.5f}}}));
  const Result<RunResult> run_result = system.run(inputs_[0], request);
  ASSERT_FALSE(run_result.ok());
  EXPECT_EQ(run_result.error().message, "unknown style 'sad'; expected old");
}

TEST_F(ModelSystemTest, a_test_take_that_cannot_be_read_is_named) {
  ManifestRow row;
  row.path = folder_ + "none.bvh";
  const auto inputs = load_inputs({row});
  ASSERT_FALSE(inputs.ok());
  EXPECT_EQ(inputs.error().message,
            folder_ + "none.bvh: cannot be read: No such file or directory");
}

TEST_F(ModelSystemTest, untouched_inputs_stand_for_every_style) {
  const std::vector<StyledTake> outputs = untouched(inputs_, {"old", "sad"});
  ASSERT_EQ(outputs.size(), 4u);
  EXPECT_EQ(outputs[1].take.row.style, "sad");
  EXPECT_EQ(outputs[2].input, 1);
  EXPECT_EQ(outputs[2].take.pose_features, inputs_[1].take.pose_features);
  EXPECT_EQ(outputs[2].source_frames.back(), static_cast<float>(inputs_[1].take.frames() - 1));
}

TEST_F(ModelSystemTest, facts_are_those_of_the_model_and_its_file) {
  const auto model = tempo_model(0);
  const SystemFacts facts = ModelSystem("tempo", model, 1234).facts();
  EXPECT_EQ(facts.recipe, "panache");
  EXPECT_EQ(facts.bytes, 1234u);
  EXPECT_EQ(facts.parameters, model->parameter_count());
  EXPECT_FALSE(facts.recorded);
}

}  // namespace
}  // namespace panache
