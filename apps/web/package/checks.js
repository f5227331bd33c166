// Checks arguments before they reach the module. Messages say what was expected and what was found.

/** Bad input. */
export class PanacheError extends Error {
  /** The kind of error, for programs that handle it. */
  kind;
  constructor(message, kind = 'other') {
    super(message);
    this.kind = kind;
  }
}
// In the order of panache_error_kind.
const kinds = [
  'other', 'fileExists', 'rateNeeded', 'notHumanoid', 'unknownStyle', 'noStyles', 'styleExists',
  'isModel', 'isStyleFile', 'styleOfAnother', 'notSafetensors', 'modelCannotLearn',
  'otherSkeletons', 'loopOpen', 'loopStrengths', 'badStyleName',
];
/** The library's last error. */
export function lastError(wasm) {
  const bytes = new Uint8Array(wasm.memory.buffer, wasm.panache_last_error());
  const text = new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  return new PanacheError(text, kinds[wasm.panache_last_error_kind()]);
}

function describe(value) {
  if (value === undefined || value === null) return 'nothing';
  if (typeof value === 'string') return `'${value}'`;
  if (typeof value !== 'object') return String(value);
  return `an object of the class ${value.constructor?.name ?? 'Object'}`;
}
export function unexpected(what, expectation, value) {
  return new PanacheError(`${what}: expected ${expectation}, found ${describe(value)}`);
}

// Returns the handle of an object, or throws if the object was freed (its handle is 0).
export function inUse(handle, what) {
  if (handle) return handle;
  throw new PanacheError(`this ${what} was freed and cannot be used any more; create another one`);
}
// Also checks that `owner` is `panache`: handles are addresses in the owner's module memory.
export function handleFor(panache, owner, handle, what, foreign) {
  if (panache !== owner) throw new PanacheError(foreign);
  return inUse(handle, what);
}

export function checkBytes(bytes, what) {
  if (typeof bytes?.byteLength === 'number') return bytes;
  throw unexpected(what, 'an ArrayBuffer or a Uint8Array', bytes);
}
export function checkFinite(value, what) {
  if (Number.isFinite(value)) return value;
  throw unexpected(what, 'a finite number', value);
}
export function checkInteger(value, what) {
  if (Number.isInteger(value)) return value;
  throw unexpected(what, 'a whole number', value);
}
// Returns the side of a style as a number. `style`: as in Panache.styles.
export function sideNumber(side, { name, side: captured }) {
  if (captured === null) {
    throw new PanacheError(`the styles of this model have no sides, so '${name}' has none`);
  }
  const words = new Map([['captured', 1], ['mirrored', -1]]);
  for (const word of captured ? ['left', 'right'] : []) {
    words.set(word, captured.split(' ').includes(word) ? 1 : -1);
  }
  const number = words.get(side) ?? side;
  if (typeof number === 'number' && number >= -1 && number <= 1) return number;
  throw unexpected(`side of '${name}'`,
    `${[...words.keys()].map((word) => `'${word}'`).join(', ')} or a number from -1 to 1`, side);
}
// Returns the seed and the amount of a person; of null, nobody. `seedOf` gives the seed of a word.
export function personNumbers(person, variety, seedOf) {
  if (!(typeof variety === 'number' && variety >= 0 && variety <= 2)) {
    throw unexpected('variety', 'a number from 0 to 2', variety);
  }
  if (person === null) return [0, 0];
  if (typeof person === 'string' && person) return [seedOf(person), variety];
  if (Number.isInteger(person) && person >= 0 && person < 2 ** 32) return [person, variety];
  throw unexpected('person', 'a word, a whole number from 0 to 4294967295, or null', person);
}
// Checks the result of a trigger: whether the style has such a gesture.
export function checkTriggered(found, { name, gestures }, gesture) {
  if (found) return;
  throw new PanacheError(
    `style '${name}' has no gesture ${gesture}; it has ${gestures.length}`);
}
// See style_timing in panache.h.
export function timingNumber(timing, what) {
  const number = new Map([['off', 0], ['steps', 1], ['all', 2], [false, 0], [true, 1]]).get(timing);
  if (number !== undefined) return number;
  throw unexpected(what, "'steps', 'all', 'off', true or false", timing);
}
function checkNumbers(list, count, what, names) {
  const found = Array.isArray(list) || ArrayBuffer.isView(list) ? list.length : undefined;
  if (found === count && Array.prototype.every.call(list, Number.isFinite)) return;
  const expectation = `${count} finite numbers (${names})`;
  if (found === undefined) throw unexpected(what, expectation, list);
  throw new PanacheError(
    `${what}: expected ${expectation}, found [${Array.from(list).join(', ')}]`);
}

export function checkJoints(joints) {
  if (!Array.isArray(joints)) throw unexpected('joints', 'an array of joints', joints);
  joints.forEach((joint, i) => {
    if (typeof joint?.name !== 'string') {
      throw unexpected(`joint ${i}: name`, 'a string', joint?.name);
    }
    const place = `joint ${i} '${joint.name}'`;
    checkInteger(joint.parent, `${place}: parent`);
    checkNumbers(joint.rotation, 4, `${place}: rotation`, 'x y z w');
    checkNumbers(joint.translation, 3, `${place}: translation`, 'x y z');
  });
}

function checkArray(array, length, what) {
  if (array instanceof Float32Array && array.length === length) return;
  const expectation = `a Float32Array of ${length} numbers`;
  if (!(array instanceof Float32Array)) throw unexpected(what, expectation, array);
  throw new PanacheError(`${what}: expected ${expectation}, found one of ${array.length}`);
}
export function checkPose(pose, joints, what) {
  checkArray(pose?.rotations, 4 * joints, `${what}.rotations`);
  checkArray(pose?.translations, 3 * joints, `${what}.translations`);
}
// Returns the number of frames of a clip with `joints` joints.
export function checkClip(clip, joints) {
  if (!(clip?.rotations instanceof Float32Array)) {
    throw unexpected('clip.rotations', 'a Float32Array with 4 numbers for each joint of each frame',
      clip?.rotations);
  }
  const frames = Math.floor(clip.rotations.length / (4 * joints));
  checkPose(clip, frames * joints, 'clip');
  return frames;
}

// Checks the keyframes [seconds, strength] of a style.
export function checkKeys(keys, style) {
  const what = `strength of '${style}'`;
  if (!Array.isArray(keys)) throw unexpected(what, 'a number or keys [seconds, strength]', keys);
  keys.forEach((key, i) => checkNumbers(key, 2, `${what}: key ${i}`, 'seconds, strength'));
  return keys;
}
