#include "clip/gltf_encode.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/bytes.h"
#include "clip/gltf_scales.h"

namespace panache {
namespace {

constexpr int kFloat = 5126;

const char* path_name(GltfPath path) {
  return path == GltfPath::rotation ? "rotation" : "translation";
}

// Writes the animation of one edit.
class AnimationWriter {
 public:
  AnimationWriter(const GltfDocument& document, const ClipEdit& edit, GltfDataWriter data)
      : document_(document),
        changed_(*edit.changed),
        source_frames_(edit.source_frames),
        data_(data),
        // An edit without an animation of the file is a change of the rest pose.
        animation_(edit.clip == kNewClip || document.animations.empty()
                       ? nullptr
                       : &document.animations[edit.clip]),
        clip_(animation_ ? animation_->clip : document.rest),
        frame_time_(edit.clip == kNewClip ? changed_.frame_time : clip_.frame_time) {
    if (edit.clip == kNewClip) {
      at_rest_.assign(changed_.frames, 0.0);
      source_frames_ = at_rest_;
    }
    assert(changed_.joints() == clip_.joints() && changed_.frames > 0);
    assert(source_frames_.size() == size_t(changed_.frames));
    if (animation_) start_ = animation_->start;
    keeps_time_ = changed_.frames == clip_.frames;
    for (int i = 0; i < changed_.frames; ++i) keeps_time_ = keeps_time_ && source_frames_[i] == i;
    find_poses();
  }

  // The animation's JSON; without channels if the file has no animation and nothing moves.
  GltfJson write() {
    GltfJson result = GltfJson::object();
    if (animation_) {
      result = document_.container.json["animations"][animation_index()];
      const std::vector<GltfChannel>& channels = animation_->channels;
      kept_samplers_.assign(result["samplers"].size(), -1);
      for (size_t c = 0; c < channels.size(); ++c) write_channel(result, c, channels[c]);
    }
    for (size_t j = 0; j < clip_.joints(); ++j) {
      const int node = document_.joint_nodes[j];
      for (const GltfPath path : {GltfPath::rotation, GltfPath::translation}) {
        if (!has_channel(node, path)) add_channel(node, static_cast<int>(j), path);
      }
    }
    result["channels"] = std::move(channels_);
    result["samplers"] = std::move(samplers_);
    return result;
  }

 private:
  // Computes the file's poses at the source times of the new frames, the new frames in the file's
  // terms, and which of their positions differ from the file's.
  void find_poses() {
    source_.skeleton = in_file_.skeleton = clip_.skeleton;
    source_.resize(changed_.frames);
    in_file_.resize(changed_.frames);
    moved_.resize(in_file_.translations.size());
    const std::vector<GltfTrack> tracks = read_scale_tracks();
    GltfScales scales =
        animation_ ? GltfScales(document_, *animation_, tracks) : GltfScales(document_);
    std::vector<Stretch> above(clip_.joints());
    for (int i = 0; i < changed_.frames; ++i) {
      sample(clip_, source_frames_[i], source_.pose(i));
      const double at = source_seconds(i), tolerance = key_tolerance(at, frame_time_);
      const Pose then = source_.pose(i), out = in_file_.pose(i);
      const ConstPose now = changed_.pose(i);
      scales.set_clip_pose(at, tolerance, then.rotations);
      for (size_t j = 0; j < clip_.joints(); ++j) above[j] = scales.above(j);
      scales.set_clip_pose(at, tolerance, now.rotations);
      for (size_t j = 0; j < clip_.joints(); ++j) {
        out.rotations[j] = file_rotation(now.rotations[j], scales.turn(j));
        out.translations[j] = scales.above(j).undo(now.translations[j]);
        moved_[i * clip_.joints() + j] =
            !(now.translations[j] == then.translations[j]) || !(scales.above(j) == above[j]);
      }
    }
  }
  std::vector<GltfTrack> read_scale_tracks() const {
    std::vector<GltfTrack> tracks(animation_ ? animation_->channels.size() : 0);
    for (size_t c = 0; c < tracks.size(); ++c) {
      const GltfChannel& channel = animation_->channels[c];
      if (channel.path == GltfPath::scale) tracks[c] = track_of(channel);
    }
    return tracks;
  }
  GltfTrack track_of(const GltfChannel& channel) const {
    GltfChecker checker("");
    GltfTrack track;
    [[maybe_unused]] const bool read =
        read_gltf_track(document_, animation_index(), channel, checker, track);
    assert(read);  // It was valid when it was read.
    return track;
  }

  // The time in the file of the frame that the new one came from.
  double source_seconds(int frame) const {
    const double source = source_frames_[frame], last = clip_.frames - 1;
    return seconds(source > 0 ? std::min(source, last) : 0.0);
  }

  // Whether the joint of a channel is unchanged at `frame`; scale, weights and nodes that are not
  // joints (-1) always are.
  bool is_same(int frame, int joint, GltfPath path) const {
    if (joint < 0) return true;
    if (path == GltfPath::translation) return !moved_[frame * clip_.joints() + joint];
    return path != GltfPath::rotation ||
           changed_.pose(frame).rotations[joint] == source_.pose(frame).rotations[joint];
  }
  bool is_same(int joint, GltfPath path) const {
    if (path != GltfPath::rotation && path != GltfPath::translation) return true;
    for (int i = 0; i < changed_.frames; ++i) {
      if (!is_same(i, joint, path)) return false;
    }
    return true;
  }

  double seconds(double frame) const { return start_ + frame * frame_time_; }
  size_t animation_index() const { return animation_ - document_.animations.data(); }

  bool has_channel(int node, GltfPath path) const {
    if (!animation_) return false;
    return std::ranges::any_of(animation_->channels, [&](const GltfChannel& channel) {
      return channel.node == node && channel.path == path;
    });
  }

  void write_channel(const GltfJson& animation, size_t which, const GltfChannel& channel) {
    GltfJson json = animation["channels"][which];
    const GltfJson& sampler = animation["samplers"][channel.sampler];
    if (channel.path == GltfPath::other) return keep(std::move(json), channel, sampler);
    // A node whose mesh has weights need not be a joint, and one that carries an expression never
    // is.
    const int joint = document_.nodes[channel.node].joint;
    const bool same = is_same(joint, channel.path);
    if (same && keeps_time_) return keep(std::move(json), channel, sampler);

    const GltfTrack track = track_of(channel);
    // A single key holds at all times, unless it is beyond the new end.
    const bool holds = track.times.size() == 1 && track.times[0] <= seconds(changed_.frames - 1);
    if (same && holds) return keep(std::move(json), channel, sampler);
    json["sampler"] = add_sampler(sampler, track, joint, channel.path, same);
    channels_.push_back(std::move(json));
  }

  // Keeps a channel with the file's own sampler, which other channels may share.
  void keep(GltfJson channel, const GltfChannel& read, const GltfJson& sampler) {
    int& kept = kept_samplers_[read.sampler];
    if (kept < 0) {
      kept = static_cast<int>(samplers_.size());
      samplers_.push_back(sampler);
    }
    channel["sampler"] = kept;
    channels_.push_back(std::move(channel));
  }

  void add_channel(int node, int joint, GltfPath path) {
    const GltfNode& placed = document_.nodes[node];
    if (placed.matrix || is_same(joint, path)) return;
    const size_t sampler =
        add_sampler(GltfJson::object(), rest_gltf_track(placed, path), joint, path, false);
    channels_.push_back(
        {{"sampler", sampler}, {"target", {{"node", node}, {"path", path_name(path)}}}});
  }

  // Adds a sampler with a key per frame, otherwise like `like`; returns its index in the animation.
  size_t add_sampler(GltfJson like, const GltfTrack& track, int joint, GltfPath path, bool same) {
    const std::vector<float> numbers = new_numbers(track, joint, path);
    const bool vectors = path == GltfPath::translation || path == GltfPath::scale;
    like["input"] = times_accessor();
    const bool stays_step = same && track.interpolation == GltfTrack::Interpolation::step;
    like["interpolation"] = stays_step ? "STEP" : "LINEAR";
    if (path == GltfPath::weights) {
      like["output"] = data_.add(numbers, "SCALAR", 1);
    } else {
      like["output"] = data_.add(numbers, vectors ? "VEC3" : "VEC4", track.components);
    }
    samplers_.push_back(std::move(like));
    return samplers_.size() - 1;
  }

  // A value per frame: the file's own at that time if nothing changed, so on a key its exact bits.
  std::vector<float> new_numbers(const GltfTrack& track, int joint, GltfPath path) const {
    const size_t n = track.components;
    std::vector<float> numbers(changed_.frames * n);
    for (int i = 0; i < changed_.frames; ++i) {
      const std::span<float> out = std::span(numbers).subspan(i * n, n);
      const ConstPose in_file = in_file_.pose(i);
      if (is_same(i, joint, path)) {
        const double at = source_seconds(i);
        track.evaluate(at, key_tolerance(at, frame_time_), out);
      } else if (path == GltfPath::translation) {
        const Vec3 v = in_file.translations[joint];
        out[0] = v.x, out[1] = v.y, out[2] = v.z;
      } else {
        Quat q = in_file.rotations[joint];
        // Of the two quaternions of a rotation, the one nearer to the previous frame's.
        const float* p = out.data() - 4;
        if (i > 0 && dot(q, Quat{p[0], p[1], p[2], p[3]}) < 0) q = {-q.x, -q.y, -q.z, -q.w};
        out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
      }
    }
    return numbers;
  }

  // The times of the frames, which all new samplers share.
  size_t times_accessor() {
    if (times_ < 0) {
      times_ = static_cast<int>(data_.add_times(start_, frame_time_, changed_.frames));
    }
    return times_;
  }

  const GltfDocument& document_;
  const Clip& changed_;
  std::span<const double> source_frames_;
  GltfDataWriter data_;
  const GltfAnimation* animation_;  // Of the file; null for a new clip.
  const Clip& clip_;                // The clip as read.
  double frame_time_;
  std::vector<double> at_rest_;  // [frames] of a new clip, 0.
  double start_ = 0;
  bool keeps_time_ = false;
  Clip source_;                     // What the file has at the times of the new frames.
  Clip in_file_;                    // The new frames in the file's terms.
  std::vector<char> moved_;         // [frames][joints] 1 if the position differs from the file's.
  std::vector<int> kept_samplers_;  // [samplers of the file] new index of each; -1 for none yet.
  GltfJson channels_ = GltfJson::array();
  GltfJson samplers_ = GltfJson::array();
  int times_ = -1;  // Accessor of the frames' times; -1 if not needed yet.
};

}  // namespace

size_t GltfDataWriter::add(std::span<const float> numbers, std::string_view type, size_t components,
                           bool bounds) {
  const size_t begin = bytes_.size();
  if (view_ < 0) {
    view_ = static_cast<int>(json_["bufferViews"].size());
    first_ = begin;
    json_["bufferViews"].push_back({{"buffer", added_at_.buffer},
                                    {"byteOffset", added_at_.offset + begin},
                                    {"byteLength", 0}});
  }
  for (const float number : numbers) {
    append_little_endian(std::bit_cast<uint32_t>(number), 4, bytes_);
  }
  json_["bufferViews"][view_]["byteLength"] = bytes_.size() - first_;
  GltfJson accessor = {{"bufferView", view_},
                       {"byteOffset", begin - first_},
                       {"componentType", kFloat},
                       {"count", numbers.size() / components},
                       {"type", type}};
  if (bounds) {
    const auto [min, max] = std::ranges::minmax(numbers);
    accessor["min"].push_back(min);
    accessor["max"].push_back(max);
  }
  json_["accessors"].push_back(std::move(accessor));
  return json_["accessors"].size() - 1;
}

size_t GltfDataWriter::add_times(double start, double frame_time, int frames) {
  std::vector<float> times;
  for (int f = 0; f < frames; ++f) {
    float time = static_cast<float>(start + f * frame_time);
    // Far from zero, floats are further apart than frames; times must increase nevertheless.
    if (f > 0) time = std::max(time, std::nextafter(times.back(), HUGE_VALF));
    times.push_back(time);
  }
  return add(times, "SCALAR", 1, true);
}

std::string encode_gltf(const GltfDocument& document, std::span<const ClipEdit> edits,
                        EditMode mode) {
  GltfJson json = document.container.json;
  std::string added;
  TakenNames names;
  const bool only_new =
      mode == EditMode::replace &&
      std::ranges::any_of(edits, [](const ClipEdit& edit) { return edit.clip == kNewClip; });
  if (only_new) {
    json.erase("animations");
  } else {
    for (const GltfAnimation& animation : document.animations) unique_name(animation.name, names);
  }
  std::vector<GltfJson> new_animations;
  for (const ClipEdit& edit : edits) {
    const GltfDataWriter data(gltf_added_at(document.container), json, added);
    GltfJson animation = AnimationWriter(document, edit, data).write();
    if (animation["channels"].empty()) continue;  // glTF requires at least one channel.
    if (mode == EditMode::replace && edit.clip != kNewClip && !document.animations.empty()) {
      json["animations"][edit.clip] = std::move(animation);
      continue;
    }
    const size_t number = document.animations.size() + new_animations.size() + 1;
    animation["name"] =
        unique_name(edit.name.empty() ? "animation " + std::to_string(number) : edit.name, names);
    new_animations.push_back(std::move(animation));
  }
  if (!new_animations.empty()) {
    GltfJson& all = json["animations"];
    if (all.is_null()) all = GltfJson::array();
    size_t at = mode == EditMode::add_first ? 0 : all.size();
    for (GltfJson& animation : new_animations) {
      all.insert(all.begin() + at++, std::move(animation));
    }
  }
  return write_gltf_container(document.container, std::move(json), added);
}

}  // namespace panache
