#include "learn/learn_style.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/parallel.h"
#include "clip/text_cursor.h"
#include "learn/find_gestures.h"
#include "learn/fit_style.h"
#include "learn/pairing.h"
#include "learn/style_file.h"
#include "learn/take.h"
#include "recipes/recipe.h"
#include "style/networks/networks.h"

namespace panache {
namespace {

constexpr double kShort = 2;  // Seconds.
// Mean squared distances of takes of one action are below kGoodMatch, of different ones mostly
// above the first of these; above the second nothing was matched at all. Measured on takes of 22
// styles.
constexpr double kPoorMatch = 0.6, kNoMatch = 1.6;
// Pairs of one action that are in step agree to at least 0.88, those half a cycle off to at most
// 0.6. See step_agreement().
constexpr double kInStep = 0.85;
// A clip that matches better by this factor when mirrored is mirrored, or a cycle that begins with
// the other foot and is too short to find its beginning. Measured on 242 pairs: all others are
// above 0.75. Below the second value, a clip matches anyway.
constexpr double kMirrored = 0.6, kNearlyEqual = 0.1;
constexpr double kSlowest = 0.5, kFastest = 2;  // Tempo.
// See fit_style(). With less penalty, a pair fits its own clips better and other takes of the
// action worse; 1 is also smoother. A twin's frame-to-frame motion is less reliable than its
// posture.
constexpr double kPairPenalty = 1, kTwinPenalty = 100;
constexpr double kHeldBack = 0.75;  // From this fraction of a styled clip on, it is held out.
// The remaining fraction of the distance to the styled motion, relative to no style: 0.84 to 1.03
// for pairs whose clips show different actions, 0.3 to 0.86 for pairs of one action.
constexpr double kNoBetter = 0.9, kGoodShare = 0.75, kMaxShare = 0.25;

// The name of a file for the model's metadata: without folders, on one line.
std::string file_name(const std::string& path) {
  std::string name = path.substr(path.find_last_of("/\\") + 1);
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return name;
}

double mean_tempo(const std::vector<Pairing>& pairings) {
  double sum = 0, count = 0;
  for (const Pairing& pairing : pairings) {
    for (const float rate : pairing.rates) sum += rate, ++count;
  }
  return sum / count;
}

// The matched instant of each styled frame, from the window with the nearest middle, as windows
// overlap. `cycle`: frames after which the neutral motion repeats, or 0.
std::vector<MatchedInstant> matched_instants(const std::vector<Pairing>& pairings, int cycle) {
  struct Placed {
    double from_middle;
    MatchedInstant instant;
  };
  std::map<int, Placed> by_frame;
  for (const Pairing& pairing : pairings) {
    const int count = static_cast<int>(pairing.neutral_frames.size());
    for (int i = 0; i < count; ++i) {
      const int frame = pairing.first + i;
      double neutral = pairing.neutral_frames[i];
      if (cycle) neutral = std::fmod(std::max(neutral, 0.0), cycle);
      const Placed placed = {std::abs(i - (count - 1) / 2.0),
                             {frame / kTakeRate, neutral / kTakeRate, pairing.cost}};
      const auto [at, is_new] = by_frame.try_emplace(frame, placed);
      if (!is_new && placed.from_middle < at->second.from_middle) at->second = placed;
    }
  }
  std::vector<MatchedInstant> instants;
  instants.reserve(by_frame.size());
  for (const auto& [frame, placed] : by_frame) instants.push_back(placed.instant);
  return instants;
}

// Whether the bodies of two takes agree within a millimetre and half a degree for as long as the
// styled one lasts. A head or a hand can turn where it is.
bool same_motion(const Take& neutral, const Take& styled) {
  constexpr float kSame = 0.001f, kSameTurn = 0.01f;  // Metres, radians.
  if (neutral.frames() < styled.frames()) return false;
  for (int f = 0; f < styled.frames(); ++f) {
    for (size_t j = 0; j < kHumanJoints; ++j) {
      if (length(neutral.body[f][j] - styled.body[f][j]) > kSame) return false;
      const Quat turn = conjugate(neutral.rotations[f][j]) * styled.rotations[f][j];
      if (length(log_rotation(turn)) > kSameTurn) return false;
    }
  }
  return true;
}

Result<PairReport> describe(const LearnPair& pair, const std::vector<Pairing>& pairings,
                            const std::vector<Take>& takes, int neutral, int styled) {
  const std::string both = pair.neutral_name + " and " + pair.styled_name;
  const bool repeats = takes[neutral].frames() > pair.neutral.frames();
  PairReport report;
  report.neutral_name = pair.neutral_name;
  report.styled_name = pair.styled_name;
  report.seconds = takes[styled].frames() / kTakeRate;
  report.twin = pair.twin;
  report.instants = matched_instants(pairings, repeats ? pair.neutral_cycle : 0);
  const auto warn = [&](const std::string& text) { report.warnings.push_back(text); };
  report.match = mean_cost(pairings);
  if (report.match > kNoMatch) {
    return Error{both + ": no match was found between them" +
                 (pairings.empty()
                      ? ", as the neutral one is too short for the styled one"
                      : " (distance " + with_decimals(report.match, 2) + ", good is below " +
                            with_decimals(double(kGoodMatch), 2) + ")") +
                 "; a pair shows one action, done neutrally and in the style"};
  }
  report.tempo = mean_tempo(pairings);
  if (same_motion(takes[neutral], takes[styled])) {
    return Error{both +
                 ": are the same motion, so there is no style to learn; give a clip in the style "
                 "as the second one"};
  }
  if (pair.twin && !pair.twin->is_known) {
    const double trust = pair.twin->trust;
    warn(pair.styled_name + ": is unlike the neutral motion that is known, so that " +
         (trust < 1 ? "only " + with_decimals(100 * trust, 0) +
                          " % of what differs from it counts as style"
                    : "what differs from it is not style alone") +
         "; give a neutral clip of the action");
  }
  std::vector<Take> exchanged = {takes[neutral], takes[styled]};
  for (HumanPositions& body : exchanged[1].body) body = mirrored(body);
  const std::vector<Pairing> other = pair_takes(exchanged, {1}, {0});
  const bool is_mirrored =
      report.match > kNearlyEqual && mean_cost(other) < kMirrored * report.match;
  if (is_mirrored) {
    warn(both +
         ": match better with left and right exchanged; record the action with the same hand or "
         "foot first in both");
  } else if (report.match > kPoorMatch) {
    warn(both + ": match badly (distance " + with_decimals(report.match, 2) + ", good is below " +
         with_decimals(double(kGoodMatch), 2) +
         "); are they of the same action, from its beginning to its end?");
  }
  const std::optional<double> in_step = step_agreement(takes, pairings);
  if (!is_mirrored && in_step && *in_step < kInStep) {
    warn(both +
         ": are out of step, left feet were paired with right ones in part; give a neutral clip of "
         "four steps or more");
  }
  if (report.tempo < kSlowest || report.tempo > kFastest) {
    warn(both + ": the style takes " + with_decimals(1 / report.tempo, 2) +
         " times as long as the neutral motion, expected " + with_decimals(1 / kFastest, 2) +
         " to " + with_decimals(1 / kSlowest, 2) +
         "; beyond that the tempo is not followed; record a neutral take nearer to it");
  }
  for (const bool is_neutral : {true, false}) {
    const double seconds = (is_neutral ? pair.neutral : pair.styled).frames() / kTakeRate;
    // A clip of this length has up to two frames less, depending on where its frames lie.
    if (seconds > kShort - 1.5 / kTakeRate || (is_neutral && pair.twin)) continue;
    warn((is_neutral ? pair.neutral_name : pair.styled_name) + ": has only " +
         with_decimals(seconds, 2) +
         " s; 2 to 3 s of a walk, or the whole of an action, teach more");
  }
  return report;
}

// Errors over some samples: of the style, of its mean posture, and of the unchanged neutral motion.
void measure(const std::shared_ptr<const Model>& model, const std::string& style,
             const std::vector<Take>& takes, const SampleSet& set,
             const std::vector<size_t>& learnt, const std::vector<size_t>& held_back,
             LearntStyle& out) {
  const Recipe& recipe = model->recipe();
  std::array<float, StyleDelta::kSize> mean{};
  for (const size_t i : learnt) {
    for (size_t n = 0; n < mean.size(); ++n) {
      mean[n] += set.target(i)[n] / static_cast<float>(learnt.size());
    }
  }
  StyleNetworks networks(model);
  std::vector<float> strengths(model->styles().size()), window(set.inputs());
  strengths[*model->find_style(style)] = 1;
  networks.set_strengths(strengths);
  for (const size_t i : held_back) {
    const Sample& sample = set.samples()[i];
    set.window(i, window);
    networks.forward(window);
    const Take& neutral = takes[sample.take];
    const StyleDelta predicted = recipe.to_change(networks.pose(), body_at(neutral, sample.frame),
                                                  root_at(neutral, sample.frame));
    const auto error = [&](const StyleDelta& change) {
      const Take& styled = takes[sample.styled];
      return pose_error(styled, sample.styled_frame, neutral, sample.frame, change).cm /
             held_back.size();
    };
    out.held_back_cm += error(predicted);
    out.mean_posture_cm += error(unpack(mean));
    out.untouched_cm += error({});
  }
}

// A style from one pair of poses: their difference.
Result<LearntStyle> learn_pose(const TensorFile& file, const Model& model,
                               std::span<const LearnPair> pairs, const std::string& style,
                               const std::string& description) {
  const LearnPair& pair = pairs[0];
  if (pairs.size() > 1) {
    return Error{"a style of poses is learnt from one pair of them; found " +
                 std::to_string(pairs.size()) + " pairs"};
  }
  StyleDelta change = change_between(pair.styled, 0, pair.neutral, 0, 1);
  change.velocity_left = change.velocity_forward = change.turn_rate = 0;
  StyleInfo info{style, description, "a pose: " + file_name(pair.styled_name), true};
  info.thumbnail = thumbnail_of(pair.styled);
  LearntStyle learnt;
  learnt.file = make_style_file(file, info, fit_posture(model, change).tensors);
  PairReport report;
  report.neutral_name = pair.neutral_name;
  report.styled_name = pair.styled_name;
  learnt.pairs.push_back(std::move(report));
  return learnt;
}

}  // namespace

const char* LearntStyle::verdict() const {
  if (!judged) return "";
  if (held_back_cm >= kNoBetter * untouched_cm) return "poor";
  if (held_back_cm < kMaxShare * untouched_cm) return "good";
  const bool beats_posture = held_back_cm < mean_posture_cm;
  return beats_posture && held_back_cm < kGoodShare * untouched_cm ? "good" : "fair";
}

Error cannot_learn(const std::string& name) {
  return {name + ": has no trunk that styles can be learnt on; expected a model of recipe " +
              learning_recipe_names() + " with 'learn.mean' and 'learn.scale'",
          ErrorKind::model_cannot_learn};
}

Result<LearntStyle> learn_style(const TensorFile& file, const std::string& name,
                                std::span<const LearnPair> pairs, const std::string& style,
                                const std::string& description) {
  if (auto good = check_style_name(style); !good) return good.error();
  Result<std::shared_ptr<const Model>> model = Model::create(file, name);
  if (!model) return model.error();
  if (!(*model)->can_learn()) return cannot_learn(name);
  if (pairs.empty()) {
    return Error{"there is nothing to learn '" + style +
                 "' from; give a neutral and a styled clip"};
  }
  if (std::any_of(pairs.begin(), pairs.end(), [](const LearnPair& pair) { return pair.is_pose; })) {
    return learn_pose(file, **model, pairs, style, description);
  }
  // Each pair is a separate set, so that it is not matched with others.
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
  LearntStyle learnt;
  double seconds = 0;
  for (const LearnPair& pair : pairs) {
    const int neutral = static_cast<int>(takes.size()), styled = neutral + 1;
    takes.push_back(pair.neutral);
    takes.push_back(pair.styled);
    for (const int t : {neutral, styled}) {
      takes[t].row = {};
      takes[t].row.set = neutral;
      takes[t].row.style = t == styled ? style : "neutral";
      takes[t].row.neutral = t == neutral;
    }
    const std::vector<Pairing> found = pair_in_phase(takes, styled, neutral, pair.neutral_cycle);
    Result<PairReport> report = describe(pair, found, takes, neutral, styled);
    if (!report) return report.error();
    seconds += report->seconds;
    learnt.pairs.push_back(*std::move(report));
    pairings.insert(pairings.end(), found.begin(), found.end());
  }
  const SampleSet set(takes, pairings, {style}, (*model)->recipe(), false);
  std::vector<size_t> all, first, held_back;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    const bool late = sample.styled_frame >= kHeldBack * takes[sample.styled].frames();
    all.push_back(i);
    (late ? held_back : first).push_back(i);
  }
  StyleInfo info{style, description, "", true};
  info.thumbnail = thumbnail_of(pairs[0].styled);
  info.origin = std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair, " : " pairs, ") +
                with_decimals(seconds, 2) + " s:";
  for (const PairReport& pair : learnt.pairs) {
    info.origin += " " + file_name(pair.neutral_name) + " -> " + file_name(pair.styled_name) + ";";
  }
  info.origin.pop_back();
  // One fit without the held-out part, to evaluate it, and one with everything.
  learnt.judged = !first.empty() && !held_back.empty();
  double penalty = kPairPenalty, trust = 1;
  for (const LearnPair& pair : pairs) {
    if (pair.twin) penalty = kTwinPenalty, trust = std::min(trust, pair.twin->trust);
  }
  std::vector<TensorFile> fits(learnt.judged ? 2 : 1);
  parallel_for(static_cast<int>(fits.size()), [&](int i) {
    fits[i] = fit_style(*model, set, i == 0 ? all : first, penalty, trust);
  });
  if (learnt.judged) {
    const TensorFile trial = make_style_file(file, info, std::move(fits[1].tensors));
    Result<TensorFile> with_it = add_style(file, name, trial, "the style", true);
    if (!with_it) return with_it.error();
    auto read = Model::create(*with_it, name);
    if (!read) return read.error();
    measure(*read, style, takes, set, first, held_back, learnt);
    if (learnt.verdict() == std::string("poor")) {
      learnt.warnings.push_back(
          "'" + style +
          "' is no better than the input on the part of the clips that was held back (" +
          with_decimals(learnt.held_back_cm, 2) + " cm off, the input " +
          with_decimals(learnt.untouched_cm, 2) +
          "); record 2 to 3 s of one action, neutrally and in the style");
    }
  }
  // If a twin does something else, the action itself would count as a gesture.
  FoundGestures gestures;
  if (trust == 1) gestures = find_gestures(takes, pairings);
  for (const FoundGesture& found : gestures.gestures) {
    fits[0].tensors[gesture_key(learnt.gestures.size())] = found.gesture.tensor();
    learnt.gestures.push_back({found.gesture.name(), learnt.pairs[found.take / 2].styled_name,
                               found.start, found.gesture.seconds()});
  }
  if (!gestures.gestures.empty()) info.gesture_rate = with_decimals(double{gestures.rate}, 3);
  learnt.file = make_style_file(file, info, std::move(fits[0].tensors));
  return learnt;
}

}  // namespace panache
