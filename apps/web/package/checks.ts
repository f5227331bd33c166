// Checks arguments before they reach the module. Messages say what was expected and what was found.

import type { Clip, Joint, Pose } from './character.js';
import type { kErrorKinds } from './header.js';

/** The kind of an error, for programs that handle it; most are 'other'. */
export type ErrorKind = typeof kErrorKinds[number];

/** Bad input; the message says where, what was expected and what was found. */
export class PanacheError extends Error {
  constructor(message: string, readonly kind: ErrorKind = 'other') { super(message); }
}

/** Returns work(); errors about the module's `argument` are about `name` instead. */
export function named<Out>(argument: string, name: string, work: () => Out): Out {
  try {
    return work();
  } catch (error) {
    if (error instanceof PanacheError && error.message.startsWith(`${argument}: `)) {
      error.message = name + error.message.slice(argument.length);
    }
    throw error;
  }
}

function describe(value: unknown) {
  if (value === undefined || value === null) return 'nothing';
  if (typeof value === 'string') return `'${value}'`;
  if (typeof value !== 'object') return String(value);
  return `an object of the class ${value.constructor?.name ?? 'Object'}`;
}
export function unexpected(what: string, expectation: string, value: unknown): PanacheError {
  return new PanacheError(`${what}: expected ${expectation}, found ${describe(value)}`);
}

/** Returns the handle of an object, or throws if the object was freed (its handle is 0). */
export function inUse<Handle>(handle: Handle, what: string): Handle {
  if (handle) return handle;
  throw new PanacheError(`this ${what} was freed and cannot be used any more; create another one`);
}

export function checkBytes(bytes: ArrayBuffer | Uint8Array, what: string): void {
  if (typeof bytes?.byteLength === 'number') return;
  throw unexpected(what, 'an ArrayBuffer or a Uint8Array', bytes);
}
export function checkFinite(value: number, what: string): number {
  if (Number.isFinite(value)) return value;
  throw unexpected(what, 'a finite number', value);
}
export function checkInteger(value: number, what: string): number {
  if (Number.isInteger(value)) return value;
  throw unexpected(what, 'a whole number', value);
}
/** Returns the caller's options over the defaults, which list all known options. */
export function optionsOf<Options extends object>(defaults: Options, given: Partial<Options>): Options {
  if (given === null || typeof given !== 'object') throw unexpected('options', 'an object', given);
  const unknown = Object.keys(given).find((key) => !(key in defaults));
  if (unknown) throw new PanacheError(`there is no option '${unknown}'`);
  return { ...defaults, ...given };
}

function checkNumbers(list: ArrayLike<number>, count: number, what: string, names: string) {
  const found = Array.isArray(list) || ArrayBuffer.isView(list) ? list.length : undefined;
  if (found === count && Array.prototype.every.call(list, Number.isFinite)) return;
  const expectation = `${count} finite numbers (${names})`;
  if (found === undefined) throw unexpected(what, expectation, list);
  throw new PanacheError(`${what}: expected ${expectation}, found [${Array.from(list).join(', ')}]`);
}
export function checkJoints(joints: readonly Joint[]): void {
  if (!Array.isArray(joints)) throw unexpected('joints', 'an array of joints', joints);
  joints.forEach((joint: Joint, i) => {
    if (typeof joint?.name !== 'string') {
      throw unexpected(`joint ${i}: name`, 'a string', joint?.name);
    }
    const which = `joint ${i} '${joint.name}'`;
    checkInteger(joint.parent, `${which}: parent`);
    checkNumbers(joint.rotation, 4, `${which}: rotation`, 'x y z w');
    checkNumbers(joint.translation, 3, `${which}: translation`, 'x y z');
  });
}

function checkArray(array: Float32Array, length: number, what: string) {
  if (array instanceof Float32Array && array.length === length) return;
  const expectation = `a Float32Array of ${length} numbers`;
  if (!(array instanceof Float32Array)) throw unexpected(what, expectation, array);
  throw new PanacheError(`${what}: expected ${expectation}, found one of ${array.length}`);
}
export function checkPose(pose: Pose, joints: number, what: string): void {
  checkArray(pose?.rotations, 4 * joints, `${what}.rotations`);
  checkArray(pose?.translations, 3 * joints, `${what}.translations`);
}
/** Returns the number of frames of a clip with `joints` joints. */
export function checkClip(clip: Clip, joints: number): number {
  if (!(clip?.rotations instanceof Float32Array)) {
    throw unexpected('clip.rotations', 'a Float32Array with 4 numbers for each joint of each frame',
      clip?.rotations);
  }
  const frames = Math.floor(clip.rotations.length / (4 * joints));
  checkPose(clip, frames * joints, 'clip');
  return frames;
}

type Key = readonly [seconds: number, strength: number];
export function checkKeys(keys: readonly Key[], style: string): readonly Key[] {
  const what = `strength of '${style}'`;
  if (!Array.isArray(keys)) throw unexpected(what, 'a number or keys [seconds, strength]', keys);
  keys.forEach((key, i) => checkNumbers(key, 2, `${what}: key ${i}`, 'seconds, strength'));
  return keys;
}
