#pragma once
// The joints of the body models SMPL, SMPL-H and SMPL-X (Loper et al. 2015, Romero et al. 2017,
// Pavlakos et al. 2019): the published tree, and approximate joint positions of their mean body.
//
// The models themselves are licensed and not needed: a pose consists of rotations of these joints.
// The offsets match the mean body to half a centimetre and are symmetric; the shape of a person
// (betas) is not applied. Metres, +Y up, facing +z, the T-pose of the models.

#include "clip/clip.h"

namespace panache {

inline constexpr size_t kSmplJoints = 24, kSmplHJoints = 52, kSmplXJoints = 55;

// The skeleton of the model with this many joints, with the model's names and VRM roles. The offset
// of the pelvis is its position in the model's own frame, whose origin is not on the floor: a body
// stands on y = -1.2.
Skeleton smpl_skeleton(size_t joints);

}  // namespace panache
