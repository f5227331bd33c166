// The messages that say why a glTF file cannot be read.

#include <functional>

#include "gltf_checks.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;
using test::small_gltf;

// What is said of the small file after `spoil` did something to it.
std::string spoilt(const std::function<void(GltfParts&)>& spoil) {
  GltfParts parts = small_gltf();
  spoil(parts);
  return gltf_rejection(parts);
}
std::string spoilt_json(const std::function<void(Json&)>& spoil) {
  return spoilt([&](GltfParts& parts) { spoil(parts.json); });
}

TEST(GltfError, a_file_that_is_no_gltf) {
  EXPECT_EQ(gltf_rejection(std::string("HIERARCHY")),
            "walk.glb: expected glTF, found text that is not JSON; is the file complete?");
  EXPECT_EQ(gltf_rejection(std::string("[1, 2]")),
            "walk.glb: expected glTF, a JSON object, found a list of 2");
  EXPECT_EQ(gltf_rejection(std::string("{}")),
            "walk.glb: asset: expected glTF's version in it, found nothing");
  EXPECT_EQ(spoilt_json([](Json& j) { j["asset"]["version"] = "1.0"; }),
            "walk.glb: asset: expected glTF version 2.0, found '1.0'");
  EXPECT_EQ(spoilt_json([](Json& j) { j["asset"]["minVersion"] = "2.1"; }),
            "walk.glb: asset: expected glTF version 2.0, found '2.1'");
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
  std::string wide = "{\"a\":1";
  for (int i = 0; i < 5000; ++i) wide += ",\"a" + std::to_string(i) + "\":1";
  EXPECT_EQ(gltf_rejection(wide + "}"),
            "walk.glb: expected JSON at most 200 brackets deep and with at most 1000 members in an "
            "object, found more");
}

TEST(GltfError, a_tree_that_is_none) {
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][2]["children"].push_back(0); }),
            "walk.glb: nodes: expected a tree, found nodes that are below themselves");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][3]["children"].push_back(2); }),
            "walk.glb: nodes[3].children[0]: expected a node without another parent, found node 2, "
            "a child of node 1");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][3]["children"].push_back(4); }),
            "walk.glb: nodes[3].children[0]: expected a whole number below 4, found 4");
  EXPECT_EQ(spoilt_json([](Json& j) { j["skins"][0]["joints"][1] = -1; }),
            "walk.glb: skins[0].joints[1]: expected a whole number below 4, found -1");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["nodes"][1]["translation"] = {1, 2};
            }),
            "walk.glb: nodes[1].translation: expected 3 numbers, found a list of 2");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][1]["translation"][1] = 2e9; }),
            "walk.glb: nodes[1].translation[1]: expected a number between -1e9 and 1e9, found "
            "2000000000.0");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j.erase("skins");
              j.erase("animations");
            }),
            "walk.glb: expected a skin or an animated node, found neither");
  EXPECT_EQ(spoilt_json([](Json& j) {
              for (int i = 4; i < 1100; ++i) {
                j["nodes"][static_cast<size_t>(i - 1)]["children"].push_back(i);
                j["nodes"].push_back(Json::object());
              }
            }),
            "walk.glb: nodes: expected at most 1000 one below the other, found more");
  EXPECT_EQ(spoilt_json([](Json& j) {
              for (int i = 0; i < 10'000; ++i) j["nodes"].push_back(Json::object());
            }),
            "walk.glb: nodes: expected at most 10000, found 10004");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["nodes"][0]["scale"] = {1e8, 1e8, 1e8};
              j["nodes"][1]["scale"] = {1e8, 1e8, 1e8};
            }),
            "walk.glb: nodes[2]: expected a position and a scale between -1e9 and 1e9, found them "
            "larger by the scales of the nodes above");
}

TEST(GltfError, animations_that_point_nowhere) {
  const auto with = [](const std::function<void(Json&)>& spoil) {
    return spoilt_json([&](Json& j) { spoil(j["animations"][0]); });
  };
  EXPECT_EQ(
      with([](Json& a) { a["channels"][1]["sampler"] = 2; }),
      "walk.glb: animations[0].channels[1].sampler: expected a whole number below 2, found 2");
  EXPECT_EQ(with([](Json& a) { a["channels"][1]["target"]["node"] = 9; }),
            "walk.glb: animations[0].channels[1].target.node: expected a whole number below 4, "
            "found 9");
  EXPECT_EQ(with([](Json& a) { a["channels"][1].erase("sampler"); }),
            "walk.glb: animations[0].channels[1]: expected a sampler and a target, one of the two "
            "is missing");
  EXPECT_EQ(with([](Json& a) { a["channels"][1]["target"]["path"] = "rotation"; }),
            "walk.glb: animations[0].channels[1]: expected a target of its own, found that of a "
            "channel before it");
  EXPECT_EQ(with([](Json& a) { a["samplers"][0]["input"] = 77; }),
            "walk.glb: animations[0].samplers[0].input: expected a whole number below 3, found 77");
  EXPECT_EQ(with([](Json& a) { a["samplers"][0]["interpolation"] = "SMOOTH"; }),
            "walk.glb: animations[0].samplers[0].interpolation: expected LINEAR, STEP or "
            "CUBICSPLINE, found 'SMOOTH'");
  EXPECT_EQ(with([](Json& a) { a["samplers"][0]["output"] = 2; }),
            "walk.glb: animations[0].samplers[0].output: expected vectors of 4 numbers, in number "
            "4 for 4 times, found 4 of 3");
  EXPECT_EQ(with([](Json& a) { a["samplers"][0]["interpolation"] = "CUBICSPLINE"; }),
            "walk.glb: animations[0].samplers[0].output: expected vectors of 4 numbers, in number "
            "12 for 4 times, found 4 of 4");
}

TEST(GltfError, accessors_beyond_their_data) {
  EXPECT_EQ(spoilt_json([](Json& j) { j["accessors"][1]["count"] = 5; }),
            "walk.glb: animations[0].samplers[0].output (accessors[1]): expected 5 elements within "
            "the 64 bytes of bufferViews[1], found it too short");
  EXPECT_EQ(spoilt_json([](Json& j) { j["accessors"][1]["count"] = 0xffffffffffffffff; }),
            "walk.glb: animations[0].samplers[0].output (accessors[1]): expected "
            "18446744073709551615 elements within the 64 bytes of bufferViews[1], found it too "
            "short");
  EXPECT_EQ(spoilt_json([](Json& j) { j["accessors"][1].erase("bufferView"); }), "(accepted)");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["accessors"][1].erase("bufferView");
              j["accessors"][1]["count"] = 4'000'000'000u;
            }),
            "walk.glb: animations[0].samplers[0].output (accessors[1]): expected fewer zeros than "
            "the file has bytes, found 4000000000");
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
            "walk.glb: accessors[1].sparse.indices.bufferView: expected a whole number below 0, "
            "found 0");
  EXPECT_EQ(spoilt_json([](Json& j) { j["bufferViews"][1]["byteOffset"] = 100; }),
            "walk.glb: bufferViews[1]: expected a part of the 128 bytes of buffers[0], found 64 "
            "bytes from byte 100 on");
  EXPECT_EQ(spoilt_json([](Json& j) { j["accessors"][1]["componentType"] = 5124; }),
            "walk.glb: animations[0].samplers[0].output (accessors[1]): expected a componentType "
            "of 5120 to 5126, found 5124");
  EXPECT_EQ(spoilt_json([](Json& j) {
              j["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = Json::object();
            }),
            "walk.glb: animations[0].samplers[0].output: expected plain motion, found it packed "
            "with EXT_meshopt_compression; 'gltf-transform copy IN.glb OUT.glb' unpacks it");
}

TEST(GltfError, more_motion_than_a_file_of_its_size_has) {
  const auto with = [](const std::function<void(Json&)>& spoil) { return spoilt_json(spoil); };
  EXPECT_EQ(with([](Json& j) {
              j["animations"].get_ref<Json::array_t&>().resize(10'001, Json::object());
            }),
            "walk.glb: animations: expected at most 10000, found 10001");
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
  EXPECT_EQ(lasting(200, 900),
            "walk.glb: animations[0]: expected at most 500000 frames, and frames times joints in "
            "all animations at most 3000000, found more");
}

TEST(GltfError, accessors_that_say_nothing_known) {
  const std::string output = "walk.glb: animations[0].samplers[0].output (accessors[1]): ";
  const auto with = [](const std::function<void(Json&)>& spoil) {
    return spoilt_json([&](Json& j) { spoil(j["accessors"][1]); });
  };
  EXPECT_EQ(with([](Json& a) { a["type"] = "MAT4"; }),
            output + "expected type SCALAR, VEC2, VEC3 or VEC4, found 'MAT4'");
  EXPECT_EQ(with([](Json& a) { a.erase("type"); }),
            output + "expected type SCALAR, VEC2, VEC3 or VEC4, found ''");
  EXPECT_EQ(with([](Json& a) { a["count"] = 0; }), output + "expected a count above 0, found 0");
  EXPECT_EQ(with([](Json& a) { a["count"] = -1; }),
            "walk.glb: accessors[1].count: expected a whole number, found -1");
  EXPECT_EQ(with([](Json& a) { a["normalized"] = 1; }),
            "walk.glb: accessors[1].normalized: expected true or false, found 1");
  EXPECT_EQ(with([](Json& a) { a = 1; }), "walk.glb: accessors[1]: expected an object, found 1");
  const auto with_view = [](const std::function<void(Json&)>& spoil) {
    return spoilt_json([&](Json& j) { spoil(j["bufferViews"][1]); });
  };
  EXPECT_EQ(with_view([](Json& v) { v.erase("buffer"); }),
            "walk.glb: bufferViews[1]: expected a buffer with data, found none");
  EXPECT_EQ(with_view([](Json& v) { v["byteStride"] = 15; }),
            output +
                "expected 4 elements within the 64 bytes of bufferViews[1], found it too "
                "short");
}

TEST(GltfError, sparse_accessors_that_are_no_whole) {
  const std::string output = "walk.glb: animations[0].samplers[0].output (accessors[1]): ";
  const auto with = [](const std::function<void(Json&)>& spoil) {
    return spoilt_json([&](Json& j) {
      // The first time, as an index: byte 0.
      Json& sparse = j["accessors"][1]["sparse"];
      sparse["count"] = 1;
      sparse["indices"] = {{"bufferView", 0}, {"componentType", 5121}};
      sparse["values"]["bufferView"] = 1;
      spoil(sparse);
    });
  };
  EXPECT_EQ(with([](Json&) {}), "(accepted)");
  EXPECT_EQ(with([](Json& s) { s.erase("values"); }),
            output + "expected indices and values in sparse, one of the two is missing");
  EXPECT_EQ(with([](Json& s) { s.erase("indices"); }),
            output + "expected indices and values in sparse, one of the two is missing");
  EXPECT_EQ(with([](Json& s) { s["indices"]["componentType"] = 5126; }),
            output + "expected sparse indices of type 5121, 5123 or 5125, found 5126");
  EXPECT_EQ(with([](Json& s) { s["values"].erase("bufferView"); }),
            "walk.glb: accessors[1].sparse.values: expected a bufferView, found none");
  // The last byte of the second time: a thirtieth of a second is 0x3d088889.
  EXPECT_EQ(with([](Json& s) { s["indices"]["byteOffset"] = 7; }),
            output + "expected sparse indices below 4, found 61");
  EXPECT_EQ(with([](Json& s) { s["count"] = 5; }),
            output + "expected at most 4 sparse elements, as many as there are elements, found 5");
}

TEST(GltfError, numbers_that_are_no_motion) {
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(4, 4, p.bin.substr(12, 4)); }),
            "walk.glb: animations[0].samplers[0].input: expected times that increase, found time 2 "
            "not after the one before it");
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(16 + 16 + 4, 4, "\xff\xff\xff\xff"); }),
            "walk.glb: animations[0].samplers[0].output (accessors[1]): expected numbers "
            "between -1e9 and 1e9, found another in element 1");
  EXPECT_EQ(spoilt([](GltfParts& p) { p.bin.replace(12, 4, std::string("\0\0\x80\x4d", 4)); }),
            "walk.glb: animations[0]: expected at most 500000 frames, and frames times joints in "
            "all animations at most 3000000, found more");
}

TEST(GltfError, places_that_a_scale_takes_too_far) {
  EXPECT_EQ(spoilt([](GltfParts& p) {
              p.json["nodes"][0]["scale"] = {1e6, 1e6, 1e6};
              const std::vector<float> places = {0, 1, 0, 0, 1e4f, 0, 0, 1, 0, 0, 1, 0};
              p.json["animations"][0]["samplers"][1]["output"] = p.add(places, "VEC3", 3);
            }),
            "walk.glb: animations[0].channels[1]: expected positions between -1e9 and 1e9, found "
            "one outside");
}

TEST(GltfError, a_name_beyond_the_limit) {
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][1]["name"] = std::string(1000, 'n'); }),
            "(accepted)");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][1]["name"] = std::string(1001, 'n'); }),
            "walk.glb: nodes[1]: expected a name of at most 1000 bytes, found 1001");
}

TEST(GltfError, members_of_another_kind) {
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][3] = "Lamp"; }),
            "walk.glb: nodes[3]: expected an object, found \"Lamp\"");
  EXPECT_EQ(spoilt_json([](Json& j) { j["nodes"][3]["name"] = 3; }),
            "walk.glb: nodes[3].name: expected a text, found 3");
  EXPECT_EQ(spoilt_json([](Json& j) { j["skins"][0] = true; }),
            "walk.glb: skins[0]: expected an object, found true");
  EXPECT_EQ(spoilt_json([](Json& j) { j["images"][0] = 5; }),
            "walk.glb: images[0]: expected an object, found 5");
  EXPECT_EQ(spoilt_json([](Json& j) { j["images"][0]["mimeType"] = 5; }),
            "walk.glb: images[0].mimeType: expected a text, found 5");
}

TEST(GltfError, a_humanoid_that_is_none) {
  const auto with = [](const char* extension, const std::function<void(Json&)>& spoil) {
    return spoilt_json([&](Json& j) { spoil(j["extensions"][extension]); });
  };
  const auto with_vrma = [&](const std::function<void(Json&)>& spoil) {
    return with("VRMC_vrm_animation", spoil);
  };
  EXPECT_EQ(spoilt_json([](Json& j) { j["extensions"] = 1; }),
            "walk.glb: extensions: expected an object, found 1");
  EXPECT_EQ(with_vrma([](Json& vrma) { vrma = 1; }),
            "walk.glb: extensions.VRMC_vrm_animation: expected an object, found 1");
  EXPECT_EQ(with("VRMC_vrm", [](Json& vrm) { vrm["humanoid"]["humanBones"]["hips"] = 1; }),
            "walk.glb: extensions.VRMC_vrm.humanoid.humanBones.hips: expected an object, found 1");
  EXPECT_EQ(with("VRMC_vrm", [](Json& vrm) { vrm["humanoid"]["humanBones"]["hips"]["node"] = 4; }),
            "walk.glb: extensions.VRMC_vrm.humanoid.humanBones.hips.node: expected a whole number "
            "below 4, found 4");
  EXPECT_EQ(with("VRM", [](Json& vrm) { vrm["humanoid"]["humanBones"][0] = 1; }),
            "walk.glb: extensions.VRM.humanoid.humanBones[0]: expected an object, found 1");
  EXPECT_EQ(with("VRM", [](Json& vrm) { vrm["humanoid"]["humanBones"][0]["bone"] = 1; }),
            "walk.glb: extensions.VRM.humanoid.humanBones[0].bone: expected a text, found 1");
  EXPECT_EQ(with_vrma([](Json& vrma) { vrma["expressions"] = 1; }),
            "walk.glb: extensions.VRMC_vrm_animation.expressions: expected an object, found 1");
  EXPECT_EQ(with_vrma([](Json& vrma) { vrma["expressions"]["custom"] = 1; }),
            "walk.glb: extensions.VRMC_vrm_animation.expressions.custom: expected an object, found "
            "1");
  EXPECT_EQ(with_vrma([](Json& vrma) { vrma["expressions"]["preset"]["happy"] = 1; }),
            "walk.glb: extensions.VRMC_vrm_animation.expressions.preset.happy: expected an object, "
            "found 1");
  EXPECT_EQ(with_vrma([](Json& vrma) { vrma["lookAt"]["node"] = 4; }),
            "walk.glb: extensions.VRMC_vrm_animation.lookAt.node: expected a whole number below 4, "
            "found 4");
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
