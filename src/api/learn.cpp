#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "api/poses.h"
#include "base/text.h"
#include "learn/style_file.h"

using namespace panache;
using namespace panache::api;

namespace {

constexpr const char* kStyledClip = "the styled clip";

Result<LearnPair> read_pair(const panache_pair& pair, int32_t number) {
  const std::string name = "pair " + std::to_string(number);
  const std::string neutral_name = name + ", neutral", styled_name = name + ", styled";
  Result<Clip> neutral = read_clip(pair.neutral, Rotations::unit, neutral_name);
  if (!neutral) return neutral.error();
  Result<Clip> styled = read_clip(pair.styled, Rotations::unit, styled_name);
  if (!styled) return styled.error();
  return make_learn_pair({*neutral, pair.neutral.skeleton->rig, neutral_name},
                         {*styled, pair.styled.skeleton->rig, styled_name});
}

// Learns the style from what read_pairs() gives, a Result of a std::vector<LearnPair>.
template <class ReadPairs>
panache_status learn_from(const void* model_bytes, size_t model_size, const char* name,
                          int32_t replace, panache_learnt** out, ReadPairs read_pairs) {
  start(out);
  return guarded([&] {
    const Result<ModelFile> model = ModelFile::parse(model_bytes, model_size);
    if (!model) return fail(PANACHE_BAD_MODEL, model.error());
    if (!model->model->can_learn()) {
      return fail(PANACHE_BAD_MODEL, cannot_learn(kModelName));
    }
    if (auto free = model->check_free(name, replace != 0); !free) {
      return fail(PANACHE_BAD_ARGUMENT, free.error());
    }
    if (auto good = check_style_name(name); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error());
    }
    const Result<std::vector<LearnPair>> pairs = read_pairs();
    if (!pairs) return fail(PANACHE_BAD_CLIP, pairs.error());
    Result<LearntStyle> style = learn_style(model->file, kModelName, *pairs, name, "");
    if (!style) return fail(PANACHE_BAD_CLIP, style.error());
    Result<TensorFile> merged = add_style(model->file, kModelName, style->file, name, true);
    if (!merged) return fail(PANACHE_BAD_MODEL, merged.error());
    std::string warnings;
    for (const std::string& warning : style->warnings) warnings += to_utf8(warning) + "\n";
    for (const PairReport& pair : style->pairs) {
      for (const std::string& warning : pair.warnings) warnings += to_utf8(warning) + "\n";
    }
    *out = new panache_learnt{format_safetensors(*merged), *std::move(style), std::move(warnings)};
    return PANACHE_OK;
  });
}

}  // namespace

panache_status panache_learn(const void* model_bytes, size_t model_size, const panache_pair* pairs,
                             int32_t pair_count, const char* name, int32_t replace,
                             panache_learnt** out) {
  return learn_from(model_bytes, model_size, name, replace, out,
                    [&]() -> Result<std::vector<LearnPair>> {
                      std::vector<LearnPair> read;
                      for (int32_t p = 0; p < pair_count; ++p) {
                        Result<LearnPair> pair = read_pair(pairs[p], p + 1);
                        if (!pair) return pair.error();
                        read.push_back(*std::move(pair));
                      }
                      return read;
                    });
}

panache_status panache_learn_alone(const void* model_bytes, size_t model_size,
                                   const void* bank_bytes, size_t bank_size,
                                   const panache_clip* styled, const char* name, int32_t replace,
                                   panache_learnt** out) {
  return learn_from(
      model_bytes, model_size, name, replace, out, [&]() -> Result<std::vector<LearnPair>> {
        const auto bank = NeutralBank::parse({static_cast<const char*>(bank_bytes), bank_size},
                                             "the bank of neutral motion");
        if (!bank) return bank.error();
        const Result<Clip> clip = read_clip(*styled, Rotations::unit, kStyledClip);
        if (!clip) return clip.error();
        Result<LearnPair> pair =
            make_learn_pair({*clip, styled->skeleton->rig, kStyledClip}, **bank);
        if (!pair) return pair.error();
        return std::vector<LearnPair>{*std::move(pair)};
      });
}

void panache_learnt_destroy(panache_learnt* learnt) { delete learnt; }

const void* panache_learnt_model(const panache_learnt* learnt, size_t* size) {
  *size = learnt->model.size();
  return learnt->model.data();
}

const char* panache_learnt_verdict(const panache_learnt* learnt) { return learnt->style.verdict(); }

panache_status panache_learnt_get_report(const panache_learnt* learnt,
                                         panache_learnt_report* report) {
  return guarded([&] {
    const LearntStyle& style = learnt->style;
    panache_learnt_report found = PANACHE_LEARNT_REPORT;
    found.was_tested = style.judged ? 1 : 0;
    found.warnings = learnt->warnings.c_str();
    found.held_back_cm = style.held_back_cm;
    found.mean_posture_cm = style.mean_posture_cm;
    found.untouched_cm = style.untouched_cm;
    if (!style.pairs.empty() && style.pairs[0].twin) {
      found.people = style.pairs[0].twin->people;
      found.is_known = style.pairs[0].twin->is_known ? 1 : 0;
      found.certainty = style.pairs[0].twin->certainty;
    }
    auto written = write_struct(found, report, "panache_learnt_report");
    return written ? PANACHE_OK : fail(PANACHE_BAD_ARGUMENT, written.error());
  });
}
