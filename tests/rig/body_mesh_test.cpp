#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "rig/body_mesh.h"
#include "rig/canonical_body.h"
#include "rig/posed_rig.h"

namespace panache {
namespace {

std::array<int, kHumanJoints> every_joint() {
  std::array<int, kHumanJoints> out;
  for (size_t j = 0; j < kHumanJoints; ++j) out[j] = static_cast<int>(j);
  return out;
}

HumanPositions canonical_offsets() {
  HumanPositions out;
  const Skeleton skeleton = canonical_skeleton();
  for (size_t j = 0; j < kHumanJoints; ++j) out[j] = skeleton.joints[j].offset;
  return out;
}

// The torso this much longer, legs as they are.
HumanPositions with_torso(float factor) {
  HumanPositions out = canonical_offsets();
  for (const HumanJoint joint : {HumanJoint::spine, HumanJoint::chest, HumanJoint::neck,
                                 HumanJoint::left_shoulder, HumanJoint::right_shoulder}) {
    out[static_cast<size_t>(index(joint))].y *= factor;
  }
  return out;
}

// How many separate pieces the triangles make.
size_t pieces_of(const BodyMesh& mesh) {
  std::vector<size_t> above(mesh.positions.size());
  for (size_t v = 0; v < above.size(); ++v) above[v] = v;
  const auto root = [&](size_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
  };
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    above[root(mesh.triangles[t + 1])] = root(mesh.triangles[t]);
    above[root(mesh.triangles[t + 2])] = root(mesh.triangles[t]);
  }
  std::set<size_t> roots;
  for (size_t v = 0; v < above.size(); ++v) roots.insert(root(v));
  return roots.size();
}

float share_of(const BodyMesh& mesh, size_t vertex, size_t joint) {
  float out = 0;
  for (size_t k = 0; k < kSkinJoints; ++k) {
    if (mesh.joints[vertex][k] == joint) out += static_cast<float>(mesh.weights[vertex][k]) / 255;
  }
  return out;
}

TEST(BodyMesh, is_one_closed_surface_whatever_the_proportions) {
  for (const auto& [torso, detail] :
       {std::pair(0.5f, BodyDetail::fine), std::pair(1.0f, BodyDetail::fine),
        std::pair(1.6f, BodyDetail::fine), std::pair(2.2f, BodyDetail::fine),
        std::pair(0.5f, BodyDetail::coarse), std::pair(2.2f, BodyDetail::coarse)}) {
    const BodyMesh mesh = make_body_mesh(with_torso(torso), every_joint(), detail);
    EXPECT_EQ(pieces_of(mesh), 1u) << torso;
    std::map<std::pair<int, int>, int> edges;  // Each way once: closed, and turned one way.
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (size_t k = 0; k < 3; ++k) {
        ++edges[{mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]}];
      }
    }
    size_t open = 0;
    for (const auto& [edge, count] : edges) open += edges.count({edge.second, edge.first}) == 0;
    EXPECT_EQ(open, 0u) << torso;
  }
}

TEST(BodyMesh, is_the_same_body_with_a_third_of_the_triangles) {
  const BodyMesh fine = make_body_mesh(canonical_offsets(), every_joint());
  const BodyMesh coarse = make_body_mesh(canonical_offsets(), every_joint(), BodyDetail::coarse);
  EXPECT_LT(coarse.triangles.size(), 0.37 * static_cast<double>(fine.triangles.size()));
  // Each of its vertices lies on the body: as near to one of the fine mesh as half of a cell's
  // diagonal there.
  float farthest = 0;
  for (const Vec3 p : coarse.positions) {
    float nearest = 1;
    for (const Vec3 q : fine.positions) nearest = std::min(nearest, length(p - q));
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 0.0165f * 1.5f);
}

TEST(BodyMesh, normals_point_out_of_the_triangles) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  size_t wrong = 0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const size_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
    const Vec3 flat =
        cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    wrong += dot(flat, mesh.normals[a] + mesh.normals[b] + mesh.normals[c]) < 0;
  }
  // Slivers in the deepest creases may turn over.
  EXPECT_LT(wrong, mesh.triangles.size() / 3 / 200);
  for (const Vec3 normal : mesh.normals) EXPECT_NEAR(length(normal), 1, 1e-5f);
}

// What a seam is: neighbours that go different ways. Between two vertices a cell apart a joint's
// share changes by at most a third.
TEST(BodyMesh, weights_add_up_and_change_softly_from_vertex_to_vertex) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  float largest = 0;
  for (size_t v = 0; v < mesh.weights.size(); ++v) {
    int sum = 0;
    for (const uint8_t weight : mesh.weights[v]) sum += weight;
    ASSERT_EQ(sum, 255);
  }
  for (size_t t = 0; t + 1 < mesh.triangles.size(); ++t) {
    if (t % 3 == 2) continue;
    const size_t a = mesh.triangles[t], b = mesh.triangles[t + 1];
    for (size_t j = 0; j < kHumanJoints; ++j) {
      largest = std::max(largest, std::abs(share_of(mesh, a, j) - share_of(mesh, b, j)));
    }
  }
  EXPECT_LT(largest, 0.34f);
}

TEST(BodyMesh, no_part_is_far_from_the_skeleton) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  float farthest = 0;
  for (const Vec3 p : mesh.positions) {
    float nearest = 1;
    for (size_t j = 1; j < kHumanJoints; ++j) {
      const Vec3 from = mesh.bind.positions[static_cast<size_t>(kHumanParent[j])];
      const Vec3 along = mesh.bind.positions[j] - from;
      const float t = std::clamp(dot(p - from, along) / dot(along, along), 0.0f, 1.0f);
      nearest = std::min(nearest, length(p - from - along * t));
    }
    farthest = std::max(farthest, nearest);
  }
  // The head over its joint, and the fingers.
  EXPECT_LT(farthest, 0.25f);
  EXPECT_GT(farthest, 0.1f);
}

TEST(BodyMesh, one_leg_does_not_move_the_other) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  const auto left = static_cast<size_t>(index(HumanJoint::left_upper_leg));
  const auto right = static_cast<size_t>(index(HumanJoint::right_lower_leg));
  size_t seen = 0;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    if (share_of(mesh, v, right) > 0.5f) {
      ++seen;
      EXPECT_EQ(share_of(mesh, v, left), 0);
    }
  }
  EXPECT_GT(seen, 100u);
}

TEST(BodyMesh, the_back_moves_with_the_chest_from_there_up) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  const auto chest = static_cast<size_t>(index(HumanJoint::chest));
  const float low = mesh.bind.positions[chest].y;
  const float high = mesh.bind.positions[static_cast<size_t>(index(HumanJoint::left_upper_arm))].y;
  size_t seen = 0;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    if (std::abs(p.x) > 0.05f || p.z > -0.05f || p.y < low + 0.01f || p.y > high) continue;
    ++seen;
    EXPECT_GT(share_of(mesh, v, chest), 0.5f);
  }
  EXPECT_GT(seen, 20u);
}

TEST(BodyMesh, hips_move_nothing_of_a_hand_or_a_head) {
  const BodyMesh mesh = make_body_mesh(canonical_offsets(), every_joint());
  size_t seen = 0;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (const HumanJoint joint : {HumanJoint::head, HumanJoint::left_hand}) {
      if (share_of(mesh, v, static_cast<size_t>(index(joint))) < 0.5f) continue;
      ++seen;
      EXPECT_EQ(share_of(mesh, v, 0), 0);
    }
  }
  EXPECT_GT(seen, 100u);
}

TEST(BodyMesh, a_joint_that_a_rig_lacks_moves_nothing) {
  std::array<int, kHumanJoints> movers = every_joint();
  const auto chest = static_cast<size_t>(index(HumanJoint::chest));
  movers[chest] = index(HumanJoint::spine);
  HumanPositions offsets = canonical_offsets();
  offsets[chest] = {};
  const BodyMesh mesh = make_body_mesh(offsets, movers);
  for (size_t v = 0; v < mesh.positions.size(); ++v) ASSERT_EQ(share_of(mesh, v, chest), 0);
}

// In a file the same vertices are where the page shows them: the file's joints times the binds
// give the mannequin's parts.
TEST(RigBody, stands_on_the_joints_of_the_clip_where_the_mannequin_stands) {
  Clip clip = test::walking_clip(3);
  // The hips turn against what is above them.
  const auto spine = static_cast<size_t>(index(HumanJoint::spine));
  clip.pose(2).rotations[spine] = axis_angle(Vec3{1, 0, 0}, 0.5f);
  const Rig rig = *Rig::create(clip);
  const SkinnedBody body = make_rig_body(rig, clip.pose(0));
  Mannequin mannequin(rig, clip.pose(0));
  const BodyMesh mesh = make_body_mesh(mannequin.offsets(), moving_joints(rig));
  std::array<float, kMannequinNumbers> parts;
  mannequin.read(clip.pose(2), parts);
  std::vector<Quat> turns(clip.joints());
  std::vector<Vec3> positions(clip.joints());
  world_pose(clip.skeleton, clip.pose(2), {turns, positions});
  const float scale = rig.unit() / rig.scale();
  for (size_t v = 0; v < mesh.positions.size(); v += 37) {
    const size_t joint = mesh.joints[v][0];
    const float* part = &parts[kPartNumbers * joint];
    const Vec3 local = rotate(conjugate(mesh.bind.rotations[joint]),
                              mesh.positions[v] - mesh.bind.positions[joint]);
    const Vec3 shown =
        Vec3{part[0], part[1], part[2]} + rotate(Quat{part[3], part[4], part[5], part[6]}, local);
    const SkinnedBody::Bind& bind = body.binds[body.joints[v][0]];
    const Vec3 own = rotate(bind.rotation, body.positions[v]) * bind.scale + bind.translation;
    const Vec3 written = (positions[bind.joint] + rotate(turns[bind.joint], own)) * rig.unit();
    // Rounding, of metres, and the floor, which files keep.
    EXPECT_LT(length(written - shown * scale - Vec3{0, rig.floor() * scale, 0}), 1e-4f);
  }
}

TEST(MannequinTest, stands_where_the_rig_stands_and_shows_twist) {
  Clip clip = test::walking_clip(2);
  const auto hand = static_cast<size_t>(index(HumanJoint::left_hand));
  const auto arm = static_cast<size_t>(index(HumanJoint::left_lower_arm));
  clip.pose(1).rotations[hand] = axis_angle(Vec3{1, 0, 0}, 1.0f);
  // Local axes that are not those of the part.
  const Quat axes = axis_angle(Vec3{0, 0, 1}, 1.2f);
  Vec3& offset_in_file = clip.skeleton.joints[hand].offset;
  offset_in_file = rotate(conjugate(axes), offset_in_file);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    pose.rotations[arm] = pose.rotations[arm] * axes;
    pose.rotations[hand] = conjugate(axes) * pose.rotations[hand];
    pose.translations[hand] = offset_in_file;
  }
  Mannequin mannequin(*Rig::create(clip), clip.pose(0));
  std::array<float, kMannequinNumbers> before, after;
  mannequin.read(clip.pose(0), before);
  mannequin.read(clip.pose(1), after);
  const auto turn = [&](const std::array<float, kMannequinNumbers>& parts) {
    const float* q = &parts[kPartNumbers * hand + 3];
    return Quat{q[0], q[1], q[2], q[3]};
  };
  const float* lower = &after[kPartNumbers * arm + 3];
  const Quat relative = conjugate(Quat{lower[0], lower[1], lower[2], lower[3]}) * turn(after);
  EXPECT_NEAR(length(log_rotation(relative)), 1.0f, 1e-3f);
  // Each part's child is where its own frame says.
  const Vec3 offset = mannequin.offsets()[hand];
  const Vec3 turned = rotate(Quat{lower[0], lower[1], lower[2], lower[3]}, offset);
  const auto position = [&](size_t part) {
    return Vec3{after[kPartNumbers * part], after[kPartNumbers * part + 1],
                after[kPartNumbers * part + 2]};
  };
  EXPECT_LT(length(position(hand) - position(arm) - turned), 1e-4f);
}

}  // namespace
}  // namespace panache
