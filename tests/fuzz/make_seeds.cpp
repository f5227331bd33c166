// make_seeds FOLDER: the inputs that fuzzing starts from, FOLDER/TARGET/NAME: small files of each
// kind as the library writes them.

#include <algorithm>
#include <cstdio>

#include "base/file.h"
#include "clip/binary_fbx.h"
#include "clip/make_fbx.h"
#include "clip/make_fbx6.h"
#include "clip/make_fbx_scene.h"
#include "clip/bvh.h"
#include "clip/fbx.h"
#include "clip/gltf.h"
#include "clip/make_acclaim.h"
#include "clip/smpl.h"
#include "framed_json.h"
#include "learn/style_file.h"
#include "make_clip.h"
#include "make_model.h"
#include "net/layer.h"
#include "net/safetensors.h"
#ifdef PANACHE_NPZ
#include <zip.h>

#include "npz.h"
#endif

extern "C" size_t LLVMFuzzerMutate(uint8_t*, size_t size, size_t) {
  return size;
}  // Not used here.

namespace {

using namespace panache;

std::string folder;

void add(const std::string& name, const std::string& bytes) {
  const auto written = write_file(folder + "/" + name, bytes, true);
  if (written) return;
  std::fprintf(stderr, "make_seeds: %s\n", written.error().message.c_str());
  std::exit(1);
}

// A GLB of this JSON alone, whose length is padded to four bytes.
std::string glb_of(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<uint32_t>(json.size());
  return "glTF" + fuzz::bytes_of(uint32_t{2}) + fuzz::bytes_of(20 + size) + fuzz::bytes_of(size) +
         "JSON" + json;
}

// Two frames of the first joints of a clip: fuzzing is slow with large files.
Clip first_joints(const Clip& clip, size_t count) {
  Clip out;
  const auto& joints = clip.skeleton.joints;
  out.skeleton.joints.assign(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(count));
  out.frame_time = clip.frame_time;
  out.resize(2);
  for (int f = 0; f < out.frames; ++f) {
    std::ranges::copy(clip.pose(f).rotations.first(count), out.pose(f).rotations.begin());
    std::ranges::copy(clip.pose(f).translations.first(count), out.pose(f).translations.begin());
  }
  return out;
}

#ifdef PANACHE_NPZ
// The same archive, compressed.
std::string deflated(const std::string& npz) {
  zip_source_t* source = zip_source_buffer_create(npz.data(), npz.size(), 0, nullptr);
  zip_source_keep(source);
  zip_t* zip = zip_open_from_source(source, 0, nullptr);
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(i), ZIP_CM_DEFLATE, 9);
  }
  zip_close(zip);
  zip_source_open(source);
  zip_source_seek(source, 0, SEEK_END);
  std::string out(static_cast<size_t>(zip_source_tell(source)), '\0');
  zip_source_seek(source, 0, SEEK_SET);
  zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  zip_source_free(source);
  return out;
}
#endif

// Chains of pivots, layers of every kind, and models that are below themselves.
void add_fbx_scenes() {
  const std::vector<test::SceneModel> models = {
      {"hips", -1, {{"Lcl Translation", {0, 90, 0}}, {"InheritType", {0}}}},
      {"spine",
       0,
       {{"Lcl Translation", {0, 20, 0}},
        {"RotationPivot", {2, 3, -4}},
        {"ScalingPivot", {4, -3, 6}},
        {"Lcl Scaling", {1.5, 0.5, -1}},
        {"PreRotation", {20, -30, 40}},
        {"PostRotation", {-15, 25, 5}},
        {"RotationOrder", {4}}}},
      {"head", 1, {{"Lcl Translation", {0, 20, 0}}, {"InheritType", {2}}}}};
  const test::SceneCurve line = {{{0, 0}, {3, 40}}}, step = {{{0, 5}, {2, 9}}, 2};
  const test::SceneCurve cubic = {{{0, 0}, {3, 30}}, 0x8 | 0x400 | 0x1000000, {30, -60, 1, 0}};
  const std::vector<test::SceneStack> stacks = {
      {"walk",
       {{"BaseLayer", {}, {{0, 0, {{line, step, cubic}}}, {1, 1, {{line, {}, cubic}}}}},
        {"Layer2", {{"BlendMode", 0}, {"Weight", 50}}, {{1, 1, {{step, line, {}}}}}},
        {"Layer3",
         {{"BlendMode", 2}, {"RotationAccumulationMode", 0}},
         {{1, 1, {{line, line, line}}}, {2, 2, {{line, line, line}}}}}}}};
  const std::string text = test::make_fbx_scene(models, stacks);
  add("fbx/chain", text);
  add("fbx/chain-packed", test::to_binary_fbx7(text, 7400, true));
  add("fbx/shuffled", test::make_fbx_scene(models, stacks, {.reversed = true, .up_axis = 2}));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out = text;
    const size_t at = out.find(from);
    if (at == out.npos) std::exit(1);
    return out.replace(at, from.size(), to);
  };
  add("fbx/cycle", with("C: \"OO\",2000,0", "C: \"OO\",2000,2002"));
  add("fbx/below-itself", with("C: \"OO\",2001,2000", "C: \"OO\",2001,2001"));
  // Objects 5000 to 5003 are the stack, its base layer, and a curve node with its first curve.
  const std::string root = "C: \"OO\",2000,0";
  add("fbx/layer-in-itself", with(root, root + "\n\tC: \"OO\",5001,5001\n\tC: \"OO\",5000,5001"));
  add("fbx/node-in-two-layers",
      with(root, root + "\n\tC: \"OO\",5002,5000\n\tC: \"OP\",5002," + "2001, \"Lcl Scaling\""));
  add("fbx/curve-as-weight",
      with(root, root + "\n\tC: \"OP\",5002,5001, \"Weight\"\n\tC: \"OP\",5003,5003, \"d|X\""));
  add("fbx/short-chain",
      with("\"RotationPivot\", \"\", \"\", \"\",2,3,-4", "\"RotationPivot\", \"\", \"\", \"\",2"));
  add("fbx/far-pivot", with("\"ScalingPivot\", \"\", \"\", \"\",4,-3,6",
                            "\"ScalingPivot\", \"\", \"\", \"\",1e9,-1e300,nan"));
  add("fbx/flat", with("\"\",1.5,0.5,-1", "\"\",0,0.5,-1e-9"));
  add("fbx/keys-back", with("KeyTime: *2 {\n\t\t\ta: 0,", "KeyTime: *2 {\n\t\t\ta: 99999999999,"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  folder = argv[1];
  const Clip walk = test::walking_clip(8);
  add("bvh/walk", format_bvh(walk));
  add("gltf/walk", format_glb(walk, "walk", 1, Quat{}));
  add("glb/walk", format_glb(walk, "walk", 1, Quat{}));
  add("glb/pictures",
      glb_of(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"},{"uri":)"
             R"("data:,"}],"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],)"
             R"("materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}}]})"));
  add("gltf/avatar", format_vrma(walk, "walk"));
  const char* text =
      R"({"asset":{"version":"2.0"},"nodes":[{"name":"a","children":[1]},{"name":"b","matrix":[1,0,0,0,)"
      R"(0,1,0,0,0,0,1,0,0,0,0,1]}],"skins":[{"joints":[0,1]}],"meshes":[{"primitives":[{"attributes":{)"
      R"("JOINTS_0":0,"WEIGHTS_0":1}}]}],"accessors":[{"componentType":5121,"count":1,"type":"VEC4"},{)"
      R"("componentType":5126,"count":1,"type":"VEC4","sparse":{"count":1,"indices":{"bufferView":0,)"
      R"("componentType":5123},"values":{"bufferView":0}}}],"bufferViews":[{"buffer":0,"byteLength":24}],)"
      R"("buffers":[{"byteLength":24,"uri":"data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],"animations":)"
      R"([{"samplers":[{"input":0,"output":1,"interpolation":"CUBICSPLINE"}],"channels":[{"sampler":0,)"
      R"("target":{"node":0,"path":"rotation"}}]}],"extensions":{"VRM":{"humanoid":{"humanBones":[{"bone":)"
      R"("hips","node":0}]}}}})";
  add("gltf/text", text);
  add("glb/text", text);
  std::string arrays;
  for (const char* wanted : {"poses", "trans", "mocap_framerate", "betas", "gender"}) {
    for (const NpzMember& member : format_smpl(smpl_body())) {
      if (member.name != std::string(wanted) + ".npy") continue;
      arrays += fuzz::bytes_of(static_cast<uint32_t>(member.bytes.size())) + member.bytes;
    }
  }
  add("smpl/walk", arrays);
#ifdef PANACHE_NPZ
  const std::string npz = cli::kWriteNpz(smpl_body(), "walk", {}, nullptr);
  add("npz/stored", npz);
  add("npz/deflated", deflated(npz));
  std::string twice = npz;  // Two members of one name.
  for (size_t at; (at = twice.find("betas.npy")) != std::string::npos;) {
    twice.replace(at, 9, "trans.npy");
  }
  add("npz/twice", twice);
#endif
  test::AcclaimMaker acclaim(walk);
  add("acclaim/skeleton", acclaim.asf());
  add("acclaim/motion", std::string("\0", 1) + acclaim.amc());
  const TensorFile model = test::make_model({"old", "proud"});
  add("model/floats", format_safetensors(model));
  add("model/int8", format_safetensors(quantize(model)));
  add("model/recipe", format_safetensors(test::make_model({"old"}, 1, test::kSmith2019)));
  if (const auto style = extract_style(model, "old", "model")) {
    add("model/style", format_safetensors(*style));
  }
  add("step/calls", std::string(200, '\x37') + std::string(100, '\x01'));
  add("threads/calls", std::string(200, '\x37') + std::string(100, '\x01'));
  add("text/map", std::string("\0", 1) + R"({"leftHand": "Hand_L", "neck": null})");
  std::string bone("\1/VMC/Ext/Bone/Pos\0\0\0,sfffffff\0\0\0Hips\0\0\0\0", 41);
  add("text/bone", bone + std::string(28, '\0'));
  add("text/bundle",
      std::string("\1#bundle\0\0\0\0\0\0\0\0\1\0\0\0\20/VMC/Ext/OK\0,i\0\0\0\0\0\1", 41));
  add("text/table", "\2path,style,content,take,neutral,split\r\n\"a,\"\"b\",old,walk,1,0,train\n");
  add("manifest/walks",
      "path,style,content,take,neutral,split\nwalk.bvh,normal,walk,1,1,train\n"
      "short.bvh,old,walk,1,0,train\nwalk.bvh,\"a b\",walk,1,0,test\n" +
          std::string(1, '\0') + "name,from,description\nold,old a,bent\n");
  add("vmc/calls", std::string(300, '\x37') + std::string(100, '\x01'));
  add("scene/calls", std::string(300, '\x37') + std::string(100, '\x01'));
  const Clip steps = first_joints(walk, 3);
  const std::string six = test::Fbx6Maker(steps, 2, 1, {{"hips", {-1, 1, 1}}}).make();
  add("fbx/text6", six);
  add("fbx/binary6", test::to_binary_fbx6(six));
  const std::string seven = test::format_fbx(steps);
  add("fbx/text7", seven);
  add("fbx/packed", test::to_binary_fbx7(seven, 7400, true));
  add("fbx/wide", test::to_binary_fbx7(seven, 7500, false));
  add("fbx/new", format_fbx(steps.skeleton, {{&steps, "walk"}}, 1, Quat{}));
  add_fbx_scenes();
  add("text/strengths", "\3seconds,old\n0,0\n1.5,1e0\n");
  return 0;
}
