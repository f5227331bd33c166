#include "walker/walker_model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/file.h"
#include "net/safetensors.h"

namespace panache {
namespace {

constexpr const char* kFormat = "panache-walker";
constexpr const char* kFormatVersion = "1";

// The scalars of a gait, in the order of their tensor.
constexpr int kGaitNumbers = 10;
template <class SomeGait>
auto numbers_of(SomeGait& gait) {
  return std::array{&gait.reference, &gait.slowest,  &gait.fastest,  &gait.cadence,
                    &gait.exponent,  &gait.lands[0], &gait.lands[1], &gait.lifts[0],
                    &gait.lifts[1],  &gait.gaze_lead};
}

constexpr float kTooLarge = 1e3f;  // Larger than any value of a gait.

// Whether the times of the steps are sensible: later divisions rely on it.
bool is_gait(const Gait& gait) {
  if (!(gait.slowest > 0.1f && gait.fastest > gait.slowest && gait.fastest < 20)) return false;
  if (!(gait.cadence > 0.01f && gait.cadence < 10 && std::abs(gait.exponent) < 3)) return false;
  for (const float speed : {gait.slowest, gait.reference, gait.fastest}) {
    const float u = speed - gait.reference;
    const float stance = gait.lifts[0] + gait.lifts[1] * u - (gait.lands[0] + gait.lands[1] * u);
    if (!(stance > 0.3f && stance < 6)) return false;
  }
  return std::abs(gait.gaze_lead) < 1;
}

Result<Gait> read_gait(const TensorFile& file, const std::string& key, const std::string& name) {
  const auto numbers = find_tensor(file, key + ".numbers", {kGaitNumbers}, name, kTooLarge);
  if (!numbers) return numbers.error();
  const auto coefficients =
      find_tensor(file, key + ".coefficients", {kChannels, kWaves, kTerms}, name, kTooLarge);
  if (!coefficients) return coefficients.error();
  Gait gait;
  for (int i = 0; i < kGaitNumbers; ++i) *numbers_of(gait)[i] = (*numbers)->values[i];
  gait.coefficients = (*coefficients)->values;
  if (!is_gait(gait)) {
    return Error{name + ": tensor '" + key + ".numbers' holds numbers that no gait has"};
  }
  return gait;
}

Result<void> check_metadata(const TensorFile& file, const std::string& name) {
  const auto format = file.metadata.find("format");
  if (format == file.metadata.end() || format->second != kFormat) {
    return Error{name +
                 ": is a safetensors file, but not a walker; expected metadata 'format' to be '" +
                 kFormat + "'"};
  }
  const auto version = file.metadata.find("format_version");
  if (version == file.metadata.end()) {
    return Error{name +
                 ": metadata 'format_version' is missing; expected a walker written by panache"};
  }
  if (version->second != kFormatVersion) {
    return Error{name + ": is a walker of format version " + version->second +
                 "; this program reads version " + kFormatVersion +
                 "; fit it again or use the program it came with"};
  }
  return {};
}

}  // namespace

WalkerModel::WalkerModel(Gait walk, Gait run, const Channels& stand,
                         std::map<std::string, std::string> metadata)
    : walk_(std::move(walk)),
      run_(std::move(run)),
      stand_(stand),
      walk_strides_(find_strides(walk_)),
      run_strides_(find_strides(run_)),
      metadata_(std::move(metadata)) {
  metadata_["format"] = kFormat;
  metadata_["format_version"] = kFormatVersion;
}

WalkerModel::Strides WalkerModel::find_strides(const Gait& gait) {
  // A gait is extrapolated this far beyond its learnt speeds.
  const float low = gait.slowest * 0.9f, high = gait.fastest * 1.4f;
  Strides strides;
  for (int i = 0; i < kStrides; ++i) {
    const float speed = static_cast<float>(i) * kStrideSpacing;
    const float wanted = speed / cadence(gait, speed);
    float a = low, b = high;
    while (b - a > 1e-4f) {
      const float middle = (a + b) / 2;
      (distance_over_foot(gait, middle) < wanted ? a : b) = middle;
    }
    strides[i].speed = a;
    strides[i].amount =
        std::clamp(wanted / std::max(distance_over_foot(gait, a), 0.01f), 0.0f, 1.0f);
  }
  return strides;
}

Stride WalkerModel::look_up(const Strides& strides, float speed) noexcept {
  const float at = std::clamp(speed / kStrideSpacing, 0.0f, kStrides - 1.001f);
  const int i = static_cast<int>(at);
  const float t = at - static_cast<float>(i);
  return {strides[i].speed * (1 - t) + strides[i + 1].speed * t,
          strides[i].amount * (1 - t) + strides[i + 1].amount * t};
}

Result<std::shared_ptr<const WalkerModel>> WalkerModel::load(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse(*bytes, path);
}

Result<std::shared_ptr<const WalkerModel>> WalkerModel::parse(std::string_view bytes,
                                                              const std::string& name) {
  Result<TensorFile> file = parse_safetensors(bytes, name);
  if (!file) return file.error();
  if (Result<void> checked = check_metadata(*file, name); !checked) return checked.error();
  Result<Gait> walk = read_gait(*file, "walk", name);
  if (!walk) return walk.error();
  Result<Gait> run = read_gait(*file, "run", name);
  if (!run) return run.error();
  const auto stand = find_tensor(*file, "stand", {kChannels}, name, kTooLarge);
  if (!stand) return stand.error();
  Channels channels;
  std::ranges::copy((*stand)->values, channels.begin());
  return std::make_shared<const WalkerModel>(*std::move(walk), *std::move(run), channels,
                                             std::move(file->metadata));
}

std::string WalkerModel::format() const {
  TensorFile file;
  file.metadata = metadata_;
  for (const auto& [key, gait] : {std::pair{"walk", &walk_}, std::pair{"run", &run_}}) {
    Tensor& numbers = file.tensors[std::string(key) + ".numbers"] = {{kGaitNumbers}, {}};
    for (const float* number : numbers_of(*gait)) numbers.values.push_back(*number);
    file.tensors[std::string(key) + ".coefficients"] = {{kChannels, kWaves, kTerms},
                                                        gait->coefficients};
  }
  file.tensors["stand"] = {{kChannels}, {stand_.begin(), stand_.end()}};
  return format_safetensors(file);
}

}  // namespace panache
