#pragma once
// The robustness of systems to disturbed input, as from other bodies, captures and files.

#include <string>
#include <vector>

#include "eval/aligned_takes.h"

namespace panache {

struct DisturbanceRow {
  std::string name;  // "none", "body scale x 0.8", ...
  double cm = 0;     // Mean pose error over styles and contents, see PoseError.
};

// The error of a system on `test` if only its input windows are disturbed; "none" first. Its output
// is applied to the undisturbed body: changes are added (recipe panache), poses replace it
// (smith2019). Empty if the system has no output for single instants or knows no style of the test.
std::vector<DisturbanceRow> measure_disturbances(const AlignedTakes& test, const System& system);

// The same takes under one disturbance, with features in `layout`. Exposed for tests.
struct Disturbing {
  std::string name;
  SeenTakes (*see)(const std::vector<Take>& takes, PoseLayout layout);
};
const std::vector<Disturbing>& disturbing_inputs();

}  // namespace panache
