// Meshes of FBX files stand in a GLB where the chain of transforms has them.

#include <nlohmann/json.hpp>

#include "cli/fbx_program_test.h"
#include "clip/make_fbx_scene.h"
#include "clip/make_gltf.h"

namespace panache::test {
namespace {

class FbxMeshes : public FbxProgramTest {};

const std::vector<Vec3d> kCorners = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}};
constexpr int64_t kGeometry = 1500;

// A scene with a triangle in one of its models.
std::string with_triangle(std::string text, size_t model) {
  std::string mesh = "\tGeometry: 1500, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: ";
  for (const Vec3d v : kCorners) {
    mesh += (mesh.ends_with("a: ") ? "" : ",") + std::to_string(v.x) + "," + std::to_string(v.y) +
            "," + std::to_string(v.z);
  }
  mesh += "\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n";
  text.insert(text.find("\tModel: 2000"), mesh);
  const std::string connections = "Connections:  {\n";
  text.insert(
      text.find(connections) + connections.size(),
      "\tC: \"OO\"," + std::to_string(kGeometry) + "," + std::to_string(2000 + model) + "\n");
  return text;
}

// Assimp writes the root as a matrix, by columns.
Affine of_node(const Json& node) {
  if (node.contains("matrix")) {
    const auto m = node["matrix"].get<std::vector<double>>();
    Affine out;
    for (size_t row = 0; row < 3; ++row) {
      for (size_t column = 0; column < 4; ++column) out[row][column] = m[4 * column + row];
    }
    return out;
  }
  const auto v = node.value("translation", std::vector<double>{0, 0, 0});
  const auto s = node.value("scale", std::vector<double>{1, 1, 1});
  const auto q = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  const Quatd turn = {q[0], q[1], q[2], q[3]};
  Affine out = affine_move({v[0], v[1], v[2]});
  for (size_t c = 0; c < 3; ++c) {
    Vec3d axis;
    axis[c] = s[c];
    const Vec3d column = rotate(turn, axis);
    out[0][c] = column.x, out[1][c] = column.y, out[2][c] = column.z;
  }
  return out;
}

// The corners of the only mesh in the world, as the nodes have them at rest.
std::vector<Vec3d> corners_in(const GltfParts& glb) {
  const Json& nodes = glb.json["nodes"];
  std::vector<int> parents(nodes.size(), -1);
  for (size_t n = 0; n < nodes.size(); ++n) {
    for (const Json& child : nodes[n].value("children", Json::array())) {
      parents[child.get<size_t>()] = static_cast<int>(n);
    }
  }
  std::vector<Vec3d> out;
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (!nodes[n].contains("mesh")) continue;
    Affine world = of_node(nodes[n]);
    for (int up = parents[n]; up >= 0; up = parents[static_cast<size_t>(up)]) {
      world = of_node(nodes[static_cast<size_t>(up)]) * world;
    }
    const Json& mesh = glb.json["meshes"][nodes[n]["mesh"].get<size_t>()];
    const std::vector<float> points =
        accessor_floats(glb, mesh["primitives"][0]["attributes"]["POSITION"]);
    for (size_t i = 0; i + 2 < points.size(); i += 3) {
      const Affine at =
          world * affine_move(Vec3{points[i], points[i + 1], points[i + 2]}.as<double>());
      out.push_back({at[0][3], at[1][3], at[2][3]});
    }
  }
  return out;
}

TEST_F(FbxMeshes, a_prop_is_where_pivots_and_its_own_geometry_place_it) {
  std::vector<SceneModel> models = {{"hips", -1, {{"Lcl Translation", {0, 90, 0}}}},
                                    {"hand",
                                     0,
                                     {{"Lcl Translation", {10, 20, 0}},
                                      {"Lcl Rotation", {30, 10, -50}},
                                      {"RotationOffset", {1, -2, 0.5}},
                                      {"RotationPivot", {2, 3, -4}},
                                      {"PreRotation", {20, -30, 40}},
                                      {"PostRotation", {-15, 25, 5}},
                                      {"RotationOrder", {4}}}},
                                    {"sword",
                                     1,
                                     {{"Lcl Translation", {8, 6, 4}},
                                      {"Lcl Rotation", {0, 70, 0}},
                                      {"RotationPivot", {2, -1, 1}},
                                      {"ScalingPivot", {1, 2, 3}},
                                      {"ScalingOffset", {0, 1, 0}},
                                      {"Lcl Scaling", {2, 0.5, 1}},
                                      {"GeometricTranslation", {0, 5, 0}},
                                      {"GeometricRotation", {90, 0, 0}},
                                      {"GeometricScaling", {1, 3, 1}}},
                                     "Mesh"}};
  SceneCurve turn;
  for (int f = 0; f <= 10; ++f) turn.keys.push_back({static_cast<double>(f), 7.0 * f});
  const std::vector<SceneStack> stacks = {
      {"Take", {{"BaseLayer", {}, {{0, 1, {{turn, {}, {}}}}}}}}};
  std::vector<SceneTransform> transforms;
  for (const SceneModel& model : models) transforms.push_back(saved_transform(model));
  const Affine world = worlds_by_formula(models, transforms)[2] * affine_move({0, 5, 0}) *
                       affine_turn({90, 0, 0}) * affine_grow({1, 3, 1});
  const std::string text = with_triangle(make_fbx_scene(models, stacks), 2);
  {
    write("in.fbx", text);
    const Ran ran = must("convert in.fbx --force -o out.glb");
    EXPECT_EQ(ran.err, "");
    const std::vector<Vec3d> corners = corners_in(glb_parts(read("out.glb")));
    ASSERT_EQ(corners.size(), 3u);
    for (const Vec3d corner : kCorners) {
      const Affine at = world * affine_move(corner);
      const Vec3d expected = Vec3d{at[0][3], at[1][3], at[2][3]} * 0.01;
      EXPECT_TRUE(std::ranges::any_of(corners,
                                      [&](Vec3d got) {
                                        return length(got - expected) <
                                               1e-5;  // Floats of a metre, through four matrices.
                                      }))
          << expected.x << " " << expected.y << " " << expected.z;
    }
  }
}

}  // namespace
}  // namespace panache::test
