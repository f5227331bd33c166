#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "clip/gltf_document.h"
#include "clip/gltf_scales.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

std::string animation_path(size_t which) { return item_path("animations", which); }

GltfPath path_named(const std::string& name) {
  if (name == "rotation") return GltfPath::rotation;
  if (name == "translation") return GltfPath::translation;
  if (name == "scale") return GltfPath::scale;
  if (name == "weights") return GltfPath::weights;
  return GltfPath::other;
}

// Numbers in a value of `path`; 0 for weights, whose number is that of the mesh's targets.
size_t components_of(GltfPath path) {
  return path == GltfPath::rotation ? 4 : path == GltfPath::weights ? 0 : 3;
}

class ChannelReader {
 public:
  explicit ChannelReader(GltfDocument& document) : document_(document) {}

  bool read(const GltfPart& root) {
    const std::vector<GltfPart> list = root.list("animations");
    if (list.size() > kGltfMaxAnimations) {
      return root.member("animations")
          .fail("expected at most " + std::to_string(kGltfMaxAnimations) + ", found " +
                std::to_string(list.size()));
    }
    document_.animations.resize(list.size());
    for (size_t a = 0; a < list.size(); ++a) read_animation(list[a], a);
    return root.ok();
  }

 private:
  void read_animation(const GltfPart& part, size_t which) {
    GltfAnimation& animation = document_.animations[which];
    const std::string name = part.text("name");
    animation.name =
        unique_name(name.empty() ? "animation " + std::to_string(which + 1) : name, names_);
    const size_t samplers = part.size("samplers");
    std::set<std::pair<int, GltfPath>> targets;
    for (const GltfPart& channel : part.list("channels")) {
      const GltfChannel read = read_channel(channel, samplers);
      if (read.path != GltfPath::other && !targets.insert({read.node, read.path}).second) {
        channel.fail("expected a target of its own, found that of a channel before it");
      }
      animation.channels.push_back(read);
    }
  }

  GltfChannel read_channel(const GltfPart& part, size_t samplers) {
    GltfChannel channel;
    channel.sampler = part.index("sampler", samplers);
    const GltfPart target = part.object("target");
    if (channel.sampler < 0 || !target) {
      part.fail("expected a sampler and a target, one of the two is missing");
    }
    channel.node = target.index("node", document_.nodes.size());
    const std::string moved = target.text("path");
    if (channel.node < 0) return channel;
    GltfNode& node = document_.nodes[channel.node];
    channel.path = path_named(moved);
    // glTF does not allow animation of a node that has a matrix.
    if (node.matrix && channel.path != GltfPath::weights) channel.path = GltfPath::other;
    const bool moves = channel.path != GltfPath::weights && channel.path != GltfPath::other;
    if (moves && !node.carrier) node.moves = true;
    return channel;
  }

  GltfDocument& document_;
  TakenNames names_;
};

class ClipReader {
 public:
  ClipReader(GltfDocument& document, GltfChecker& checker, std::optional<double> fps)
      : document_(document), checker_(checker), fps_(fps) {}

  bool read() {
    const size_t skeletons = document_.animations.size() * document_.joint_nodes.size();
    if (skeletons > kGltfMaxSkeletons) {
      return checker_.fail("animations", "expected at most " + std::to_string(kGltfMaxSkeletons) +
                                             " joints in all of them, found " +
                                             std::to_string(skeletons));
    }
    for (size_t a = 0; a < document_.animations.size(); ++a) {
      if (!read_tracks(a) || !make_room(a) || !fill(a)) return false;
      mark_still_joints(document_.animations[a].clip);
    }
    return true;
  }

 private:
  // Reads the keys of all channels that we support.
  bool read_tracks(size_t which) {
    const std::vector<GltfChannel>& channels = document_.animations[which].channels;
    tracks_.assign(channels.size(), {});
    for (size_t c = 0; c < channels.size(); ++c) {
      if (channels[c].path == GltfPath::other) continue;
      if (!read_gltf_track(document_, which, channels[c], checker_, tracks_[c])) return false;
      values_ += tracks_[c].times.size() + tracks_[c].numbers.size();
      const size_t max = gltf_max_values(document_.container.size);
      if (values_ > max) {
        return checker_.fail(animation_path(which), "expected at most " + std::to_string(max) +
                                                        " numbers in all animations of a file of " +
                                                        std::to_string(document_.container.size) +
                                                        " bytes, found more");
      }
    }
    return true;
  }

  // The channel whose keys determine the frames: the one that rotates or moves a node with the most
  // keys. One or two equal keys only hold a pose.
  const GltfTrack* deciding_track(const GltfAnimation& animation) const {
    const GltfTrack* max = nullptr;
    for (size_t c = 0; c < tracks_.size(); ++c) {
      const GltfPath path = animation.channels[c].path;
      if (path != GltfPath::rotation && path != GltfPath::translation) continue;
      if (joint_of(animation.channels[c]) < 0) continue;
      const GltfTrack& track = tracks_[c];
      if (track.times.size() <= 2 && track.is_constant()) continue;
      if (!max || track.times.size() > max->times.size()) max = &track;
    }
    return max;
  }

  bool make_room(size_t which) {
    GltfAnimation& animation = document_.animations[which];
    double first = INFINITY, last = -INFINITY;
    for (const GltfTrack& track : tracks_) {
      if (track.times.empty()) continue;
      first = std::min<double>(first, track.times.front());
      last = std::max<double>(last, track.times.back());
    }
    if (first > last) first = last = 0;
    const GltfTrack* deciding = deciding_track(animation);
    animation.has_rate = deciding && deciding->times.size() > 1;
    const FrameGrid grid = animation.has_rate && fps_ ? find_grid(deciding, first, last, 1 / *fps_)
                                                      : find_grid(deciding, first, last);
    poses_ += grid.frames * document_.joint_nodes.size();
    const size_t max = gltf_max_poses(document_.container.size);
    if (!(grid.frames <= kGltfMaxFrames) || !(poses_ <= max)) {
      return checker_.fail(animation_path(which),
                           "expected at most " + std::to_string(kGltfMaxFrames) +
                               " frames, and frames times joints in all animations at most " +
                               std::to_string(max) + ", found more");
    }
    animation.start = grid.start;
    animation.clip.skeleton = document_.skeleton;
    animation.clip.frame_time = grid.frame_time;
    animation.clip.resize(static_cast<int>(grid.frames));
    return true;
  }

  bool fill(size_t which) {
    GltfAnimation& animation = document_.animations[which];
    GltfScales scales(document_, animation, tracks_);
    const int far = fill_clip(document_, animation, tracks_, scales);
    return far < 0 || checker_.fail(item_path(animation_path(which) + ".channels", far),
                                    "expected positions between -1e9 and 1e9, found one outside");
  }

  // -1 for a node that carries an expression or a gaze.
  int joint_of(const GltfChannel& channel) const { return document_.nodes[channel.node].joint; }

  GltfDocument& document_;
  GltfChecker& checker_;
  std::optional<double> fps_;
  std::vector<GltfTrack> tracks_;  // [channels] of the current animation.
  size_t values_ = 0;
  double poses_ = 0;
};

}  // namespace

bool read_gltf_track(const GltfDocument& document, size_t which, const GltfChannel& channel,
                     GltfChecker& checker, GltfTrack& out) {
  const GltfPart root(document.container.json, checker);
  const GltfPart sampler = root.item("animations", which).item("samplers", channel.sampler);
  const size_t accessors = root.size("accessors");
  const int input = sampler.index("input", accessors), output = sampler.index("output", accessors);
  const std::string interpolation = sampler.text("interpolation", "LINEAR");
  if (input < 0 || output < 0) {
    sampler.fail("expected an input and an output, one of the two is missing");
  }
  if (!checker.ok()) return false;
  using enum GltfTrack::Interpolation;
  if (interpolation == "STEP") {
    out.interpolation = step;
  } else if (interpolation == "CUBICSPLINE") {
    out.interpolation = cubic;
  } else if (interpolation != "LINEAR") {
    return sampler.member("interpolation")
        .fail("expected LINEAR, STEP or CUBICSPLINE, found '" + interpolation.substr(0, 20) + "'");
  }
  GltfValues times, values;
  const std::string input_path = sampler.path() + ".input";
  const std::string output_path = sampler.path() + ".output";
  if (!read_gltf_accessor(document.container, input, input_path, checker, times) ||
      !read_gltf_accessor(document.container, output, output_path, checker, values)) {
    return false;
  }
  if (times.components != 1) return checker.fail(input_path, "expected numbers, found vectors");
  // Several exporters write two keys at one time, or one a rounding error early: see retime_gltf().
  constexpr float kEarly = 1e-3f;
  for (size_t i = 1; i < times.count; ++i) {
    if (times.numbers[i] >= times.numbers[i - 1] - kEarly) continue;
    return checker.fail(input_path, "expected times that increase, found time " +
                                        std::to_string(i) + " not after the one before it");
  }
  const size_t expected = components_of(channel.path);
  const size_t elements = times.count * (out.interpolation == cubic ? 3 : 1);
  const bool weights = expected == 0;
  if (weights ? values.components != 1 || values.count % elements != 0
              : values.components != expected || values.count != elements) {
    const std::string what =
        weights ? "a number of weights that is a multiple of "
                : "vectors of " + std::to_string(expected) + " numbers, in number ";
    return checker.fail(output_path, "expected " + what + std::to_string(elements) + " for " +
                                         std::to_string(times.count) + " times, found " +
                                         std::to_string(values.count) + " of " +
                                         std::to_string(values.components));
  }
  out.rotates = channel.path == GltfPath::rotation;
  out.components = weights ? values.count / elements : expected;
  out.times = std::move(times.numbers);
  out.numbers = std::move(values.numbers);
  return true;
}

GltfTrack rest_gltf_track(const GltfNode& node, GltfPath path) {
  GltfTrack track;
  track.rotates = path == GltfPath::rotation;
  track.components = components_of(path);
  track.times = {0};
  const Quat q = node.rotation;
  const Vec3 t = node.translation;
  if (track.rotates) {
    track.numbers = {q.x, q.y, q.z, q.w};
  } else {
    track.numbers = {t.x, t.y, t.z};
  }
  return track;
}

bool read_gltf_channels(GltfDocument& document, GltfChecker& checker) {
  return ChannelReader(document).read(GltfPart(document.container.json, checker));
}

bool read_gltf_clips(GltfDocument& document, GltfChecker& checker, std::optional<double> fps) {
  return ClipReader(document, checker, fps).read();
}

namespace {

// Sums the weights of the vertices of skinned meshes for each joint. Data that cannot be read, such
// as a compressed mesh, or is too large, is ignored: motion does not depend on it. Members are
// looked up without a GltfPart, which would build a path for each of a million primitives.
class WeightReader {
 public:
  WeightReader(const GltfContainer& container, GltfDocument& document)
      : container_(container),
        document_(document),
        json_(container.json),
        left_(gltf_max_values(container.size)) {}

  void read() {
    for (const GltfJson& node : list(json_, "nodes")) {
      const int skin = index(node, "skin", "skins"), mesh = index(node, "mesh", "meshes");
      if (skin < 0 || mesh < 0) continue;
      const GltfJson& joints = list(list(json_, "skins")[static_cast<size_t>(skin)], "joints");
      const GltfJson& primitives =
          list(list(json_, "meshes")[static_cast<size_t>(mesh)], "primitives");
      for (const GltfJson& primitive : primitives) {
        if (left_ == 0) return;
        for (int set = 0; set < kMaxSets && add_set(primitive, set, skin, joints); ++set) {
        }
      }
    }
  }

 private:
  static constexpr int kMaxSets = 16;

  static const GltfJson& list(const GltfJson& object, const char* key) {
    static const GltfJson kNone = GltfJson::array();
    if (!object.is_object()) return kNone;
    const auto member = object.find(key);
    return member == object.end() || !member->is_array() ? kNone : *member;
  }
  // The member `key` of an object as an index in the file's list `of`; -1 if it is not one.
  int index(const GltfJson& object, const char* key, const char* of) const {
    if (!object.is_object()) return -1;
    const auto member = object.find(key);
    if (member == object.end() || !member->is_number_unsigned()) return -1;
    const auto value = member->get<uint64_t>();
    return value < list(json_, of).size() ? static_cast<int>(value) : -1;
  }

  // Adds one set of four joints per vertex; returns whether there was one.
  bool add_set(const GltfJson& primitive, int set, int skin, const GltfJson& joints) {
    if (left_ == 0) return false;
    --left_;
    if (!primitive.is_object()) return false;
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end()) return false;
    const std::string number = std::to_string(set);
    GltfValues which, weights;
    const bool found = values(*attributes, "JOINTS_" + number, which) &&
                       values(*attributes, "WEIGHTS_" + number, weights);
    left_ -= std::min(left_, which.numbers.size() + weights.numbers.size());
    if (!found) return false;
    for (size_t i = 0; i < std::min(which.numbers.size(), weights.numbers.size()); ++i) {
      const auto slot = static_cast<size_t>(std::max(which.numbers[i], 0.0f));
      if (!(weights.numbers[i] > 0) || slot >= joints.size()) continue;
      // The skins were checked before, so these are nodes.
      GltfNode& node = document_.nodes[joints[slot].get<size_t>()];
      if (node.skin < 0) node.skin = skin;
      if (node.skin == skin) node.skin_weight += weights.numbers[i];
    }
    return true;
  }

  bool values(const GltfJson& attributes, const std::string& name, GltfValues& out) const {
    const int accessor = index(attributes, name.c_str(), "accessors");
    GltfChecker unheard("");
    return accessor >= 0 && read_gltf_accessor(container_, accessor, "", unheard, out);
  }

  const GltfContainer& container_;
  GltfDocument& document_;
  const GltfJson& json_;
  // Numbers and sets that may still be read: nodes and primitives may share a large mesh.
  size_t left_;
};

}  // namespace

void read_gltf_weights(const GltfContainer& container, GltfDocument& document) {
  WeightReader(container, document).read();
}

}  // namespace panache
