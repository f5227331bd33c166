// What an animator gets back: a character with its textures, the result first.

#include <array>
#include <map>

#include "cli/fbx_program_test.h"
#include "clip/gltf.h"
#include "clip/make_character.h"
#include "clip/motion_file.h"

namespace panache::test {
namespace {

using Names = std::vector<std::string>;

// Little-endian.
std::string number(size_t value, size_t bytes) {
  std::string out;
  for (size_t i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
  return out;
}
std::string big_endian(size_t value, size_t bytes) {
  std::string out = number(value, bytes);
  std::reverse(out.begin(), out.end());
  return out;
}

// Pictures of 2 x 2 pixels, all red.
std::string red_tga() {
  std::string out = number(2 << 16, 3) + std::string(9, '\0') + number(2, 2) + number(2, 2) +
                    number(24, 1) + number(0, 1);
  for (int i = 0; i < 4; ++i) out += std::string("\0\0\xff", 3);
  return out;
}
std::string red_bmp() {
  std::string out = "BM" + number(54 + 16, 4) + number(0, 4) + number(54, 4) + number(40, 4) +
                    number(2, 4) + number(2, 4) + number(1, 2) + number(24, 2) +
                    std::string(24, '\0');
  for (int row = 0; row < 2; ++row) out += std::string("\0\0\xff\0\0\xff\0\0", 8);
  return out;
}
std::string red_psd() {
  std::string out = "8BPS" + big_endian(1, 2) + std::string(6, '\0') + big_endian(3, 2) +
                    big_endian(2, 4) + big_endian(2, 4) + big_endian(8, 2) + big_endian(3, 2) +
                    std::string(12, '\0') + big_endian(0, 2);
  return out + std::string(4, '\xff') + std::string(8, '\0');
}

// A walk with a square whose black material has the picture at `texture` for its colour, or inside
// of the file where `content` is not empty.
std::string textured_fbx(const std::string& texture, const std::string& content = "") {
  std::string text = format_fbx(walking_clip(5));
  const auto insert_before = [&](const std::string& end, const std::string& what) {
    text.insert(text.find(end), what);
  };
  std::string inside;
  if (!content.empty()) inside = "\t\tContent: , \"" + to_base64(content) + "\"\n";
  insert_before("}\nConnections:",
                "\tGeometry: 501, \"Geometry::Skin\", \"Mesh\" {\n"
                "\t\tVertices: *12 {\n\t\t\ta: 0,0,0,1,0,0,1,1,0,0,1,0\n\t\t}\n"
                "\t\tPolygonVertexIndex: *4 {\n\t\t\ta: 0,1,2,-4\n\t\t}\n"
                "\t\tLayerElementUV: 0 {\n\t\t\tMappingInformationType: \"ByPolygonVertex\"\n"
                "\t\t\tReferenceInformationType: \"Direct\"\n"
                "\t\t\tUV: *8 {\n\t\t\t\ta: 0,0,1,0,1,1,0,1\n\t\t\t}\n\t\t}\n"
                "\t\tLayerElementMaterial: 0 {\n\t\t\tMappingInformationType: \"AllSame\"\n"
                "\t\t\tReferenceInformationType: \"IndexToDirect\"\n"
                "\t\t\tMaterials: *1 {\n\t\t\t\ta: 0\n\t\t\t}\n\t\t}\n"
                "\t\tLayer: 0 {\n\t\t\tLayerElement:  {\n\t\t\t\tType: \"LayerElementUV\"\n"
                "\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t\tLayerElement:  {\n"
                "\t\t\t\tType: \"LayerElementMaterial\"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n"
                "\t}\n"
                "\tModel: 502, \"Model::Skin\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
                "\tMaterial: 503, \"Material::Black\", \"\" {\n\t\tShadingModel: \"phong\"\n"
                "\t\tProperties70:  {\n"
                "\t\t\tP: \"DiffuseColor\", \"Color\", \"\", \"A\",0,0,0\n\t\t}\n\t}\n"
                "\tVideo: 504, \"Video::Red\", \"Clip\" {\n\t\tType: \"Clip\"\n"
                "\t\tFileName: \"" +
                    texture + "\"\n\t\tRelativeFilename: \"" + texture + "\"\n" + inside +
                    "\t}\n"
                    "\tTexture: 505, \"Texture::Red\", \"\" {\n\t\tType: \"TextureVideoClip\"\n"
                    "\t\tFileName: \"" +
                    texture + "\"\n\t\tRelativeFilename: \"" + texture + "\"\n\t}\n");
  text.insert(text.rfind("}\n"),
              "\tC: \"OO\",502,0\n\tC: \"OO\",501,502\n\tC: \"OO\",503,502\n"
              "\tC: \"OO\",504,505\n\tC: \"OP\",505,503, \"DiffuseColor\"\n");
  return text;
}

class Character : public FbxProgramTest {
 protected:
  Json json_of(const std::string& name) const { return glb_parts(read(name)).json; }
  Names clips_of(const std::string& name) const {
    const auto file = read_motion(path(name));
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file ? (*file)->clip_names() : Names{};
  }
};

TEST_F(Character, every_glb_has_a_skin_over_all_joints) {
  write_walk("walk.bvh");
  must("convert walk.bvh -o walk.vrma");
  must("convert walk.bvh -o walk.npz");
  for (const std::string from : {"walk.fbx", "walk.bvh", "walk.vrma", "walk.npz"}) {
    for (const bool has_body : {true, false}) {
      SCOPED_TRACE(from + (has_body ? " with a body" : " without"));
      std::vector<std::string> command = {"convert", from, "--force", "-o", "out.glb"};
      if (!has_body) command.emplace_back("--no-body");
      must(command);
      const Json json = json_of("out.glb");
      ASSERT_EQ(json["skins"].size(), 1u);
      ASSERT_EQ(json["meshes"].size(), 1u);
      EXPECT_EQ(json["meshes"][0]["name"], has_body ? "body" : "sticks");
      // All but the scene's root and the mesh, which no animation moves.
      const size_t joints = json["skins"][0]["joints"].size(), nodes = json["nodes"].size();
      EXPECT_GE(joints + 3, nodes);
      for (const Json& channel : json["animations"][0]["channels"]) {
        const Json& all = json["skins"][0]["joints"];
        EXPECT_NE(std::find(all.begin(), all.end(), channel["target"]["node"]), all.end());
      }
    }
  }
}

TEST_F(Character, a_styled_fbx_of_joints_alone_is_one_too) {
  write("walk.fbx", format_fbx(walking_clip(40)));
  must("stylize walk.fbx --style old=1 -o old.glb");
  must("retarget walk.fbx --onto walk.fbx -o again.glb");
  for (const char* name : {"old.glb", "again.glb"}) {
    EXPECT_EQ(json_of(name)["skins"].size(), 1u) << name;
  }
  EXPECT_EQ(json_of("old.glb")["meshes"][0]["name"], "body");
}

TEST_F(Character, a_texture_takes_the_place_of_the_colour_and_becomes_png) {
  const std::map<std::string, std::string> pictures = {
      {"red.tga", red_tga()}, {"red.bmp", red_bmp()}, {"red.psd", red_psd()}};
  for (const auto& [name, bytes] : pictures) {
    for (const bool is_inside : {false, true}) {
      SCOPED_TRACE(name + (is_inside ? " inside" : " beside"));
      write("tex/" + name, bytes);
      write("hero.fbx", textured_fbx("C:\\\\art\\\\tex\\\\" + name, is_inside ? bytes : ""));
      const Ran ran = must("convert hero.fbx --force -o hero.glb");
      EXPECT_FALSE(holds(ran.err, "texture"));
      const GltfParts parts = glb_parts(read("hero.glb"));
      ASSERT_EQ(parts.json["images"].size(), 1u);
      EXPECT_EQ(parts.json["images"][0]["mimeType"], "image/png");
      const Json& view =
          parts.json["bufferViews"][parts.json["images"][0]["bufferView"].get<size_t>()];
      EXPECT_EQ(parts.bin.substr(view["byteOffset"].get<size_t>(), 4), "\x89PNG");
      const Json& colour = parts.json["materials"][0]["pbrMetallicRoughness"];
      ASSERT_TRUE(colour.contains("baseColorTexture"));
      if (colour.contains("baseColorFactor")) {
        EXPECT_EQ(colour["baseColorFactor"], (std::vector<double>{1, 1, 1, 1}));
      }
    }
  }
}

TEST_F(Character, a_missing_texture_is_a_line_with_its_path) {
  for (const auto& [name, bytes] :
       std::map<std::string, std::string>{{"lost.png", ""}, {"odd.dds", "DDS and what follows"}}) {
    if (!bytes.empty()) write(name, bytes);
    write("hero.fbx", textured_fbx(name));
    const Ran ran = must("convert hero.fbx --force -o hero.glb");
    EXPECT_TRUE(holds(ran.err, "panache: hero.fbx: texture '" + name + "'"));
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    const Json json = json_of("hero.glb");
    EXPECT_FALSE(json.contains("images") || json.contains("textures"));
    EXPECT_FALSE(json["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
  }
}

TEST_F(Character, what_is_styled_comes_first) {
  write("hero.glb", to_glb(character()));
  must("stylize hero.glb --clip Walk --style old=1 -o old.glb");
  EXPECT_EQ(clips_of("old.glb"), (Names{"Walk (old 1)", "Walk", "Wave"}));
  must("stylize hero.glb --clip Walk --style old=1 --last -o last.glb");
  EXPECT_EQ(clips_of("last.glb"), (Names{"Walk", "Wave", "Walk (old 1)"}));
}

// The character's walk with more animations of one joint, which stand before it.
std::string with_poses(const std::map<std::string, std::vector<float>>& poses) {
  GltfParts parts = character();
  Json animations = Json::array();
  for (const auto& [name, times] : poses) {
    const size_t number = parts.json["animations"].size();
    std::vector<float> turns;
    for (size_t k = 0; k < times.size(); ++k) {
      const Quat turn = axis_angle(Vec3{0, 1, 0}, 0.1f * static_cast<float>(k + 1));
      turns.insert(turns.end(), {turn.x, turn.y, turn.z, turn.w});
    }
    const size_t at = parts.add_bounded(times, "SCALAR", 1);
    parts.json["animations"].push_back({{"name", name}});
    parts.add_channel(number, 1, "rotation", "LINEAR", at, parts.add(turns, "VEC4", 4));
    animations.push_back(parts.json["animations"].back());
  }
  animations.push_back(parts.json["animations"][0]);
  parts.json["animations"] = std::move(animations);
  return to_glb(parts);
}

TEST_F(Character, poses_are_passed_over_with_a_note) {
  write("hero.glb", with_poses({{"Armature|T-Pose", {0, 0.1f, 0.2f}},
                                {"Rest", {0, 0.1f, 0.2f}},
                                {"first pose", {0, 0.1f, 0.2f}},
                                {"one", {0}}}));
  const Ran ran = must("stylize hero.glb --style old=1 -o old.glb");
  EXPECT_EQ(ran.err,
            "panache: hero.glb: 'Armature|T-Pose', 'Rest' and 'one' are poses, not motions, and "
            "are passed over; --clip NAME takes one all the same\n"
            "panache: hero.glb: the animation has keys for lower joints of the body alone, to lie "
            "over another: joints without keys get none\n");
  EXPECT_EQ(clips_of("old.glb"), (Names{"first pose (old 1)", "Walk (old 1)", "Armature|T-Pose",
                                        "Rest", "first pose", "one", "Walk"}));
  must("stylize hero.glb --clip Rest --style old=1 -o rest.glb");
  EXPECT_EQ(clips_of("rest.glb")[0], "Rest (old 1)");
}

TEST_F(Character, a_folder_gets_the_format_that_is_asked_for) {
  write_walk("in/a.bvh");
  write("in/b.fbx", format_fbx(walking_clip(40)));
  must("stylize in --style old=1 --to glb -o glb");
  EXPECT_EQ(entries("glb"), (Names{"a.glb", "b.glb"}));
  must("stylize in --style old=1 --to bvh -o bvh");
  EXPECT_EQ(entries("bvh"), (Names{"a.bvh", "b.bvh"}));
  const Ran other = run("stylize in/a.bvh --style old=1 --to glb -o a.bvh");
  EXPECT_EQ(other.exit, 2);
  EXPECT_EQ(other.err, "panache: --to glb: a.bvh has another format\n");
}

// Where the hips of a file's first motion are in the first and in the last frame.
std::pair<Vec3, Vec3> hips_of(const std::string& file) {
  const auto motion = read_motion(file);
  EXPECT_TRUE(motion.ok()) << motion.error().message;
  const Clip& clip = (*motion)->clip();
  const auto hips = static_cast<size_t>(
      std::ranges::find_if(clip.skeleton.joints,
                           [](const Joint& j) { return j.name == "hips" || j.name == "Hips"; }) -
      clip.skeleton.joints.begin());
  std::pair<Vec3, Vec3> out;
  for (const bool last : {false, true}) {
    (last ? out.second : out.first) = world_positions(clip, last ? clip.frames - 1 : 0)[hips];
  }
  return out;
}

TEST_F(Character, a_motion_in_place_keeps_its_height_and_loses_its_path) {
  write_walk("walk.bvh");
  FbxOptions z_up;
  z_up.z_up = true;
  write("z.fbx", format_fbx(walking_clip(40), z_up));
  write("hero.glb", to_glb(character()));
  const std::pair<std::string, Words> commands[] = {
      {"a.bvh", "convert walk.bvh"},
      {"b.glb", "convert walk.bvh"},
      {"c.glb", "convert z.fbx"},
      {"d.bvh", "stylize walk.bvh --style old=1"},
      {"e.glb", "stylize z.fbx --style old=1"},
      {"f.glb", "retarget walk.bvh --onto hero.glb"},
      {"g.glb", "convert walk.bvh --onto hero.glb"},
  };
  for (const auto& [out, command] : commands) {
    SCOPED_TRACE(out);
    must(command + Words{"-o", "moves-" + out});
    must(command + Words{"--in-place", "-o", out});
    const auto [moving_start, moving_end] = hips_of(path("moves-" + out));
    const auto [start, end] = hips_of(path(out));
    EXPECT_GT(length(moving_end - moving_start), 0.5f);  // It walks at 1.2 m/s.
    // BVH has six decimals; the others round floats below 2 m.
    EXPECT_NEAR(end.x, start.x, 2e-5f);
    EXPECT_NEAR(end.z, start.z, 2e-5f);
    EXPECT_NEAR(end.y, moving_end.y, 2e-5f);
  }
}

TEST_F(Character, feet_that_hang_on_the_root_follow_the_shins_with_a_note) {
  Clip clip = walking_clip(5);
  for (const HumanJoint foot : {HumanJoint::left_foot, HumanJoint::right_foot}) {
    clip.skeleton.joints[static_cast<size_t>(index(foot))].parent = 0;
  }
  for (const HumanJoint knee : {HumanJoint::left_lower_leg, HumanJoint::right_lower_leg}) {
    clip.skeleton.joints[static_cast<size_t>(index(knee))].offset = {0, 0, 0};
  }
  write("ik.bvh", format_bvh(clip));
  const Ran ran = must("stylize ik.bvh --style old=1 -o out.bvh");
  EXPECT_TRUE(holds(ran.err, "the left foot 'leftFoot' is not below the shin 'leftLowerLeg'"));
}

}  // namespace
}  // namespace panache::test
