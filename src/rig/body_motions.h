#pragma once
// Which motions of a file are a person's: files also hold animations of morph weights, materials,
// cameras and props.

#include <string>
#include <vector>

#include "clip/motion_file.h"
#include "rig/rig.h"

namespace panache {

// Whether a motion moves the humanoid of `rig`: one of its joints, a joint between them, or one
// that carries them all. `joints` are those of the motion, with what it leaves still.
bool moves_humanoid(const Skeleton& joints, const Rig& rig);

// Whether a motion of this name and length is a pose: "T-Pose", "Armature|Rest", one frame.
bool is_pose(const std::string& name, int frames);

struct BodyMotions {
  std::vector<int> clips;  // As in MotionFile::clip(), in their order.
  // Poses beside motions, in their order: they have one frame, or are called a T-pose, a rest or a
  // bind pose. In a file without other motions they are in `clips`.
  std::vector<int> poses;
  bool humanoid =
      false;  // Whether the file has a humanoid; otherwise all motions count that move a joint.
};
BodyMotions find_body_motions(const MotionFile& file, const RigOptions& options = {});

// "'blink' and 'lamp' move no joint of the humanoid", for messages.
std::string describe_still(const std::vector<std::string>& names, bool humanoid);
// The same of all motions that `body` of a file lacks, its poses too, "... and are passed over";
// empty where there are none.
std::string note_passed_over(const MotionFile& file, const BodyMotions& body);

// The first of them, or 0: what stands for a file of which one motion is wanted.
int first_body_motion(const MotionFile& file, const RigOptions& options = {});

}  // namespace panache
