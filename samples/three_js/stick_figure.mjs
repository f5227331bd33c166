// The samples' walking figure (../common/stick_figure.h) as three.js bones with names of their own.
import { Bone } from 'three';

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

// Angles of what swings, x y z w about x.
function bend(bone, angle) {
  bone.quaternion.set(Math.sin(angle / 2), 0, 0, Math.cos(angle / 2));
}

// Poses the figure as it walks, `seconds` after it began.
export function walk(root, seconds) {
  const turn = 6.283185307179586 * seconds * 0.9;
  const bone = (name) => root.getObjectByName(name);
  // All bones, as an animation mixer would: a style turns those too that the walk leaves at rest.
  for (const [name, , translation] of kBones) {
    bone(name).quaternion.identity();
    bone(name).position.set(...translation);
  }
  root.position.set(0, Math.fround(Math.fround(0.95) + Math.fround(0.02 * Math.cos(2 * turn))),
    Math.fround(1.2 * seconds));
  bend(bone('Wing_L'), 0.4 * Math.sin(turn));
  bend(bone('Wing_R'), -0.4 * Math.sin(turn));
  bend(bone('Wing_L_1'), -0.3);
  bend(bone('Wing_R_1'), -0.3);
  bend(bone('Stilt_L'), -0.45 * Math.sin(turn));
  bend(bone('Stilt_R'), 0.45 * Math.sin(turn));
  bend(bone('Stilt_L_1'), 0.35 + 0.35 * Math.cos(turn));
  bend(bone('Stilt_R_1'), 0.35 - 0.35 * Math.cos(turn));
}
