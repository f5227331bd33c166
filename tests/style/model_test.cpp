#include "style/model/model.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "make_model.h"
#include "net/layer.h"
#include "style/networks/networks.h"
#include "style_checks.h"

namespace panache {
namespace {

TEST(Model, what_was_written_is_read) {
  const auto model = read(test::make_model({"old", "proud"}));
  EXPECT_EQ(model->styles().size(), 2u);
  EXPECT_EQ(model->styles()[1].name, "proud");
  EXPECT_EQ(model->styles()[1].description, "looks proud");
  EXPECT_EQ(&model->recipe(), &test::kPanache);
}

TEST(Model, styles_are_in_groups_where_the_model_names_them) {
  TensorFile file = test::make_model({"old", "proud", "mine"});
  const auto groups = [&] {
    std::vector<std::string> out;
    const auto model = read(file);
    for (const StyleInfo& style : model->styles()) out.push_back(style.group);
    return out;
  };
  using Groups = std::vector<std::string>;
  EXPECT_EQ(groups(), (Groups{"", "", ""}));
  file.metadata["style_groups"] = "ages\nmoods of a day\n\n";
  EXPECT_EQ(groups(), (Groups{"ages", "moods of a day", ""}));
  file = quantize(file);
  EXPECT_EQ(groups(), (Groups{"ages", "moods of a day", ""}));
  file.metadata["style_groups"] = "ages\nmoods\n";
  EXPECT_EQ(failure(file),
            "m.safetensors: metadata 'style_groups' has 2 lines; expected 3, one per style");
  file.metadata["style_groups"] = "ages\nmoods\n\nmoods\n";
  EXPECT_EQ(failure(file),
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
  const auto whole = read(file), int8 = read(quantize(file));
  EXPECT_EQ(int8->metadata(), whole->metadata());
  EXPECT_EQ(int8->parameter_count(), whole->parameter_count());
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
  EXPECT_EQ(failure(test::make_model(names)),
            "m.safetensors: has 256 styles; expected at most 255");
  names.pop_back();
  EXPECT_EQ(failure(test::make_model(names)), "");
}

TEST(Model, what_is_wrong_with_a_file_is_named) {
  using File = TensorFile&;
  const auto tensor = [](const std::string& name, auto&& change) {
    return [=](File file) { change(file.tensors[name].values); };
  };
  const auto without = [](const std::string& name) {
    return [=](File file) { file.tensors.erase(name); };
  };
  const auto instead = [](const std::string& name, const Tensor& other) {
    return [=](File file) { file.tensors[name] = other; };
  };
  const auto metadata = [](const std::string& key, const std::string& text) {
    return [=](File file) { file.metadata[key] = text; };
  };
  const std::pair<std::function<void(File)>, std::string> cases[] = {
      {[](File) {}, ""},
      {metadata("format", ""),
       "is a safetensors file, but not a panache model; expected metadata 'format' to be "
       "'panache'"},
      {[](File file) { file.metadata.erase("format"); },
       "is a safetensors file, but not a panache model; expected metadata 'format' to be "
       "'panache'"},
      {metadata("format", "panache-style"), "is a style file, not a model"},
      {metadata("format_version", "7"),
       "is a model of format version 7; this program reads version 1; train it again or use the "
       "program it came with"},
      {metadata("joints", canonical_joint_list() + " tail"),
       "was trained on other joints than this program's 21; train it again"},
      {metadata("window", "all there is"),
       "sees a window of all there is; expected " + window_description()},
      {metadata("recipe", "magic"), "has recipe 'magic'; expected panache or smith2019"},
      {without("input.mean"), "tensor 'input.mean' is missing"},
      {[](File file) {
         file.tensors["input.mean"].shape = {33, 2};
       },
       "tensor 'input.mean' has shape [33, 2]; expected [66]"},
      {tensor("input.scale", [](auto& values) { values[3] = 0; }),
       "tensor 'input.scale' must be above zero throughout"},
      {tensor("input.scale", [](auto& values) { values[3] = 1e-40f; }),  // Without a reciprocal.
       "tensor 'input.scale' must be above zero throughout"},
      {tensor("gate.limit", [](auto& values) { values = {0}; }),
       "tensor 'gate.limit' must be above zero"},
      {tensor("gate.limit", [](auto& values) { values = {NAN}; }),
       "tensor 'gate.limit' holds a number that is not finite (number 0)"},
      {tensor("gate.mean", [](auto& values) { values[3] = INFINITY; }),
       "tensor 'gate.mean' holds a number that is not finite (number 3)"},
      {instead("gate.mean", test::constant_tensor(9, 0)),
       "tensor 'gate.mean' has shape [9]; expected [16]"},
      {without("gate.mean"), "tensor 'gate.mean' is missing"},
      {without("gate.limit"), "tensor 'gate.limit' is missing"},
      {without("gate.whitening.weight"), "tensor 'gate.whitening.weight' is missing"},
      {instead("gate.whitening.weight", test::constant_tensor(16, 1)),
       "tensor 'gate.whitening.weight' has shape [16]; expected [16, 16]"},
      {[](File file) { (file = quantize(file)).tensors.erase("pose.head.0.scale"); },
       "tensor 'pose.head.0.scale' is missing"},
      {[](File file) {  // A style can be learnt on the others.
         file = test::make_model({"old"}, 1, test::kSmith2019);
         file.metadata["styles"] = file.metadata["style_descriptions"] = "";
       },
       "has no styles"}};
  for (const auto& [change, message] : cases) {
    TensorFile file = test::make_model({"old"});
    test::add_gate(file, 2);
    change(file);
    EXPECT_EQ(failure(file), message.empty() ? "" : "m.safetensors: " + message);
  }
}

TEST(Model, whatever_is_missing_is_named) {
  for (const char* key :
       {"format_version", "recipe", "joints", "window", "styles", "style_descriptions"}) {
    TensorFile file = test::make_model({"old"});
    file.metadata.erase(key);
    EXPECT_TRUE(
        failure(file).starts_with("m.safetensors: metadata '" + std::string(key) + "' is missing"))
        << failure(file);
  }
  for (const std::string network : {"pose", "timing", "contact"}) {
    for (const std::string layer : {".trunk.0", ".head.0"}) {
      for (const std::string part : {".weight", ".bias"}) {
        TensorFile file = test::make_model({"old"});
        file.tensors.erase(network + layer + part);
        EXPECT_NE(failure(file).find("'" + network + layer), std::string::npos) << failure(file);
      }
    }
  }
  TensorFile file = test::make_model({"old"});
  file.metadata["styles"] = "old\nproud\n";
  EXPECT_NE(failure(file), "") << "a head for the second style";
}

TEST(Model, an_unknown_style_gets_the_nearest_names) {
  const auto model = read(test::make_model({"angry", "old", "proud", "sad"}));
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
  const auto message = [&] { return read(file)->find_style("qwerty").error().message; };
  EXPECT_EQ(message(), "unknown style 'qwerty'; the model has 13 styles");
  file.metadata["style_groups"] = groups;
  EXPECT_EQ(message(), "unknown style 'qwerty'; the model has 13 styles: moods and ages");
}

TEST(Model, other_words_for_a_style_find_it_after_all_names) {
  TensorFile file = test::make_model({"old", "sad", "Sad", "moping"});
  file.metadata["style_words"] = "elderly aged sad\n\ntired\nunhappy tired\n";
  const auto model = read(file);
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
  EXPECT_EQ(failure(file),
            "m.safetensors: metadata 'style_words' has 1 lines; expected 4, one per style");
}

}  // namespace
}  // namespace panache
