// GLB files as bytes: what comes back from the process that reads FBX may be anything.

#include "glb.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "clip/gltf_json.h"

namespace panache::cli {
namespace {

std::string number(size_t value) {
  const auto small = static_cast<uint32_t>(value);
  return {reinterpret_cast<const char*>(&small), sizeof small};
}

// A GLB of this JSON alone.
std::string glb_of(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return "glTF" + number(2) + number(20 + json.size()) + number(json.size()) + "JSON" + json;
}

Result<std::string> no_png(const std::string&) { return Error{"no picture"}; }

// The JSON of what becomes of it.
GltfJson with_pictures_of(const std::string& json) {
  std::vector<std::string> notes;
  return GltfJson::parse(with_pictures(glb_of(json), "in.fbx", no_png, notes).substr(20), nullptr,
                         false);
}

// Writing JSON recurses: a million brackets would exhaust the stack.
TEST(Glb, json_of_a_million_brackets_stays_as_it_is) {
  const size_t depth = 1'000'000;
  const std::string glb =
      glb_of("{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}");
  std::vector<std::string> notes;
  EXPECT_TRUE(with_pictures(glb, "in.fbx", no_png, notes) == glb);
}

TEST(Glb, extensions_of_a_material_that_are_none_stay) {
  const GltfJson json = with_pictures_of(
      R"({"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],"materials":[)"
      R"({"extensions":[1]},{"extensions":{"KHR_materials_pbrSpecularGlossiness":{},"a":{}}},7]})");
  EXPECT_EQ(json["materials"].dump(), R"([{"extensions":[1]},{"extensions":{"a":{}}},7])");
  EXPECT_FALSE(json.contains("extensionsUsed"));
}

TEST(Glb, pictures_that_are_none_are_taken_out_of_their_materials) {
  std::vector<std::string> notes;
  const std::string glb = with_pictures(
      glb_of(
          R"({"images":[7,{"uri":"gone.png"},{"uri":"data:,x"},{"bufferView":9}],"textures":[)"
          R"({"source":1},{"source":0},7,{"source":2},{"source":-1}],"materials":[{)"
          R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0,0,0,1]},)"
          R"("normalTexture":{"index":1},"emissiveTexture":{"index":3},"extensions":{"a":{"bTexture":{"index":1}}}},)"
          R"({"pbrMetallicRoughness":7,"normalTexture":{"index":"a"}},7]})"),
      "in.fbx", no_png, notes);
  const GltfJson json = GltfJson::parse(glb.substr(20));
  EXPECT_EQ(json["images"].dump(), R"([7,{"bufferView":9}])");
  EXPECT_EQ(json["textures"].dump(), R"([{"source":0},7,{"source":-1}])");
  EXPECT_FALSE(json["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
  EXPECT_FALSE(json["materials"][0].contains("emissiveTexture"));
  EXPECT_EQ(json["materials"][0]["normalTexture"]["index"], 0);
  EXPECT_EQ(json["materials"][0]["extensions"]["a"]["bTexture"]["index"], 0);
  EXPECT_EQ(notes.size(), 2u);
}

TEST(Glb, a_gltf_whose_parts_are_none_is_rejected_with_their_place) {
  const auto message = [](const std::string& json) {
    const Result<std::string> glb = gltf_to_glb(json, "in.gltf");
    return glb ? "none" : glb.error().message;
  };
  const std::string buffers = R"({"buffers":[{"uri":"data:,","byteLength":0}],"bufferViews":)";
  EXPECT_EQ(message(R"({"buffers":7})"), "in.gltf: buffers: expected a list, found 7");
  EXPECT_EQ(message(R"({"buffers":[7]})"), "in.gltf: buffers[0]: expected an object, found 7");
  EXPECT_EQ(message(R"({"buffers":[{"uri":7}]})"),
            "in.gltf: buffers[0].uri: expected a text, found 7");
  EXPECT_EQ(message(buffers + "[7]}"), "in.gltf: bufferViews[0]: expected an object, found 7");
  EXPECT_EQ(message(buffers + "[{}]}"), "in.gltf: bufferViews[0]: expected a buffer, found none");
  EXPECT_EQ(message(buffers + R"([{"buffer":0,"byteOffset":"x"}]})"),
            "in.gltf: bufferViews[0].byteOffset: expected a whole number, found \"x\"");
  EXPECT_TRUE(
      message(buffers + R"([{"buffer":1}]})").starts_with("in.gltf: bufferViews[0].buffer"));
}

}  // namespace
}  // namespace panache::cli
