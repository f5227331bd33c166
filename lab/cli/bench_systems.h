#pragma once
// The systems of other papers for panache-lab bench: built from motion, then timed.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

struct SystemTime {
  std::string name;
  double frame_us = 0;  // Processor time of a frame, with root, feet and all.
  size_t bytes = 0;     // What it keeps to work with.
};

class BuiltSystems {
 public:
  virtual ~BuiltSystems() = default;
  // A frame of each, and of the model first, in one run on the same take.
  virtual std::vector<SystemTime> time() const = 0;
};

// Builds all of them from the training takes of `manifest`; `styles`: a CSV of style names, or
// empty; `model`: path of the model beside them. Takes minutes.
Result<std::unique_ptr<BuiltSystems>> build_systems(const std::string& manifest,
                                                    const std::string& styles,
                                                    const std::string& model);

}  // namespace panache::cli
