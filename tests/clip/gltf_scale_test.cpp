// Scales of any sign, even and uneven, at rest and in motion: joints are where glTF's matrices have
// them, as read and as written, and are turned by what is left without the scales.

#include "gltf_checks.h"
#include "rescale.h"

namespace panache {
namespace {

using test::character;
using test::GltfParts;
using test::Json;
using test::MatrixPositions;
using test::node_called;

using Signs = std::array<double, 3>;
constexpr Signs kSigns[] = {{-1, 1, 1},  {1, -1, 1},  {1, 1, -1},  {-1, -1, 1},
                            {1, -1, -1}, {-1, 1, -1}, {-1, -1, -1}};

// Places within 2.5 m at the end of chains of 13 nodes, rounded to floats a few times each, of
// quaternions that are floats themselves.
constexpr double kRounding = 2.5 * 13 * 4 * 0x1p-23;

void expect_positions(const GltfParts& parts, const Clip& clip, size_t animation, double tolerance,
                      const std::string& what) {
  const MatrixPositions positions(parts, animation);
  double worst = 0;
  for (int f = 0; f < clip.frames; f += 7) {
    const std::vector<Vec3> at = world_positions(clip, f);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const size_t node = node_called(parts, clip.skeleton.joints[j].name);
      const Vec3d want = positions.position(node, static_cast<size_t>(f));
      worst = std::max(worst, length(at[j].as<double>() - want));
    }
  }
  EXPECT_LT(worst, tolerance) << what;
}

// The first motion of the file is where the matrices have it; and so is one that turns every joint
// and moves the hips, once it is written.
void expect_read_and_written(const GltfParts& parts, const std::string& what,
                             double tolerance = kRounding) {
  const auto file = must_read(parts);
  ASSERT_TRUE(file) << what;
  expect_positions(parts, file->clip(), 0, tolerance, what + ", read");
  Clip changed = file->clip();
  const size_t hips = joint_named(changed, "Hips");
  for (int f = 0; f < changed.frames; ++f) {
    for (size_t j = 1; j < changed.joints(); ++j) {
      if (!changed.skeleton.joints[j].can_rotate) continue;
      const float angle = 0.02f * static_cast<float>(j % 7) + 0.01f * static_cast<float>(f % 5);
      Quat& q = changed.pose(f).rotations[j];
      q = normalized(q * axis_angle(normalized(Vec3{0.3f, 1, -0.5f}), angle));
    }
    changed.pose(f).translations[hips] += Vec3{0.01f, 0.02f, 0.03f};
  }
  for (const EditMode mode : {EditMode::replace, EditMode::add_beside}) {
    const std::string bytes = edited(*file, changed, mode);
    const size_t which = mode == EditMode::replace ? 0 : 2;
    expect_positions(test::glb_parts(bytes), changed, which, tolerance, what + ", written");
    const auto again = must_read(bytes);
    ASSERT_TRUE(again) << what;
    expect_positions(test::glb_parts(bytes), again->clip(static_cast<int>(which)), which, tolerance,
                     what + ", read again");
  }
  // Nothing that is the same is written anew.
  const std::string same = edited(*file, file->clip(), EditMode::replace);
  EXPECT_EQ(test::glb_parts(same).bin, parts.bin) << what;
}

TEST(GltfScale, a_mirrored_joint_leaves_every_place_where_it_was) {
  const auto plain = must_read(character());
  for (const std::string name : {"Armature", "Hips", "Chest", "LeftArm", "RightUpLeg"}) {
    for (const Signs& signs : kSigns) {
      const std::string what = name + " " + Json(signs).dump();
      GltfParts parts = character();
      test::rescale(parts, name, signs, 0.5);
      const auto file = must_read(parts);
      ASSERT_TRUE(file);
      for (int f = 0; f < plain->clip().frames; f += 10) {
        const auto want = world_positions(plain->clip(), f), got = world_positions(file->clip(), f);
        for (size_t j = 0; j < want.size(); ++j) {
          EXPECT_LT(length(want[j] - got[j]), kRounding) << what << " " << j;
        }
      }
      expect_read_and_written(parts, what);
    }
  }
}

TEST(GltfScale, several_mirrored_joints_do_so_too) {
  GltfParts parts = character({.centimetres = true});
  test::rescale(parts, "Armature", {-1, 1, 1});
  test::rescale(parts, "Spine", {-1, -1, -1}, 2);
  test::rescale(parts, "LeftShoulder", {1, -1, 1}, 0.25);
  test::rescale(parts, "LeftForeArm", {1, -1, -1});
  test::rescale(parts, "RightUpLeg", {-1, 1, 1});
  expect_read_and_written(parts, "several");
}

// The same numbers said in another way: a half turn in the rotation, or two signs.
TEST(GltfScale, a_joint_is_turned_alike_however_its_mirror_image_is_said) {
  GltfParts one = character(), other = character();
  test::rescale(one, "Spine", {-1, 1, 1});
  test::rescale(other, "Spine", {-1, 1, 1});
  Json& spine = other.json["nodes"][node_called(other, "Spine")];
  spine["scale"] = {1, -1, 1};
  const auto half_turn = [](float* q, size_t) {
    const Quat turned = Quat{q[0], q[1], q[2], q[3]} * Quat{0, 0, 1, 0};
    q[0] = turned.x, q[1] = turned.y, q[2] = turned.z, q[3] = turned.w;
  };
  std::array<float, 4> q = spine["rotation"];
  half_turn(q.data(), 0);
  spine["rotation"] = q;
  test::edit_keys(other, node_called(other, "Spine"), "rotation", half_turn);
  const auto a = must_read(one), b = must_read(other);
  ASSERT_TRUE(a && b);
  for (size_t j = 0; j < a->clip().joints(); ++j) {
    EXPECT_LT(angle_between(a->clip().pose(7).rotations[j], b->clip().pose(7).rotations[j]), 1e-6);
  }
  expect_read_and_written(other, "other");
}

TEST(GltfScale, a_mirroring_matrix_is_taken_apart) {
  GltfParts parts = character();
  test::rescale(parts, "Armature", {1, -1, 1}, 0.5);
  Json& armature = parts.json["nodes"][0];
  armature.erase("scale");
  armature.erase("rotation");
  armature["matrix"] = {0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1};
  expect_read_and_written(parts, "matrix");
  // One that shears besides: places are what it makes of them.
  armature["matrix"] = {0.5, 0.1, 0, 0, 0, -0.6, 0.05, 0, 0.1, 0, 0.5, 0, 0, 0.2, 0, 1};
  expect_read_and_written(parts, "shear", 2 * kRounding);
}

// A matrix says what three scales say.
TEST(GltfScale, a_joint_is_turned_by_a_matrix_as_by_scales) {
  for (const Signs& signs : kSigns) {
    GltfParts scaled = character();
    test::rescale(scaled, "Armature", signs, 0.5);
    Json& armature = scaled.json["nodes"][0];
    armature.erase("rotation");
    GltfParts matrix = scaled;
    const Json scale = armature["scale"];
    Json& same = matrix.json["nodes"][0];
    same.erase("scale");
    same["matrix"] = {scale[0], 0, 0, 0, 0, scale[1], 0, 0, 0, 0, scale[2], 0, 0, 0, 0, 1};
    const auto a = must_read(scaled), b = must_read(matrix);
    ASSERT_TRUE(a && b);
    for (size_t j = 0; j < a->clip().joints(); ++j) {
      EXPECT_LT(angle_between(a->clip().pose(7).rotations[j], b->clip().pose(7).rotations[j]), 1e-6)
          << Json(signs) << " " << j;
    }
  }
}

TEST(GltfScale, uneven_scales_are_in_the_places) {
  for (const std::string name : {"Armature", "Hips", "Chest", "LeftArm"}) {
    for (const Signs& scale : {Signs{1, 1.25, 0.8}, Signs{2, 0.5, 1}, Signs{-1.5, 1, 0.75}}) {
      const std::string what = name + " " + Json(scale).dump();
      GltfParts stretched = character();
      stretched.json["nodes"][node_called(stretched, name)]["scale"] = scale;
      expect_read_and_written(stretched, what, 4 * kRounding);
      // Taken back below the joint, nothing moves.
      GltfParts undone = character();
      test::scale_and_undo(undone, name, scale);
      expect_read_and_written(undone, what + " undone", 2 * kRounding);
    }
  }
}

TEST(GltfScale, animated_scales_are_in_the_places) {
  const auto with_keys = [](const std::string& name, const auto& scale_at) {
    GltfParts parts = character();
    std::vector<float> keys;
    for (int i = 0; i < 31; ++i) {
      for (const double s : scale_at(i)) keys.push_back(static_cast<float>(s));
    }
    const size_t times = parts.add_bounded(test::key_times(31), "SCALAR", 1);
    parts.add_channel(0, node_called(parts, name), "scale", "LINEAR", times,
                      parts.add(keys, "VEC3", 3));
    return parts;
  };
  const auto grows = [](int i) { return Signs{1 + 0.02 * i, 1 + 0.02 * i, 1 + 0.02 * i}; };
  const auto stretches = [](int i) { return Signs{1, 1 + 0.01 * i, 1 - 0.01 * i}; };
  const auto is_mirrored = [](int) { return Signs{-1, 1, 1}; };
  for (const std::string name : {"Armature", "Hips", "Spine", "LeftArm"}) {
    expect_read_and_written(with_keys(name, grows), name + " grows", 2 * kRounding);
    expect_read_and_written(with_keys(name, stretches), name + " stretches", 4 * kRounding);
    expect_read_and_written(with_keys(name, is_mirrored), name + " is mirrored", kRounding);
  }
}

// Exporters round.
TEST(GltfScale, keys_that_only_repeat_the_scale_change_nothing) {
  const auto plain = must_read(character());
  GltfParts parts = character();
  const size_t times = parts.add_bounded({0, 1}, "SCALAR", 1);
  parts.add_channel(0, node_called(parts, "Hips"), "scale", "LINEAR", times,
                    parts.add(std::vector<float>{1, 0.99999f, 1.00001f, 1, 1, 1}, "VEC3", 3));
  const auto file = must_read(parts);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip().rotations, plain->clip().rotations);
  EXPECT_EQ(file->clip().translations, plain->clip().translations);
}

// A figure that appears out of nothing.
TEST(GltfScale, what_is_scaled_away_keeps_the_size_that_it_has_at_rest) {
  const auto plain = must_read(character());
  GltfParts parts = character();
  const size_t times = parts.add_bounded({0, 1}, "SCALAR", 1);
  parts.add_channel(0, 0, "scale", "STEP", times,
                    parts.add(std::vector<float>{0, 0, 0, 1, 1, 1}, "VEC3", 3));
  const auto file = must_read(parts);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip().translations, plain->clip().translations);
}

TEST(GltfScale, a_flat_scale_above_joints_is_rejected) {
  GltfParts parts = character();
  parts.json["nodes"][1]["scale"] = {1, 0, 1};
  EXPECT_EQ(gltf_rejection(parts),
            "walk.glb: nodes[1]: expected a scale that leaves each of its axes some length, as "
            "other joints are below it, found one that is flat");
  // Nothing is below the toes.
  parts = character();
  parts.json["nodes"][node_called(parts, "LeftToeBase")]["scale"] = {1, 0, 1};
  EXPECT_EQ(gltf_rejection(parts), "(accepted)");
}

}  // namespace
}  // namespace panache
