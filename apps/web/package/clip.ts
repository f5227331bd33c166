// Styles whole clips of the caller.

import type { Clip, Skeleton } from './character.js';
import { PanacheError, checkKeys, optionsOf, unexpected } from './checks.js';
import { kStrengthKey, kStrengthTrack, kStylizeOptions } from './header.js';
import type { Panache } from './index.js';
import type { Arena } from './memory.js';
import { removerHandle, writeClip, type Remover } from './remover.js';
import {
  kStylizing, personNumbers, sideNumber, styleIndex, timingNumber, writeShape,
  type Person, type Shape, type Side, type StylizingOptions, type Timing,
} from './styling.js';

export interface StylizeOptions extends StylizingOptions {
  /** Where the clip takes the tempo of the style. true is 'steps', the default; false is 'off'. */
  styleTiming?: Timing | boolean;
  shape?: Partial<Shape>;
  /** Sides of styles that are not put on as captured, by style. */
  sides?: Record<string, Side>;
  /** See Character.setPerson(); default: null and 1. */
  person?: Person;
  variety?: number;
  /** Whether the last pose of the result equals its first, except for travel: if it does in the
   * clip ('auto'), always, or an error if the two are too far apart ('on'), or never ('off'). */
  loop?: 'auto' | 'on' | 'off';
  /** The style of the clip, to remove first, including its tempo; 'any' for an unknown style. Needs
   * a remover. */
  remove?: string | null;
  remover?: Remover | null;
}
const kDefaults: Required<StylizeOptions> = { ...kStylizing, styleTiming: 'steps', shape: {},
  loop: 'auto', remover: null, remove: null, sides: {}, person: null, variety: 1 };
const kLoops = ['off', 'auto', 'on'];

export interface StyledClip extends Clip {
  frameCount: number;
  /** The (fractional) input frame that each output frame shows. */
  sourceFrames: Float64Array;
  /** [frames][2]: 1 where the left and the right foot are planted. */
  contacts: Uint8Array;
  gates: Float32Array;
  /** Whether it was styled as a loop. */
  isLoop: boolean;
}

type Strengths = Parameters<Panache['stylizeClip']>[2];

function writeTrack(arena: Arena, panache: Panache, name: string, strength: Strengths[string]) {
  const keys = checkKeys(typeof strength === 'number' ? [[0, strength]] : strength, name);
  return {
    style: styleIndex(panache.styles, name), keyCount: keys.length,
    keys: arena.array(kStrengthKey, keys.map(([seconds, value]) => ({ seconds, strength: value }))),
  };
}

// Writes the sides of all styles; null if none is given.
function writeSides(arena: Arena, { styles }: Panache, sides: Record<string, Side>) {
  const given = Object.entries(sides);
  if (!given.length) return 0;
  const all = new Float32Array(styles.length).fill(1);
  for (const [name, side] of given) {
    const index = styleIndex(styles, name);
    all[index] = sideNumber(side, styles[index]);
  }
  return arena.copy(all);
}

// Writes the numbers of a person; null for nobody.
function writePerson(arena: Arena, panache: Panache, person: Person, variety: number) {
  const { _module: module, personAxes } = panache;
  const [seed, amount] = personNumbers(module, person, variety);
  if (amount === 0) return 0;
  const count = Math.max(1, personAxes.length), at = arena.allocate(4 * count);
  arena.check(module.wasm.panache_model_draw_person(panache._model(), seed, at, personAxes.length));
  const numbers = module.floats(at, count);
  numbers.forEach((number, i) => (numbers[i] = number * amount));
  return at;
}

// The style that stylizeClip() removes first.
function removalOf(panache: Panache, remover: Remover | null, remove: string | null) {
  if (!remover && remove === null) return {};
  if (!remover) {
    throw new PanacheError('remove: expected remover too, the model that takes the style off');
  }
  if (remove === null) throw new PanacheError('remover: expected remove too, the style to take off');
  return { remover: removerHandle(panache, remover), removed: styleIndex(remover.styles, remove) };
}

export function stylizeClip(panache: Panache, skeleton: Skeleton, clip: Clip, strengths: Strengths,
  options: StylizeOptions): StyledClip {
  const { _module: module, _module: { wasm } } = panache;
  const { shape, styleTiming, loop, remover, remove, sides, person, variety, ...told } =
    optionsOf(kDefaults, options);
  if (!kLoops.includes(loop)) throw unexpected('loop', "'auto', 'on' or 'off'", loop);
  const joints = skeleton.jointCount;
  const styled = module.use((arena) => {
    const from = writeClip(arena, panache, skeleton, clip);
    const tracks = Object.entries(strengths).map(
      ([name, strength]) => writeTrack(arena, panache, name, strength));
    const written = arena.write(kStylizeOptions, {
      ...told, styleTiming: timingNumber(styleTiming, 'styleTiming'),
      shape: writeShape(arena, shape), loop: kLoops.indexOf(loop),
      ...removalOf(panache, remover, remove), sides: writeSides(arena, panache, sides),
      person: writePerson(arena, panache, person, variety),
    });
    const list = arena.array(kStrengthTrack, tracks);
    return arena.create((out) => wasm.panache_stylize_clip(
      panache._model(), from, list, tracks.length, written, out));
  });
  const frames = wasm.panache_styled_clip_frame_count(styled);
  const floats = (at: number, count: number) => module.copy(Float32Array, at, count * frames);
  const out = {
    frameCount: frames,
    frameSeconds: clip.frameSeconds,
    rotations: floats(wasm.panache_styled_clip_rotations(styled), 4 * joints),
    translations: floats(wasm.panache_styled_clip_translations(styled), 3 * joints),
    sourceFrames: module.copy(Float64Array, wasm.panache_styled_clip_source_frames(styled), frames),
    contacts: module.copy(Uint8Array, wasm.panache_styled_clip_contacts(styled), 2 * frames),
    gates: floats(wasm.panache_styled_clip_gates(styled), 1),
    isLoop: wasm.panache_styled_clip_is_loop(styled) !== 0,
  };
  wasm.panache_styled_clip_destroy(styled);
  return out;
}
