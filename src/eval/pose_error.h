#pragma once
// How far a system's pose is from the real styled take, aligned in time.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "style/model.h"
#include "train/manifest.h"

namespace panache {

struct PoseError {
  double degrees = 0;  // Mean over frames and joints of the angle between local rotations.
  double cm = 0;       // Mean over frames and joints of the distance on the canonical body.
};

// One style's row of the table: an error per system.
struct PoseErrorRow {
  std::string style;
  size_t frames = 0;
  std::vector<PoseError> errors;  // [systems]
};

struct PoseErrorTable {
  std::vector<std::string> systems;  // "no transfer", "mean posture", then the models as named.
  std::vector<PoseErrorRow> rows;    // Per style; the last is the mean of the styles.
};

struct NamedModel {
  std::string name;
  std::shared_ptr<const Model> model;
};

// Judges on the test takes of `rows`, styled ones aligned to neutral test takes of the same
// content. The mean posture of a style is measured on the training takes. Styles that a model does
// not know are left out of the table.
Result<PoseErrorTable> measure_pose_error(const std::vector<ManifestRow>& rows,
                                          const std::vector<NamedModel>& models);

}  // namespace panache
