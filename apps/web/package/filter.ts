// Mirrors and smooths tracked poses before they are styled.

import type { Joint, Pose, Skeleton } from './character.js';
import { PanacheError, checkFinite, checkJoints, checkPose } from './checks.js';

const kStages = 2;        // Each delays a movement by its time constant or less.
const kLongestGap = 0.5;  // Seconds; after it the tracker has begun anew.
const kMaxSmooth = 1;     // Seconds.

const human = ['Shoulder', 'UpperArm', 'LowerArm', 'Hand', 'UpperLeg', 'LowerLeg', 'Foot', 'Toes'];

const multiply = ([a, b, c, d]: number[], [x, y, z, w]: number[]) => [
  d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x,
  d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z];
const inverse = ([x, y, z, w]: number[]) => [-x, -y, -z, w];
const turn = (q: number[], [x, y, z]: number[]) =>
  multiply(multiply(q, [x, y, z, 0]), inverse(q)).slice(0, 3);
// In the plane x = 0.
const mirroredTurn = ([x, y, z, w]: number[]) => [x, -y, -z, w];
const mirroredPosition = ([x, y, z]: number[]) => [-x, y, z];

// The name of the joint on the other side; null if the name has no side.
function twinName(name: string) {
  const swapped = name.replace(/left|right/gi, (side) => {
    const other = side.toLowerCase() === 'left' ? 'right' : 'left';
    return side === side.toUpperCase() ? other.toUpperCase()
      : side[0] === side[0].toUpperCase() ? other[0].toUpperCase() + other.slice(1) : other;
  });
  return swapped === name ? null : swapped;
}

// The joint on the other side for each joint, or the joint itself.
function findTwins(skeleton: Skeleton, joints: readonly Joint[]) {
  const twins = joints.map((_, j) => j);
  const names = new Map<string | null, number>(joints.map(({ name }, j) => [name, j]));
  joints.forEach(({ name }, j) => { twins[j] = names.get(twinName(name)) ?? j; });
  for (const part of human) {
    const [left, right] = [skeleton.find(`left${part}`), skeleton.find(`right${part}`)];
    if (left < 0 || right < 0) continue;
    twins[left] = right;
    twins[right] = left;
  }
  return twins;
}

// Rotations from the joint to the root.
function worldOf(joints: readonly Joint[], rotationOf: (joint: number) => number[]) {
  const world: number[][] = [];
  joints.forEach(({ parent }, j) => {
    world.push(parent < 0 ? rotationOf(j) : multiply(world[parent], rotationOf(j)));
  });
  return world;
}

/** Prepares tracked poses for a character: step(filtered, ...). */
export class PoseFilter {
  #joints: readonly Joint[]; #twins: number[]; #rest: number[][]; #mirror: boolean; #smooth: number;
  #stages: Pose[] | null = null;

  /** `joints`: those of the skeleton, whose rest pose is symmetric about x = 0. `mirror` exchanges
   * left and right, as a mirror does; joints that are not human, such as fingers, go by "left" and
   * "right" in their names. `smooth`: cuts jitter, delaying any movement by at most this long;
   * seconds, 0 to 1. */
  constructor(skeleton: Skeleton, joints: readonly Joint[],
    options: { mirror?: boolean; smooth?: number } = {}) {
    const { mirror = false, smooth = 0 } = options;
    checkJoints(joints);
    if (joints.length !== skeleton.jointCount) {
      throw new PanacheError(`joints: expected the ${skeleton.jointCount} of the skeleton, found ` +
        joints.length);
    }
    if (!(checkFinite(smooth, 'smooth') >= 0 && smooth <= kMaxSmooth)) {
      throw new PanacheError(`smooth: expected 0 to ${kMaxSmooth} seconds, found ${smooth}`);
    }
    this.#joints = joints;
    this.#twins = findTwins(skeleton, joints);
    this.#rest = worldOf(joints, (j) => Array.from(joints[j].rotation));
    this.#mirror = mirror;
    this.#smooth = smooth;
  }

  /** Changes a pose in place, `seconds` after the last one. */
  apply(pose: Pose, seconds: number): void {
    checkPose(pose, this.#joints.length, 'pose');
    checkFinite(seconds, 'seconds');
    if (this.#mirror) this.#mirrorPose(pose);
    if (this.#smooth > 0) this.#smoothPose(pose, seconds);
  }
  /** The next pose is not smoothed with those before. */
  reset(): void { this.#stages = null; }

  // What a joint has turned since its rest pose is that of its twin, mirrored.
  #mirrorPose({ rotations, translations }: Pose) {
    const joints = this.#joints, rest = this.#rest;
    const at = (list: Float32Array, j: number, size: number) =>
      Array.from(list.subarray(size * j, size * (j + 1)));
    const world = worldOf(joints, (j) => at(rotations, j, 4));
    const turned = joints.map((_, j) => {
      const twin = this.#twins[j];
      return multiply(mirroredTurn(multiply(world[twin], inverse(rest[twin]))), rest[j]);
    });
    const moved = joints.map(({ parent }, j) => {
      const twin = this.#twins[j], position = at(translations, twin, 3);
      const far = position.some((v, k) => Math.abs(v - joints[twin].translation[k]) > 1e-6);
      if (!far) return at(translations, j, 3);  // Its place in the parent does not change.
      const above = joints[twin].parent;
      const seen = mirroredPosition(above < 0 ? position : turn(world[above], position));
      return parent < 0 ? seen : turn(inverse(turned[parent]), seen);
    });
    joints.forEach(({ parent }, j) => {
      rotations.set(parent < 0 ? turned[j] : multiply(inverse(turned[parent]), turned[j]), 4 * j);
      translations.set(moved[j], 3 * j);
    });
  }

  #smoothPose({ rotations, translations }: Pose, seconds: number) {
    if (seconds > kLongestGap) this.reset();
    this.#stages ??= Array.from({ length: kStages }, () => (
      { rotations: rotations.slice(), translations: translations.slice() }));
    const gain = 1 - Math.exp(-seconds / (this.#smooth / kStages));
    for (const stage of this.#stages) {
      for (let i = 0; i < rotations.length; i += 4) {
        let dot = 0;
        for (let k = i; k < i + 4; ++k) dot += stage.rotations[k] * rotations[k];
        const sign = dot < 0 ? -1 : 1;
        const sum = [0, 1, 2, 3].map((k) =>
          stage.rotations[i + k] * (1 - gain) + sign * gain * rotations[i + k]);
        const length = Math.hypot(...sum);
        if (!(length > 0 && length < Infinity)) continue;  // No rotation.
        for (let k = 0; k < 4; ++k) rotations[i + k] = stage.rotations[i + k] = sum[k] / length;
      }
      for (let i = 0; i < translations.length; ++i) {
        const next = stage.translations[i] + gain * (translations[i] - stage.translations[i]);
        if (Number.isFinite(next)) translations[i] = stage.translations[i] = next;
      }
    }
  }
}
