// glTF files whose data is packed (EXT_meshopt_compression), and those with quantized vertices.

#include <cstring>

#include <meshoptimizer.h>

#include "cli/node.h"
#include "clip/make_character.h"

namespace panache::test {
namespace {

constexpr const char* kExtension = "EXT_meshopt_compression";
constexpr const char* kQuantization = "KHR_mesh_quantization";

// A character twice: with its data packed, and with what it is unpacked to.
class Packer {
 public:
  enum class What { all, meshes };

  Packer(What what, bool triangles) : what_(what), triangles_(triangles), from_(character()) {
    from_.json["extensionsUsed"].push_back(kQuantization);
    from_.json["extensionsRequired"].push_back(kQuantization);
    packed.json = plain.json = from_.json;
    packed.json["bufferViews"] = plain.json["bufferViews"] = Json::array();
    for (size_t v = 0; v < from_.json["bufferViews"].size(); ++v) add_view(v);
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      packed.json[list].push_back(kExtension);
    }
    packed.json["buffers"][1] = {{"byteLength", plain.bin.size()},
                                 {"extensions", {{kExtension, {{"fallback", true}}}}}};
  }

  GltfParts plain, packed;

 private:
  void add_view(size_t v) {
    const Json& accessors = from_.json["accessors"];
    size_t a = 0;
    while (accessors[a]["bufferView"] != v) ++a;
    const std::string type = accessors[a]["type"];
    const size_t components = type == "SCALAR" ? 1
                              : type == "MAT4" ? 16
                                               : static_cast<size_t>(type[3] - '0');
    const int component = accessors[a]["componentType"];
    std::string bytes = from_.bin.substr(from_.json["bufferViews"][v]["byteOffset"],
                                         from_.json["bufferViews"][v]["byteLength"]);
    Json coding = {{"mode", "ATTRIBUTES"}};
    size_t stride = components * (component == 5126 ? 4 : 2);
    std::string encoded = bytes;
    const bool is_index = from_.json["bufferViews"][v].value("target", 0) == 34963;
    if (is_index) {
      coding["mode"] = triangles_ ? "TRIANGLES" : "INDICES";
    } else if (is_of("NORMAL", a)) {
      filter(coding, "OCTAHEDRAL", bytes, encoded, stride = 4, 3);
      plain.json["accessors"][a]["componentType"] = 5120;
      plain.json["accessors"][a]["normalized"] = true;
    } else if (const std::string path = path_of(a); path == "rotation" && component == 5126) {
      filter(coding, "QUATERNION", bytes, encoded, stride = 8, 4);
      plain.json["accessors"][a]["componentType"] = 5122;
      plain.json["accessors"][a]["normalized"] = true;
    } else if (path == "translation") {
      filter(coding, "EXPONENTIAL", bytes, encoded, stride, 3);
    }
    packed.json["accessors"][a] = plain.json["accessors"][a];

    const int target = from_.json["bufferViews"][v].value("target", 0);
    plain.add_view(bytes, target);
    Json& view = plain.json["bufferViews"].back();
    if (stride == 4 && coding.contains("filter")) view["byteStride"] = 4;
    Json out = view;
    const bool pack = what_ == What::all || target != 0;
    const std::string data = pack ? pack_bytes(encoded, stride, coding["mode"]) : bytes;
    packed.bin.resize((packed.bin.size() + 3) / 4 * 4);
    Json extent = {{"buffer", 0}, {"byteOffset", packed.bin.size()}, {"byteLength", data.size()}};
    packed.bin += data;
    if (pack) {
      extent["byteStride"] = stride;
      extent["count"] = encoded.size() / stride;
      extent.update(coding);
      out["buffer"] = 1;
      out["extensions"][kExtension] = extent;
    } else {
      out.update(extent);
    }
    packed.json["bufferViews"].push_back(out);
  }

  bool is_of(const char* attribute, size_t accessor) const {
    for (const Json& mesh : from_.json["meshes"]) {
      if (mesh["primitives"][0]["attributes"].value(attribute, size_t{9999}) == accessor) {
        return true;
      }
    }
    return false;
  }
  // What an accessor moves with keys that a filter fits, or "".
  std::string path_of(size_t accessor) const {
    for (const Json& animation : from_.json["animations"]) {
      for (const Json& channel : animation["channels"]) {
        const Json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
        if (sampler["output"] == accessor && sampler["interpolation"] != "CUBICSPLINE") {
          return channel["target"]["path"];
        }
      }
    }
    return "";
  }

  // Turns floats into what a filter wants in `encoded` and into what it gives in `bytes`.
  static void filter(Json& coding, const char* name, std::string& bytes, std::string& encoded,
                     size_t stride, size_t components) {
    coding["filter"] = name;
    const size_t count = bytes.size() / 4 / components;
    const size_t width = name[0] == 'E' ? 3 : 4;
    std::vector<float> numbers(count * width);
    for (size_t i = 0; i < count; ++i) {
      std::memcpy(&numbers[i * width], &bytes[i * components * 4], components * 4);
    }
    encoded.assign(count * stride, '\0');
    if (name[0] == 'O') meshopt_encodeFilterOct(encoded.data(), count, stride, 8, numbers.data());
    if (name[0] == 'Q') meshopt_encodeFilterQuat(encoded.data(), count, stride, 16, numbers.data());
    if (name[0] == 'E') meshopt_encodeFilterExp(encoded.data(), count, stride, 24, numbers.data());
    bytes = encoded;
    if (name[0] == 'O') meshopt_decodeFilterOct(bytes.data(), count, stride);
    if (name[0] == 'Q') meshopt_decodeFilterQuat(bytes.data(), count, stride);
    if (name[0] == 'E') meshopt_decodeFilterExp(bytes.data(), count, stride);
  }

  static std::string pack_bytes(const std::string& bytes, size_t stride, const std::string& mode) {
    const size_t count = bytes.size() / stride;
    std::vector<unsigned char> out;
    size_t size = 0;
    if (mode == "ATTRIBUTES") {
      out.resize(meshopt_encodeVertexBufferBound(count, stride));
      size = meshopt_encodeVertexBuffer(out.data(), out.size(), bytes.data(), count, stride);
    } else {
      std::vector<uint16_t> half(count);
      std::memcpy(half.data(), bytes.data(), bytes.size());
      const std::vector<unsigned> all(half.begin(), half.end());
      out.resize(std::max(meshopt_encodeIndexSequenceBound(count, 1 << 16),
                          meshopt_encodeIndexBufferBound(count, 1 << 16)));
      size = mode == "INDICES"
                 ? meshopt_encodeIndexSequence(out.data(), out.size(), all.data(), count)
                 : meshopt_encodeIndexBuffer(out.data(), out.size(), all.data(), count);
    }
    EXPECT_GT(size, 0u);
    return {reinterpret_cast<const char*>(out.data()), size};
  }

  const What what_;
  const bool triangles_;
  GltfParts from_;
};

class Packed : public ProgramTest {
 protected:
  // What the verbs make of a file: the outputs, one after the other.
  std::vector<std::string> results(const GltfParts& parts) {
    write("hero.glb", to_glb(parts));
    std::vector<std::string> out;
    out.push_back(must("info hero.glb --json").out);
    must("convert hero.glb --clip Walk --force -o a.bvh");
    out.push_back(read("a.bvh"));
    must("stylize hero.glb --style old=1 --force -o a.glb");
    out.push_back(read("a.glb"));
    return out;
  }
  // Members in any order.
  static nlohmann::json sorted(const Json& document) {
    return nlohmann::json::parse(document.dump());
  }
};

TEST_F(Packed, files_give_what_the_plain_file_gives) {
  const Packer both(Packer::What::all, false);
  const auto plain = results(both.plain), packed = results(both.packed);
  EXPECT_EQ(packed[0], plain[0]);
  EXPECT_EQ(packed[1], plain[1]);
  const GltfParts a = glb_parts(plain[2]), b = glb_parts(packed[2]);
  EXPECT_EQ(sorted(b.json), sorted(a.json));
  EXPECT_EQ(b.bin, a.bin);
}

TEST_F(Packed, triangles_keep_their_corners) {
  const Packer both(Packer::What::all, true);
  const GltfParts a = glb_parts(results(both.plain)[2]), b = glb_parts(results(both.packed)[2]);
  // Packing may turn a triangle, so that another of its corners is the first.
  const size_t indices = a.json["meshes"][0]["primitives"][0]["indices"];
  const auto triangles = [&](const GltfParts& parts) {
    const std::string bytes = accessor_bytes(parts, indices);
    std::vector<uint16_t> out(bytes.size() / 2);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    for (auto i = out.begin(); i != out.end(); i += 3) {
      std::rotate(i, std::min_element(i, i + 3), i + 3);
    }
    return out;
  };
  EXPECT_EQ(triangles(b), triangles(a));
}

TEST_F(Packed, meshes_alone_stay_packed) {
  const Packer both(Packer::What::meshes, true);
  const auto plain = results(both.plain), packed = results(both.packed);
  EXPECT_EQ(packed[0], plain[0]);
  EXPECT_EQ(packed[1], plain[1]);
  const Json out = glb_parts(packed[2]).json;
  EXPECT_EQ(out["extensionsUsed"], both.packed.json["extensionsUsed"]);
  for (size_t v = 0; v < both.packed.json["bufferViews"].size(); ++v) {
    EXPECT_EQ(out["bufferViews"][v], both.packed.json["bufferViews"][v]);
  }
}

TEST_F(Packed, what_is_wrong_is_rejected_with_its_place) {
  const Packer good(Packer::What::all, false);
  const size_t view =
      good.plain.json["accessors"][good.plain.json["animations"][0]["samplers"][0]["output"]
                                       .get<size_t>()]["bufferView"];
  const std::vector<std::pair<const char*, Json>> faults = {{"count", 0},
                                                            {"count", 1'000'000'000'000},
                                                            {"byteStride", 6},
                                                            {"byteStride", 512},
                                                            {"byteStride", 0},
                                                            {"mode", "X"},
                                                            {"filter", "QUATERNION"},
                                                            {"byteLength", 9},
                                                            {"byteLength", 1 << 30},
                                                            {"buffer", 1},
                                                            {"mode", "TRIANGLES"}};
  for (const auto& [key, value] : faults) {
    GltfParts bad = good.packed;
    bad.json["bufferViews"][view]["extensions"][kExtension][key] = value;
    write("bad.glb", to_glb(bad));
    const Ran ran = run("info bad.glb");
    EXPECT_EQ(ran.exit, 1) << key << value;
    EXPECT_TRUE(begins(ran.err, "panache: bad.glb: bufferViews[" + std::to_string(view) +
                                    "].extensions.EXT_meshopt_compression"));
  }
}

TEST_F(Packed, quantized_vertices_stay_as_they_are) {
  const GltfParts parts = Packer(Packer::What::all, false).plain;
  const GltfParts out = glb_parts(results(parts)[2]);
  EXPECT_EQ(out.json["extensionsRequired"], parts.json["extensionsRequired"]);
  EXPECT_EQ(out.json["meshes"], parts.json["meshes"]);
  EXPECT_EQ(out.bin.substr(0, parts.bin.size()), parts.bin);
}

TEST_F(Packed, the_validator_finds_no_error_in_what_is_written) {
  const Packer both(Packer::What::all, true);
  write("plain.glb", results(both.plain)[2]);
  write("unpacked.glb", results(both.packed)[2]);
  expect_valid_gltf(*this, "plain.glb unpacked.glb");
}

}  // namespace
}  // namespace panache::test
