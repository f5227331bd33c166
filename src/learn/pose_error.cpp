#include "learn/pose_error.h"

#include <numbers>

#include "learn/samples.h"
#include "style/stages/pose_change.h"

namespace panache {
namespace {

double degrees_between(Quat a, Quat b) {
  return length(log_rotation(conjugate(a) * b)) * 180 / std::numbers::pi;
}

}  // namespace

PoseError pose_error(const Take& styled, int frame, const Take& neutral, float at,
                     const StyleDelta& change) {
  // The true change t maps the neutral rotations n to the styled ones, s = t n; so the model
  // reaches c n = c t^-1 s.
  const StyleDelta truth = change_between(styled, frame, neutral, at, 1);
  const std::array<Quat, kHumanJoints>& real = styled.rotations[frame];
  std::array<Quat, kHumanJoints> reached;
  for (int j = 0; j < kHumanJoints; ++j) {
    reached[j] = joint_rotation(change, j) * conjugate(joint_rotation(truth, j)) * real[j];
  }
  const HumanPositions body = change_body(body_at(neutral, at), change);
  PoseError error;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    error.degrees += parent < 0 ? degrees_between(reached[j], real[j])
                                : degrees_between(conjugate(reached[parent]) * reached[j],
                                                  conjugate(real[parent]) * real[j]);
    error.cm += 100 * length(body[j] - styled.body[frame][j]);
  }
  error.degrees /= kHumanJoints;
  error.cm /= kHumanJoints;
  return error;
}

}  // namespace panache
