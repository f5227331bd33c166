#include "clip/gltf.h"

#include <cassert>
#include <utility>
#include <vector>

#include "clip/deform_tree.h"
#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"

namespace panache {
namespace {

class GltfFile final : public MotionFile {
 public:
  GltfFile(GltfDocument document, bool one_motion)
      : document_(std::move(document)), one_motion_(one_motion) {}

  std::vector<std::string> clip_names() const override {
    std::vector<std::string> names;
    names.reserve(document_.animations.size());
    for (const GltfAnimation& animation : document_.animations) names.push_back(animation.name);
    return names;
  }
  std::vector<std::string> notes() const override { return document_.notes; }
  bool is_mended() const override { return !document_.notes.empty(); }
  const Clip& clip(int which) const override {
    assert(which >= 0);
    if (document_.animations.empty()) return document_.rest;
    return document_.animations[which].clip;
  }
  Clip rest() const override {
    Clip out = document_.rest;
    for (Joint& joint : out.skeleton.joints) joint.can_translate = joint.can_rotate;
    return out;
  }
  std::string encode(std::span<const ClipEdit> edits, EditMode mode) const override {
    return encode_gltf(document_, edits, one_motion_ ? EditMode::replace : mode);
  }

 private:
  GltfDocument document_;
  bool one_motion_;
};

Result<GltfDocument> read_once(std::string bytes, const std::string& name,
                               std::optional<double> fps) {
  GltfChecker checker(name);
  GltfDocument document;
  if (!read_gltf_container(std::move(bytes), name, checker, document.container)) {
    return checker.error();
  }
  // Packed meshes alone stay packed in the output.
  std::optional<GltfContainer> plain;
  if (has_packed_data(document.container)) {
    const bool is_needed = has_packed_motion(document.container);
    GltfChecker unpacking(name);
    GltfContainer unpacked;
    if (unpack_gltf(document.container, unpacking, unpacked)) {
      (is_needed ? document.container : plain.emplace()) = std::move(unpacked);
    } else if (is_needed) {
      return unpacking.error();
    }
  }
  if (!read_gltf_nodes(document, checker) || !read_gltf_channels(document, checker)) {
    return checker.error();
  }
  read_gltf_weights(plain ? *plain : document.container, document);
  if (!build_gltf_skeleton(document, checker) || !read_gltf_clips(document, checker, fps)) {
    return checker.error();
  }
  return document;
}

// If keys need other times, rewrites them and reads the file again.
Result<GltfDocument> read_document(std::string bytes, const std::string& name,
                                   const ReadOptions& options) {
  Result<GltfDocument> document = read_once(std::move(bytes), name, {});
  if (!document) return document;
  RetimedGltf retimed;
  GltfChecker checker(name);
  if (!retime_gltf(*document, options.fps, name, checker, retimed)) return checker.error();
  if (retimed.bytes.empty()) return document;
  document = read_once(std::move(retimed.bytes), name, options.fps);
  if (document) document->notes = std::move(retimed.notes);
  return document;
}

std::unique_ptr<MotionFile> make_file(GltfDocument document, bool one_motion) {
  return std::make_unique<GltfFile>(std::move(document), one_motion);
}

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_gltf(std::string bytes, const std::string& name,
                                               const ReadOptions& options) {
  Result<GltfDocument> document = read_document(std::move(bytes), name, options);
  if (!document) return document.error();
  return join_deforming_joints(make_file(*std::move(document), false));
}

Result<std::string> whole_character(
    std::string bytes, const std::string& name, bool completes_skin,
    const std::function<std::optional<SkinnedBody>(const MotionFile&)>& make_body) {
  Result<GltfDocument> document = read_document(bytes, name, {});
  if (!document) return document.error();
  const auto skins = document->container.json.find("skins");
  if (skins != document->container.json.end() && skins->size() == 1) {
    return completes_skin ? with_whole_skin(*document) : bytes;
  }
  if (!lacks_figure(*document)) return bytes;
  const GltfFile file(*document, false);
  const std::optional<SkinnedBody> body = make_body(file);
  return with_figure(*document, body ? &*body : nullptr);
}

Result<std::unique_ptr<MotionFile>> parse_vrma(std::string bytes, const std::string& name,
                                               const ReadOptions& options) {
  Result<GltfDocument> document = read_document(std::move(bytes), name, options);
  if (!document) return document.error();
  const GltfJson::json_pointer hips("/extensions/VRMC_vrm_animation/humanoid/humanBones/hips/node");
  if (!document->container.json.contains(hips)) {
    return Error{name +
                 ": extensions.VRMC_vrm_animation: expected a humanoid with hips, found none; a "
                 "file without it is a .glb"};
  }
  const std::vector<Vec3> offsets = t_pose_offsets(document->rest);
  stand_in_t_pose(offsets, document->rest);
  for (GltfAnimation& animation : document->animations) stand_in_t_pose(offsets, animation.clip);
  return make_file(*std::move(document), true);
}

namespace {

constexpr const char* kVrmAnimation = "VRMC_vrm_animation";

class GlbFormatter {
 public:
  GlbFormatter(const Clip& clip, const std::string& name, double metres_per_unit, Quat to_y_up)
      : clip_(clip), name_(name), scale_(metres_per_unit), turn_(to_y_up.as<double>()) {
    assert(metres_per_unit > 0);
  }

  std::string format(const SkinnedBody* body) {
    begin();
    add_figure({0, 0}, json_, bytes_, figure_joints(), name_, body);
    return end();
  }

  // Makes a VRM animation: without a figure, but with a humanoid.
  std::string format_vrma() {
    begin();
    add_humanoid();
    return end();
  }

 private:
  void begin() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Panache"}};
    json_["scene"] = 0;
    json_["scenes"][0]["nodes"].push_back(0);
    add_nodes();
    json_["buffers"][0]["byteLength"] = 0;
  }

  std::string end() {
    add_animation();

    GltfContainer container;
    container.binary = true;
    container.has_bin = true;
    container.buffers.emplace_back("");
    return write_gltf_container(container, std::move(json_), bytes_);
  }

  // Adds the top node, the joints, then the End Sites.
  void add_nodes() {
    const Skeleton& skeleton = clip_.skeleton;
    GltfJson above = {{"name", name_}, {"children", GltfJson::array()}};
    const Quat turn = turn_.as<float>();
    above["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    above["scale"] = {scale_, scale_, scale_};
    json_["nodes"].push_back(std::move(above));
    for (const Joint& joint : skeleton.joints) {
      GltfJson node = {{"name", joint.name}};
      node["translation"] = {joint.offset.x, joint.offset.y, joint.offset.z};
      node["rotation"] = {joint.rest.x, joint.rest.y, joint.rest.z, joint.rest.w};
      json_["nodes"].push_back(std::move(node));
    }
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      json_["nodes"][node_above(j)]["children"].push_back(j + 1);
    }
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
      for (const Vec3 end : skeleton.joints[j].ends) {
        json_["nodes"][j + 1]["children"].push_back(json_["nodes"].size());
        json_["nodes"].push_back({{"name", skeleton.joints[j].name + " end"},
                                  {"translation", {end.x, end.y, end.z}},
                                  {"extras", {{kEndSite, true}}}});
      }
    }
  }

  void add_humanoid() {
    json_["extensionsUsed"].push_back(kVrmAnimation);
    GltfJson& animation = json_["extensions"][kVrmAnimation];
    animation["specVersion"] = "1.0";
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const std::string& role = clip_.skeleton.joints[j].role;
      if (!role.empty()) animation["humanoid"]["humanBones"][role]["node"] = j + 1;
    }
  }

  size_t node_above(size_t joint) const { return clip_.skeleton.joints[joint].parent + 1; }

  // The joints and the End Sites, for the skin.
  std::vector<FigureJoint> figure_joints() const {
    const Affine above = affine(turn_, {}, {scale_, scale_, scale_});
    std::vector<FigureJoint> out;
    const auto add = [&](int parent, int clip_joint, const Affine& local) {
      const Affine world = (parent < 0 ? above : out[parent].world) * local;
      out.push_back({.node = out.size() + 1,
                     .parent = parent,
                     .clip_joint = clip_joint,
                     .local = local,
                     .world = world});
    };
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const Joint& joint = clip_.skeleton.joints[j];
      add(joint.parent, static_cast<int>(j),
          affine(joint.rest.as<double>(), joint.offset.as<double>()));
      out.back().wanders = wanders(clip_, j);
    }
    for (size_t j = 0; j < clip_.joints(); ++j) {
      for (const Vec3 end : clip_.skeleton.joints[j].ends) {
        add(static_cast<int>(j), -1, affine({}, end.as<double>()));
      }
    }
    return out;
  }

  void add_animation() {
    GltfDataWriter data({0, 0}, json_, bytes_);
    GltfJson channels = GltfJson::array(), samplers = GltfJson::array();
    size_t input = 0;
    const auto add = [&](size_t joint, const char* path, size_t components,
                         const std::vector<float>& numbers) {
      if (samplers.empty()) input = data.add_times(0, clip_.frame_time, clip_.frames);
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", joint + 1}, {"path", path}}}});
      samplers.push_back(
          {{"input", input},
           {"interpolation", "LINEAR"},
           {"output", data.add(numbers, components == 3 ? "VEC3" : "VEC4", components)}});
    };
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const Joint& joint = clip_.skeleton.joints[j];
      if (joint.can_translate) add(j, "translation", 3, translations_of(j));
      if (joint.can_rotate) add(j, "rotation", 4, turns_of(j));
    }
    if (channels.empty()) return;
    GltfJson& animation = json_["animations"][0];
    animation["name"] = name_;
    animation["channels"] = std::move(channels);
    animation["samplers"] = std::move(samplers);
  }

  std::vector<float> translations_of(size_t joint) const {
    std::vector<float> numbers;
    for (int f = 0; f < clip_.frames; ++f) {
      const Vec3 t = clip_.pose(f).translations[joint];
      numbers.insert(numbers.end(), {t.x, t.y, t.z});
    }
    return numbers;
  }

  std::vector<float> turns_of(size_t joint) const {
    std::vector<float> numbers;
    Quat before;
    for (int f = 0; f < clip_.frames; ++f) {
      Quat q = clip_.pose(f).rotations[joint];
      // Of the two quaternions of a rotation, the one nearer to the previous frame's.
      if (f > 0 && dot(q, before) < 0) q = {-q.x, -q.y, -q.z, -q.w};
      numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w});
      before = q;
    }
    return numbers;
  }

  const Clip& clip_;
  const std::string& name_;
  double scale_;
  Quatd turn_;
  GltfJson json_;
  std::string bytes_;
};

}  // namespace

std::string format_glb(const Clip& clip, const std::string& clip_name, double metres_per_unit,
                       Quat to_y_up, const SkinnedBody* body) {
  return GlbFormatter(clip, clip_name, metres_per_unit, to_y_up).format(body);
}

std::string format_vrma(const Clip& clip, const std::string& clip_name) {
  return GlbFormatter(clip, clip_name, 1, {}).format_vrma();
}

}  // namespace panache
