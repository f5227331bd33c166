#pragma once
// Motion of the body models SMPL, SMPL-H and SMPL-X in the format of AMASS and others: an .npz
// archive of arrays. Callers pack and unpack the archive.
//
// Reads `poses` [frames, 72, 156 or 165], a rotation vector for each joint; `trans` [frames, 3],
// metres; and `mocap_framerate`, `mocap_frame_rate`, `fps`, `framerate` or `frame_rate`, frames per
// second. The axes are not converted: Z is up in AMASS, Y elsewhere. All other arrays, such as
// betas and gender, are kept; body shape is not applied (clip/smpl_skeleton.h).

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

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
