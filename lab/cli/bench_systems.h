#pragma once
// Builds and times the systems of other papers for panache-lab bench.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/system.h"

namespace panache::cli {

struct SystemTime {
  std::string name;
  double frame_us = 0;  // CPU time per frame, including root motion and feet.
  size_t bytes = 0;     // Size of its data.
};

struct BuiltSystems {
  TestInput input;
  std::vector<std::unique_ptr<System>> systems;

  // Times a frame of each, after the model's, in one run on the same take.
  std::vector<SystemTime> time() const;
};

// Builds all of them from the training takes of `manifest`; `styles`: a CSV of style names, or
// empty; `model`: path of the model to compare with. Takes minutes.
Result<BuiltSystems> build_systems(const std::string& manifest, const std::string& styles,
                                   const std::string& model);

}  // namespace panache::cli
