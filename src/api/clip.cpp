#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "api/poses.h"
#include "learn/recognise.h"
#include "retarget/retarget.h"
#include "style/play/removal.h"

using namespace panache;
using namespace panache::api;

namespace {

Result<StrengthTrack> read_track(const panache_strength_track& from, int32_t styles) {
  if (from.style < 0 || from.style >= styles) {
    return Error{"there is no style " + std::to_string(from.style) + "; the model has " +
                 std::to_string(styles)};
  }
  if (from.key_count < 1 || !from.keys) return Error{"expected at least one key, found none"};
  StrengthTrack out{from.style, {}};
  for (int32_t k = 0; k < from.key_count; ++k) {
    const panache_strength_key& key = from.keys[k];
    const std::string where = "key " + std::to_string(k) + ": ";
    if (!std::isfinite(key.seconds) || !std::isfinite(key.strength)) {
      return Error{where + "is not finite"};
    }
    if (k > 0 && !(key.seconds > from.keys[k - 1].seconds)) {
      return Error{where + "is not later than the one before it"};
    }
    out.points.push_back({key.seconds, key.strength});
  }
  return out;
}

Result<std::vector<StrengthTrack>> read_tracks(const panache_strength_track* from, int32_t count,
                                               int32_t styles) {
  std::vector<StrengthTrack> out;
  if (count < 0 || (count > 0 && !from)) {
    return Error{std::to_string(count) + " tracks; expected an array of 0 or more"};
  }
  for (int32_t t = 0; t < count; ++t) {
    Result<StrengthTrack> track = read_track(from[t], styles);
    if (!track) return located("track " + std::to_string(t), track.error());
    out.push_back(*std::move(track));
  }
  return out;
}

Result<RestyleOptions> read_options(const panache_stylize_options* options, const Model& model) {
  // Programs compiled with a header without loops and gestures get the old behaviour.
  panache_stylize_options initial = PANACHE_STYLIZE_OPTIONS;
  if (options) initial.loop = 0, initial.gesture_rate = 0;
  const auto given =
      read_struct<panache_stylize_options>(options, initial, "panache_stylize_options");
  if (!given) return given.error();
  const Result<Shape> shape = read_shape(given->shape);
  if (!shape) return shape.error();
  RestyleOptions out;
  out.stylizer = read_stylizer_options(*given);
  out.timing = given->style_timing != 0;
  out.stylizer.tempo_everywhere = given->style_timing == 2;
  out.stylizer.shape = *shape;
  if (given->sides) out.stylizer.sides.assign(given->sides, given->sides + model.styles().size());
  if (given->person) {
    const auto axes = static_cast<int32_t>(model.persons() ? model.persons()->axes() : 0);
    const Result<PersonNumbers> person = read_person(model, given->person, axes);
    if (!person) return located("panache_stylize_options", person.error());
    out.stylizer.person = *person;
  }
  if (given->loop < 0 || given->loop > 2) {
    return Error{"panache_stylize_options: loop is " + std::to_string(given->loop) +
                 "; expected 0, 1 or 2"};
  }
  constexpr std::array kModes = {LoopMode::off, LoopMode::detect, LoopMode::force};
  out.loop = kModes[given->loop];
  return out;
}

Result<std::optional<Removal>> read_removal(const panache_stylize_options* options) {
  const auto given = read_struct<panache_stylize_options>(options, PANACHE_STYLIZE_OPTIONS,
                                                          "panache_stylize_options");
  if (!given) return given.error();
  const int32_t styles = given->remover ? panache_model_style_count(given->remover) : 1;
  if (given->removed < 0 || given->removed >= styles) {
    return Error{"panache_stylize_options: removed is " + std::to_string(given->removed) +
                 (given->remover ? "; the remover has " + std::to_string(styles) + " styles"
                                 : "; expected 0 without a remover")};
  }
  if (!given->remover) return std::optional<Removal>();
  if (auto any = find_removal(*given->remover->model, ""); !any) return any.error();
  return std::optional(Removal{given->remover->model, given->removed});
}

}  // namespace

panache_status panache_recognise_styles(const panache_model* remover, const panache_clip* clip,
                                        float* shares, int32_t count) {
  return guarded([&] {
    const int32_t expected = panache_model_style_count(remover) + 1;
    if (count != expected) {
      return fail(PANACHE_BAD_ARGUMENT,
                  {std::to_string(count) + " shares; expected " + std::to_string(expected) +
                   ", one for each style and one for neutral"});
    }
    const Result<Clip> input = read_clip(*clip, Rotations::as_given, "clip");
    if (!input) return fail(PANACHE_BAD_CLIP, input.error());
    if (input->frames == 0) return fail(PANACHE_BAD_CLIP, {"clip: has no frames"});
    const auto found = recognise_styles(remover->model, *input, clip->skeleton->rig);
    if (!found) return fail(PANACHE_BAD_MODEL, found.error());
    write_shares(*found, {shares, static_cast<size_t>(count)});
    return PANACHE_OK;
  });
}

panache_status panache_stylize_clip(const panache_model* model, const panache_clip* clip,
                                    const panache_strength_track* tracks, int32_t track_count,
                                    const panache_stylize_options* options,
                                    panache_styled_clip** out) {
  start(out);
  return guarded([&] {
    const auto restyle_options = read_options(options, *model->model);
    if (!restyle_options) return fail(PANACHE_BAD_ARGUMENT, restyle_options.error());
    const auto strengths = read_tracks(tracks, track_count, panache_model_style_count(model));
    if (!strengths) return fail(PANACHE_BAD_ARGUMENT, strengths.error());
    const Result<Clip> input = read_clip(*clip, Rotations::as_given, "clip");
    if (!input) return fail(PANACHE_BAD_CLIP, input.error());
    if (input->frames == 0) return fail(PANACHE_BAD_CLIP, {"clip: has no frames"});
    const Result<std::optional<Removal>> removal = read_removal(options);
    if (!removal) return fail(PANACHE_BAD_ARGUMENT, removal.error());
    const Rig& rig = clip->skeleton->rig;
    Result<Restyled> styled =
        *removal
            ? restyle_without(*input, rig, **removal, model->model, *strengths, *restyle_options)
            : restyle(*input, rig, model->model, *strengths, *restyle_options);
    if (!styled) return fail(PANACHE_BAD_ARGUMENT, styled.error());
    std::vector<uint8_t> contacts;
    for (const FootContacts& feet : styled->contacts) {
      contacts.insert(contacts.end(), feet.begin(), feet.end());
    }
    *out = new panache_styled_clip{*std::move(styled), std::move(contacts)};
    return PANACHE_OK;
  });
}

void panache_styled_clip_destroy(panache_styled_clip* styled) { delete styled; }

int32_t panache_styled_clip_frame_count(const panache_styled_clip* styled) {
  return styled->restyled.clip.frames;
}

const float* panache_styled_clip_rotations(const panache_styled_clip* styled) {
  return &styled->restyled.clip.rotations.data()->x;
}

const float* panache_styled_clip_translations(const panache_styled_clip* styled) {
  return &styled->restyled.clip.translations.data()->x;
}

const double* panache_styled_clip_source_frames(const panache_styled_clip* styled) {
  return styled->restyled.source_frames.data();
}

const uint8_t* panache_styled_clip_contacts(const panache_styled_clip* styled) {
  return styled->contacts.data();
}

const float* panache_styled_clip_gates(const panache_styled_clip* styled) {
  return styled->restyled.gates.data();
}

int32_t panache_styled_clip_is_loop(const panache_styled_clip* styled) {
  return styled->restyled.loop.closed;
}

panache_status panache_retarget_clip(const panache_clip* clip, const panache_skeleton* onto,
                                     const panache_retarget_options* options,
                                     panache_styled_clip** out) {
  start(out);
  return guarded([&] {
    const auto given = read_struct<panache_retarget_options>(options, PANACHE_RETARGET_OPTIONS,
                                                             "panache_retarget_options");
    if (!given) return fail(PANACHE_BAD_ARGUMENT, given.error());
    const Result<Clip> motion = read_clip(*clip, Rotations::unit, "clip");
    if (!motion) return fail(PANACHE_BAD_CLIP, motion.error());
    if (motion->frames == 0) return fail(PANACHE_BAD_CLIP, {"clip: has no frames"});
    const Rig& rig = clip->skeleton->rig;
    Result<Retargeted> done = retarget(*motion, rig, onto->body, onto->rig,
                                       {given->hold_feet != 0, given->meet_hands != 0});
    if (!done) return fail(PANACHE_BAD_SKELETON, done.error());
    auto result = std::make_unique<panache_styled_clip>();
    const int first = motion->frames - done->clip.frames;
    for (int f = 0; f < done->clip.frames; ++f) {
      result->restyled.source_frames.push_back(first + f);
      result->restyled.gates.push_back(1);
      const FootContacts& feet = done->contacts[f];
      result->contacts.insert(result->contacts.end(), feet.begin(), feet.end());
    }
    result->restyled.clip = std::move(done->clip);
    result->restyled.contacts = std::move(done->contacts);
    *out = result.release();
    return PANACHE_OK;
  });
}
