#pragma once
// How much a system's answer suffers when only its input is disturbed: what other bodies, captures
// and files do to it.

#include <string>
#include <vector>

#include "eval/aligned_takes.h"

namespace panache {

struct DisturbanceRow {
  std::string name;  // "none", "body scale x 0.8", ...
  double cm = 0;     // Mean pose error over styles and contents, see PoseError.
};

// The error of a system on `test` when the windows that it sees are disturbed and nothing else is;
// "none" first. Its answer is put on the undisturbed body: changes as they are (recipe panache),
// poses in place of it (smith2019). Nothing where the system has no answers for single instants, or
// knows no style of the test.
std::vector<DisturbanceRow> measure_disturbances(const AlignedTakes& test, const System& system);

// The same takes as seen under one disturbance, numbers in `layout`. Exposed for tests.
struct Disturbing {
  std::string name;
  SeenTakes (*see)(const std::vector<Take>& takes, PoseLayout layout);
};
const std::vector<Disturbing>& disturbing_inputs();

}  // namespace panache
