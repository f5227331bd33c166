// Characters with mirrored and uneven scales are styled, retargeted to and converted as the same
// character without them is.

#include <functional>

#include "cli/program.h"
#include "cli/same_positions.h"
#include "clip/make_character.h"
#include "clip/rescale.h"

namespace panache::test {
namespace {

struct Variant {
  const char* name;
  std::function<void(GltfParts&)> rewrite;  // Leaves every node of the file where it is.
};

// A scale in the keys alone, the same at all times or not; what is below takes it back.
void rescale_keys(GltfParts& parts, const std::string& name, const std::array<double, 3>& signs) {
  rescale(parts, name, signs);
  Json& node = parts.json["nodes"][node_called(parts, name)];
  const std::vector<float> key = node["scale"].get<std::vector<float>>();
  node.erase("scale");
  for (size_t animation : {0, 1}) {
    const size_t times = parts.add_bounded({0}, "SCALAR", 1);
    parts.add_channel(animation, node_called(parts, name), "scale", "LINEAR", times,
                      parts.add(key, "VEC3", 3));
  }
}

const Variant kVariants[] = {
    {"-1 at the root",
     [](GltfParts& p) {
       rescale(p, "Armature", {-1, -1, -1});
     }},
    {"mirrored root",
     [](GltfParts& p) {
       rescale(p, "Armature", {-1, 1, 1});
     }},
    {"mirrored hips",
     [](GltfParts& p) {
       rescale(p, "Hips", {-1, 1, 1});
     }},
    {"-1 at the hips",
     [](GltfParts& p) {
       rescale(p, "Hips", {-1, -1, -1}, 3);
     }},
    {"mirrored spine",
     [](GltfParts& p) {
       rescale(p, "Spine", {1, 1, -1});
     }},
    {"two axes of the chest",
     [](GltfParts& p) {
       rescale(p, "Chest", {-1, 1, -1});
     }},
    {"mirrored arm",
     [](GltfParts& p) {
       rescale(p, "LeftArm", {1, -1, 1});
     }},
    {"mirrored thigh",
     [](GltfParts& p) {
       rescale(p, "RightUpLeg", {-1, 1, 1});
     }},
    {"mirrored foot",
     [](GltfParts& p) {
       rescale(p, "RightFoot", {-1, 1, 1});
     }},
    {"one in another",
     [](GltfParts& p) {
       rescale(p, "Hips", {-1, 1, 1}, 2);
       rescale(p, "Chest", {1, -1, 1}, 0.5);
       rescale(p, "RightArm", {-1, -1, -1});
       rescale(p, "LeftLeg", {1, 1, -1});
     }},
    {"uneven, taken back",
     [](GltfParts& p) {
       scale_and_undo(p, "Spine", {1.5, 0.8, -2});
     }},
    {"uneven feet, head and hand",
     [](GltfParts& p) {
       for (const char* leaf : {"LeftToeBase", "RightToeBase", "Head"}) {
         p.json["nodes"][node_called(p, leaf)]["scale"] = {1.5, 1, -0.7};
       }
     }},
    {"mirrored by keys",
     [](GltfParts& p) {
       rescale_keys(p, "Spine", {-1, 1, 1});
     }},
};

class Scales : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("plain.glb", to_glb(character()));
    write_walk("walk.bvh");
  }
  // How far the nodes of a file are from those of plain.glb after the same was done to both.
  void expect_alike(const std::string& plain, const std::string& other, size_t animation,
                    const char* what, double tolerance) {
    const GltfParts a = glb_parts(read(plain)), b = glb_parts(read(other));
    const auto keys = [&](const GltfParts& parts) {
      const Json& sampler = parts.json["animations"][animation]["samplers"].back();
      return parts.json["accessors"][sampler["input"].get<size_t>()]["count"].get<size_t>();
    };
    ASSERT_EQ(keys(a), keys(b)) << what;
    const MatrixPlaces plain_nodes(a, animation), other_nodes(b, animation);
    double worst = 0;
    for (size_t f = 0; f < keys(a); f += 3) {
      for (size_t n = 0; n < a.json["nodes"].size(); ++n) {
        worst = std::max(worst, length(plain_nodes.place(n, f) - other_nodes.place(n, f)));
      }
    }
    std::printf("%s: %.7f m\n", what, worst);
    EXPECT_LT(worst, tolerance) << what;
  }
};

// What differs between two runs is the rounding of a place within 2.5 m at the end of 13 joints,
// which the step sees as another input: its networks multiply that by about ten.
constexpr double kSameInput = 10 * 2.5 * 13 * 4 * 0x1p-23;

TEST_F(Scales, a_style_is_the_plain_characters) {
  must("stylize plain.glb --style old=1 --clip Walk -o plain-old.glb");
  for (const Variant& variant : kVariants) {
    GltfParts parts = character();
    variant.rewrite(parts);
    write("other.glb", to_glb(parts));
    must("stylize other.glb --style old=1 --clip Walk --force -o other-old.glb");
    expect_alike("plain-old.glb", "other-old.glb", 0, variant.name, kSameInput);
    must("stylize other.glb --style old=0 --replace --force -o same.glb");
    EXPECT_EQ(glb_parts(read("same.glb")).bin, parts.bin) << variant.name;
  }
}

TEST_F(Scales, motion_of_others_is_put_on_it_as_on_the_plain_one) {
  must("retarget walk.bvh --onto plain.glb -o plain-walk.glb");
  for (const Variant& variant : kVariants) {
    // What only the keys of the file's own motions say is not there in a new one.
    if (std::string(variant.name) == "mirrored by keys") continue;
    GltfParts parts = character();
    variant.rewrite(parts);
    write("other.glb", to_glb(parts));
    must("retarget walk.bvh --onto other.glb --force -o other-walk.glb");
    expect_alike("plain-walk.glb", "other-walk.glb", 0, variant.name, kSameInput);
  }
}

TEST_F(Scales, other_formats_hold_the_same_motion) {
  must("convert plain.glb --clip Walk -o plain.bvh");
  const Result<std::unique_ptr<MotionFile>> plain = read_motion(path("plain.bvh"));
  ASSERT_TRUE(plain.ok());
  for (const Variant& variant : kVariants) {
    GltfParts parts = character();
    variant.rewrite(parts);
    write("other.glb", to_glb(parts));
    must("convert other.glb --clip Walk --force -o other.bvh");
    const Result<std::unique_ptr<MotionFile>> other = read_motion(path("other.bvh"));
    ASSERT_TRUE(other.ok()) << variant.name;
    // Angles in BVH have six decimals of a degree.
    expect_same_positions((*plain)->clip(), (*other)->clip(), 2e-5f);
  }
}

}  // namespace
}  // namespace panache::test
