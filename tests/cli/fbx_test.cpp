// FBX files: as they are, and as GLB with the meshes that Assimp reads.

#include <array>
#include <csignal>

#include <nlohmann/json.hpp>

#include "cli/fbx_program_test.h"
#include "cli/node.h"
#include "cli/same_positions.h"
#include "clip/bvh.h"
#include "clip/make_gltf.h"

namespace panache::test {
namespace {

// Angles in the file have six decimals of a degree, places six of a unit; along a chain of seven
// joints of half a metre that adds up to less than this. Metres.
constexpr float kNear = 2e-5f;

class Fbx : public FbxProgramTest {
 protected:
  // The file brought to `name` and read again.
  std::unique_ptr<MotionFile> converted(const std::string& from, const std::string& name) {
    const Ran ran = must({"convert", from, "--force", "-o", name});
    EXPECT_EQ(ran.err, "");
    Result<std::unique_ptr<MotionFile>> file = read_motion(path(name));
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file ? *std::move(file) : nullptr;
  }
  // A walk goes through FBX, as `options` have it, to BVH and to GLB.
  void expect_kept(const FbxOptions& options) {
    const Clip walk = walking_clip(20);
    write("in.fbx", format_fbx(walk, options));
    for (const std::string name : {"out.bvh", "out.glb"}) {
      SCOPED_TRACE(name);
      const auto file = converted("in.fbx", name);
      ASSERT_TRUE(file);
      expect_same_positions(walk, file->clip(), kNear);
    }
  }
};

TEST_F(Fbx, a_walk_keeps_its_places_and_times_whatever_the_file_counts_in) {
  const std::pair<const char*, void (*)(FbxOptions&)> cases[] = {
      {"centimetres", [](FbxOptions&) {}},
      {"inches", [](FbxOptions& o) { o.centimetres = 2.54; }},
      {"metres", [](FbxOptions& o) { o.centimetres = 100; }},
      {"Z up", [](FbxOptions& o) { o.z_up = true; }},
      {"rotations before a joint's own",
       [](FbxOptions& o) {
         o.pre_rotation = normalized(Quat{0.3f, -0.5f, 0.2f, 0.7f});
       }},
      {"a first key that is late", [](FbxOptions& o) { o.first_key = 2.5; }},
  };
  for (const auto& [name, change] : cases) {
    SCOPED_TRACE(name);
    FbxOptions options;
    change(options);
    expect_kept(options);
  }
}

TEST_F(Fbx, only_what_moves_can_move) {
  const auto file = converted("walk.fbx", "out.glb");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), std::vector<std::string>{"Take 001"});
  for (const Joint& joint : file->clip().skeleton.joints) {
    // Roots may in any file.
    EXPECT_EQ(joint.can_translate, joint.name == "hips" || joint.parent < 0) << joint.name;
  }
}

#if defined(PANACHE_SECCOMP) && !defined(PANACHE_SANITIZED)  // Not under the sanitizers.
TEST_F(Fbx, the_process_that_reads_it_is_locked_before_it_answers) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_GT(::fcntl(ends[1], F_SETPIPE_SZ, 4096), 0);  // Less than the answer: it has to wait.
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::execl(PANACHE_PROGRAM, "panache", "--read-fbx-for-parent", path("walk.fbx").c_str(), nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string answer(1, '\0');
  EXPECT_EQ(::read(ends[0], answer.data(), 1), 1);
  EXPECT_EQ(answer, "+");
  const std::string status = "/proc/" + std::to_string(child) + "/status";
  EXPECT_NE(read_file(status)->find("\nSeccomp:\t2\n"), std::string::npos);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
}
#endif

TEST_F(Fbx, several_at_once_give_what_each_gives_alone) {
  for (const std::string name : {"a", "b", "c", "d", "e"}) {
    write("in/" + name + ".fbx", format_fbx(walking_clip(name[0] - 'a' + 5)));
  }
  must("convert in --to bvh --jobs 5 -o many");
  for (const std::string& name : entries("in")) {
    const std::string stem = name.substr(0, 1);
    ASSERT_TRUE(converted("in/" + name, "one.bvh"));
    EXPECT_TRUE(read("many/" + stem + ".bvh") == read("one.bvh")) << stem;
  }
}

TEST_F(Fbx, info_shows_it) {
  const Ran ran = must("info walk.fbx");
  EXPECT_TRUE(holds(ran.out, "  motion  Take 001  5 frames at 30 a second: 0.17 s\n"));
  EXPECT_TRUE(holds(ran.out, "  unit    1 m (metres, most likely), inferred from the legs\n"));
}

TEST_F(Fbx, stylize_gives_a_file_of_its_kind_or_a_glb_with_both_motions) {
  write("walk.fbx", format_fbx(walking_clip(40)));
  must("stylize walk.fbx --style old=1 -o out/");
  must("stylize walk.fbx --style old=1 -o out/walk.glb");
  EXPECT_EQ(entries("out"), (std::vector<std::string>{"walk.fbx", "walk.glb"}));
  const auto fbx = read_motion(path("out/walk.fbx")), glb = read_motion(path("out/walk.glb"));
  ASSERT_TRUE(fbx.ok()) << fbx.error().message;
  ASSERT_TRUE(glb.ok()) << glb.error().message;
  const std::vector<std::string> expected = {"Take 001 (old 1)", "Take 001"};
  EXPECT_EQ((*fbx)->clip_names(), expected);
  EXPECT_EQ((*glb)->clip_names(), expected);
  // Networks multiply rounding by about ten.
  expect_same_positions((*fbx)->clip(), (*glb)->clip(), 10 * kNear);
}

// Two walks, side by side, of joints with equal names.
Clip two_walks() {
  const Clip walk = walking_clip(40);
  Clip out;
  out.frame_time = walk.frame_time;
  const auto count = static_cast<int>(walk.joints());
  for (int figure = 0; figure < 2; ++figure) {
    for (Joint joint : walk.skeleton.joints) {
      if (joint.parent >= 0) joint.parent += figure * count;
      out.skeleton.joints.push_back(joint);
    }
  }
  out.resize(walk.frames);
  for (int f = 0; f < walk.frames; ++f) {
    for (size_t j = 0; j < out.joints(); ++j) {
      const size_t of = j % walk.joints();
      // The second is half a cycle late, or early.
      const int at = j < walk.joints() ? f : (f + 15) % walk.frames;
      out.pose(f).rotations[j] = walk.pose(at).rotations[of];
      out.pose(f).translations[j] = walk.pose(f).translations[of];
      if (j == walk.joints()) out.pose(f).translations[j].x += 1;
    }
  }
  return out;
}

// How far the joints of a name, of the first figure and of the second, are from where they were,
// along each axis by its weight.
std::pair<float, float> moved(const Clip& from, const Clip& to, const std::string& name,
                              Vec3 weights = {1, 1, 1}) {
  EXPECT_EQ(from.frames, to.frames);
  std::array<float, 2> max = {};
  std::vector<Quat> rotations(from.joints());
  std::vector<Vec3> before(from.joints()), after(from.joints());
  for (int f = 0; f < std::min(from.frames, to.frames); ++f) {
    world_pose(from.skeleton, from.pose(f), {rotations, before});
    world_pose(to.skeleton, to.pose(f), {rotations, after});
    for (size_t j = 0; j < from.joints(); ++j) {
      const std::string& called = from.skeleton.joints[j].name;
      if (called != name && called != name + " (2)") continue;
      float& of = max[called == name ? 0 : 1];
      const Vec3 by = after[j] - before[j];
      of = std::max(of, length(Vec3{by.x * weights.x, by.y * weights.y, by.z * weights.z}));
    }
  }
  return {max[0], max[1]};
}

TEST_F(Fbx, every_figure_is_styled_and_stays_where_it_was_though_names_are_equal) {
  write("made.fbx", format_fbx(two_walks()));
  write("other.fbx",
        *read_file(PANACHE_SOURCE_DIR "/tests/fixtures/fbx/two-figures-equal-names.fbx"));
  for (const std::string from : {"made.fbx", "other.fbx"}) {
    SCOPED_TRACE(from);
    must({"stylize", from, "--style", "old=1", "--force", "-o", "old.fbx"});
    must({"stylize", from, "--style", "old=1", "--force", "-o", "old.glb"});
    const auto in = read_motion(path(from)), out = read_motion(path("old.fbx")),
               glb = read_motion(path("old.glb"));
    ASSERT_TRUE(in.ok() && out.ok() && glb.ok());
    expect_same_positions((*out)->clip(), (*glb)->clip(), 10 * kNear);
    const auto hands = moved((*in)->clip(), (*out)->clip(), "leftHand");
    const auto hips = moved((*in)->clip(), (*out)->clip(), "hips", {1, 0, 0});
    // A style bends arms by centimetres; figures are a metre apart, sideways.
    EXPECT_GT(hands.first, 0.02f);
    EXPECT_GT(hands.second, 0.02f);
    EXPECT_LT(hips.first, 0.3f);
    EXPECT_LT(hips.second, 0.3f);
  }
}

TEST_F(Fbx, strength_0_and_convert_keep_every_byte) {
  write("walk.fbx", format_fbx(walking_clip(40)));
  must("stylize walk.fbx --style old=0 --replace -o same.fbx");
  EXPECT_TRUE(read("same.fbx") == read("walk.fbx"));
  must("convert walk.fbx -o copy.fbx");
  EXPECT_TRUE(read("copy.fbx") == read("walk.fbx"));
}

TEST_F(Fbx, other_formats_become_fbx_and_fbx_becomes_any) {
  const Clip walk = walking_clip(40);
  write("walk.bvh", format_bvh(walk));
  ASSERT_TRUE(converted("walk.bvh", "out.fbx"));
  const auto file = converted("out.fbx", "out.bvh");
  ASSERT_TRUE(file);
  expect_same_positions(walk, file->clip(), kNear);
  // A character in FBX gets a motion and stays FBX.
  must("retarget walk.bvh --onto walk.fbx -o on.fbx");
  const auto on = read_motion(path("on.fbx"));
  ASSERT_TRUE(on.ok()) << on.error().message;
  EXPECT_EQ((*on)->clip_names(), std::vector<std::string>{"walk"});
}

TEST_F(Fbx, a_damaged_file_gets_a_message) {
  write("bad.fbx", read("walk.fbx").substr(0, 5000));
  const Ran cut = run("info bad.fbx");
  EXPECT_EQ(cut.exit, 1) << cut.out;
  EXPECT_TRUE(begins(cut.err, "panache: bad.fbx:"));
  EXPECT_EQ(std::count(cut.err.begin(), cut.err.end(), '\n'), 1) << cut.err;
  write("bad.fbx", "no such thing");
  EXPECT_EQ(run("info bad.fbx").err,
            "panache: bad.fbx: does not begin as FBX files do; is it damaged?\n");
}

// A program of other people's reads a walk of ours and writes it as FBX, on its own axes and units,
// with a skin.
class FbxOfBlender : public Fbx {
 protected:
  void SetUp() override {
    Fbx::SetUp();
    if (IsSkipped()) return;
    if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "there is no blender";
    must("walker -o walk.bvh --seconds 2 --turn 20");
  }
  // Runs the script below and then these lines.
  void run_in_blender(const std::string& lines) {
    write("make.py", kScript + lines);
    const std::string command =
        "cd '" + path("") +
        "' && blender -b --factory-startup --python-exit-code 1 --python make.py >blender.log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << read("blender.log");
  }
  // `options` go to Blender's exporter.
  void expect_kept_by_blender(const std::string& options, float size = 1) {
    run_in_blender("export('walk.bvh', 'blender.fbx'" + options + ")\n");
    const auto walk = read_motion(path("walk.bvh"));
    ASSERT_TRUE(walk.ok());
    for (const std::string name : {"out.bvh", "out.glb"}) {
      SCOPED_TRACE(name);
      const auto file = converted("blender.fbx", name);
      ASSERT_TRUE(file);
      // Blender samples the motion in floats, some metres from the origin.
      expect_same_positions((*walk)->clip(), file->clip(), 1e-4f, 1 / size);
      // The skin tells the rest pose, so that the first frame is not taken for it.
      const Ran info = run({"info", name});
      EXPECT_TRUE(holds(info.out, "  start   the first frame is motion\n"));
    }
  }

  // Each joint has a triangle in each body, of which one corner is in the joint and two are 5 cm
  // from it: so it is in the axes of a joint that counts in metres.
  void expect_skins_sit_on_their_joints(float size = 1) {
    GltfParts glb = glb_parts(read("out.glb"));
    ASSERT_EQ(glb.json["meshes"].size(), 2u);
    ASSERT_EQ(glb.json["skins"].size(), 1u);
    const size_t matrices = glb.json["skins"][0]["inverseBindMatrices"];
    Json& columns = glb.json["accessors"][matrices];  // Four to a matrix.
    columns["count"] = 4 * columns["count"].get<size_t>();
    columns["type"] = "VEC4";
    const std::vector<float> binds = accessor_floats(glb, matrices);
    for (const Json& mesh : glb.json["meshes"]) {
      const Json& attributes = mesh["primitives"][0]["attributes"];
      const std::vector<float> points = accessor_floats(glb, attributes["POSITION"]);
      const std::string joints = accessor_bytes(glb, attributes["JOINTS_0"]);
      const size_t joint_bytes = joints.size() / (points.size() / 3);
      for (size_t i = 0; 3 * i < points.size(); ++i) {
        const auto joint = static_cast<unsigned char>(joints[i * joint_bytes]);
        const float* m = &binds[16u * joint];  // Column after column.
        const float* p = &points[3 * i];
        const auto row = [&](int r) {
          return m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
        };
        const float away = length(Vec3{row(0), row(1), row(2)});
        EXPECT_LE(std::min(away, std::abs(away - 0.05f * size)), 1e-5f) << i;
      }
    }
  }

  // Debian's Blender opens files in a way that its Python has given up.
  static constexpr const char* kScript = R"(
import bpy, builtins
plain = builtins.open
builtins.open = lambda f, mode='r', *rest, **named: plain(f, mode.replace('U', ''), *rest, **named)

def add_body(armature, place):
    mesh = bpy.data.meshes.new('Body')
    body = bpy.data.objects.new('Body', mesh)
    bpy.context.collection.objects.link(body)
    body.location = place
    bones = list(armature.data.bones)
    corners = [(0, 0, 0), (.05, 0, 0), (0, .05, 0)]
    heads = [armature.matrix_world @ bone.head_local for bone in bones]
    mesh.from_pydata([tuple(h[k] + c[k] - place[k] for k in range(3))
                      for h in heads for c in corners], [],
                     [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(bones))])
    for i, bone in enumerate(bones):
        body.vertex_groups.new(name=bone.name).add([3 * i, 3 * i + 1, 3 * i + 2], 1, 'REPLACE')
    body.parent = armature
    body.matrix_parent_inverse = armature.matrix_world.inverted()
    body.modifiers.new('Armature', 'ARMATURE').object = armature
    return body

def two_bodies(armature):
    for place in ((0, 0, 0), (1, 2, 3)):
        add_body(armature, place)

def half_as_large(armature):
    two_bodies(armature)
    armature.scale = (0.5, 0.5, 0.5)

def export(bvh, fbx, bodies=two_bodies, **options):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_anim.bvh(filepath=bvh, update_scene_fps=True, update_scene_duration=True)
    armature = bpy.context.object
    bodies(armature)
    bpy.ops.export_scene.fbx(filepath=fbx, add_leaf_bones=False, bake_anim_simplify_factor=0,
                             **options)

)";
};

TEST_F(FbxOfBlender, a_skinned_walk_keeps_its_places) {
  expect_kept_by_blender("");
  expect_skins_sit_on_their_joints();
}

TEST_F(FbxOfBlender, the_scale_of_a_node_goes_into_the_places_below_it) {
  expect_kept_by_blender(", half_as_large", 0.5f);
  expect_skins_sit_on_their_joints(0.5f);
}

// Weights that sum to anything, of up to six joints, and a material.
TEST_F(FbxOfBlender, the_validator_finds_no_error_in_a_smooth_skin) {
  run_in_blender(R"(
def smooth(armature):
    body = add_body(armature, (0, 0, 0))
    groups = list(body.vertex_groups)
    for v in body.data.vertices:
        for k in range(6):
            groups[(v.index + 5 * k) % len(groups)].add([v.index], 0.3 / (1 + k), 'REPLACE')
    for group in groups:
        group.remove([len(body.data.vertices) - 1])
    material = bpy.data.materials.new('Skin')
    material.use_nodes = True
    body.data.materials.append(material)
export('walk.bvh', 'smooth.fbx', smooth)
)");
  ASSERT_TRUE(converted("smooth.fbx", "out.glb"));
  const GltfParts glb = glb_parts(read("out.glb"));
  const std::string used = glb.json.value("extensionsUsed", Json::array()).dump();
  EXPECT_FALSE(holds(used, "SpecularGlossiness"));
  for (const Json& node : glb.json["nodes"]) {
    EXPECT_FALSE(node.contains("matrix")) << node.dump();
    for (const Json& scale : node.value("scale", Json::array())) EXPECT_EQ(scale, 1.0f);
  }
  ASSERT_EQ(glb.json["meshes"].size(), 1u);
  const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_FALSE(attributes.contains("WEIGHTS_1"));
  const std::vector<float> weights = accessor_floats(glb, attributes["WEIGHTS_0"]);
  ASSERT_GT(weights.size(), 200u);
  for (size_t i = 0; i < weights.size(); i += 4) {
    EXPECT_NEAR(weights[i] + weights[i + 1] + weights[i + 2] + weights[i + 3], 1, 1e-6f) << i;
  }
  expect_valid_gltf(*this, "out.glb");
}

TEST_F(FbxOfBlender, a_skinned_walk_with_other_axes_and_units_keeps_its_places) {
  expect_kept_by_blender(", axis_up='Z', axis_forward='Y', apply_scale_options='FBX_SCALE_ALL'");
}

}  // namespace
}  // namespace panache::test
