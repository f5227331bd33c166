#pragma once
// The joints of the body models SMPL, SMPL-H and SMPL-X (Loper et al. 2015, Romero et al. 2017,
// Pavlakos et al. 2019): the published tree, and about where the joints of their mean body are.
//
// The models themselves are licensed and not needed: a pose is rotations of these joints. The
// offsets are the mean body's to half a centimetre, made the same on both sides; the shape of a
// person (betas) is not applied. Metres, +Y up, facing +z, the T-pose of the models.

#include "clip/clip.h"

namespace panache {

inline constexpr size_t kSmplJoints = 24, kSmplHJoints = 52, kSmplXJoints = 55;

// The skeleton of the model with so many joints, under the models' names, with VRM roles. The
// offset of the pelvis is its place in the models' own frame, above whose origin bodies do not
// stand: a body stands on y = -1.2.
Skeleton smpl_skeleton(size_t joints);

}  // namespace panache
