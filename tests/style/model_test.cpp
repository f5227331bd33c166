#include "style/model/model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_model.h"
#include "net/layer.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

std::string rejection(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "m.safetensors");
  return model.ok() ? "accepted" : model.error().message;
}

TEST(Model, what_was_written_is_read) {
  const auto model =
      Model::parse(format_safetensors(test::make_model({"old", "proud"})), "m.safetensors");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ((*model)->styles().size(), 2u);
  EXPECT_EQ((*model)->styles()[1].name, "proud");
  EXPECT_EQ((*model)->styles()[1].description, "looks proud");
  EXPECT_EQ(&(*model)->recipe(), &test::kPanache);
}

TEST(Model, styles_are_in_groups_where_the_model_names_them) {
  TensorFile file = test::make_model({"old", "proud", "mine"});
  const auto groups = [&] {
    const auto model = Model::parse(format_safetensors(file), "m.safetensors");
    std::vector<std::string> out;
    if (model) {
      for (const StyleInfo& style : (*model)->styles()) out.push_back(style.group);
    }
    return out;
  };
  using Groups = std::vector<std::string>;
  EXPECT_EQ(groups(), (Groups{"", "", ""}));
  file.metadata["style_groups"] = "ages\nmoods of a day\n\n";
  EXPECT_EQ(groups(), (Groups{"ages", "moods of a day", ""}));
  file = quantize(file);
  EXPECT_EQ(groups(), (Groups{"ages", "moods of a day", ""}));
  file.metadata["style_groups"] = "ages\nmoods\n";
  EXPECT_EQ(rejection(file),
            "m.safetensors: metadata 'style_groups' has 2 lines; expected 3, one per style");
  file.metadata["style_groups"] = "ages\nmoods\n\nmoods\n";
  EXPECT_EQ(rejection(file),
            "m.safetensors: metadata 'style_groups' has 4 lines; expected 3, one per style");
}

TEST(Model, tensors_in_memory_make_the_same_model_as_their_file) {
  const TensorFile file = quantize(test::make_model({"old", "proud"}));
  const auto answer = [](const Result<std::shared_ptr<const Model>>& model) {
    EXPECT_TRUE(model.ok()) << model.error().message;
    StyleNetworks networks(*model);
    networks.set_strengths(std::vector<float>{1, 0.5f});
    networks.forward(
        std::vector<float>(size_t(kWindowPoses) * pose_feature_count((*model)->layout()), 1));
    return std::vector<float>(networks.pose().begin(), networks.pose().end());
  };
  // Halves and bytes are numbers that a file can hold, so nothing is rounded on the way.
  const auto whole = parse_safetensors(format_safetensors(file), "m");
  EXPECT_EQ(answer(Model::create(*whole, "m")),
            answer(Model::parse(format_safetensors(file), "m")));
  EXPECT_EQ(Model::create({}, "m").error().message,
            Model::parse(format_safetensors({}), "m").error().message);
}

TEST(Model, an_int8_one_is_the_same_model_with_as_many_parameters) {
  const TensorFile file = test::make_model({"old", "proud"});
  const auto whole = Model::parse(format_safetensors(file), "whole");
  const auto int8 = Model::parse(format_safetensors(quantize(file)), "half");
  ASSERT_TRUE(int8.ok()) << int8.error().message;
  EXPECT_EQ((*int8)->metadata(), (*whole)->metadata());
  EXPECT_EQ((*int8)->parameter_count(), (*whole)->parameter_count());
}

TEST(Model, an_int8_one_without_its_int8_scale_is_rejected) {
  TensorFile file = quantize(test::make_model({"old"}));
  file.tensors.erase("pose.head.0.scale");
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'pose.head.0.scale' is missing");
}

TEST(Model, every_truncation_of_an_int8_one_is_rejected) {
  const std::string bytes = format_safetensors(quantize(test::make_model({"old"})));
  for (size_t size = 0; size < bytes.size(); size += 97) {
    EXPECT_FALSE(Model::parse(bytes.substr(0, size), "m").ok()) << size;
  }
}

TEST(Model, more_styles_than_a_step_has_room_for_are_rejected) {
  std::vector<std::string> names;
  for (int i = 0; i < 256; ++i) names.push_back("style" + std::to_string(i));
  EXPECT_EQ(rejection(test::make_model(names)),
            "m.safetensors: has 256 styles; expected at most 255");
  names.pop_back();
  EXPECT_EQ(rejection(test::make_model(names)), "accepted");
}

TEST(Model, without_a_style_it_is_rejected_where_none_can_be_learnt_on_it) {
  TensorFile file = test::make_model({"old"}, 1, test::kSmith2019);
  EXPECT_EQ(rejection(file), "accepted");
  file.metadata["styles"] = file.metadata["style_descriptions"] = "";
  EXPECT_EQ(rejection(file), "m.safetensors: has no styles");
}

TEST(Model, a_scale_without_a_reciprocal_is_rejected) {
  TensorFile file = test::make_model({"old"});
  file.tensors["input.scale"].values[3] = 1e-40f;
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'input.scale' must be above zero throughout");
}

TEST(Model, a_model_of_another_version_is_rejected) {
  TensorFile file = test::make_model({"old"});
  file.metadata["format_version"] = "7";
  EXPECT_EQ(rejection(file),
            "m.safetensors: is a model of format version 7; this program reads version 1; train it "
            "again or use the program it came with");
}

TEST(Model, a_model_of_other_joints_or_another_window_is_rejected) {
  TensorFile file = test::make_model({"old"});
  file.metadata["joints"] += " tail";
  EXPECT_EQ(rejection(file),
            "m.safetensors: was trained on other joints than this program's 21; train it again");
  file = test::make_model({"old"});
  file.metadata["window"] = "all there is";
  EXPECT_EQ(rejection(file),
            "m.safetensors: sees a window of all there is; expected " + window_description());
}

TEST(Model, metadata_that_is_missing_is_named) {
  for (const char* key :
       {"format_version", "recipe", "joints", "window", "styles", "style_descriptions"}) {
    TensorFile file = test::make_model({"old"});
    file.metadata.erase(key);
    EXPECT_TRUE(rejection(file).starts_with("m.safetensors: metadata '" + std::string(key) +
                                            "' is missing"))
        << rejection(file);
  }
}

TEST(Model, a_safetensors_file_of_something_else_is_rejected) {
  TensorFile file = test::make_model({"old"});
  file.metadata.erase("format");
  EXPECT_EQ(rejection(file),
            "m.safetensors: is a safetensors file, but not a panache model; expected metadata "
            "'format' to be 'panache'");
}

TEST(Model, a_style_file_is_told_from_a_model) {
  TensorFile file = test::make_model({"old"});
  file.metadata["format"] = "panache-style";
  EXPECT_EQ(rejection(file), "m.safetensors: is a style file, not a model");
}

TEST(Model, wrong_or_missing_tensors_are_named) {
  TensorFile file = test::make_model({"old"});
  file.tensors.erase("input.mean");
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'input.mean' is missing");
  for (const std::string network : {"pose", "timing", "contact"}) {
    for (const std::string layer : {".trunk.0", ".head.0"}) {
      for (const std::string part : {".weight", ".bias"}) {
        file = test::make_model({"old"});
        file.tensors.erase(network + layer + part);
        EXPECT_NE(rejection(file).find("'" + network + layer), std::string::npos)
            << rejection(file);
      }
    }
  }
  file = test::make_model({"old"});
  file.tensors["input.scale"].values[3] = 0;
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'input.scale' must be above zero throughout");
  file = test::make_model({"old"});
  file.tensors["input.mean"].shape = {33, 2};
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'input.mean' has shape [33, 2]; expected [66]");
  file = test::make_model({"old"});
  file.metadata["recipe"] = "magic";
  EXPECT_EQ(rejection(file), "m.safetensors: has recipe 'magic'; expected panache or smith2019");
  file = test::make_model({"old"});
  file.metadata["styles"] = "old\nproud\n";
  EXPECT_NE(rejection(file), "accepted");
}

TEST(Model, a_damaged_gate_is_rejected) {
  const auto damaged = [](const auto& damage) {
    TensorFile file = test::make_model({"old"});
    test::add_gate(file, 2);
    damage(file.tensors);
    return rejection(file);
  };
  EXPECT_EQ(damaged([](auto&) {}), "accepted");
  EXPECT_EQ(damaged([](auto& tensors) { tensors["gate.limit"].values = {0}; }),
            "m.safetensors: tensor 'gate.limit' must be above zero");
  EXPECT_EQ(damaged([](auto& tensors) { tensors["gate.limit"].values = {NAN}; }),
            "m.safetensors: tensor 'gate.limit' holds a number that is not finite (number 0)");
  EXPECT_EQ(damaged([](auto& tensors) { tensors["gate.mean"].values[3] = INFINITY; }),
            "m.safetensors: tensor 'gate.mean' holds a number that is not finite (number 3)");
  EXPECT_EQ(damaged([](auto& tensors) { tensors["gate.mean"] = test::constant_tensor(9, 0); }),
            "m.safetensors: tensor 'gate.mean' has shape [9]; expected [16]");
  EXPECT_EQ(damaged([](auto& tensors) { tensors.erase("gate.limit"); }),
            "m.safetensors: tensor 'gate.limit' is missing");
  EXPECT_EQ(damaged([](auto& tensors) { tensors.erase("gate.whitening.weight"); }),
            "m.safetensors: tensor 'gate.whitening.weight' is missing");
  EXPECT_EQ(damaged([](auto& tensors) {
              tensors["gate.whitening.weight"] = test::constant_tensor(16, 1);
            }),
            "m.safetensors: tensor 'gate.whitening.weight' has shape [16]; expected [16, 16]");
}

TEST(Model, a_gate_that_lacks_its_mean_is_rejected) {
  TensorFile file = test::make_model({"old"});
  test::add_gate(file, 2);
  file.tensors.erase("gate.mean");
  EXPECT_EQ(rejection(file), "m.safetensors: tensor 'gate.mean' is missing");
}

TEST(Model, an_unknown_style_gets_the_nearest_names) {
  const auto model = *Model::parse(
      format_safetensors(test::make_model({"angry", "old", "proud", "sad"})), "m.safetensors");
  EXPECT_EQ(*model->find_style("proud"), 2);
  EXPECT_EQ(model->find_style("prod").error().message,
            "unknown style 'prod'; the nearest is proud");
  EXPECT_EQ(model->find_style("drunk").error().message,
            "unknown style 'drunk'; expected angry, old, proud or sad");
}

TEST(Model, an_unknown_style_among_many_gets_the_groups) {
  std::vector<std::string> names;
  std::string groups;
  for (int i = 0; i < 13; ++i) {
    names.push_back("style " + std::to_string(i));
    groups += i == 12 ? "\n" : i % 2 == 0 ? "moods\n" : "ages\n";
  }
  TensorFile file = test::make_model(names);
  const auto message = [&] {
    return (*Model::parse(format_safetensors(file), "m.safetensors"))
        ->find_style("qwerty")
        .error()
        .message;
  };
  EXPECT_EQ(message(), "unknown style 'qwerty'; the model has 13 styles");
  file.metadata["style_groups"] = groups;
  EXPECT_EQ(message(), "unknown style 'qwerty'; the model has 13 styles: moods and ages");
}

TEST(Model, other_words_for_a_style_find_it_after_all_names) {
  TensorFile file = test::make_model({"old", "sad", "Sad", "moping"});
  file.metadata["style_words"] = "elderly aged sad\n\ntired\nunhappy tired\n";
  const auto model = *Model::parse(format_safetensors(file), "m.safetensors");
  EXPECT_EQ(*model->find_style_by_any_name("elderly"), 0);
  EXPECT_EQ(*model->find_style_by_any_name("Aged"), 0);
  EXPECT_EQ(*model->find_style_by_any_name("tired"), 2);
  EXPECT_EQ(*model->find_style_by_any_name("sad"), 1);
  EXPECT_EQ(*model->find_style_by_any_name("MOPING"), 3);
  // Two names that differ in case alone mean neither.
  EXPECT_EQ(*model->find_style_by_any_name("SAD"), 0);
  for (const char* part : {"elder", "elderly aged", "", "unhapp"}) {
    EXPECT_FALSE(model->find_style_by_any_name(part)) << part;
  }
  EXPECT_FALSE(model->find_style("elderly"));
  file.metadata["style_words"] = "elderly\n";
  EXPECT_EQ(rejection(file),
            "m.safetensors: metadata 'style_words' has 1 lines; expected 4, one per style");
}

}  // namespace
}  // namespace panache
