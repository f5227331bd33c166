// What JavaScript sees of it: functions of numbers and addresses. Who creates a thing frees it. A
// function that fails gives null, and panache_error() says why.

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "actor.h"
#include "clip/bvh.h"
#include "clip/gltf.h"
#include "golden.h"

using namespace panache;
using namespace panache::web;

#define PANACHE_EXPORT extern "C" __attribute__((visibility("default"), used))

namespace {

using ModelHandle = std::shared_ptr<const Model>;
using WalkerHandle = std::shared_ptr<const WalkerModel>;
using FileHandle = std::shared_ptr<const MotionFile>;

std::string last_error;

template <class T>
T* keep(Result<T> result) {
  if (result) return new T(*std::move(result));
  last_error = result.error().message;
  return nullptr;
}

std::string_view bytes_at(const char* data, uint32_t size) { return {data, size}; }

}  // namespace

// Strings and files on their way out: where their bytes are, and how many.
PANACHE_EXPORT const char* panache_bytes_data(const std::string* bytes) { return bytes->data(); }
PANACHE_EXPORT uint32_t panache_bytes_size(const std::string* bytes) {
  return static_cast<uint32_t>(bytes->size());
}
PANACHE_EXPORT void panache_bytes_free(std::string* bytes) { delete bytes; }
PANACHE_EXPORT const std::string* panache_error() { return &last_error; }

PANACHE_EXPORT ModelHandle* panache_model_create(const char* data, uint32_t size) {
  return keep(Model::parse(bytes_at(data, size), "the model"));
}
PANACHE_EXPORT void panache_model_free(ModelHandle* model) { delete model; }
PANACHE_EXPORT std::string* panache_model_describe(ModelHandle* model) {
  nlohmann::json styles = nlohmann::json::array();
  for (const StyleInfo& style : (*model)->styles()) {
    styles.push_back({{"name", style.name}, {"description", style.description}});
  }
  return new std::string(styles.dump());
}
// Two halves of the number, the lower first.
PANACHE_EXPORT void panache_model_golden(ModelHandle* model, uint32_t* out) {
  const uint64_t hash = golden_hash(*model);
  out[0] = static_cast<uint32_t>(hash);
  out[1] = static_cast<uint32_t>(hash >> 32);
}

PANACHE_EXPORT WalkerHandle* panache_walker_create(const char* data, uint32_t size) {
  return keep(WalkerModel::parse(bytes_at(data, size), "the walker's model"));
}
PANACHE_EXPORT void panache_walker_free(WalkerHandle* walker) { delete walker; }

// `name` ends in .bvh, or is taken for a glTF file.
PANACHE_EXPORT FileHandle* panache_file_create(const char* data, uint32_t size, const char* name) {
  const std::string path = name;
  const bool bvh = path.ends_with(".bvh");
  std::string bytes(data, size);
  auto file = bvh ? parse_bvh(std::move(bytes), path) : parse_gltf(std::move(bytes), path);
  if (file) return new FileHandle(*std::move(file));
  last_error = file.error().message;
  return nullptr;
}
PANACHE_EXPORT void panache_file_free(FileHandle* file) { delete file; }
PANACHE_EXPORT std::string* panache_file_describe(FileHandle* file) {
  nlohmann::json clips = nlohmann::json::array(), joints = nlohmann::json::array();
  const std::vector<std::string> names = (*file)->clip_names();
  for (size_t i = 0; i < names.size(); ++i) {
    const Clip& clip = (*file)->clip(static_cast<int>(i));
    clips.push_back({{"name", names[i]}, {"frames", clip.frames}, {"frameTime", clip.frame_time}});
  }
  for (const Joint& joint : (*file)->clip().skeleton.joints) {
    joints.push_back({{"name", joint.name}, {"parent", joint.parent}});
  }
  const nlohmann::json all = {{"clips", clips}, {"joints", joints}};
  // Names are the file's, and may be no UTF-8.
  return new std::string(all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

namespace {

Actor* make_actor(ModelHandle* model, std::unique_ptr<Source> source) {
  Result<std::unique_ptr<Actor>> actor = Actor::create(*model, std::move(source));
  if (actor) return actor->release();
  last_error = actor.error().message;
  return nullptr;
}

}  // namespace

PANACHE_EXPORT Actor* panache_actor_walk(ModelHandle* model, WalkerHandle* walker) {
  return make_actor(model, std::make_unique<WalkerSource>(*walker));
}
PANACHE_EXPORT Actor* panache_actor_clip(ModelHandle* model, FileHandle* file, int32_t which) {
  Result<std::unique_ptr<ClipSource>> source = ClipSource::create(*file, which);
  if (source) return make_actor(model, *std::move(source));
  last_error = source.error().message;
  return nullptr;
}
PANACHE_EXPORT void panache_actor_free(Actor* actor) { delete actor; }

PANACHE_EXPORT float* panache_actor_strengths(Actor* actor) { return actor->strengths().data(); }
// Posture, dynamics, timing, legs, torso, left arm, right arm, foot lock.
PANACHE_EXPORT void panache_actor_shape(Actor* actor, float posture, float dynamics, float timing,
                                        float legs, float torso, float left_arm, float right_arm,
                                        float foot_lock) {
  actor->shape() = {1, posture, dynamics, timing, {legs, torso, left_arm, right_arm}, foot_lock};
}
PANACHE_EXPORT void panache_actor_step(Actor* actor, double seconds) { actor->step(seconds); }
PANACHE_EXPORT void panache_actor_measure(Actor* actor, int32_t count) { actor->measure(count); }

// The four below do nothing, or give 0, where the source is of the other kind.
PANACHE_EXPORT void panache_actor_steer(Actor* actor, float speed, float turn) {
  if (auto* walk = dynamic_cast<WalkerSource*>(&actor->source())) walk->steer(speed, turn);
}
PANACHE_EXPORT void panache_actor_seek(Actor* actor, double seconds) {
  if (auto* clip = dynamic_cast<ClipSource*>(&actor->source())) clip->seek(seconds);
}
PANACHE_EXPORT void panache_actor_loop(Actor* actor, int32_t loop) {
  if (auto* clip = dynamic_cast<ClipSource*>(&actor->source())) clip->set_loop(loop != 0);
}
PANACHE_EXPORT double panache_actor_seconds(Actor* actor) {
  auto* clip = dynamic_cast<ClipSource*>(&actor->source());
  return clip ? clip->seconds() : 0;
}

PANACHE_EXPORT double panache_actor_rate(Actor* actor) { return actor->stylizer().rate(); }
PANACHE_EXPORT float panache_actor_gate(Actor* actor) { return actor->stylizer().gate(); }
PANACHE_EXPORT float panache_actor_contact(Actor* actor, int32_t foot) {
  return actor->stylizer().contacts()[static_cast<size_t>(foot)];
}
PANACHE_EXPORT const float* panache_actor_pose(Actor* actor, int32_t styled) {
  return actor->pose(styled != 0).data();
}
PANACHE_EXPORT const float* panache_actor_parts(Actor* actor, int32_t styled) {
  return actor->parts(styled != 0).data();
}
PANACHE_EXPORT const float* panache_actor_offsets(Actor* actor) { return &actor->offsets()[0].x; }
// As Placement: x y z w, scale, floor.
PANACHE_EXPORT void panache_actor_placement(Actor* actor, float* out) {
  const Placement placement = actor->placement();
  std::memcpy(out, &placement, sizeof placement);
}

PANACHE_EXPORT std::string* panache_actor_export(Actor* actor, const char* extension,
                                                 const char* file_extension) {
  return keep(actor->export_as(extension, file_extension));
}
