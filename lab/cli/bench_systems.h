#pragma once
// The systems of other papers for panache-lab bench: built from motion, then timed.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "eval/system.h"

namespace panache::cli {

struct SystemTime {
  std::string name;
  double frame_us = 0;  // Processor time of a frame, with root, feet and all.
  size_t bytes = 0;     // What it keeps to work with.
};

struct BuiltSystems {
  TestInput input;
  std::vector<std::unique_ptr<System>> systems;

  // A frame of each, and of the model first, in one run on the same take.
  std::vector<SystemTime> time() const;
};

// Builds all of them from the training takes of `manifest`; `styles`: a CSV of style names, or
// empty; `model`: path of the model beside them. Takes minutes.
Result<BuiltSystems> build_systems(const std::string& manifest, const std::string& styles,
                                   const std::string& model);

}  // namespace panache::cli
