// No file can hurt us: whatever is done to a good file, the answer is a message or clips that keep
// their promises and can be written again.

#include <functional>

#include "gltf_checks.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;

// A small file with a little of everything that is read: keys of each kind, whole numbers, a
// stride, a sparse accessor, a matrix, a humanoid, an expression, a skinned mesh.
GltfParts rich_gltf() {
  GltfParts parts = test::small_gltf();
  const size_t times = parts.add_bounded({0.5f, 1}, "SCALAR", 1);
  const std::vector<int16_t> turns = {0, 0, 0, 32767, 0, 32767, 0, 0};
  const size_t packed = parts.add(turns, "VEC4", 4);
  parts.json["accessors"][packed]["normalized"] = true;
  parts.json["bufferViews"].back()["byteStride"] = 8;
  parts.add_channel(1, 2, "rotation", "STEP", times, packed);
  const size_t cubic = parts.add(std::vector<float>(18, 0.25f), "VEC3", 3);
  parts.add_channel(1, 2, "translation", "CUBICSPLINE", times, cubic);
  const size_t scale = parts.add(std::vector<float>{1, 1, 1, 2, 2, 2}, "VEC3", 3);
  Json accessor = parts.json["accessors"][scale];
  const size_t indices = parts.add_view(std::string_view("\1\0", 2));
  accessor["sparse"]["count"] = 1;
  accessor["sparse"]["values"]["bufferView"] = accessor["bufferView"];
  accessor["sparse"]["indices"] = {{"bufferView", indices}, {"componentType", 5123}};
  accessor.erase("bufferView");
  parts.json["accessors"][scale] = accessor;
  parts.add_channel(1, 2, "scale", "LINEAR", times, scale);
  parts.add_channel(1, 3, "weights", "LINEAR", times, times);
  parts.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1};
  parts.json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"]["hips"]["node"] = 1;
  Json& vrma = parts.json["extensions"]["VRMC_vrm_animation"];
  vrma["humanoid"]["humanBones"]["hips"]["node"] = 1;
  vrma["expressions"]["preset"]["happy"]["node"] = 4;
  vrma["lookAt"]["node"] = 4;
  const size_t joints = parts.add(std::vector<uint16_t>{0, 1, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const size_t weights = parts.add(std::vector<float>{0.5f, 0.5f, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  parts.json["meshes"][0]["primitives"][0]["attributes"] = {{"JOINTS_0", joints},
                                                            {"WEIGHTS_0", weights}};
  parts.json["nodes"][3]["mesh"] = 0;
  parts.json["nodes"][3]["skin"] = 0;
  parts.json["nodes"].push_back({{"name", "happy"}});
  parts.add_channel(0, 4, "translation", "LINEAR", 0, 2);
  parts.json["extensions"]["VRM"]["humanoid"]["humanBones"].push_back(
      {{"bone", "head"}, {"node", 2}});
  return parts;
}

// Reads `bytes`; what is accepted keeps its promises, can be written in every way, and is accepted
// again. Returns whether it was.
bool check_harmless(const std::string& bytes) {
  auto file = parse_gltf(bytes, "walk.glb");
  if (!file) {
    expect_whole_message(file.error(), "walk.glb: ");
    return false;
  }
  const int clips = std::max<int>(static_cast<int>((*file)->clip_names().size()), 1);
  for (int i = 0; i < clips; ++i) EXPECT_EQ(broken_promise((*file)->clip(i)), "");

  const Clip& clip = (*file)->clip(clips - 1);
  // A clip of many frames is a clock gone wrong; writing it takes long and shows nothing more.
  if (clip.frames > 200) return true;
  Clip changed = clip;
  for (Quat& q : changed.rotations) q = Quat{q.w, -q.z, q.y, -q.x};
  for (Vec3& t : changed.translations) t = t * 0.5f;
  const std::vector<double> same = same_frames(clip.frames);
  const std::vector<double> still(same.size(), clip.frames / 3.0);
  const ClipEdit edits[] = {{clips - 1, &clip, same, "same"},
                            {clips - 1, &clip, still, "still"},
                            {clips - 1, &changed, same, "changed"}};
  const std::string replaced = (*file)->encode({&edits[2], 1}, EditMode::replace);
  for (const std::string& out : {(*file)->encode(edits, EditMode::add_beside), replaced}) {
    auto back = parse_gltf(out, "walk.glb");
    EXPECT_TRUE(back.ok()) << back.error().message;
  }
  return true;
}

TEST(GltfSafety, every_truncation_is_harmless) {
  for (const std::string& bytes :
       {test::to_glb(rich_gltf()), test::to_gltf_text(test::small_gltf())}) {
    ASSERT_TRUE(check_harmless(bytes));
    for (size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(check_harmless(bytes.substr(0, size))) << size;
    }
  }
}

// Under the sanitizers reading takes ten times as long, and a fuzz target tries such files, too.
#ifdef PANACHE_SANITIZED
constexpr size_t kByteStep = 7;
#else
constexpr size_t kByteStep = 1;
#endif

TEST(GltfSafety, every_changed_byte_is_harmless) {
  constexpr int kValues[] = {0, '9', 0xff};
  size_t accepted = 0, rejected = 0;
  const std::string bytes = test::to_glb(rich_gltf());
  for (size_t i = 0; i < bytes.size(); i += kByteStep) {
    for (const int value : {kValues[i % std::size(kValues)], -1}) {
      ++(check_harmless(with_byte(bytes, i, value)) ? accepted : rejected);
    }
  }
  // Both ways were taken, or this test says nothing.
  EXPECT_GT(accepted, 1000 / kByteStep);
  EXPECT_GT(rejected, 1000 / kByteStep);
}

// Calls `visit` with each value of `json`, the innermost first.
void for_each_value(Json& json, const std::function<void(Json&)>& visit) {
  if (json.is_structured()) {
    for (Json& item : json) for_each_value(item, visit);
  }
  visit(json);
}

TEST(GltfSafety, every_value_of_the_json_replaced_by_a_bad_one_is_harmless) {
  const Json bad[] = {0,
                      1,
                      -1,
                      0.5,
                      1e300,
                      -1e9,
                      4294967295u,
                      4294967296u,
                      18446744073709551615u,
                      "text",
                      nullptr,
                      true,
                      Json::array(),
                      Json::object(),
                      Json::array({0, 0}),
                      Json::array({-1e9, 1e9, 1e-30})};
  GltfParts parts = test::glb_parts(test::to_glb(rich_gltf()));
  int accepted = 0, rejected = 0;
  size_t first = 0;  // Half of the bad values for each, and the other half for its neighbours.
  for_each_value(parts.json, [&](Json& value) {
    const Json good = value;
    for (size_t i = first++ % 2; i < std::size(bad); i += 2) {
      value = bad[i];
      ++(check_harmless(test::glb_of(parts.json.dump(), parts.bin)) ? accepted : rejected);
    }
    value = good;
  });
  EXPECT_GT(accepted, 400);
  EXPECT_GT(rejected, 400);
}

TEST(GltfSafety, every_missing_member_and_item_is_harmless) {
  GltfParts parts = test::glb_parts(test::to_glb(rich_gltf()));
  for_each_value(parts.json, [&](Json& value) {
    const Json good = value;
    for (size_t i = 0; i < good.size() && good.is_structured(); ++i) {
      if (value.is_object()) {
        value.erase(std::next(good.items().begin(), static_cast<std::ptrdiff_t>(i)).key());
      } else {
        value.erase(i);
      }
      check_harmless(test::glb_of(parts.json.dump(), parts.bin));
      value = good;
    }
  });
}

TEST(GltfSafety, many_animations_of_one_name_take_no_time) {
  GltfParts parts = test::small_gltf();
  for (int i = 0; i < 9'998; ++i) parts.json["animations"].push_back({{"name", "nod"}, {"a", 0}});
  const auto file = must_read(parts);
  EXPECT_EQ(file->clip_names().back(), "nod (9999)");
}

}  // namespace
}  // namespace panache
