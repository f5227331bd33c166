#include "eval/ood.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "clip/motion_format.h"
#include "eval/joint_limits.h"
#include "eval/metrics.h"
#include "eval/motion_metrics.h"
#include "takes/manifest.h"
#include "learn/take.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

constexpr float kLimitTolerance_deg = 5;  // A smaller excess over a limit is not counted.
constexpr float kFloorTolerance = 0.03f;  // Metres.
constexpr float kCrouch = 0.7f;           // Metres: hips below it.
constexpr float kJump = 0.06f;            // Metres.
constexpr double kStill = 0.01;           // m/s: a coordinate that deviates less does not move.

Result<OodRow> style_input(const System& system, const TestInput& input,
                           const StyleRequest& request, const OodJudge* judge) {
  Result<RunResult> run_result = system.run(input, request);
  if (!run_result) return run_result.error();
  OodRow row = compare_ood(input.take, run_result->output.take);
  row.clip = fs::path(input.take.row.path).stem().string();
  row.style = request.style;
  row.gate = run_result->gate;
  if (!judge) return row;
  StyleRequest timed = request;
  timed.timing = true;
  if (system.can_run(input, timed)) {
    run_result = system.run(input, timed);
    if (!run_result) return run_result.error();
  }
  const Take& output = run_result->output.take;
  const double log_rate = std::log(static_cast<double>(input.take.frames()) / output.frames());
  row.verdict = judge->judge(input.take, output, log_rate, request.style);
  return row;
}

// Paths of the contents without a styled row.
std::vector<std::string> unstyled_files(const std::vector<ManifestRow>& rows) {
  std::set<std::string> styled;
  for (const ManifestRow& row : rows) {
    if (!row.neutral) styled.insert(row.content);
  }
  std::vector<std::string> files, tests;
  for (const ManifestRow& row : rows) {
    if (styled.contains(row.content)) continue;
    files.push_back(row.path);
    if (row.test) tests.push_back(row.path);
  }
  return tests.empty() ? files : tests;
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Velocity of one coordinate of a joint in the body frame, m/s. [frames - 1]
std::vector<float> velocities(const Take& take, HumanJoint joint, float Vec3::*axis) {
  std::vector<float> out;
  for (int f = 1; f < take.frames(); ++f) {
    const Vec3 step = take.body[f][index(joint)] - take.body[f - 1][index(joint)];
    out.push_back(step.*axis * static_cast<float>(kTakeRate));
  }
  return out;
}

// Pearson's correlation of `to` with `from`; empty if `from` does not move.
std::optional<double> correlation(const std::vector<float>& from, const std::vector<float>& to) {
  const double from_mean = mean_of(from), to_mean = mean_of(to);
  double both = 0, from_squares = 0, to_squares = 0;
  for (size_t i = 0; i < from.size(); ++i) {
    const double a = from[i] - from_mean, b = to[i] - to_mean;
    both += a * b;
    from_squares += a * a;
    to_squares += b * b;
  }
  const double count = static_cast<double>(from.size());
  if (!(from_squares > count * kStill * kStill)) return std::nullopt;
  return to_squares > 0 ? both / std::sqrt(from_squares * to_squares) : 0;
}

double velocity_correlation(const Take& from, const Take& to) {
  using enum HumanJoint;
  double sum = 0, count = 0;
  for (const HumanJoint joint : {left_hand, right_hand, left_foot, right_foot}) {
    for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      const auto one = correlation(velocities(from, joint, axis), velocities(to, joint, axis));
      if (!one) continue;
      sum += *one;
      ++count;
    }
  }
  return count > 0 ? sum / count : kNotMeasured;
}

// Twice the distance of a joint from the midpoint of its previous and next positions: the length of
// a jump in otherwise uniform motion, in the body frame, metres.
float kink(const Take& take, int frame, int joint) {
  const auto at = [&](int f) { return take.body[f][joint]; };
  return length(at(frame + 1) + at(frame - 1) - at(frame) * 2.0f);
}

// Frames where a joint of `to` jumps further than in `from` at that time.
int count_jumps(const Take& from, const Take& to) {
  constexpr int kNear = 2;  // Frames: tolerance of the time of an impact.
  int count = 0;
  const int last = std::min(from.frames(), to.frames()) - 2;
  for (int f = 1; f <= last; ++f) {
    const auto jumps = [&](int joint) {
      float usual = 0;
      for (int i = std::max(1, f - kNear); i <= std::min(last, f + kNear); ++i) {
        usual = std::max(usual, kink(from, i, joint));
      }
      return kink(to, f, joint) > std::max(usual + kJump, 2 * usual);
    };
    for (int j = 0; j < kHumanJoints; ++j) {
      if (!jumps(j)) continue;
      ++count;
      break;
    }
  }
  return count;
}

// Mean angle between the headings of the two bodies.
double mean_turn_deg(const Take& from, const Take& to) {
  double sum = 0;
  for (int f = 0; f < to.frames(); ++f) {
    const double turn = to.root[f].facing - from.root[f].facing;
    sum += std::abs(std::remainder(turn, 2 * std::numbers::pi));
  }
  return sum / to.frames() * 180 / std::numbers::pi;
}

float lowest_toe(const HumanPositions& body) {
  return std::min(body[index(kToes[0])].y, body[index(kToes[1])].y);
}

// Counts the legs of one frame.
void count_legs(const HumanPositions& from, const HumanPositions& to, LegRange& range) {
  for (size_t side = 0; side < 2; ++side) {
    const LegBeyond was = leg_beyond(from, side), is = leg_beyond(to, side);
    if (std::max(was.thigh, was.knee) > 0) continue;
    ++range.legs;
    range.thighs += is.thigh > kLimitTolerance_deg;
    range.knees += is.knee > kLimitTolerance_deg;
    range.worst_deg = std::max({range.worst_deg, is.thigh, is.knee});
  }
}

// Share of the frames where `fails` is true for `to` but not for `from`.
template <typename Fails>
double share_of_frames(const Take& from, const Take& to, const Fails& fails) {
  int count = 0;
  for (int f = 0; f < to.frames(); ++f) count += fails(from.body[f], to.body[f]);
  return static_cast<double>(count) / to.frames();
}

}  // namespace

OodRow compare_ood(const Take& input, const Take& output) {
  OodRow row;
  const double jerk = mean_jerk(input);
  row.jerk_ratio = jerk > 0 ? mean_jerk(output) / jerk : kNotMeasured;
  row.velocity_correlation = velocity_correlation(input, output);
  row.distance_cm = 100 * summed_distance(output, input) / kHumanJoints;
  row.beyond_limits =
      share_of_frames(input, output, [](const HumanPositions& from, const HumanPositions& to) {
        return beyond_limits(to).degrees > kLimitTolerance_deg &&
               beyond_limits(from).degrees <= kLimitTolerance_deg;
      });
  for (int f = 0; f < output.frames(); ++f) {
    const bool low = input.body[f][index(HumanJoint::hips)].y < kCrouch;
    count_legs(input.body[f], output.body[f], low ? row.crouching : row.upright);
  }
  row.under_floor =
      share_of_frames(input, output, [](const HumanPositions& from, const HumanPositions& to) {
        return lowest_toe(to) < std::min(0.0f, lowest_toe(from)) - kFloorTolerance;
      });
  row.jumps = count_jumps(input, output);
  row.skating_ratio = skating_ratio(output);
  row.input_skating_ratio = skating_ratio(input);
  row.turned_deg = mean_turn_deg(input, output);
  row.drift_m = length(output.root.back().position - input.root.back().position);
  row.shot = measure_shot(input, output);
  return row;
}

Result<std::vector<OodRow>> measure_ood(const std::vector<std::string>& files, const System& system,
                                        const OodJudge* judge,
                                        const std::function<void(double)>& progress,
                                        float strength) {
  std::vector<ManifestRow> named;
  for (const std::string& file : files) named.emplace_back().path = file;
  Result<std::vector<TestInput>> inputs = load_inputs(named);
  if (!inputs) return inputs.error();
  std::vector<std::pair<const TestInput*, StyleRequest>> jobs;
  for (const TestInput& input : *inputs) {
    for (const std::string& style : system.styles()) {
      const StyleRequest request{style, {{style, strength}}, false};
      if (system.can_run(input, request)) jobs.emplace_back(&input, request);
    }
  }
  std::atomic<int> done = 0;
  return parallel_results<OodRow>(jobs.size(), [&](int job) {
    Result<OodRow> row = style_input(system, *jobs[job].first, jobs[job].second, judge);
    const int finished = ++done;
    if (progress) progress(static_cast<double>(finished) / static_cast<double>(jobs.size()));
    return row;
  });
}

Result<std::vector<std::string>> list_ood(const std::string& path) {
  const std::span<const MotionFormat> formats = known_motion_formats();
  std::error_code status;
  std::vector<std::string> files;
  if (fs::is_directory(path, status)) {
    for (fs::recursive_directory_iterator at(path, status), end; !status && at != end;
         at.increment(status)) {
      if (at->is_regular_file(status) && find_format(formats, extension_of(at->path().string()))) {
        files.push_back(at->path().string());
      }
    }
    if (status) return Error{path + ": cannot be listed: " + status.message()};
    if (files.empty())
      return Error{path + ": holds no motion file (" + list_extensions(formats) + ")"};
  } else if (extension_of(path) == ".csv") {
    Result<std::vector<ManifestRow>> rows = read_manifest(path, 0);
    if (!rows) return rows.error();
    files = unstyled_files(*rows);
    if (files.empty())
      return Error{path + ": every content exists in a style; none is out of distribution"};
  } else if (fs::exists(path, status)) {
    files = {path};
  } else {
    return Error{path + ": not found; expected a motion file, a folder or a manifest (.csv)"};
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace panache
