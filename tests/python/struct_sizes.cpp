// Prints name, size, and names and places of the fields of the structs of panache.h, as the
// compiler sees them.

#include <panache/panache.h>

#include <cstddef>
#include <cstdio>

#define STRUCT(name) std::printf("\n%s %zu", #name, sizeof(panache_##name))
#define FIELD(name, field) std::printf(" %s %zu", #field, offsetof(panache_##name, field))

int main() {
  STRUCT(joint);
  FIELD(joint, name);
  FIELD(joint, parent);
  FIELD(joint, rotation);
  FIELD(joint, translation);
  STRUCT(human_joint);
  FIELD(human_joint, vrm_name);
  FIELD(human_joint, joint);
  STRUCT(skeleton_options);
  FIELD(skeleton_options, struct_size);
  FIELD(skeleton_options, metres_per_unit);
  FIELD(skeleton_options, up_axis);
  FIELD(skeleton_options, rotations);
  FIELD(skeleton_options, translations);
  FIELD(skeleton_options, pose_count);
  FIELD(skeleton_options, human_joint_count);
  FIELD(skeleton_options, human_joints);
  STRUCT(character_options);
  FIELD(character_options, struct_size);
  FIELD(character_options, ease_seconds);
  FIELD(character_options, smoothing_seconds);
  FIELD(character_options, hold_feet);
  FIELD(character_options, style_root);
  FIELD(character_options, skip_cycles);
  FIELD(character_options, max_lag);
  FIELD(character_options, max_lead);
  FIELD(character_options, max_speed);
  FIELD(character_options, remover);
  FIELD(character_options, gesture_rate);
  FIELD(character_options, gesture_seed);
  STRUCT(shape);
  FIELD(shape, struct_size);
  FIELD(shape, strength);
  FIELD(shape, posture);
  FIELD(shape, dynamics);
  FIELD(shape, timing);
  FIELD(shape, legs);
  FIELD(shape, torso);
  FIELD(shape, left_arm);
  FIELD(shape, right_arm);
  FIELD(shape, foot_lock);
  FIELD(shape, hand_contacts);
  FIELD(shape, energy);
  STRUCT(input_pose);
  FIELD(input_pose, rotations);
  FIELD(input_pose, translations);
  STRUCT(output_pose);
  FIELD(output_pose, rotations);
  FIELD(output_pose, translations);
  STRUCT(report);
  FIELD(report, struct_size);
  FIELD(report, gate);
  FIELD(report, contacts);
  FIELD(report, rate);
  FIELD(report, ahead);
  STRUCT(clip);
  FIELD(clip, skeleton);
  FIELD(clip, frame_count);
  FIELD(clip, frame_seconds);
  FIELD(clip, rotations);
  FIELD(clip, translations);
  STRUCT(strength_key);
  FIELD(strength_key, seconds);
  FIELD(strength_key, strength);
  STRUCT(strength_track);
  FIELD(strength_track, style);
  FIELD(strength_track, key_count);
  FIELD(strength_track, keys);
  STRUCT(stylize_options);
  FIELD(stylize_options, struct_size);
  FIELD(stylize_options, ease_seconds);
  FIELD(stylize_options, smoothing_seconds);
  FIELD(stylize_options, hold_feet);
  FIELD(stylize_options, style_root);
  FIELD(stylize_options, style_timing);
  FIELD(stylize_options, shape);
  FIELD(stylize_options, max_speed);
  FIELD(stylize_options, loop);
  FIELD(stylize_options, removed);
  FIELD(stylize_options, remover);
  FIELD(stylize_options, gesture_rate);
  FIELD(stylize_options, gesture_seed);
  FIELD(stylize_options, sides);
  FIELD(stylize_options, person);
  STRUCT(retarget_options);
  FIELD(retarget_options, struct_size);
  FIELD(retarget_options, hold_feet);
  FIELD(retarget_options, meet_hands);
  STRUCT(pair);
  FIELD(pair, neutral);
  FIELD(pair, styled);
  STRUCT(learnt_report);
  FIELD(learnt_report, struct_size);
  FIELD(learnt_report, was_tested);
  FIELD(learnt_report, warnings);
  FIELD(learnt_report, held_back_cm);
  FIELD(learnt_report, mean_posture_cm);
  FIELD(learnt_report, untouched_cm);
  FIELD(learnt_report, people);
  FIELD(learnt_report, is_known);
  FIELD(learnt_report, certainty);
  STRUCT(clip_edit);
  FIELD(clip_edit, clip);
  FIELD(clip_edit, name);
  FIELD(clip_edit, frames);
  FIELD(clip_edit, source_frames);
  std::printf("\n");
}
