// Characters whose hips deform no mesh: what hangs on the hips, as a node or a mesh, stays with the
// thighs wherever the body goes.

#include <functional>

#include "cli/program.h"
#include "clip/make_character.h"
#include "clip/rescale.h"

namespace panache::test {
namespace {

// The character with a skin whose legs weigh what they do in others: the boxes of the fingers, more
// than half of all, follow the thighs.
GltfParts with_heavy_legs(const CharacterOptions& options) {
  GltfParts parts = character(options);
  for (Json& joint : parts.json["skins"][0]["joints"]) {
    const std::string name = parts.json["nodes"][joint.get<size_t>()]["name"];
    const size_t hand = name.find("Hand");
    if (hand == std::string::npos || hand + 4 == name.size()) continue;
    joint = node_called(parts, name.substr(0, hand) + "UpLeg");
  }
  return parts;
}

// Takes a joint out of the skin; what followed it follows the one after it.
void leave_out(GltfParts& parts, const std::string& name) {
  Json& joints = parts.json["skins"][0]["joints"];
  for (size_t i = 0; i + 1 < joints.size(); ++i) {
    if (joints[i] == node_called(parts, name)) joints[i] = joints[i + 1];
  }
}

// Hangs a mesh on a joint, half a hand before it.
void hang(GltfParts& parts, const std::string& name, const std::string& on) {
  Json& nodes = parts.json["nodes"];
  nodes[node_called(parts, on)]["children"].push_back(nodes.size());
  nodes.push_back({{"name", name}, {"mesh", 1}, {"translation", {0, 0.02, 0.1}}});
}

// Puts a node between a joint and these children of it.
void group(GltfParts& parts, const std::string& name, const std::string& on,
           const std::vector<std::string>& children) {
  Json& nodes = parts.json["nodes"];
  const size_t above = node_called(parts, on), own = nodes.size();
  Json left = Json::array({own}), moved = Json::array();
  for (const Json& child : nodes[above]["children"]) {
    const std::string child_name = nodes[child.get<size_t>()]["name"];
    const bool is_moved = std::find(children.begin(), children.end(), child_name) != children.end();
    (is_moved ? moved : left).push_back(child);
  }
  nodes[above]["children"] = left;
  nodes.push_back({{"name", name}, {"children", moved}});
}

// Gives the animation of the hips' places to the node above them.
void move_by_the_root(GltfParts& parts) {
  const size_t hips = node_called(parts, "Hips"), root = node_called(parts, "Armature");
  edit_keys(parts, hips, "translation", [&](float* position, size_t) { position[1] -= 0.95f; });
  for (Json& channel : parts.json["animations"][0]["channels"]) {
    Json& target = channel["target"];
    if (target["node"] == hips && target["path"] == "translation") target["node"] = root;
  }
}

// What is done beside leaving the hips out of the skin.
struct Variant {
  const char* name;
  std::function<void(GltfParts&)> rewrite;
  bool centimetres = false;
};

const Variant kVariants[] = {
    {"hips", [](GltfParts&) {}},
    {"hips in centimetres", [](GltfParts&) {}, true},
    {"hips and spine", [](GltfParts& p) { leave_out(p, "Spine"); }},
    {"hips above a group",
     [](GltfParts& p) {
       group(p, "Legs", "Hips", {"LeftUpLeg", "RightUpLeg"});
     }},
    {"hips above three groups",
     [](GltfParts& p) {
       group(p, "Left", "Hips", {"LeftUpLeg"});
       group(p, "Right", "Hips", {"RightUpLeg"});
       group(p, "Up", "Hips", {"Spine"});
     }},
    {"hips that a root moves", move_by_the_root},
    {"mirrored hips",
     [](GltfParts& p) {
       rescale(p, "Hips", {-1, 1, 1});
     }},
};

class HipsBesideTheSkin : public ProgramTest {
 protected:
  // In the last animation of the file the hips go more than 1 m, and they and what hangs on them
  // are as far from the thighs as at rest.
  void expect_together(const std::string& file, const std::string& what) {
    const GltfParts parts = glb_parts(read(file));
    const Json& animations = parts.json["animations"];
    const Json& sampler = animations.back()["samplers"].back();
    const size_t keys =
        parts.json["accessors"][sampler["input"].get<size_t>()]["count"].get<size_t>();
    ASSERT_GT(keys, 10u) << what;
    const MatrixPositions now(parts, animations.size() - 1);
    GltfParts resting = parts;
    resting.json["animations"] = Json::array({Json{{"channels", Json::array()}}});
    const MatrixPositions rest(resting, 0);
    const size_t hips = node_called(parts, "Hips");
    double worst = 0;
    for (size_t f = 0; f < keys; ++f) {
      for (const char* fixed : {"Hips", "Belt", "LeftUpLeg", "RightUpLeg", "Spine"}) {
        for (const char* leg : {"LeftUpLeg", "RightUpLeg"}) {
          const size_t a = node_called(parts, fixed), b = node_called(parts, leg);
          const double before = length(rest.position(a, 0) - rest.position(b, 0));
          worst =
              std::max(worst, std::abs(length(now.position(a, f) - now.position(b, f)) - before));
        }
      }
    }
    std::printf("%s: %.6f m\n", what.c_str(), worst);
    // Places within 2.5 m, at the end of 3 joints.
    EXPECT_LT(worst, 2.5 * 3 * 4 * 0x1p-23) << what;
    EXPECT_GT(length(now.position(hips, keys - 1) - now.position(hips, 0)), 1.0) << what;
  }
};

TEST_F(HipsBesideTheSkin, they_stay_with_the_thighs) {
  write_walk("walk.bvh", 60);
  for (const Variant& variant : kVariants) {
    GltfParts parts = with_heavy_legs({.centimetres = variant.centimetres});
    parts.json["animations"].erase(1);
    hang(parts, "Belt", "Hips");
    leave_out(parts, "Hips");
    variant.rewrite(parts);
    write("hero.glb", to_glb(parts));
    expect_together("hero.glb", std::string(variant.name));
    must("stylize hero.glb --style old=1 --clip Walk --force -o old.glb");
    expect_together("old.glb", std::string(variant.name) + ", styled");
    must("retarget walk.bvh --onto hero.glb --force -o walk.glb");
    expect_together("walk.glb", std::string(variant.name) + ", retargeted");
    // As to a character that has no motion of its own.
    parts.json.erase("animations");
    write("still.glb", to_glb(parts));
    must("retarget walk.bvh --onto still.glb --force -o walk.glb");
    expect_together("walk.glb", std::string(variant.name) + ", retargeted without motion");
  }
}

}  // namespace
}  // namespace panache::test
