// The messages that say why a glTF file cannot be read.

#include <functional>

#include "gltf_checks.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;
using test::small_gltf;

// What is said of the small file after `spoil` did something to it, without the file's name.
std::string spoilt(const std::function<void(GltfParts&)>& spoil) {
  GltfParts parts = small_gltf();
  spoil(parts);
  const std::string out = gltf_rejection(parts);
  return out.starts_with("walk.glb: ") ? out.substr(10) : out;
}
std::string spoilt_json(const std::function<void(Json&)>& spoil) {
  return spoilt([&](GltfParts& parts) { spoil(parts.json); });
}

// One member of the small file's JSON gets this value, or goes where that is "gone".
struct Member {
  const char *pointer, *value;
  std::string message;
};
void set(Json& json, const Member& member) {
  const Json::json_pointer at(member.pointer);
  if (member.value == std::string("gone")) {
    json[at.parent_pointer()].erase(at.back());
  } else {
    json[at] = Json::parse(member.value);
  }
}

const std::string kOutput = "animations[0].samplers[0].output (accessors[1]): ";
const std::string kTooMuch =
    "animations[0]: expected at most 500000 frames, and frames times joints in all animations at "
    "most 3000000, found more";

TEST(GltfError, every_member_that_is_wrong_has_its_place_and_message) {
  const Member cases[] = {
      {"/asset/version", "\"1.0\"", "asset: expected glTF version 2.0, found '1.0'"},
      {"/asset/minVersion", "\"2.1\"", "asset: expected glTF version 2.0, found '2.1'"},
      // Nodes that do not form a tree.
      {"/nodes/2/children/0", "0", "nodes: expected a tree, found nodes that are below themselves"},
      {"/nodes/3/children/0", "2",
       "nodes[3].children[0]: expected a node without another parent, found node 2, a child of "
       "node 1"},
      {"/nodes/3/children/0", "4",
       "nodes[3].children[0]: expected a whole number below 4, found 4"},
      {"/skins/0/joints/1", "-1", "skins[0].joints[1]: expected a whole number below 4, found -1"},
      {"/nodes/1/translation", "[1, 2]",
       "nodes[1].translation: expected 3 numbers, found a list of 2"},
      {"/nodes/1/translation/1", "2e9",
       "nodes[1].translation[1]: expected a number between -1e9 and 1e9, found 2000000000.0"},
      // Animations that point nowhere.
      {"/animations/0/channels/1/sampler", "2",
       "animations[0].channels[1].sampler: expected a whole number below 2, found 2"},
      {"/animations/0/channels/1/target/node", "9",
       "animations[0].channels[1].target.node: expected a whole number below 4, found 9"},
      {"/animations/0/channels/1/sampler", "gone",
       "animations[0].channels[1]: expected a sampler and a target, one of the two is missing"},
      {"/animations/0/channels/1/target/path", "\"rotation\"",
       "animations[0].channels[1]: expected a target of its own, found that of a channel before "
       "it"},
      {"/animations/0/samplers/0/input", "77",
       "animations[0].samplers[0].input: expected a whole number below 3, found 77"},
      {"/animations/0/samplers/0/interpolation", "\"SMOOTH\"",
       "animations[0].samplers[0].interpolation: expected LINEAR, STEP or CUBICSPLINE, found "
       "'SMOOTH'"},
      {"/animations/0/samplers/0/output", "2",
       "animations[0].samplers[0].output: expected vectors of 4 numbers, in number 4 for 4 times, "
       "found 4 of 3"},
      {"/animations/0/samplers/0/interpolation", "\"CUBICSPLINE\"",
       "animations[0].samplers[0].output: expected vectors of 4 numbers, in number 12 for 4 "
       "times, found 4 of 4"},
      // Accessors beyond their data, and such as say nothing known.
      {"/accessors/1/count", "5",
       kOutput + "expected 5 elements within the 64 bytes of bufferViews[1], found it too short"},
      {"/accessors/1/count", "18446744073709551615",
       kOutput +
           "expected 18446744073709551615 elements within the 64 bytes of bufferViews[1], found "
           "it too short"},
      {"/accessors/1/bufferView", "gone", "(accepted)"},
      {"/bufferViews/1/byteOffset", "100",
       "bufferViews[1]: expected a part of the 128 bytes of buffers[0], found 64 bytes from byte "
       "100 on"},
      {"/accessors/1/componentType", "5124",
       kOutput + "expected a componentType of 5120 to 5126, found 5124"},
      {"/bufferViews/1/extensions/EXT_meshopt_compression", "{}",
       "animations[0].samplers[0].output: expected plain motion, found it packed with "
       "EXT_meshopt_compression; 'gltf-transform copy IN.glb OUT.glb' unpacks it"},
      {"/accessors/1/type", "\"MAT4\"",
       kOutput + "expected type SCALAR, VEC2, VEC3 or VEC4, found 'MAT4'"},
      {"/accessors/1/type", "gone", kOutput + "expected type SCALAR, VEC2, VEC3 or VEC4, found ''"},
      {"/accessors/1/count", "0", kOutput + "expected a count above 0, found 0"},
      {"/accessors/1/count", "-1", "accessors[1].count: expected a whole number, found -1"},
      {"/accessors/1/normalized", "1", "accessors[1].normalized: expected true or false, found 1"},
      {"/accessors/1", "1", "accessors[1]: expected an object, found 1"},
      {"/bufferViews/1/buffer", "gone", "bufferViews[1]: expected a buffer with data, found none"},
      {"/bufferViews/1/byteStride", "15",
       kOutput + "expected 4 elements within the 64 bytes of bufferViews[1], found it too short"},
      // Members of another kind.
      {"/nodes/3", "\"Lamp\"", "nodes[3]: expected an object, found \"Lamp\""},
      {"/nodes/3/name", "3", "nodes[3].name: expected a text, found 3"},
      {"/skins/0", "true", "skins[0]: expected an object, found true"},
      {"/images/0", "5", "images[0]: expected an object, found 5"},
      {"/images/0/mimeType", "5", "images[0].mimeType: expected a text, found 5"},
      {"/extensions", "1", "extensions: expected an object, found 1"},
      // A humanoid that is malformed.
      {"/extensions/VRMC_vrm_animation", "1",
       "extensions.VRMC_vrm_animation: expected an object, found 1"},
      {"/extensions/VRMC_vrm/humanoid/humanBones/hips", "1",
       "extensions.VRMC_vrm.humanoid.humanBones.hips: expected an object, found 1"},
      {"/extensions/VRMC_vrm/humanoid/humanBones/hips/node", "4",
       "extensions.VRMC_vrm.humanoid.humanBones.hips.node: expected a whole number below 4, found "
       "4"},
      {"/extensions/VRM/humanoid/humanBones/0", "1",
       "extensions.VRM.humanoid.humanBones[0]: expected an object, found 1"},
      {"/extensions/VRM/humanoid/humanBones/0/bone", "1",
       "extensions.VRM.humanoid.humanBones[0].bone: expected a text, found 1"},
      {"/extensions/VRMC_vrm_animation/expressions", "1",
       "extensions.VRMC_vrm_animation.expressions: expected an object, found 1"},
      {"/extensions/VRMC_vrm_animation/expressions/custom", "1",
       "extensions.VRMC_vrm_animation.expressions.custom: expected an object, found 1"},
      {"/extensions/VRMC_vrm_animation/expressions/preset/happy", "1",
       "extensions.VRMC_vrm_animation.expressions.preset.happy: expected an object, found 1"},
      {"/extensions/VRMC_vrm_animation/lookAt/node", "4",
       "extensions.VRMC_vrm_animation.lookAt.node: expected a whole number below 4, found 4"},
  };
  for (const Member& member : cases) {
    SCOPED_TRACE(member.pointer);
    EXPECT_EQ(spoilt_json([&](Json& json) { set(json, member); }), member.message);
  }
}

TEST(GltfError, sparse_accessors_that_are_no_whole) {
  const Member cases[] = {
      {"/values/bufferView", "1", "(accepted)"},
      {"/values", "gone",
       kOutput + "expected indices and values in sparse, one of the two is missing"},
      {"/indices", "gone",
       kOutput + "expected indices and values in sparse, one of the two is missing"},
      {"/indices/componentType", "5126",
       kOutput + "expected sparse indices of type 5121, 5123 or 5125, found 5126"},
      {"/values/bufferView", "gone",
       "accessors[1].sparse.values: expected a bufferView, found none"},
      // The last byte of the second time: a thirtieth of a second is 0x3d088889.
      {"/indices/byteOffset", "7", kOutput + "expected sparse indices below 4, found 61"},
      {"/count", "5",
       kOutput + "expected at most 4 sparse elements, as many as there are elements, found 5"},
  };
  for (const Member& member : cases) {
    SCOPED_TRACE(member.pointer);
    EXPECT_EQ(spoilt_json([&](Json& json) {
                // The first time, as an index: byte 0.
                Json& sparse = json["accessors"][1]["sparse"];
                sparse["count"] = 1;
                sparse["indices"] = {{"bufferView", 0}, {"componentType", 5121}};
                sparse["values"]["bufferView"] = 1;
                set(sparse, member);
              }),
              member.message);
  }
}

TEST(GltfError, a_file_that_is_no_gltf) {
  const std::pair<std::string, std::string> cases[] = {
      {"HIERARCHY", "expected glTF, found text that is not JSON; is the file complete?"},
      {"[1, 2]", "expected glTF, a JSON object, found a list of 2"},
      {"{}", "asset: expected glTF's version in it, found nothing"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(gltf_rejection(text), "walk.glb: " + message);
}

TEST(GltfError, a_glb_that_was_cut) {
  const std::string glb = test::to_glb(small_gltf());
  EXPECT_EQ(gltf_rejection(glb.substr(0, 10)),
            "walk.glb: expected a GLB of 12 bytes at least, found 10; is the file complete?");
  EXPECT_EQ(gltf_rejection(glb.substr(0, 100)),
            "walk.glb: expected a GLB of " + std::to_string(glb.size()) +
                " bytes at least, found 100; is the file complete?");
  EXPECT_EQ(gltf_rejection(std::string("glTF\1\0\0\0\0\0\0\0", 12)),
            "walk.glb: expected GLB version 2, found version 1");
  // The file goes on, but not with a whole chunk.
  const auto with_length = [](std::string bytes, size_t length) {
    std::string number;
    test::append_uint32(number, length);
    return bytes.replace(8, 4, number);
  };
  const std::string longer = glb + std::string(20, '\0');
  EXPECT_EQ(gltf_rejection(with_length(longer, glb.size() + 7)),
            "walk.glb: expected a GLB of " + std::to_string(glb.size() + 8) +
                " bytes at least, found " + std::to_string(glb.size() + 7) +
                "; is the file complete?");
  EXPECT_EQ(gltf_rejection(with_length(longer, glb.size() + 8)), "(accepted)");
  EXPECT_EQ(gltf_rejection(with_length(glb, glb.size() - 1)),
            "walk.glb: expected a GLB of " + std::to_string(glb.size()) +
                " bytes at least, found " + std::to_string(glb.size() - 1) +
                "; is the file complete?");
  EXPECT_EQ(gltf_rejection(with_length(glb, 12)),
            "walk.glb: expected a GLB with a JSON chunk, found none");
  EXPECT_EQ(gltf_rejection(std::string(glb).replace(16, 4, "NOSJ")),
            "walk.glb: expected JSON as the first chunk of the GLB, found another");
}

TEST(GltfError, nesting_and_size_of_the_json) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(gltf_rejection("{\"extras\": " + deep),
            "walk.glb: expected JSON at most 200 brackets deep and with at most 1000 members in an "
            "object, found more");
  std::string many_members = "{\"a\":1";
  for (int i = 0; i < 5000; ++i) many_members += ",\"a" + std::to_string(i) + "\":1";
  EXPECT_EQ(gltf_rejection(many_members + "}"),
            "walk.glb: expected JSON at most 200 brackets deep and with at most 1000 members in an "
            "object, found more");
}

TEST(GltfError, trees_and_sizes_beyond_the_limits) {
  EXPECT_EQ(spoilt_json([](Json& j) {
              j.erase("skins");
              j.erase("animations");
            }),
            "expected a skin or an animated node, found neither");
  EXPECT_EQ(spoilt_json([](Json& j) {
              for (int i = 4; i < 1100; ++i) {
                j["nodes"][static_cast<size_t>(i - 1)]["children"].push_back(i);
                j["nodes"].push_back(Json::object());
              }
            }),
            "nodes: expected at most 1000 one below the other, found more");
  EXPECT_EQ(spoilt_json([](Json& j) {
              for (int i = 0; i < 10'000; ++i) j["nodes"].push_back(Json::object());
            }),
            "nodes: expected at most 10000, found 10004");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["nodes"][0]["scale"] = {1e8, 1e8, 1e8};
              j["nodes"][1]["scale"] = {1e8, 1e8, 1e8};
            }),
            "nodes[2]: expected a position and a scale between -1e9 and 1e9, found them larger by "
            "the scales of the nodes above");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][1]["name"] = std::string(1000, 'n'); }),
            "(accepted)");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][1]["name"] = std::string(1001, 'n'); }),
            "nodes[1]: expected a name of at most 1000 bytes, found 1001");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["animations"].get_ref<Json::array_t&>().resize(10'001, Json::object());
            }),
            "animations: expected at most 10000, found 10001");
}

TEST(GltfError, accessors_without_a_view) {
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["accessors"][1].erase("bufferView");
              j["accessors"][1]["count"] = 4'000'000'000u;
            }),
            kOutput + "expected fewer zeros than the file has bytes, found 4000000000");
  EXPECT_EQ(spoilt_json([](Json& j) {
              Json& accessor = j["accessors"][1];
              accessor.erase("bufferView");
              accessor["sparse"]["count"] = 1;
              accessor["sparse"]["indices"] = {{"bufferView", 0}, {"componentType", 5121}};
              accessor["sparse"]["values"]["bufferView"] = 0;
              // The first accessor that is asked for, so that nothing else is missed before.
              j["animations"][0]["samplers"][0]["input"] = 1;
              j.erase("bufferViews");
            }),
            "accessors[1].sparse.indices.bufferView: expected a whole number below 0, found 0");
}

TEST(GltfError, more_motion_than_a_file_of_its_size_has) {
  // Two keys that are far apart, on a few joints and on many.
  const auto lasting = [](float seconds, int joints) {
    GltfParts parts = small_gltf();
    const size_t times = parts.add_bounded({0.0f, seconds}, "SCALAR", 1);
    const size_t turns = parts.add(std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}, "VEC4", 4);
    Json& animation = parts.json["animations"][0];
    animation["samplers"][0] = {{"input", times}, {"output", turns}};
    animation["samplers"][1] = animation["samplers"][0];
    animation["channels"].erase(1);
    for (int i = 0; i < joints; ++i) {
      parts.json["skins"][0]["joints"].push_back(parts.json["nodes"].size());
      parts.json["nodes"].push_back(Json::object());
    }
    return gltf_rejection(parts);
  };
  EXPECT_EQ(lasting(100, 0), "(accepted)");
  EXPECT_EQ(lasting(100, 900), "(accepted)");
  EXPECT_EQ(lasting(200, 900), "walk.glb: " + kTooMuch);
}

TEST(GltfError, numbers_that_are_no_motion) {
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(4, 4, p.bin.substr(12, 4)); }),
            "animations[0].samplers[0].input: expected times that increase, found time 2 not after "
            "the one before it");
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(16 + 16 + 4, 4, "\xff\xff\xff\xff"); }),
            kOutput + "expected numbers between -1e9 and 1e9, found another in element 1");
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(12, 4, std::string("\0\0\x80\x4d", 4)); }),
            kTooMuch);
  EXPECT_EQ(
      spoilt([](GltfParts& p) {
        p.json["nodes"][0]["scale"] = {1e6, 1e6, 1e6};
        const std::vector<float> positions = {0, 1, 0, 0, 1e4f, 0, 0, 1, 0, 0, 1, 0};
        p.json["animations"][0]["samplers"][1]["output"] = p.add(positions, "VEC3", 3);
      }),
      "animations[0].channels[1]: expected positions between -1e9 and 1e9, found one outside");
}

TEST(GltfError, a_vrm_animation_without_hips) {
  const auto file = parse_vrma(test::to_glb(small_gltf()), "walk.vrma");
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(
      file.error().message,
      "walk.vrma: extensions.VRMC_vrm_animation: expected a humanoid with hips, found none; a "
      "file without it is a .glb");
  const auto none = parse_vrma("HIERARCHY", "walk.vrma");
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().message,
            "walk.vrma: expected glTF, found text that is not JSON; is the file complete?");
}

TEST(GltfError, files_that_may_not_be_read) {
  const auto with_uri = [](const std::string& uri) {
    return gltf_rejection(test::to_gltf_text(small_gltf(), uri));
  };
  const std::string cure = "; save the file as .glb, which has everything in it";
  EXPECT_EQ(with_uri("/etc/passwd"),
            "walk.glb: buffers[0].uri: expected a name relative to this file, found "
            "'/etc/passwd'" +
                cure);
  for (const char* uri :
       {"../walk.bin", "a/../../walk.bin", "%2e%2e/walk.bin", "a/%2E./walk.bin"}) {
    EXPECT_EQ(with_uri(uri),
              "walk.glb: buffers[0].uri: expected a file beside or below this one, "
              "found '" +
                  std::string(uri) + "'" + cure);
  }
  for (const char* uri : {"https://example.org/walk.bin", "file:///etc/passwd"}) {
    EXPECT_EQ(with_uri(uri),
              "walk.glb: buffers[0].uri: expected a file beside this one or a data "
              "URI, found '" +
                  std::string(uri) + "'" + cure);
  }
  EXPECT_EQ(with_uri("%00"),
            "walk.glb: buffers[0].uri: expected the name of a file, found '%00'" + cure);
  EXPECT_EQ(with_uri("nowhere.bin"),
            "walk.glb: buffers[0].uri: nowhere.bin: cannot be read: No such file or directory");
  EXPECT_EQ(with_uri("data:;base64,AA!A"), "walk.glb: buffers[0].uri: expected base64, found '!'");
  EXPECT_EQ(with_uri("data:;base64,AAAA"), "walk.glb: buffers[0]: expected 128 bytes, found 3");
}

}  // namespace
}  // namespace panache
