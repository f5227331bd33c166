// Functions for the page that panache.h lacks: models, motion and players. See exports.h. Messages
// use the file names that the page passes.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "api/options.h"
#include "clip/motion_format.h"
#include "exports.h"
#include "golden.h"
#include "learn/recognise.h"
#include "learn/style_file.h"
#include "player.h"
#include "pose/motion_notes.h"
#include "retarget/retarget.h"
#include "rig/body_motions.h"
#include "style/model/side.h"
#include "style/play/removal.h"

using namespace panache;
using namespace panache::web;

// Writes the two words of the hash, the lower first.
PANACHE_EXPORT void panache_page_golden(const panache_model* model, uint32_t* out) {
  const uint64_t hash = golden_hash(model->model);
  out[0] = static_cast<uint32_t>(hash);
  out[1] = static_cast<uint32_t>(hash >> 32);
}

PANACHE_EXPORT panache_model* panache_page_model_create(const char* data, uint32_t size,
                                                        const char* name) {
  auto model = Model::parse(bytes_at(data, size), name);
  if (model) return new panache_model{*std::move(model)};
  return fail(model.error());
}
// A model that removes styles.
PANACHE_EXPORT panache_model* panache_page_remover_create(const char* data, uint32_t size) {
  const std::string name = "the remover";
  auto model = Model::parse(bytes_at(data, size), name);
  if (!model) return fail(model.error());
  if (const auto any = find_removal(**model, ""); !any) return fail(located(name, any.error()));
  return new panache_model{*std::move(model)};
}
// "elderly aged" as a list.
static nlohmann::json split_words(std::string_view words) {
  nlohmann::json list = nlohmann::json::array();
  while (!words.empty()) {
    const size_t end = std::min(words.find(' '), words.size());
    if (end > 0) list.push_back(std::string(words.substr(0, end)));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return list;
}
// See Style in the package's styling.ts.
PANACHE_EXPORT panache_bytes* panache_page_styles(const panache_model* model) {
  nlohmann::json all = nlohmann::json::array();
  const bool has_sides = check_has_sides(*model->model).ok();
  for (const StyleInfo& style : model->model->styles()) {
    nlohmann::json gestures = nlohmann::json::array();
    for (const Gesture& gesture : model->model->gestures(static_cast<int>(all.size()))) {
      gestures.push_back(gesture.name());
    }
    all.push_back({{"name", style.name},
                   {"description", style.description},
                   {"group", style.group},
                   {"side", has_sides ? nlohmann::json(style.side) : nlohmann::json()},
                   {"words", split_words(style.words)},
                   {"learnt", style.learnt},
                   {"thumbnail", style.thumbnail},
                   {"gestures", gestures}});
  }
  return to_bytes(all);
}

// Whether the bytes are a style file, and not a model.
PANACHE_EXPORT int32_t panache_page_is_style(const char* data, uint32_t size) {
  const Result<TensorFile> file = parse_safetensors(bytes_at(data, size), "");
  return file && is_style_file(*file);
}
// The bytes of the model with the style of a style file added.
PANACHE_EXPORT panache_bytes* panache_page_style_add(const char* model, uint32_t model_size,
                                                     const char* style, uint32_t style_size,
                                                     const char* style_name, int32_t replace) {
  const std::string model_name = "the model";
  const Result<TensorFile> to = parse_safetensors(bytes_at(model, model_size), model_name);
  if (!to) return fail(to.error());
  const Result<TensorFile> from = parse_safetensors(bytes_at(style, style_size), style_name);
  if (!from) return fail(from.error());
  const Result<TensorFile> merged = add_style(*to, model_name, *from, style_name, replace != 0);
  if (!merged) return fail(merged.error());
  return new panache_bytes{format_safetensors(*merged)};
}

PANACHE_EXPORT WalkerHandle* panache_page_walker_create(const char* data, uint32_t size) {
  auto walker = WalkerModel::parse(bytes_at(data, size), "the walker's model");
  if (walker) return new WalkerHandle(*std::move(walker));
  return fail(walker.error());
}
PANACHE_EXPORT void panache_page_walker_free(WalkerHandle* walker) { delete walker; }

// The extension of `name` decides. `fps` as in ReadOptions; 0: the file's.
PANACHE_EXPORT FileHandle* panache_page_file_create(const char* data, uint32_t size,
                                                    const char* name, double fps) {
  ReadOptions options;
  if (fps != 0) {
    if (auto good = check_fps(fps); !good) return fail(good.error());
    options.fps = fps;
  }
  auto file = parse_motion(std::string(bytes_at(data, size)), name, options);
  if (file) return new FileHandle(*std::move(file));
  return fail(file.error());
}
// The bytes of the character's file, with its motions replaced by the retargeted one.
PANACHE_EXPORT panache_bytes* panache_page_file_put_on(FileHandle* motion, int32_t which,
                                                       FileHandle* character) {
  const Clip& clip = (*motion)->clip(which);
  const Result<Rig> rig = Rig::create(clip);
  if (!rig) return fail(rig.error());
  const Clip* own = (*character)->clip_names().empty()
                        ? nullptr
                        : &(*character)->clip(first_body_motion(**character));
  const Result<std::pair<Clip, Rig>> body = find_body((*character)->rest(), own, {});
  if (!body) return fail(body.error());
  const Result<Retargeted> done = retarget(clip, *rig, body->first, body->second);
  if (!done) return fail(done.error());
  const std::vector<std::string> names = (*motion)->clip_names();
  const std::string name = names.empty() || names[static_cast<size_t>(which)].empty()
                               ? "motion"
                               : names[static_cast<size_t>(which)];
  const ClipEdit edit = {kNewClip, &done->clip, {}, name};
  return new panache_bytes{(*character)->encode({&edit, 1}, EditMode::replace)};
}
PANACHE_EXPORT void panache_page_file_free(FileHandle* file) { delete file; }
// `name`: the file name, for the notes.
PANACHE_EXPORT panache_bytes* panache_page_file_describe(FileHandle* file, const char* name) {
  nlohmann::json clips = nlohmann::json::array(), joints = nlohmann::json::array();
  const std::vector<std::string> names = (*file)->clip_names();
  const std::vector<int> body = find_body_motions(**file).clips;
  for (size_t i = 0; i < names.size(); ++i) {
    const int which = static_cast<int>(i);
    const Clip& clip = (*file)->clip(which);
    clips.push_back({{"name", names[i]},
                     {"frames", clip.frames},
                     {"frameTime", clip.frame_time},
                     {"moves", std::find(body.begin(), body.end(), which) != body.end()}});
  }
  for (const Joint& joint : (*file)->clip().skeleton.joints) {
    joints.push_back({{"name", joint.name}, {"parent", joint.parent}});
  }
  const nlohmann::json all = {
      {"clips", clips}, {"joints", joints}, {"notes", motion_notes(**file, name)}};
  return to_bytes(all);
}

// See panache_recognise_styles().
PANACHE_EXPORT panache_status panache_page_file_recognise(FileHandle* file, int32_t which,
                                                          const panache_model* remover,
                                                          float* shares) {
  const Clip& clip = (*file)->clip(which);
  const Result<Rig> rig = Rig::create(clip);
  if (!rig) return api::fail(PANACHE_BAD_SKELETON, rig.error());
  const auto found = recognise_styles(remover->model, clip, *rig);
  if (!found) return api::fail(PANACHE_BAD_MODEL, found.error());
  write_shares(*found, {shares, remover->model->styles().size() + 1});
  return PANACHE_OK;
}

namespace {

Player* make_player(const panache_model* model, Result<Source> source) {
  if (!source) return fail(source.error());
  Result<std::unique_ptr<Player>> player =
      Player::create(model ? model->model : nullptr, *std::move(source));
  if (player) return player->release();
  return fail(player.error());
}
panache_status status_of(const Result<void>& done, panache_status failed) {
  return done ? PANACHE_OK : api::fail(failed, done.error());
}

}  // namespace

PANACHE_EXPORT Player* panache_page_player_walk(const panache_model* model, WalkerHandle* walker) {
  return make_player(model, Source(*walker));
}
PANACHE_EXPORT Player* panache_page_player_clip(const panache_model* model, FileHandle* file,
                                                int32_t which) {
  return make_player(model, Source::create(*file, which));
}
PANACHE_EXPORT void panache_page_player_free(Player* player) { delete player; }

PANACHE_EXPORT float* panache_page_player_strengths(Player* player) {
  return player->strengths().data();
}
// Times and strengths, [count][2].
PANACHE_EXPORT void panache_page_player_set_track(Player* player, int32_t style, const double* keys,
                                                  int32_t count) {
  std::vector<StrengthTrack::Point> points;
  for (int32_t i = 0; i < count; ++i) {
    points.push_back({keys[2 * i], static_cast<float>(keys[2 * i + 1])});
  }
  player->set_track(style, std::move(points));
}
PANACHE_EXPORT void panache_page_player_set_side(Player* player, int32_t style, float side) {
  player->set_side(style, side);
}
// See panache_character_set_person().
PANACHE_EXPORT void panache_page_player_set_person(Player* player, uint32_t seed, float amount) {
  player->set_person(seed, amount);
}
PANACHE_EXPORT panache_status panache_page_player_use_model(Player* player,
                                                            const panache_model* model) {
  return status_of(player->use_model(model->model), PANACHE_BAD_SKELETON);
}
PANACHE_EXPORT panache_status panache_page_player_use_remover(Player* player,
                                                              const panache_model* remover) {
  return status_of(player->use_remover(remover->model), PANACHE_BAD_SKELETON);
}
PANACHE_EXPORT void panache_page_player_set_removed(Player* player, int32_t style) {
  player->set_removed(style);
}
PANACHE_EXPORT panache_status panache_page_player_set_shape(Player* player,
                                                            const panache_shape* shape) {
  const Result<Shape> read = api::read_shape(shape);
  if (!read) return api::fail(PANACHE_BAD_ARGUMENT, read.error());
  player->shape() = *read;
  return PANACHE_OK;
}
// `timing`: see style_timing in panache.h.
PANACHE_EXPORT void panache_page_player_set_timing(Player* player, int32_t timing) {
  player->set_timing(static_cast<Timing>(timing));
}
PANACHE_EXPORT void panache_page_player_set_gesture_rate(Player* player, float rate) {
  player->set_gesture_rate(rate);
}
PANACHE_EXPORT int32_t panache_page_player_trigger(Player* player, int32_t style, int32_t gesture) {
  return player->trigger(style, gesture) ? 1 : 0;
}
PANACHE_EXPORT void panache_page_player_step(Player* player, double seconds) {
  player->step(seconds);
}
PANACHE_EXPORT void panache_page_player_measure(Player* player, int32_t count) {
  player->measure(count);
}

// For the walker only.
PANACHE_EXPORT void panache_page_player_steer(Player* player, float speed, float turn) {
  player->source().steer(speed, turn);
}
// For clips only.
PANACHE_EXPORT void panache_page_player_seek(Player* player, double seconds) {
  player->source().seek(seconds);
}
PANACHE_EXPORT void panache_page_player_loop(Player* player, int32_t loop) {
  player->source().set_loop(loop != 0);
}
PANACHE_EXPORT double panache_page_player_seconds(Player* player) {
  return player->source().seconds();
}
PANACHE_EXPORT int32_t panache_page_player_first_frame(Player* player) {
  return player->source().first_frame();
}

PANACHE_EXPORT double panache_page_player_rate(Player* player) { return player->rate(); }
PANACHE_EXPORT float panache_page_player_gate(Player* player) { return player->gate(); }
PANACHE_EXPORT float panache_page_player_contact(Player* player, int32_t foot) {
  return player->contact(static_cast<size_t>(foot));
}
PANACHE_EXPORT const float* panache_page_player_pose(Player* player, int32_t styled) {
  return player->shown(styled != 0).numbers.data();
}
PANACHE_EXPORT const float* panache_page_player_parts(Player* player, int32_t styled) {
  return player->shown(styled != 0).parts.data();
}
// Writes the numbers of vertices and of triangle indices, then the addresses of the arrays of
// BodyMesh in order, the bind pose as positions and rotations. Valid as long as the player.
PANACHE_EXPORT void panache_page_player_body(Player* player, int32_t coarse, uint32_t* out) {
  const BodyMesh& body = player->body(coarse ? BodyDetail::coarse : BodyDetail::fine);
  const auto address = [](const void* data) {
    return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(data));
  };
  const uint32_t all[] = {static_cast<uint32_t>(body.positions.size()),
                          static_cast<uint32_t>(body.triangles.size()),
                          address(&body.bind.positions),
                          address(&body.bind.rotations),
                          address(body.positions.data()),
                          address(body.normals.data()),
                          address(body.joints.data()),
                          address(body.weights.data()),
                          address(body.accents.data()),
                          address(body.triangles.data())};
  std::copy(std::begin(all), std::end(all), out);
}
// Writes a Placement: x y z w, scale, floor.
PANACHE_EXPORT void panache_page_player_placement(Player* player, float* out) {
  const web::Placement placement = player->placement();
  std::memcpy(out, &placement, sizeof placement);
}

PANACHE_EXPORT panache_bytes* panache_page_player_export(Player* player, const char* extension,
                                                         const char* file_extension, int32_t styled,
                                                         double seconds) {
  auto written = player->export_as(extension, file_extension, styled != 0, seconds);
  if (written) return new panache_bytes{*std::move(written)};
  return fail(written.error());
}
