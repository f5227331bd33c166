#pragma once
// glTF files for tests, made in memory: pieces that a test may bend before they become a file.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/quat.h"

namespace panache::test {

using Json = nlohmann::ordered_json;

// A file's JSON and the data of its only buffer.
struct GltfParts {
  Json json = Json::parse(R"({"asset": {"version": "2.0"}})");
  std::string bin;

  // A bufferView of bytes, its index; `target` as in glTF, 0 for none.
  size_t add_view(std::string_view bytes, int target = 0) {
    bin.resize((bin.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    json["bufferViews"].push_back(view);
    bin += bytes;
    return json["bufferViews"].size() - 1;
  }

  // An accessor of whole numbers of `size` bytes or of floats, its index.
  template <class T>
  size_t add(const std::vector<T>& numbers, const char* type, size_t components, int target = 0) {
    constexpr int kType = std::is_same_v<T, float> ? 5126
                          : sizeof(T) == 1         ? 5121
                          : std::is_signed_v<T>    ? 5122
                                                   : 5123;
    std::string bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    const size_t view = add_view(bytes, target);  // Moves members of the JSON.
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", kType},
                                 {"count", numbers.size() / components},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }
  // The same with the bounds of its elements, as times and positions need them.
  size_t add_bounded(const std::vector<float>& numbers, const char* type, size_t components,
                     int target = 0) {
    const size_t accessor = add(numbers, type, components, target);
    for (size_t k = 0; k < components; ++k) {
      float min = numbers[k], max = numbers[k];
      for (size_t i = k; i < numbers.size(); i += components) {
        min = std::min(min, numbers[i]);
        max = std::max(max, numbers[i]);
      }
      json["accessors"][accessor]["min"].push_back(min);
      json["accessors"][accessor]["max"].push_back(max);
    }
    return accessor;
  }
  // A channel of animation `animation` with a sampler of its own.
  void add_channel(size_t animation, size_t node, const char* path, const char* interpolation,
                   size_t times, size_t values) {
    Json& to = json["animations"][animation];
    const size_t sampler = to["samplers"].size();
    to["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
    to["samplers"].push_back(
        {{"input", times}, {"interpolation", interpolation}, {"output", values}});
  }
};

inline void append_uint32(std::string& out, size_t value) {
  for (size_t i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

inline std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return out;
}

// A GLB of chunks as they are given; lengths are those of the texts, padded.
inline std::string glb_of(std::string json, std::string bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  append_uint32(out, 2);
  append_uint32(out, 12 + 8 + json.size() + (bin.empty() ? 0 : 8 + bin.size()));
  append_uint32(out, json.size());
  out += "JSON" + json;
  if (bin.empty()) return out;
  append_uint32(out, bin.size());
  return out + std::string("BIN\0", 4) + bin;
}

inline std::string to_glb(GltfParts parts) {
  if (!parts.bin.empty()) parts.json["buffers"][0]["byteLength"] = parts.bin.size();
  return glb_of(parts.json.dump(), parts.bin);
}

// JSON text with the data in it, or in a file of that address.
inline std::string to_gltf_text(GltfParts parts, const std::string& uri = "") {
  Json& buffer = parts.json["buffers"][0];
  buffer["byteLength"] = parts.bin.size();
  buffer["uri"] =
      uri.empty() ? "data:application/octet-stream;base64," + to_base64(parts.bin) : uri;
  return parts.json.dump(2);
}

// Takes a GLB of ours apart again, with its one buffer.
inline GltfParts glb_parts(std::string_view glb) {
  const auto number = [&](size_t at) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(glb[at + i]);
    return size_t{value};
  };
  GltfParts parts;
  const size_t json_size = number(12);
  parts.json = Json::parse(glb.substr(20, json_size));
  if (20 + json_size + 8 <= glb.size()) parts.bin = glb.substr(28 + json_size);
  return parts;
}

// The bytes of the elements of an accessor without a stride.
inline std::string accessor_bytes(const GltfParts& parts, size_t accessor) {
  const Json& json = parts.json["accessors"][accessor];
  const Json& view = parts.json["bufferViews"][json["bufferView"].get<size_t>()];
  const std::string type = json["type"];
  const size_t components = type == "SCALAR" ? 1 : static_cast<size_t>(type[3] - '0');
  const int component = json["componentType"];
  const size_t size = component == 5126 ? 4 : component < 5122 ? 1 : 2;
  return parts.bin.substr(view.value("byteOffset", size_t{0}) + json.value("byteOffset", size_t{0}),
                          json["count"].get<size_t>() * components * size);
}

inline std::vector<float> accessor_floats(const GltfParts& parts, size_t accessor) {
  const std::string bytes = accessor_bytes(parts, accessor);
  std::vector<float> numbers(bytes.size() / 4);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(numbers.data()));
  return numbers;
}

inline void append(std::vector<float>& numbers, Quat q) {
  numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w});
}
inline void append(std::vector<float>& numbers, Vec3 v) {
  numbers.insert(numbers.end(), {v.x, v.y, v.z});
}

// Boxes in one mesh, skinned and with a morph target: per corner of a face its place, normal,
// joints, weights and what the target adds.
struct BoxMesh {
  std::vector<float> positions, normals, weights, morph;
  std::vector<uint16_t> joints, indices;

  // A box from `base` to `tip`; the corners at its base hang half on `parent`, and the target
  // pushes all corners apart along x by `push`.
  void add_box(Vec3d base, Vec3d tip, double width, int joint, int parent, double push) {
    const Quatd turn = rotation_between(Vec3d{0, 1, 0}, normalized(tip - base));
    const double size = length(tip - base);
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const double side = face % 2 ? 1 : -1;
      const uint16_t first = static_cast<uint16_t>(positions.size() / 3);
      for (int corner = 0; corner < 4; ++corner) {
        std::array<double, 3> at = {};
        at[static_cast<size_t>(axis)] = side;
        at[static_cast<size_t>((axis + 1) % 3)] = corner % 2 ? 1 : -1;
        at[static_cast<size_t>((axis + 2) % 3)] = (corner / 2 ? 1 : -1) * side;
        std::array<double, 3> out = {};
        out[static_cast<size_t>(axis)] = side;
        const Vec3d local = {at[0] * width / 2, (at[1] + 1) / 2 * size, at[2] * width / 2};
        append(positions, (base + rotate(turn, local)).as<float>());
        append(normals, rotate(turn, Vec3d{out[0], out[1], out[2]}).as<float>());
        append(morph, Vec3d{at[0] * push, 0, 0}.as<float>());
        const bool shared = at[1] < 0 && parent >= 0;
        joints.insert(joints.end(), {static_cast<uint16_t>(joint),
                                     static_cast<uint16_t>(shared ? parent : 0), 0, 0});
        weights.insert(weights.end(), {shared ? 0.5f : 1.0f, shared ? 0.5f : 0.0f, 0, 0});
      }
      for (const int i : {0, 1, 2, 2, 1, 3}) {
        indices.push_back(static_cast<uint16_t>(first + i));
      }
    }
  }
};

inline std::vector<float> key_times(int count, float rate = 30, float first = 0) {
  std::vector<float> times;
  for (int i = 0; i < count; ++i) times.push_back(first + static_cast<float>(i) / rate);
  return times;
}

// Two joints of a skin under a plain node, and a node without motion. One animation "nod" of four
// keys at 30 per second: the hips (node 1) move and turn about x, the head (node 2) is at rest.
inline GltfParts small_gltf() {
  GltfParts parts;
  Json& json = parts.json;
  json["scene"] = 0;
  json["scenes"][0]["nodes"] = {0, 3};
  json["nodes"] =
      Json::array({{{"name", "Armature"}, {"children", Json::array({1})}},
                   {{"name", "Hips"}, {"children", Json::array({2})}, {"translation", {0, 1, 0}}},
                   {{"name", "Head"}, {"translation", {0, 0.5, 0}}},
                   {{"name", "Lamp"}}});
  json["skins"][0]["joints"] = {1, 2};
  json["animations"][0]["name"] = "nod";
  const size_t times = parts.add_bounded(key_times(4), "SCALAR", 1);
  std::vector<float> turns, positions;
  for (int i = 0; i < 4; ++i) {
    append(turns, axis_angle(Vec3d{1, 0, 0}, 0.2 * i).as<float>());
    append(positions, Vec3{0.1f * static_cast<float>(i), 1, 0});
  }
  parts.add_channel(0, 1, "rotation", "LINEAR", times, parts.add(turns, "VEC4", 4));
  parts.add_channel(0, 1, "translation", "LINEAR", times, parts.add(positions, "VEC3", 3));
  return parts;
}

}  // namespace panache::test
