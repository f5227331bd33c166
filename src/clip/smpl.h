#pragma once
// Motion of the body models SMPL, SMPL-H and SMPL-X in the format of AMASS and others: an .npz
// archive of arrays. Callers pack and unpack the archive.
//
// Reads `poses` [frames, 72, 156 or 165], a rotation vector for each joint; `trans` [frames, 3],
// metres; and `mocap_framerate`, `mocap_frame_rate`, `fps`, `framerate` or `frame_rate`, frames per
// second. The axes are not converted: Z is up in AMASS, Y elsewhere. All other arrays, such as
// betas and gender, are kept; body shape is not applied: the joints are
// those of the mean body.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// The joints of the body models SMPL, SMPL-H and SMPL-X (Loper et al. 2015, Romero et al. 2017,
// Pavlakos et al. 2019): the published tree, and approximate joint positions of their mean body.
//
// The models themselves are licensed and not needed: a pose consists of rotations of these joints.
// The offsets match the mean body to half a centimetre and are symmetric; the shape of a person
// (betas) is not applied. Metres, +Y up, facing +z, the T-pose of the models.
inline constexpr size_t kSmplJoints = 24, kSmplHJoints = 52, kSmplXJoints = 55;

// The skeleton of the model with this many joints, with the model's names and VRM roles. The offset
// of the pelvis is its position in the model's own frame, whose origin is not on the floor: a body
// stands on y = -1.2.
Skeleton smpl_skeleton(size_t joints);

struct NpzMember {
  std::string name;   // "poses.npy"
  std::string bytes;  // A .npy file (clip/npy.h).
};
// Returns the bytes of an archive with these members.
using PackNpz = std::string (*)(const std::vector<NpzMember>& members);

// Reads the arrays of an archive; `whole` has its bytes, which encode() returns if nothing changed.
// Error messages start with `name`.
//
// encode() keeps the types of poses and trans. An unchanged joint keeps its numbers. Arrays that
// hold parts of the poses (root_orient, pose_body, ...) are recomputed; other arrays with a row per
// frame (dmpls, markers) are dropped, because they belong to another motion.
Result<std::unique_ptr<MotionFile>> parse_smpl(std::vector<NpzMember> members, std::string whole,
                                               PackNpz pack, const std::string& name,
                                               const ReadOptions& options = {});

// The body of SMPL-H in T-pose, one frame.
Clip smpl_body();

// The arrays for a motion of smpl_body() in metres with +Y up: in the AMASS format, with Z up,
// gender "neutral" and betas of 0.
std::vector<NpzMember> format_smpl(const Clip& clip);

}  // namespace panache
