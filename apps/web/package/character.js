// Styles the caller's own poses: panache.h for JavaScript. See index.d.ts.
import {
  PanacheError, checkFinite, checkInteger, checkJoints, checkKeys, checkPose, checkTriggered,
  handleFor, inUse, personNumbers, sideNumber, timingNumber, unexpected,
} from './checks.js';
import { removedIndex, removerHandle, writeClip } from './remover.js';
import {
  kCharacterOptions, kHumanJoint, kInputPose, kJoint, kReport, kShape, kSkeletonOptions,
  kStrengthKey, kStrengthTrack, kStylizeOptions,
} from './structs.js';

const kLoops = ['off', 'auto', 'on'];
const kNeutralShape = {
  strength: 1, posture: 1, dynamics: 1, timing: 1, legs: 1, torso: 1, leftArm: 1, rightArm: 1,
  footLock: 1, handContacts: 1, energy: 1,
};
const kStylizing = { easeSeconds: 0.15, smoothingSeconds: 0.04, holdFeet: true, styleRoot: true,
  maxSpeed: 15, gestureRate: 1, gestureSeed: 0 };

// Merges a caller's options into the defaults, which list all known options.
function optionsOf(defaults, given) {
  if (given === null || typeof given !== 'object') throw unexpected('options', 'an object', given);
  const unknown = Object.keys(given).find((key) => !(key in defaults));
  if (unknown) throw new PanacheError(`there is no option '${unknown}'`);
  return { ...defaults, ...given };
}

export function writeShape(arena, shape) {
  return arena.write(kShape, { structSize: kShape.size, ...optionsOf(kNeutralShape, shape) });
}

export class Skeleton {
  #wasm; #panache; #skeleton;

  constructor(panache, joints, options) {
    const { metresPerUnit, upAxis, humanJoints, poses } = optionsOf(
      { metresPerUnit: 0, upAxis: null, humanJoints: {}, poses: [] }, options);
    checkJoints(joints);
    this.#panache = panache;
    this.#wasm = panache._wasm;
    this.jointCount = joints.length;
    this.#skeleton = panache._arena((arena) => {
      const list = arena.array(kJoint, joints.map((joint) => ({
        name: arena.text(joint.name), parent: joint.parent, rotation: joint.rotation,
        translation: joint.translation,
      })));
      const map = Object.entries(humanJoints).map(([name, joint]) => (
        { vrmName: arena.text(name), joint: checkInteger(joint, `humanJoints.${name}`) }));
      poses.forEach((pose, i) => checkPose(pose, joints.length, `poses[${i}]`));
      const all = (key) => arena.copy(
        Float32Array.from(poses.flatMap((pose) => Array.from(pose[key]))));
      const told = arena.write(kSkeletonOptions, {
        structSize: kSkeletonOptions.size, metresPerUnit,
        upAxis: upAxis === null ? 0 : arena.text(upAxis),
        rotations: all('rotations'), translations: all('translations'), poseCount: poses.length,
        humanJointCount: map.length, humanJoints: arena.array(kHumanJoint, map),
      });
      return arena.create(
        (out) => this.#wasm.panache_skeleton_create(list, joints.length, told, out));
    });
  }

  find(humanJoint) {
    return this.#panache._arena((arena) => this.#wasm.panache_skeleton_find(
      this._handleFor(this.#panache), arena.text(humanJoint)));
  }
  _handleFor(panache) {
    return handleFor(panache, this.#panache, this.#skeleton, 'skeleton',
      'this skeleton is of another Panache; create one with createSkeleton()');
  }

  free() {
    this.#wasm.panache_skeleton_destroy(this.#skeleton);
    this.#skeleton = 0;
  }
}

export class Character {
  #wasm; #panache; #joints; #styles; #remover; #character; #block; #pose;

  constructor(panache, skeleton, options) {
    const { remover, ...told } = optionsOf(
      { ...kStylizing, skipCycles: false, maxLag: 0, maxLead: 0, remover: null }, options);
    this.#panache = panache;
    this.#wasm = panache._wasm;
    this.#joints = skeleton.jointCount;
    this.#styles = panache.styles;  // A character keeps the model that it was created with.
    this.#remover = remover;
    this.#character = panache._arena((arena) => {
      const at = arena.write(kCharacterOptions, { structSize: kCharacterOptions.size, ...told,
        remover: remover ? removerHandle(panache, remover) : 0 });
      return arena.create((out) => this.#wasm.panache_character_create(
        panache._model(), skeleton._handleFor(panache), at, out));
    });
    // A pose, which is styled in place, and the struct that points to it.
    this.#block = this.#wasm.malloc(28 * this.#joints + kInputPose.size);
    if (!this.#block) {
      this.free();
      throw new PanacheError('there is not enough memory');
    }
    this.#pose = this.#block + 28 * this.#joints;
    new Uint32Array(this.#wasm.memory.buffer, this.#pose, 2).set(
      [this.#block, this.#block + 16 * this.#joints]);
  }

  setStrength(style, strength) {
    const character = this.#handle();
    const index = this.#panache._styleIndex(style, this.#styles);
    this.#wasm.panache_character_set_strength(
      character, index, checkFinite(strength, `strength of '${style}'`));
  }
  setSide(style, side) {
    const character = this.#handle();
    const index = this.#panache._styleIndex(style, this.#styles);
    this.#wasm.panache_character_set_side(character, index, sideNumber(side, this.#styles[index]));
  }
  setPerson(person, variety = 1) {
    const character = this.#handle();
    const [seed, amount] = personNumbers(person, variety, (word) => this.#panache._seedOf(word));
    if (amount === 0 && this.#panache.personAxes.length === 0) return;
    this.#panache._arena((arena) => arena.check(
      this.#wasm.panache_character_set_person(character, seed, amount)));
  }
  trigger(style, gesture = 0) {
    const character = this.#handle();
    const index = this.#panache._styleIndex(style, this.#styles);
    checkTriggered(this.#wasm.panache_character_trigger(
      character, index, checkInteger(gesture, 'gesture')), this.#styles[index], gesture);
  }
  setRemoved(style) {
    this.#wasm.panache_character_set_removed(
      this.#handle(), removedIndex(this.#remover, style, 'character'));
  }
  setShape(shape) {
    this.#panache._arena((arena) => arena.check(this.#wasm.panache_character_set_shape(
      this.#handle(), writeShape(arena, shape))));
  }

  step(input, output, seconds) {
    const character = this.#handle();
    checkPose(input, this.#joints, 'input');
    checkPose(output, this.#joints, 'output');
    if (typeof seconds !== 'number') throw unexpected('seconds', 'a number', seconds);
    const { buffer } = this.#wasm.memory;
    const rotations = new Float32Array(buffer, this.#block, 4 * this.#joints);
    const translations = new Float32Array(
      buffer, this.#block + 16 * this.#joints, 3 * this.#joints);
    rotations.set(input.rotations);
    translations.set(input.translations);
    this.#wasm.panache_character_step(character, this.#pose, seconds, this.#pose);
    output.rotations.set(rotations);
    output.translations.set(translations);
  }

  report() {
    return this.#panache._arena((arena) => {
      const at = arena.write(kReport, { structSize: kReport.size });
      arena.check(this.#wasm.panache_character_get_report(this.#handle(), at));
      const { structSize, ...report } = arena.read(kReport, at);
      return report;
    });
  }
  reset() { this.#wasm.panache_character_reset(this.#handle()); }

  free() {
    this.#wasm.panache_character_destroy(this.#character);
    this.#wasm.free(this.#block);
    this.#character = this.#block = 0;
  }
  #handle() { return inUse(this.#character, 'character'); }
}

// `strength`: a number, or keyframes [seconds, strength].
function writeTrack(arena, panache, name, strength) {
  const keys = checkKeys(typeof strength === 'number' ? [[0, strength]] : strength, name);
  return {
    style: panache._styleIndex(name), keyCount: keys.length,
    keys: arena.array(kStrengthKey, keys.map(([seconds, value]) => ({ seconds, strength: value }))),
  };
}

// Writes the sides of all styles; null if none is given.
function writeSides(arena, panache, sides) {
  const given = Object.entries(sides);
  if (!given.length) return 0;
  const all = new Float32Array(panache.styles.length).fill(1);
  for (const [name, side] of given) {
    const index = panache._styleIndex(name);
    all[index] = sideNumber(side, panache.styles[index]);
  }
  return arena.copy(all);
}

// Writes the numbers of a person; null for nobody.
function writePerson(arena, panache, person, variety) {
  const [seed, amount] = personNumbers(person, variety, (word) => panache._seedOf(word));
  if (amount === 0) return 0;
  const count = Math.max(1, panache.personAxes.length), at = arena.allocate(4 * count);
  arena.check(panache._wasm.panache_model_draw_person(
    panache._model(), seed, at, panache.personAxes.length));
  const numbers = new Float32Array(panache._wasm.memory.buffer, at, count);
  numbers.forEach((number, i) => (numbers[i] = number * amount));
  return at;
}

// The style that stylizeClip() removes first.
function removalOf(panache, remover, remove) {
  if (!remover && remove === null) return {};
  if (!remover) {
    throw new PanacheError('remove: expected remover too, the model that takes the style off');
  }
  if (remove === null) throw new PanacheError('remover: expected remove too, the style to take off');
  return { remover: removerHandle(panache, remover), removed: remover._styleIndex(remove) };
}

export function stylizeClip(panache, skeleton, clip, strengths, options) {
  const wasm = panache._wasm;
  const { shape, styleTiming, loop, remover, remove, sides, person, variety, ...told } = optionsOf(
    { ...kStylizing, styleTiming: 'steps', shape: {}, loop: 'auto', remover: null, remove: null,
      sides: {}, person: null, variety: 1 }, options);
  if (!kLoops.includes(loop)) throw unexpected('loop', "'auto', 'on' or 'off'", loop);
  const joints = skeleton.jointCount;
  const styled = panache._arena((arena) => {
    const from = writeClip(arena, panache, skeleton, clip);
    const tracks = Object.entries(strengths).map(
      ([name, strength]) => writeTrack(arena, panache, name, strength));
    const how = arena.write(kStylizeOptions, {
      structSize: kStylizeOptions.size, ...told, styleTiming: timingNumber(styleTiming, 'styleTiming'),
      shape: writeShape(arena, shape), loop: kLoops.indexOf(loop),
      ...removalOf(panache, remover, remove), sides: writeSides(arena, panache, sides),
      person: writePerson(arena, panache, person, variety),
    });
    const list = arena.array(kStrengthTrack, tracks);
    return arena.create((out) => wasm.panache_stylize_clip(
      panache._model(), from, list, tracks.length, how, out));
  });
  const frames = wasm.panache_styled_clip_frame_count(styled);
  const copy = (type, at, count) => new type(wasm.memory.buffer, at, count).slice();
  const out = {
    frameCount: frames,
    frameSeconds: clip.frameSeconds,
    rotations: copy(Float32Array, wasm.panache_styled_clip_rotations(styled), 4 * joints * frames),
    translations: copy(
      Float32Array, wasm.panache_styled_clip_translations(styled), 3 * joints * frames),
    sourceFrames: copy(Float64Array, wasm.panache_styled_clip_source_frames(styled), frames),
    contacts: copy(Uint8Array, wasm.panache_styled_clip_contacts(styled), 2 * frames),
    gates: copy(Float32Array, wasm.panache_styled_clip_gates(styled), frames),
    isLoop: wasm.panache_styled_clip_is_loop(styled) !== 0,
  };
  wasm.panache_styled_clip_destroy(styled);
  return out;
}
