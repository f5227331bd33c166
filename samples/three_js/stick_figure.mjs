// The samples' walking figure (../common/stick_figure.h) as three.js bones with names of their own.
import { AnimationClip, Bone, QuaternionKeyframeTrack, VectorKeyframeTrack } from 'three';

// Name, parent, translation; metres, Y up, facing +z, arms hanging.
const kBones = [
  ['Pelvis_M', -1, [0, 0.95, 0]],
  ['Back_A', 0, [0, 0.15, 0]],
  ['Back_B', 1, [0, 0.15, 0]],
  ['Nape', 2, [0, 0.22, 0]],
  ['Skull', 3, [0, 0.1, 0.02]],
  ['Wing_L', 2, [0.19, 0.16, 0]],
  ['Wing_L_1', 5, [0.02, -0.28, 0]],
  ['Wing_L_2', 6, [0, -0.25, 0.02]],
  ['Wing_R', 2, [-0.19, 0.16, 0]],
  ['Wing_R_1', 8, [-0.02, -0.28, 0]],
  ['Wing_R_2', 9, [0, -0.25, 0.02]],
  ['Stilt_L', 0, [0.09, -0.04, 0]],
  ['Stilt_L_1', 11, [0, -0.42, 0]],
  ['Stilt_L_2', 12, [0, -0.41, -0.02]],
  ['Stilt_L_3', 13, [0, -0.07, 0.14]],
  ['Stilt_R', 0, [-0.09, -0.04, 0]],
  ['Stilt_R_1', 15, [0, -0.42, 0]],
  ['Stilt_R_2', 16, [0, -0.41, -0.02]],
  ['Stilt_R_3', 17, [0, -0.07, 0.14]],
];

// Names that nobody knows: this says which bone is which.
export const humanBones = {
  hips: 'Pelvis_M', spine: 'Back_A', chest: 'Back_B', neck: 'Nape', head: 'Skull',
  leftUpperArm: 'Wing_L', leftLowerArm: 'Wing_L_1', leftHand: 'Wing_L_2',
  rightUpperArm: 'Wing_R', rightLowerArm: 'Wing_R_1', rightHand: 'Wing_R_2',
  leftUpperLeg: 'Stilt_L', leftLowerLeg: 'Stilt_L_1', leftFoot: 'Stilt_L_2',
  leftToes: 'Stilt_L_3',
  rightUpperLeg: 'Stilt_R', rightLowerLeg: 'Stilt_R_1', rightFoot: 'Stilt_R_2',
  rightToes: 'Stilt_R_3',
};

// The root bone of a new figure.
export function createFigure() {
  const bones = [];
  for (const [name, parent, translation] of kBones) {
    const bone = new Bone();
    bone.name = name;
    bone.position.set(...translation);
    bones[parent]?.add(bone);
    bones.push(bone);
  }
  return bones[0];
}

// The figure's walk as an animation of so many seconds.
export function createWalk(seconds) {
  const times = Array.from({ length: 60 * seconds + 1 }, (_, frame) => frame / 60);
  // What swings about x, by an angle at each instant.
  const swing = (name, angle) => new QuaternionKeyframeTrack(`${name}.quaternion`, times,
    times.flatMap((t) => {
      const half = angle(6.283185307179586 * t * 0.9) / 2;
      return [Math.sin(half), 0, 0, Math.cos(half)];
    }));
  return new AnimationClip('walk', -1, [
    new VectorKeyframeTrack('Pelvis_M.position', times, times.flatMap(
      (t) => [0, 0.95 + 0.02 * Math.cos(2 * 6.283185307179586 * t * 0.9), 1.2 * t])),
    swing('Wing_L', (turn) => 0.4 * Math.sin(turn)),
    swing('Wing_R', (turn) => -0.4 * Math.sin(turn)),
    swing('Wing_L_1', () => -0.3),
    swing('Wing_R_1', () => -0.3),
    swing('Stilt_L', (turn) => -0.45 * Math.sin(turn)),
    swing('Stilt_R', (turn) => 0.45 * Math.sin(turn)),
    swing('Stilt_L_1', (turn) => 0.35 + 0.35 * Math.cos(turn)),
    swing('Stilt_R_1', (turn) => 0.35 - 0.35 * Math.cos(turn)),
  ]);
}
