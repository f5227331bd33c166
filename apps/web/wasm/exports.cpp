// Functions for the page that panache.h lacks: the walker and players. See exports.h.

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "exports.h"
#include "golden.h"
#include "player.h"

using namespace panache;
using namespace panache::web;

PANACHE_EXPORT const uint64_t* panache_page_golden(const panache_model* model) {
  static uint64_t hash;
  hash = golden_hash(model->model);
  return &hash;
}

PANACHE_EXPORT WalkerHandle* panache_page_walker_create(const char* data, uint32_t size) {
  auto walker = WalkerModel::parse(bytes_at(data, size), "the walker's model");
  if (walker) return new WalkerHandle(*std::move(walker));
  return fail(walker.error());
}
PANACHE_EXPORT void panache_page_walker_free(WalkerHandle* walker) { delete walker; }

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
PANACHE_EXPORT Player* panache_page_player_clip(const panache_model* model,
                                                const panache_motion_file* file, int32_t which) {
  return make_player(model, Source::create(file->file, which));
}
PANACHE_EXPORT void panache_page_player_free(Player* player) { delete player; }

// See Player::character(); the player owns it, until the next use_model().
PANACHE_EXPORT panache_character* panache_page_player_character(Player* player) {
  return player->character();
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
// `timing`: see style_timing in panache.h.
PANACHE_EXPORT void panache_page_player_set_timing(Player* player, int32_t timing) {
  player->set_timing(static_cast<Timing>(timing));
}
PANACHE_EXPORT void panache_page_player_set_gesture_rate(Player* player, float rate) {
  player->set_gesture_rate(rate);
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

static uint32_t address(const void* data) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(data));
}
// What is shown, until the next call: seconds, rate, gate, contacts of the left and the right foot,
// first frame; a Placement; the addresses of Shown::numbers and of Shown::parts, first the input's.
PANACHE_EXPORT const double* panache_page_player_facts(Player* player) {
  const Source& source = player->source();
  const web::Placement at = player->placement();
  const Shown &input = player->shown(false), &styled = player->shown(true);
  static std::array<double, 16> facts;
  facts = {source.seconds(),
           player->rate(),
           player->gate(),
           player->contact(0),
           player->contact(1),
           static_cast<double>(source.first_frame()),
           at.to_y_up.x,
           at.to_y_up.y,
           at.to_y_up.z,
           at.to_y_up.w,
           at.scale,
           at.floor,
           static_cast<double>(address(input.numbers.data())),
           static_cast<double>(address(styled.numbers.data())),
           static_cast<double>(address(input.parts.data())),
           static_cast<double>(address(styled.parts.data()))};
  return facts.data();
}
// Writes the numbers of vertices and of triangle indices, then the addresses of the arrays of
// BodyMesh in order, the bind pose as positions and rotations. Valid as long as the player.
PANACHE_EXPORT void panache_page_player_body(Player* player, int32_t coarse, uint32_t* out) {
  const BodyMesh& body = player->body(coarse ? BodyDetail::coarse : BodyDetail::fine);
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
PANACHE_EXPORT panache_bytes* panache_page_player_export(Player* player, const char* extension,
                                                         const char* file_extension, int32_t styled,
                                                         double seconds) {
  auto written = player->export_as(extension, file_extension, styled != 0, seconds);
  if (written) return new panache_bytes{*std::move(written)};
  return fail(written.error());
}
