#pragma once
// Finds the motions of a file that move its humanoid: files also hold animations of morph weights,
// materials, cameras and props.

#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/motion_file.h"
#include "rig/rig.h"

namespace panache {

// Whether a motion moves the humanoid of `rig`: one of its joints, a joint between them, or an
// ancestor of them all. `joints`: the motion's joints, including those without animation.
bool moves_humanoid(const Skeleton& joints, const Rig& rig);

// Whether a motion of this name and length is a pose: "T-Pose", "Armature|Rest", one frame.
bool is_pose(const std::string& name, int frames);

struct BodyMotions {
  std::vector<int> clips;  // Indices for MotionFile::clip(), ascending.
  // Poses, ascending: clips of one frame, or named T-pose, rest or bind pose. If a file has nothing
  // else, they are in `clips`.
  std::vector<int> poses;
  bool humanoid =
      false;  // Whether the file has a humanoid; otherwise every motion that moves a joint counts.
};
BodyMotions find_body_motions(const MotionFile& file, const RigOptions& options = {});

// "'blink' and 'lamp' move no joint of the humanoid", for messages.
std::string describe_still(const std::vector<std::string>& names, bool humanoid);
// The same for all motions of the file that are not in `body`, poses included, "... and are passed
// over"; empty if there are none.
std::string note_passed_over(const MotionFile& file, const BodyMotions& body);

// The first of them, or 0: the default if one motion of a file is wanted.
int first_body_motion(const MotionFile& file, const RigOptions& options = {});

// For games that move the character themselves. Removes the horizontal path of the body of `clip`,
// which has the joints of `rig`: hips and joints above them keep the horizontal position of the
// motion's first frame (Rig::first_frame()). Heights, rotations and a calibration pose stay. Joints
// without animated translation stay unchanged.
void stay_in_place(const Rig& rig, Clip& clip);

}  // namespace panache
