// Styles the caller's own poses: panache.h for JavaScript.

import {
  PanacheError, checkFinite, checkInteger, checkJoints, checkPose, inUse, optionsOf, unexpected,
} from './checks.js';
import type { Panache } from './index.js';
import { removedIndex, removerHandle, type Remover } from './remover.js';
import { kCharacterOptions, kHumanJoint, kInputPose, kJoint, kReport, kSkeletonOptions } from './structs.js';
import {
  checkTriggered, kStylizing, personNumbers, sideNumber, styleIndex, writeShape,
  type Person, type Shape, type Side, type Style, type StylizingOptions,
} from './styling.js';

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
        structSize: kSkeletonOptions.size, metresPerUnit,
        upAxis: upAxis === null ? 0 : arena.text(upAxis),
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
export class Character {
  #panache: Panache; #joints: number; #styles: readonly Style[]; #remover: Remover | null;
  #character: number; #block: number; #pose: number;

  /** @internal */ static _create(panache: Panache, skeleton: Skeleton, options: CharacterOptions) {
    return new Character(panache, skeleton, options);
  }
  private constructor(panache: Panache, skeleton: Skeleton, options: CharacterOptions) {
    const { remover, ...told } = optionsOf<Required<CharacterOptions>>(
      { ...kStylizing, skipCycles: false, maxLag: 0, maxLead: 0, remover: null }, options);
    const { _module: module } = panache;
    this.#panache = panache;
    this.#joints = skeleton.jointCount;
    this.#styles = panache.styles;  // A character keeps the model that it was created with.
    this.#remover = remover;
    this.#character = module.use((arena) => {
      const at = arena.write(kCharacterOptions, { structSize: kCharacterOptions.size, ...told,
        remover: remover ? removerHandle(panache, remover) : 0 });
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

  /** 0 is neutral, 1 the style as captured, above 1 exaggerates it (-4 to 4). Eased in. Throws if
   * the model has no such style, or the strength is not finite. */
  setStrength(style: string, strength: number): void {
    const character = this.#handle(), index = styleIndex(this.#styles, style);
    this.#wasm.panache_character_set_strength(
      character, index, checkFinite(strength, `strength of '${style}'`));
  }
  /** Initially 'captured'. Eased in. Throws if the model has no such style or the style no such side. */
  setSide(style: string, side: Side): void {
    const character = this.#handle(), index = styleIndex(this.#styles, style);
    this.#wasm.panache_character_set_side(character, index, sideNumber(side, this.#styles[index]));
  }
  /** Moves as somebody else does, in addition to the styles; initially null, nobody. `variety`: how
   * far from the mean person, 0 to 2; 1, the default, is as people differ. Eased in. Throws if the
   * model has no persons. */
  setPerson(person: Person, variety = 1): void {
    const character = this.#handle();
    const [seed, amount] = personNumbers(this.#panache._module, person, variety);
    if (amount === 0 && this.#panache.personAxes.length === 0) return;
    this.#panache._module.use((arena) => arena.check(
      this.#wasm.panache_character_set_person(character, seed, amount)));
  }
  /** Plays a gesture of a style (its index in `gestures`; 0) at the style's strength. Waits up to
   * 3 s until no other gesture plays and a foot is on the floor; otherwise drops it. Throws if the
   * style has no such gesture. */
  trigger(style: string, gesture = 0): void {
    const character = this.#handle(), index = styleIndex(this.#styles, style);
    checkTriggered(this.#wasm.panache_character_trigger(
      character, index, checkInteger(gesture, 'gesture')), this.#styles[index], gesture);
  }
  /** Removes a style of the remover from the input before styles are added. Keeps the input's
   * tempo. null: none, the default. Eased in. Throws if the character has no remover. */
  setRemoved(style: string | null): void {
    this.#wasm.panache_character_set_removed(
      this.#handle(), removedIndex(this.#remover, style, 'character'));
  }
  /** Missing amounts are 1. Eased in. */
  setShape(shape: Partial<Shape>): void {
    this.#panache._module.use((arena) => arena.check(this.#wasm.panache_character_set_shape(
      this.#handle(), writeShape(arena, shape))));
  }

  /** Styles the next pose, `seconds` after the last. Input and output may be the same arrays. */
  step(input: Pose, output: Pose, seconds: number): void {
    const character = this.#handle(), { _module: module } = this.#panache;
    checkPose(input, this.#joints, 'input');
    checkPose(output, this.#joints, 'output');
    if (typeof seconds !== 'number') throw unexpected('seconds', 'a number', seconds);
    const rotations = module.floats(this.#block, 4 * this.#joints);
    const translations = module.floats(this.#block + 16 * this.#joints, 3 * this.#joints);
    rotations.set(input.rotations);
    translations.set(input.translations);
    this.#wasm.panache_character_step(character, this.#pose, seconds, this.#pose);
    output.rotations.set(rotations);
    output.translations.set(translations);
  }

  report(): Report {
    return this.#panache._module.use((arena) => {
      const at = arena.write(kReport, { structSize: kReport.size });
      arena.check(this.#wasm.panache_character_get_report(this.#handle(), at));
      const { structSize, ...report } = arena.read(kReport, at);
      return report as unknown as Report;
    });
  }
  /** Forgets the motion so far. */
  reset(): void { this.#wasm.panache_character_reset(this.#handle()); }

  free(): void {
    this.#wasm.panache_character_destroy(this.#character);
    this.#wasm.free(this.#block);
    this.#character = this.#block = 0;
  }
  get #wasm() { return this.#panache._module.wasm; }
  #handle() { return inUse(this.#character, 'character'); }
}
