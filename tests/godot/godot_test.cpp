// The extension for Godot, loaded as the engine loads it, in a host that plays the engine. Its
// poses are compared with the library's own steps.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <panache/panache.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <tuple>
#include <variant>

#include "host.h"
#include "walker/walker.h"

namespace panache::godot {
namespace {

const char* const kModel = "res://panache-int8.safetensors";

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The joint of a bone.
size_t joint_of(const Clip& walk, size_t bone) {
  for (size_t j = 0; j < walk.joints(); ++j) {
    if (walk.skeleton.joints[j].name == host.bones[bone].name) return j;
  }
  return 0;
}

class Godot : public testing::Test {
 protected:
  static Clip walk_;
  static void SetUpTestSuite() {
    WalkClipOptions options;
    options.seconds = 4;
    walk_ = walk_clip(*WalkerModel::load(PANACHE_SOURCE_DIR "/models/walker.safetensors"), options);
  }

  void SetUp() override {
    host = Host();
    library_ = dlopen(PANACHE_GODOT_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    ASSERT_TRUE(library_) << dlerror();
    const auto enter = reinterpret_cast<Flag (*)(GetFunction, void*, Initialization*)>(
        dlsym(library_, "panache_godot_init"));
    ASSERT_TRUE(enter);
    ASSERT_TRUE(enter(get_function, this, &extension_));
    for (int32_t level = 0; level < 4; ++level) extension_.initialize(extension_.user, level);
    host.files[kModel] = read(PANACHE_SOURCE_DIR "/models/panache-int8.safetensors");
    for (const Joint& joint : walk_.skeleton.joints) {
      host.bones.push_back(
          {joint.name,
           joint.parent,
           {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {joint.offset.x, joint.offset.y, joint.offset.z}}});
    }
  }
  void TearDown() override {
    for (int32_t level = 3; level >= 0; --level) extension_.deinitialize(extension_.user, level);
    EXPECT_EQ(host.type_name, "");
    EXPECT_EQ(host.live, 0) << "of the engine's values are not destroyed";
    dlclose(library_);
  }

  // A frame of the walk, whose root motion carries the skeleton's node over the ground.
  static void animate(int frame) {
    const ConstPose pose = std::as_const(walk_).pose(frame);
    for (size_t j = 0; j < host.bones.size(); ++j) {
      const Quat q = pose.rotations[joint_of(walk_, j)];
      const Vec3 p = pose.translations[joint_of(walk_, j)];
      host.bones[j].rotation = {q.x, q.y, q.z, q.w};
      host.bones[j].position = {p.x, p.y, p.z};
    }
    Bone& hips = *std::find_if(host.bones.begin(), host.bones.end(),
                               [](const Bone& bone) { return bone.name == "hips"; });
    host.at.origin = {hips.position.x, 3.5f, hips.position.z};
    hips.position.x = hips.position.z = 0;
  }
  // A node with the model, and with these properties set before it, as in a scene file.
  using Value = std::variant<double, bool, std::string>;
  static void* node_with(const std::vector<std::pair<const char*, Value>>& values) {
    void* node = host.make_node();
    for (const auto& [name, value] : values) {
      const bool is_set =
          std::visit([&, &name = name](const auto& v) { return host.set(node, name, v); }, value);
      EXPECT_TRUE(is_set) << name;
    }
    EXPECT_TRUE(host.set(node, "model_path", std::string(kModel)));
    return node;
  }
  static void play(void* node, int begin, int end) {
    for (int f = begin; f < end; ++f) {
      animate(f);
      host.process(node);
    }
  }
  void* library_ = nullptr;
  Initialization extension_{};
};
Clip Godot::walk_;

// The library itself, on the same joints in the walk's order below a joint for the node.
class Reference {
 public:
  explicit Reference(const Clip& walk, bool style_root = false, float strength = 1) : walk_(walk) {
    std::vector<panache_joint> joints = {{"", -1, {0, 0, 0, 1}, {0, 0, 0}}};
    for (const Joint& joint : walk.skeleton.joints) {
      joints.push_back({joint.name.c_str(),
                        joint.parent + 1,
                        {0, 0, 0, 1},
                        {joint.offset.x, joint.offset.y, joint.offset.z}});
    }
    const std::string bytes = host.files[kModel];
    EXPECT_EQ(panache_model_create(bytes.data(), bytes.size(), &model_), PANACHE_OK);
    EXPECT_EQ(panache_skeleton_create(joints.data(), static_cast<int32_t>(joints.size()), nullptr,
                                      &skeleton_),
              PANACHE_OK)
        << panache_last_error();
    panache_character_options options = PANACHE_CHARACTER_OPTIONS;
    options.style_root = style_root;
    EXPECT_EQ(panache_character_create(model_, skeleton_, &options, &character_), PANACHE_OK);
    panache_character_set_strength(character_, panache_model_find_style(model_, "old"), strength);
    rotations_.resize(4 * joints.size());
    translations_.resize(3 * joints.size());
  }
  ~Reference() {
    panache_character_destroy(character_);
    panache_skeleton_destroy(skeleton_);
    panache_model_destroy(model_);
  }
  void step(int frame, double seconds) {
    const ConstPose pose = walk_.pose(frame);
    rotations_ = {0, 0, 0, 1};
    translations_ = {pose.translations[0].x, 0, pose.translations[0].z};
    for (size_t j = 0; j < walk_.joints(); ++j) {
      const Quat q = pose.rotations[j];
      const Vec3 p = j ? pose.translations[j] : Vec3{0, pose.translations[0].y, 0};
      rotations_.insert(rotations_.end(), {q.x, q.y, q.z, q.w});
      translations_.insert(translations_.end(), {p.x, p.y, p.z});
    }
    panache_character_step(character_, {rotations_.data(), translations_.data()}, seconds,
                           {rotations_.data(), translations_.data()});
  }
  void reset() { panache_character_reset(character_); }
  void set_side(float side) {
    panache_character_set_side(character_, panache_model_find_style(model_, "old"), side);
  }
  void set_person(uint32_t seed, float amount = 1) {
    EXPECT_EQ(panache_character_set_person(character_, seed, amount), PANACHE_OK)
        << panache_last_error();
  }
  void set_energy(float energy) {
    panache_shape shape = PANACHE_SHAPE;
    shape.energy = energy;
    panache_character_set_shape(character_, &shape);
  }
  // Largest difference to the host's bones.
  float apart() const {
    float max = 0;
    for (size_t b = 0; b < host.bones.size(); ++b) {
      const size_t j = joint_of(walk_, b) + 1;
      const Bone& bone = host.bones[b];
      const float there[] = {bone.rotation.x, bone.rotation.y, bone.rotation.z, bone.rotation.w,
                             bone.position.x, bone.position.y, bone.position.z};
      for (size_t i = 0; i < 4; ++i)
        max = std::max(max, std::abs(there[i] - rotations_[4 * j + i]));
      for (size_t i = 0; i < 3; ++i)
        max = std::max(max, std::abs(there[4 + i] - translations_[3 * j + i]));
    }
    return max;
  }

 private:
  const Clip& walk_;
  panache_model* model_ = nullptr;
  panache_skeleton* skeleton_ = nullptr;
  panache_character* character_ = nullptr;
  std::vector<float> rotations_, translations_;
};

// The node has the library's pose in every frame, while `change` changes both alike before some;
// returns how far that is from the pose of `plain`, at most. Frees the node.
float follow(const Clip& walk, void* node, Reference& reference, Reference& plain, int frames,
             const std::function<void(int)>& change, void (*animate)(int)) {
  float max = 0;
  for (int f = 0; f < frames; ++f) {
    change(f);
    animate(f % walk.frames);
    host.process(node);
    reference.step(f % walk.frames, host.seconds);
    plain.step(f % walk.frames, host.seconds);
    EXPECT_EQ(reference.apart(), 0) << "frame " << f;
    if (reference.apart() != 0) break;
    max = std::max(max, plain.apart());
  }
  EXPECT_TRUE(host.errors.empty()) << host.errors.front();
  host.free_node(node);
  return max;
}

TEST_F(Godot, a_styled_walk_has_the_bits_of_the_library) {
  for (const bool style_root : {false, true}) {
    // Styles may come before the model.
    void* node = node_with({{"styles/old", 1.0}, {"style_root", style_root}});
    Reference reference(walk_, style_root), none(walk_, style_root, 0);
    EXPECT_GT(follow(
                  walk_, node, reference, none, walk_.frames, [](int) {}, animate),
              0.01f);
    EXPECT_GT(host.writes, walk_.frames);
  }
}

TEST_F(Godot, the_side_of_a_style_is_the_librarys) {
  void* node = node_with({{"sides/old", -1.0}, {"styles/old", 1.0}});
  Reference reference(walk_), captured(walk_);
  reference.set_side(-1);
  const auto change = [&](int frame) {
    if (frame != 60) return;
    host.set(node, "sides/old", 0.5);
    reference.set_side(0.5f);
  };
  EXPECT_GT(follow(walk_, node, reference, captured, 90, change, animate), 0.01f);
}

TEST_F(Godot, energy_is_the_librarys) {
  void* node = node_with({{"shape/energy", 0.3}});
  Reference reference(walk_, false, 0), plain(walk_, false, 0);
  reference.set_energy(0.3f);
  const auto change = [&](int frame) {
    if (frame != 60) return;
    host.set(node, "shape/energy", 1.7);
    reference.set_energy(1.7f);
  };
  EXPECT_GT(follow(walk_, node, reference, plain, 90, change, animate), 0.01f);
}

TEST_F(Godot, a_person_is_a_number_or_a_word_and_may_change) {
  const std::pair<const char*, uint32_t> cases[] = {
      {"7", 7},
      {" 007 ", 7},
      {"4294967295", UINT32_MAX},
      {"4294967296", panache_person_seed("4294967296")},
      {"-7", panache_person_seed("-7")},
      {"7up", panache_person_seed("7up")},
      {" mara", panache_person_seed("mara")},
      {"mara jones", panache_person_seed("mara jones")}};
  for (const auto& [text, seed] : cases) {
    SCOPED_TRACE(text);
    void* node = node_with({{"person", std::string(text)}, {"styles/old", 1.0}});
    EXPECT_EQ(host.get_text(node, "person"), text);  // As typed, while a word is typed, too.
    Reference reference(walk_), nobody(walk_);
    reference.set_person(seed);
    follow(
        walk_, node, reference, nobody, 20, [](int) {}, animate);
  }

  void* node = node_with({});
  Reference reference(walk_, false, 0), nobody(walk_, false, 0);
  const auto change = [&](int frame) {
    if (frame == 30) {
      host.set(node, "person", int64_t{7});  // By a script.
      reference.set_person(7);
    } else if (frame == 60) {
      host.set(node, "variety", 1.5);
      reference.set_person(7, 1.5f);
    } else if (frame == 90) {
      host.set(node, "variety", 3.0);  // The inspector has a range.
      reference.set_person(7, 2);
    } else if (frame == 120) {
      host.set(node, "person", std::string());
      reference.set_person(7, 0);
    }
  };
  EXPECT_GT(follow(walk_, node, reference, nobody, walk_.frames, change, animate), 0.01f);
}

TEST_F(Godot, a_model_without_persons_is_told_once) {
  host.files["res://without"] = read(PANACHE_SOURCE_DIR "/models/smith2019.safetensors");
  void* node = host.make_node();
  host.set(node, "model_path", std::string("res://without"));
  for (int f = 0; f < 60; ++f) {
    if (f == 10) {
      EXPECT_TRUE(host.errors.empty()) << host.errors.front();
      host.set(node, "person", std::string("mara"));
    }
    if (f >= 10) host.set(node, "variety", f / 60.0);
    if (f == 20) host.set(node, "hold_feet", false);  // Another character.
    if (f == 50) host.set(node, "person", std::string());
    animate(f);
    host.process(node);
  }
  ASSERT_EQ(host.errors.size(), 1u);
  EXPECT_EQ(host.errors[0].rfind("Panache: the model has no persons; expected ", 0), 0u)
      << host.errors[0];
  host.writes = 0;
  host.set(node, "styles/angry", 1.0);
  play(node, 60, 90);
  EXPECT_GT(host.writes, 0) << "the styles go on";
  EXPECT_EQ(host.errors.size(), 1u) << host.errors.back();

  // With another model, the person is there.
  host.set(node, "person", std::string("mara"));
  host.set(node, "styles/angry", 0.0);
  host.set(node, "model_path", std::string(kModel));
  host.writes = 0;
  play(node, 0, 30);
  EXPECT_GT(host.writes, 0);
  EXPECT_EQ(host.errors.size(), 1u) << host.errors.back();
  host.free_node(node);
}

TEST_F(Godot, bones_before_their_parents_turned_and_scaled_nodes_are_styled_alike) {
  // The other way round: the children come first.
  std::reverse(host.bones.begin(), host.bones.end());
  const auto last = static_cast<int64_t>(host.bones.size()) - 1;
  for (Bone& bone : host.bones) {
    if (bone.parent >= 0) bone.parent = last - bone.parent;
  }
  // The node faces +x and is twice as large; the walk goes where it faces.
  host.at = {{{0, 0, 2}, {0, 2, 0}, {-2, 0, 0}}, {0, 0, 0}};
  void* node = node_with({{"styles/old", 1.0}});
  Reference reference(walk_);
  for (int f = 0; f < walk_.frames; ++f) {
    animate(f);
    host.at.origin = {2 * host.at.origin.z, 3.5f, -2 * host.at.origin.x};
    host.process(node);
    reference.step(f, host.seconds);
    // Rounding of the turn, through 200 frames.
    ASSERT_LT(reference.apart(), 1e-3f) << "frame " << f;
  }
  host.free_node(node);
}

TEST_F(Godot, without_a_style_nothing_is_written) {
  void* node = node_with({});
  play(node, 0, 60);
  EXPECT_EQ(host.writes, 0);
  host.set(node, "styles/old", 1.0);
  play(node, 60, 61);
  EXPECT_GT(host.writes, 10);
  host.free_node(node);
}

TEST_F(Godot, properties_are_listed_set_read_and_reverted) {
  EXPECT_EQ(host.type_name, "PanacheCharacter");
  EXPECT_EQ(host.parent_name, "SkeletonModifier3D");
  void* node = host.make_node();
  EXPECT_EQ(host.properties(node).size(), 8u);
  host.set(node, "model_path", std::string(kModel));
  EXPECT_EQ(host.list_changes, 1);
  std::set<std::string> names;
  for (const Property& property : host.properties(node)) {
    const std::string name = Host::text_of(property.name);
    names.insert(name);
    EXPECT_EQ(property.usage, 6u) << name;
    EXPECT_TRUE(host.can_revert(node, name)) << name;
    const bool is_side = name.starts_with("sides/");
    if (!is_side && !name.starts_with("styles/")) continue;
    EXPECT_EQ(property.type, Type::real);
    EXPECT_EQ(property.hint, kHintRange);
    EXPECT_EQ(Host::text_of(property.hint_text), is_side ? "-1,1,0.01" : "-1,2,0.01");
  }
  for (const char* name : {"styles/old", "styles/proud", "sides/old", "person", "variety"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  // At first, and set to.
  const std::tuple<const char*, double, double> numbers[] = {{"styles/proud", 0, 0.5},
                                                             {"sides/old", 1, -0.5},
                                                             {"gestures", 1, 0},
                                                             {"variety", 1, 0.5},
                                                             {"shape/energy", 1, 0.5}};
  for (const auto& [name, initial, value] : numbers) {
    EXPECT_EQ(host.get_real(node, name), initial) << name;
    EXPECT_TRUE(host.set(node, name, value)) << name;
    EXPECT_EQ(host.get_real(node, name), value) << name;
  }
  EXPECT_EQ(host.get_real(node, "styles/old"), 0);
  EXPECT_TRUE(host.get_flag(node, "hold_feet"));
  EXPECT_TRUE(host.set(node, "hold_feet", false));
  EXPECT_FALSE(host.get_flag(node, "hold_feet"));
  EXPECT_EQ(host.get_text(node, "person"), "");
  EXPECT_TRUE(host.set(node, "person", int64_t{12}));
  EXPECT_EQ(host.get_text(node, "person"), "12");
  EXPECT_FALSE(host.set(node, "shape/elbows", 0.5));
  EXPECT_EQ(host.get_text(node, "model_path"), kModel);
  EXPECT_FALSE(host.set(node, "position", 1.0));
  EXPECT_FALSE(host.can_revert(node, "position"));
  host.free_node(node);
}

TEST_F(Godot, motion_is_forgotten_on_demand_and_time_is_that_of_the_skeletons_mode) {
  host.physics = 1;
  void* node = node_with({{"styles/old", 1.0}});
  Reference reference(walk_);
  const MethodInfo& reset = host.methods.at("reset_motion");
  for (int f = 0; f < 120; ++f) {
    if (f == 60 || f == 90) {
      reference.reset();
      void* instance = *static_cast<void**>(node);
      if (f == 60) reset.call(reset.user, instance, nullptr, 0, nullptr, nullptr);
      if (f == 90) reset.call_plain(reset.user, instance, nullptr, nullptr);
    }
    animate(f);
    if (f < 100) host.process(node);
    if (f >= 100) host.process(node, 0.02);
    reference.step(f, f < 100 ? host.physics_seconds : 0.02);
    ASSERT_EQ(reference.apart(), 0) << "frame " << f;
  }
  host.free_node(node);
}

TEST_F(Godot, what_is_wrong_is_told_once) {
  void* node = host.make_node();
  host.process(node);  // Without a model.
  EXPECT_TRUE(host.errors.empty());
  host.set(node, "model_path", std::string("res://none.safetensors"));
  ASSERT_EQ(host.errors.size(), 1u);
  EXPECT_EQ(host.errors[0],
            "Panache: res://none.safetensors: there is no such file, or it is empty");
  host.files["res://bad"] = "bad";
  host.set(node, "model_path", std::string("res://bad"));
  ASSERT_EQ(host.errors.size(), 2u);
  EXPECT_EQ(host.errors[1].rfind("Panache: res://bad: ", 0), 0u) << host.errors[1];

  host.set(node, "model_path", std::string(kModel));
  host.set(node, "styles/odl", 1.0);
  play(node, 0, 3);
  ASSERT_EQ(host.errors.size(), 3u);
  EXPECT_EQ(host.errors[2], "Panache: unknown style 'odl'; the nearest is old");

  // A skeleton that is no humanoid any more, and one that is again.
  const std::vector<Bone> whole = host.bones;
  host.bones.resize(3);
  ++host.version;
  for (int f = 0; f < 3; ++f) host.process(node);
  ASSERT_EQ(host.errors.size(), 4u);
  EXPECT_EQ(host.errors[3].rfind("Panache: no humanoid found: ", 0), 0u) << host.errors[3];
  host.bones = whole;
  ++host.version;
  host.set(node, "styles/old", 1.0);
  host.writes = 0;
  play(node, 0, 3);
  EXPECT_GT(host.writes, 0);
  host.free_node(node);
}

TEST_F(Godot, an_engine_that_lacks_a_function_is_left_alone) {
  const auto enter = reinterpret_cast<Flag (*)(GetFunction, void*, Initialization*)>(
      dlsym(library_, "panache_godot_init"));
  const GetFunction older = [](const char* name) {
    const bool newer = std::string(name) == "classdb_register_extension_class3";
    return newer ? nullptr : get_function(name);
  };
  Initialization extension{};
  EXPECT_FALSE(enter(older, this, &extension));
  EXPECT_EQ(extension.initialize, nullptr);
  EXPECT_TRUE(enter(get_function, this, &extension));
}

}  // namespace
}  // namespace panache::godot
