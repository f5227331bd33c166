#pragma once
// Motion of the body models SMPL, SMPL-H and SMPL-X as research exchanges it (AMASS and others): an
// archive .npz of arrays, which others unpack and pack.
//
// Read are `poses` [frames, 72, 156 or 165], a rotation vector for each joint; `trans` [frames, 3],
// metres; and `mocap_framerate`, `mocap_frame_rate`, `fps`, `framerate` or `frame_rate`, frames per
// second. The axes are those of the numbers: Z up in AMASS, Y up elsewhere. All other arrays, betas
// and gender among them, are kept; the shape of the body is not applied (clip/smpl_skeleton.h).

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
// The bytes of an archive of these.
using PackNpz = std::string (*)(const std::vector<NpzMember>& members);

// Reads the arrays of an archive; `whole` are its bytes, which encode() gives back where nothing
// changed, and `name` stands in front of the message of a failure.
//
// encode() writes poses and trans in the types that they have. A joint that is as it was keeps its
// numbers. Arrays that hold parts of the poses (root_orient, pose_body, ...) are made anew, other
// arrays with a row per frame (dmpls, markers) are left out: they are of another motion.
Result<std::unique_ptr<MotionFile>> parse_smpl(std::vector<NpzMember> members, std::string whole,
                                               PackNpz pack, const std::string& name,
                                               const ReadOptions& options = {});

// The body of SMPL-H in T-pose, one frame.
Clip smpl_body();

// The arrays of a motion of smpl_body() in metres with +Y up: as those of AMASS, with Z up, gender
// "neutral" and betas of 0.
std::vector<NpzMember> format_smpl(const Clip& clip);

}  // namespace panache
