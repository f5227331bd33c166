#include <algorithm>
#include <array>
#include <cmath>

#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "api/poses.h"
#include "style/stylizer.h"

using namespace panache;
using namespace panache::api;

panache_status panache_character_create(const panache_model* model,
                                        const panache_skeleton* skeleton,
                                        const panache_character_options* options,
                                        panache_character** out) {
  start(out);
  return guarded([&] {
    // Programs compiled with a header without gestures get none.
    panache_character_options initial = PANACHE_CHARACTER_OPTIONS;
    if (options) initial.gesture_rate = 0;
    const auto given = read_struct(options, initial, "panache_character_options");
    if (!given) return fail(PANACHE_BAD_ARGUMENT, given.error());
    LiveOptions live_options;
    live_options.stylizer = read_stylizer_options(*given);
    live_options.max_lag = given->max_lag;
    live_options.max_lead = given->max_lead;
    live_options.skip_cycles = given->skip_cycles != 0;
    if (given->remover) live_options.remover = given->remover->model;
    Result<LiveStylizer> live = LiveStylizer::create(model->model, skeleton->rig, live_options);
    if (!live) return fail(PANACHE_BAD_ARGUMENT, live.error());
    *out =
        new panache_character{*std::move(live), std::vector<float>(model->model->styles().size())};
    return PANACHE_OK;
  });
}

void panache_character_destroy(panache_character* character) { delete character; }

void panache_character_set_strength(panache_character* character, int32_t style, float strength) {
  std::vector<float>& strengths = character->strengths;
  if (style < 0 || size_t(style) >= strengths.size() || !std::isfinite(strength)) return;
  strengths[style] = strength;
}

void panache_character_set_side(panache_character* character, int32_t style, float side) {
  character->live.stylizer().set_side(style, side);
}

panache_status panache_character_set_person(panache_character* character, uint32_t seed,
                                            float amount) {
  return guarded([&] {
    Stylizer& stylizer = character->live.stylizer();
    if (Result<void> good = check_has_persons(stylizer.model()); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error());
    }
    if (!(amount >= 0 && amount <= kMaxVariety)) {
      return fail(PANACHE_BAD_ARGUMENT,
                  {"a person's amount is " + std::to_string(amount) + "; expected 0 to 2"});
    }
    stylizer.set_person(person_of_seed(stylizer.model(), seed, amount));
    return PANACHE_OK;
  });
}

panache_status panache_character_set_person_numbers(panache_character* character,
                                                    const float* numbers, int32_t count) {
  return guarded([&] {
    Stylizer& stylizer = character->live.stylizer();
    const Result<PersonNumbers> person = read_person(stylizer.model(), numbers, count);
    if (!person) return fail(PANACHE_BAD_ARGUMENT, person.error());
    stylizer.set_person(*person);
    return PANACHE_OK;
  });
}

panache_status panache_character_get_person_numbers(const panache_character* character,
                                                    float* numbers, int32_t count) {
  return guarded([&] {
    const Stylizer& stylizer = character->live.stylizer();
    if (Result<void> good = check_person_count(stylizer.model(), count); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error());
    }
    std::copy_n(stylizer.person().begin(), count, numbers);
    return PANACHE_OK;
  });
}

void panache_character_set_removed(panache_character* character, int32_t style) {
  character->live.set_removed(style);
}

int32_t panache_character_trigger(panache_character* character, int32_t style, int32_t gesture) {
  return character->live.stylizer().trigger(style, gesture) ? 1 : 0;
}

panache_status panache_character_set_shape(panache_character* character,
                                           const panache_shape* shape) {
  return guarded([&] {
    const Result<Shape> read = read_shape(shape);
    if (!read) return fail(PANACHE_BAD_ARGUMENT, read.error());
    character->live.stylizer().set_shape(*read);
    return PANACHE_OK;
  });
}

void panache_character_step(panache_character* character, panache_input_pose in, double seconds,
                            panache_output_pose out) {
  const size_t joints = character->live.stylizer().rig().joint_count();
  character->live.step(view(in, joints), character->strengths, seconds, view(out, joints));
}

void panache_step_many(panache_character* const* characters, int32_t count,
                       const panache_input_pose* in, double seconds,
                       const panache_output_pose* out) {
  // As many at a time as fit on the stack.
  std::array<CrowdMember, 256> members;
  int32_t done = 0;
  while (done < count) {
    size_t taken = 0;
    for (; taken < members.size() && done < count; ++taken, ++done) {
      panache_character& character = *characters[done];
      // Characters with their own play head are stepped one by one.
      if (!character.live.is_pass_through()) break;
      Stylizer& stylizer = character.live.stylizer();
      const size_t joints = stylizer.rig().joint_count();
      members[taken] = {&stylizer, view(in[done], joints), character.strengths,
                        view(out[done], joints)};
    }
    step_crowd(std::span(members).first(taken), seconds);
    for (; done < count && !characters[done]->live.is_pass_through(); ++done) {
      panache_character_step(characters[done], in[done], seconds, out[done]);
    }
  }
}

void panache_character_reset(panache_character* character) { character->live.reset(); }

panache_status panache_character_get_report(const panache_character* character,
                                            panache_report* report) {
  return guarded([&] {
    const Stylizer& stylizer = character->live.stylizer();
    panache_report now = PANACHE_REPORT;
    now.gate = stylizer.gate();
    now.contacts[0] = stylizer.contacts()[0];
    now.contacts[1] = stylizer.contacts()[1];
    now.rate = stylizer.rate();
    now.ahead = character->live.ahead();
    auto written = write_struct(now, report, "panache_report");
    return written ? PANACHE_OK : fail(PANACHE_BAD_ARGUMENT, written.error());
  });
}

size_t panache_character_state_size(const panache_character* character) {
  return character->live.state_size();
}

void panache_character_save(const panache_character* character, void* out) {
  const size_t size = character->live.state_size();
  character->live.save({static_cast<std::byte*>(out), size});
}

panache_status panache_character_restore(panache_character* character, const void* bytes,
                                         size_t size) {
  if (character->live.restore({static_cast<const std::byte*>(bytes), size})) return PANACHE_OK;
  return guarded([&] {
    return fail(
        PANACHE_BAD_STATE,
        {"expected the " + std::to_string(character->live.state_size()) +
         " bytes of a state saved by a character of the same model, skeleton and options; found " +
         std::to_string(size) + " bytes that are not a saved state"});
  });
}
