#include "retarget/retarget.h"

#include <utility>

#include "api/errors.h"
#include "api/objects.h"
#include "api/poses.h"
#include "api/sized_struct.h"

using namespace panache;
using namespace panache::api;

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
