// Styles characters of three.js: panache/three. Reads and writes three's objects without importing
// three.

import type { AnimationMixer, Bone, Object3D } from 'three';
import { PanacheError, checkFinite, unexpected } from './checks.js';
import type { Character, CharacterOptions, Panache, Pose, Side, Skeleton, SkeletonOptions } from './index.js';

export interface StyledBonesOptions extends CharacterOptions,
    Pick<SkeletonOptions, 'metresPerUnit' | 'upAxis'> {
  /** The name of the bone for each human joint ("leftHand", as in VRM), if names and shape are not
   * enough; null if there is none. */
  humanBones?: Record<string, string | null>;
}

// Returns `root`, the bones below it and all nodes in between, parents first.
function findBones(root: Object3D) {
  if (typeof root?.traverse !== 'function') throw unexpected('root', 'an Object3D', root);
  const wanted = new Set<Object3D>();
  root.traverse((object) => {
    if (!(object as Bone).isBone) return;
    let at: Object3D | null = object;
    for (; at && !wanted.has(at); at = at === root ? null : at.parent) wanted.add(at);
  });
  if (!wanted.size) throw new PanacheError('root: expected an object with bones, found none');
  const bones: Object3D[] = [];
  root.traverse((object) => { if (wanted.has(object)) bones.push(object); });
  return bones;
}

// The scale of each bone's parent, relative to the parent of `root`: joints have no scale.
function scalesOf(bones: Object3D[], index: Map<Object3D | null, number>) {
  const own: number[] = [];
  return bones.map((bone, i) => {
    const above = own[index.get(bone.parent) ?? -1] ?? 1;
    const { x, y, z } = bone.scale;
    if (!(Math.min(x, y, z) > 0 && Math.max(x, y, z) < 1.001 * Math.min(x, y, z))) {
      throw new PanacheError(`'${bone.name}': expected a scale that is above 0 and the same along ` +
        `all axes, found ${x}, ${y}, ${z}`);
    }
    own[i] = above * x;
    return above;
  });
}

/** Styles bones in place, however they were posed. Takes the bones below `root` with all nodes in
 * between; scales are read once and have to be uniform. */
export class StyledBones {
  #bones: Object3D[]; #scales: number[]; #skeleton: Skeleton; #character: Character; #pose: Pose;
  #input: { rotations: Float64Array; translations: Float64Array };
  #styled = false;

  /** The bones have to be in their rest pose or an upright pose. Throws a PanacheError if they are
   * not a humanoid. */
  constructor(panache: Panache, root: Object3D, options: StyledBonesOptions = {}) {
    const { humanBones = {}, metresPerUnit, upAxis, ...rest } = options;
    this.#bones = findBones(root);
    const index = new Map<Object3D | null, number>(this.#bones.map((bone, i) => [bone, i]));
    this.#scales = scalesOf(this.#bones, index);
    const count = this.#bones.length;
    this.#pose = { rotations: new Float32Array(4 * count), translations: new Float32Array(3 * count) };
    this.#input = { rotations: new Float64Array(4 * count), translations: new Float64Array(3 * count) };
    this.#read();
    const joints = this.#bones.map((bone, i) => ({
      name: bone.name, parent: index.get(bone.parent) ?? -1,
      rotation: [...this.#pose.rotations.subarray(4 * i, 4 * i + 4)],
      translation: [...this.#pose.translations.subarray(3 * i, 3 * i + 3)],
    }));
    const humanJoints = Object.fromEntries(Object.entries(humanBones).map(([human, name]) => {
      const bone = name === null ? -1 : this.#bones.findIndex((bone) => bone.name === name);
      if (bone < 0 && name !== null) {
        throw new PanacheError(`humanBones.${human}: there is no bone '${name}'`);
      }
      return [human, bone];
    }));
    this.#skeleton = panache.createSkeleton(joints, {
      humanJoints, ...(metresPerUnit !== undefined && { metresPerUnit }),
      ...(upAxis !== undefined && { upAxis }),
    });
    try {
      this.#character = panache.createCharacter(this.#skeleton, rest);
    } catch (error) {
      this.#skeleton.free();
      throw error;
    }
  }

  /** Use it for strengths, the shape of the style, reports and resets. */
  get character(): Character { return this.#character; }
  /** The output of the last step, parents before children, with scales multiplied in. */
  get pose(): Pose { return this.#pose; }

  /** Styles the current pose of the bones, `seconds` after the last step. Pose all bones again, or
   * call restore(), before the next step. */
  step(seconds: number): void {
    this.#read();
    this.#character.step(this.#pose, this.#pose, seconds);
    const { rotations, translations } = this.#pose;
    this.#bones.forEach((bone, i) => {
      // Do not write unchanged values: they would lose the digits beyond 32 bits.
      if (differs(rotations, this.#input.rotations, 4 * i, 4)) {
        bone.quaternion.fromArray(rotations, 4 * i);
      }
      if (differs(translations, this.#input.translations, 3 * i, 3, this.#scales[i])) {
        bone.position.fromArray(translations, 3 * i).divideScalar(this.#scales[i]);
      }
    });
    this.#styled = true;
  }

  /** Restores the pose from before the last step. */
  restore(): void {
    if (!this.#styled) return;
    this.#bones.forEach((bone, i) => {
      bone.quaternion.fromArray(this.#input.rotations, 4 * i);
      bone.position.fromArray(this.#input.translations, 3 * i);
    });
    this.#styled = false;
  }

  /** The bones stay as they are. */
  free(): void {
    this.#character.free();
    this.#skeleton.free();
  }

  #read() {
    this.#bones.forEach((bone, i) => {
      bone.quaternion.toArray(this.#input.rotations, 4 * i);
      bone.position.toArray(this.#input.translations, 3 * i);
      for (let k = 0; k < 4; ++k) this.#pose.rotations[4 * i + k] = this.#input.rotations[4 * i + k];
      for (let k = 0; k < 3; ++k) {
        this.#pose.translations[3 * i + k] = this.#input.translations[3 * i + k] * this.#scales[i];
      }
    });
  }
}

function differs(styled: Float32Array, input: Float64Array, begin: number, count: number, scale = 1) {
  for (let i = begin; i < begin + count; ++i) {
    if (styled[i] !== Math.fround(input[i] * scale)) return true;
  }
  return false;
}

/** Styles the character that an AnimationMixer moves. Call update() instead of the mixer's. */
export class StyledMixer {
  #mixer: AnimationMixer; #bones: StyledBones;

  constructor(panache: Panache, mixer: AnimationMixer, options?: StyledBonesOptions) {
    if (typeof mixer?.getRoot !== 'function') throw unexpected('mixer', 'an AnimationMixer', mixer);
    this.#mixer = mixer;
    this.#bones = new StyledBones(panache, mixer.getRoot() as Object3D, options);
  }

  /** Use it for the shape of the style, reports and resets. */
  get character(): Character { return this.#bones.character; }
  /** 0 is neutral, 1 the style as captured, -4 to 4. Eased in. */
  setStrength(style: string, strength: number): void {
    this.character.setStrength(style, strength);
  }
  /** See Character.setSide(). */
  setSide(style: string, side: Side): void { this.character.setSide(style, side); }

  /** Updates the mixer by `seconds`, then styles its pose. */
  update(seconds: number): void {
    checkFinite(seconds, 'seconds');
    // The mixer only writes what its actions change, so it needs its own pose back first.
    this.#bones.restore();
    this.#mixer.update(seconds);
    this.#bones.step(seconds);
  }

  /** Restores the mixer's pose, for example before mixer.stopAllAction(). */
  restore(): void { this.#bones.restore(); }
  /** Restores the mixer's pose, and frees the character. */
  free(): void {
    this.#bones.restore();
    this.#bones.free();
  }
}
