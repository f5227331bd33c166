// Styles the caller's own poses: panache.h for JavaScript.

import { PanacheError, checkInteger, checkJoints, checkPose, inUse, optionsOf, unexpected } from './checks.js';
import { kCharacterOptions, kHumanJoint, kInputPose, kJoint, kReport, kSkeletonOptions } from './header.js';
import type { Panache } from './index.js';
import { removedIndex, removerHandle, type Remover } from './remover.js';
import { Styled, kStylizing, type Style, type StylizingOptions } from './styling.js';

/** One joint of your skeleton. */
export interface Joint {
  name: string;
  /** Index of the parent, smaller than the joint's own; -1 for a root. */
  parent: number;
  /** Rest transform relative to the parent: rotation x y z w, and translation in any unit. */
  rotation: ArrayLike<number>;
  translation: ArrayLike<number>;
}

/** Local rotations [joints][4] and translations [joints][3], in the skeleton's units and axes. */
export interface Pose {
  rotations: Float32Array;
  translations: Float32Array;
}
export interface Clip extends Pose {
  frameSeconds: number;
}

export interface SkeletonOptions {
  /** 0 (the default): detected from the length of the legs. */
  metresPerUnit?: number;
  /** "+Y", "-Z", ...; null (the default): detected. */
  upAxis?: string | null;
  /** The joint map, if names and shape are not enough: the index of the joint for each human joint
   * ("leftHand", as in VRM), -1 if there is none. */
  humanJoints?: Record<string, number>;
  /** A few poses of ordinary motion, to detect axes and floor more reliably than from the rest pose
   * alone. */
  poses?: readonly Pose[];
}

/** Your rig, shared by all its characters. */
export class Skeleton {
  readonly jointCount: number;
  #panache: Panache; #skeleton: number;

  /** @internal */ static _create(panache: Panache, joints: readonly Joint[], options: SkeletonOptions) {
    return new Skeleton(panache, joints, options);
  }
  private constructor(panache: Panache, joints: readonly Joint[], options: SkeletonOptions) {
    const { metresPerUnit, upAxis, humanJoints, poses } = optionsOf<Required<SkeletonOptions>>(
      { metresPerUnit: 0, upAxis: null, humanJoints: {}, poses: [] }, options);
    checkJoints(joints);
    this.#panache = panache;
    this.jointCount = joints.length;
    this.#skeleton = panache._module.use((arena) => {
      const list = arena.array(kJoint, joints.map((joint) => ({
        name: arena.text(joint.name), parent: joint.parent, rotation: joint.rotation,
        translation: joint.translation,
      })));
      const map = Object.entries(humanJoints).map(([name, joint]) => (
        { vrmName: arena.text(name), joint: checkInteger(joint, `humanJoints.${name}`) }));
      poses.forEach((pose, i) => checkPose(pose, joints.length, `poses[${i}]`));
      const all = (key: keyof Pose) => arena.copy(
        Float32Array.from(poses.flatMap((pose) => Array.from(pose[key]))));
      const told = arena.write(kSkeletonOptions, {
        metresPerUnit, upAxis: upAxis === null ? 0 : arena.text(upAxis),
        rotations: all('rotations'), translations: all('translations'), poseCount: poses.length,
        humanJointCount: map.length, humanJoints: arena.array(kHumanJoint, map),
      });
      return arena.create(
        (out) => panache._module.wasm.panache_skeleton_create(list, joints.length, told, out));
    });
  }

  /** Index of the joint mapped to a human joint, or -1. */
  find(humanJoint: string): number {
    const { _module: module } = this.#panache;
    return module.use((arena) => module.wasm.panache_skeleton_find(
      this._handleFor(this.#panache), arena.text(humanJoint)));
  }
  /** @internal */ _handleFor(panache: Panache): number {
    if (panache === this.#panache) return inUse(this.#skeleton, 'skeleton');
    throw new PanacheError('this skeleton is of another Panache; create one with createSkeleton()');
  }

  /** Characters that use it keep working. */
  free(): void {
    this.#panache._module.wasm.panache_skeleton_destroy(this.#skeleton);
    this.#skeleton = 0;
  }
}

export interface CharacterOptions extends StylizingOptions {
  /** How far the output may lag or lead the input, seconds. Default: 0. */
  maxLag?: number;
  maxLead?: number;
  /** Skip or repeat whole cycles to stay within these limits. Default: false. */
  skipCycles?: boolean;
  /** For setRemoved(). Default: null. */
  remover?: Remover | null;
}

/** Measurements of the last step. */
export interface Report {
  /** 1 if the input resembles the training motion; towards 0 styles only add their mean posture. */
  gate: number;
  /** Probability that each foot is planted: left, right. */
  contacts: [number, number];
  /** Input seconds per output second that the style asks for. */
  rate: number;
  /** Seconds by which the output leads the newest input; below 0: it lags. */
  ahead: number;
}

/** One of your characters in motion. */
export class Character extends Styled {
  #joints: number; #styles: readonly Style[]; #remover: Remover | null;
  #character: number; #block: number; #pose: number;

  /** @internal */ static _create(panache: Panache, skeleton: Skeleton, options: CharacterOptions) {
    return new Character(panache, skeleton, options);
  }
  private constructor(panache: Panache, skeleton: Skeleton, options: CharacterOptions) {
    super(panache);
    const { remover, ...told } = optionsOf<Required<CharacterOptions>>(
      { ...kStylizing, skipCycles: false, maxLag: 0, maxLead: 0, remover: null }, options);
    const { _module: module } = panache;
    this.#joints = skeleton.jointCount;
    this.#styles = panache.styles;  // A character keeps the model that it was created with.
    this.#remover = remover;
    this.#character = module.use((arena) => {
      const at = arena.write(kCharacterOptions,
        { ...told, remover: remover ? removerHandle(panache, remover) : 0 });
      return arena.create((out) => module.wasm.panache_character_create(
        panache._model(), skeleton._handleFor(panache), at, out));
    });
    // A pose, which is styled in place, and the struct that points to it.
    this.#block = module.wasm.malloc(28 * this.#joints + kInputPose.size);
    this.#pose = this.#block + 28 * this.#joints;
    if (!this.#block) {
      this.free();
      throw new PanacheError('there is not enough memory');
    }
    module.words(this.#pose, 2).set([this.#block, this.#block + 16 * this.#joints]);
  }

  /** Removes a style of the remover from the input before styles are added. Keeps the input's
   * tempo. null: none, the default. Eased in. Throws if the character has no remover. */
  setRemoved(style: string | null): void {
    this._wasm.panache_character_set_removed(
      this._character, removedIndex(this.#remover, style, 'character'));
  }

  /** Styles the next pose, `seconds` after the last. Input and output may be the same arrays. */
  step(input: Pose, output: Pose, seconds: number): void {
    const character = this._character, { _module: module } = this._panache;
    checkPose(input, this.#joints, 'input');
    checkPose(output, this.#joints, 'output');
    if (typeof seconds !== 'number') throw unexpected('seconds', 'a number', seconds);
    const rotations = module.floats(this.#block, 4 * this.#joints);
    const translations = module.floats(this.#block + 16 * this.#joints, 3 * this.#joints);
    rotations.set(input.rotations);
    translations.set(input.translations);
    this._wasm.panache_character_step(character, this.#pose, seconds, this.#pose);
    output.rotations.set(rotations);
    output.translations.set(translations);
  }

  report(): Report {
    return this._panache._module.use((arena) => {
      const at = arena.write(kReport);
      arena.check(this._wasm.panache_character_get_report(this._character, at));
      const { structSize, ...report } = arena.read(kReport, at);
      return report as unknown as Report;
    });
  }
  /** Forgets the motion so far. */
  reset(): void { this._wasm.panache_character_reset(this._character); }

  free(): void {
    this._wasm.panache_character_destroy(this.#character);
    this._wasm.free(this.#block);
    this.#character = this.#block = 0;
  }
  /** @internal */ get _styles() { return this.#styles; }
  /** @internal */ get _character() { return inUse(this.#character, 'character'); }
}
