#pragma once
// The walker's model: a walk, a run and a standing pose. A few thousand numbers.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "walker/gait.h"

namespace panache {

// How to evaluate a gait at a given speed: as learnt at `speed`, scaled by `amount` (0 to 1) so
// that the standing foot moves back under the body as fast as the body moves ahead.
struct Stride {
  float speed = 0;
  float amount = 1;
};

class WalkerModel {
 public:
  // Reads and checks a model file; the error message says what is wrong.
  static Result<std::shared_ptr<const WalkerModel>> load(const std::string& path);
  static Result<std::shared_ptr<const WalkerModel>> parse(std::string_view bytes,
                                                          const std::string& name);

  WalkerModel() = default;
  WalkerModel(Gait walk, Gait run, const Channels& stand,
              std::map<std::string, std::string> metadata);

  const Gait& walk() const { return walk_; }
  const Gait& run() const { return run_; }
  Stride walk_stride(float speed) const noexcept { return look_up(walk_strides_, speed); }
  Stride run_stride(float speed) const noexcept { return look_up(run_strides_, speed); }
  const Channels& stand() const { return stand_; }  // Symmetric, over the middle of the feet.
  const std::map<std::string, std::string>& metadata() const { return metadata_; }

  // The bytes of a model file that parse() reads.
  std::string format() const;

 private:
  static constexpr float kStrideSpacing = 0.1f;  // m/s
  static constexpr int kStrides = 64;
  using Strides = std::array<Stride, kStrides>;
  static Strides find_strides(const Gait& gait);
  static Stride look_up(const Strides& strides, float speed) noexcept;

  Gait walk_, run_;
  Channels stand_{};
  Strides walk_strides_, run_strides_;
  std::map<std::string, std::string> metadata_;  // Data and licence; format() adds more.
};

}  // namespace panache
