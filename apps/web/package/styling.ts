// What characters, clips and players are told of styles: names, sides, persons, shapes.

import { PanacheError, checkBytes, checkFinite, checkInteger, named, optionsOf, unexpected } from './checks.js';
import { kShape, kStyleInfo, kStylizeOptions } from './header.js';
import type { Panache } from './index.js';
import type { Arena, Module } from './memory.js';

export interface Style {
  /** "old" */
  name: string;
  /** What the style looks like, for people. */
  description: string;
  /** The group of the style, "moods"; "" for learnt styles, and in models without groups. */
  group: string;
  /** Other words for it in lower case, as people search for it: "elderly"; may be empty. */
  words: readonly string[];
  /** Whether learnStyle() made it. */
  learnt: boolean;
  /** A row of poses from the styled clip, SVG; "" for styles that were not learnt. */
  thumbnail: string;
  /** The side that was captured, as one sees it: "right leg", "to the left". It has the word left or
   * right in it once; with the other one it tells what is seen of the mirrored style. "" if the model
   * does not say, null if its styles have no sides. */
  side: string | null;
  /** What its gestures do and how long they take, "glances left, 1.2 s"; often empty. */
  gestures: string[];
}

/** The side of a style, such as the leg of a limp: 1 or 'captured', -1 or 'mirrored', between them
 * the mean of both; 'left' and 'right' if the style's `side` tells which was captured. */
export type Side = number | 'captured' | 'mirrored' | 'left' | 'right';

/** A person by a seed: each whole number and each word is another one; null is nobody. */
export type Person = number | string | null;

/** Where a motion takes the tempo of its styles: only where the feet step, so talk and gestures
 * keep their length; everywhere; or nowhere. */
export type Timing = 'steps' | 'all' | 'off';

/** Scales the parts of what the styles do, 0 to 2; 1 is the style as the model has it. Posture is
 * the constant part of the change, dynamics the rest. Parts of the body are relative to what they
 * are attached to. */
export interface Shape {
  strength: number;
  posture: number;
  dynamics: number;
  timing: number;
  /** Includes the hips, their height and the root motion. */
  legs: number;
  /** Includes the head. */
  torso: number;
  leftArm: number;
  rightArm: number;
  /** 0 to 1. */
  footLock: number;
  /** How firmly hands keep what they touch, 0 to 1. */
  handContacts: number;
  /** From calm to lively: how much of the input's own movement of torso, head and arms is kept, with
   * or without a style. */
  energy: number;
}
const { structSize: _, ...kNeutralShape } = kShape.initial;

export interface StylizingOptions {
  /** A change of strength takes about this long. Default: 0.15. */
  easeSeconds?: number;
  /** Time constant of the filter on the change. Default: 0.04. */
  smoothingSeconds?: number;
  /** Hold planted feet in place. Default: true. */
  holdFeet?: boolean;
  /** Style the root motion too. Default: true. */
  styleRoot?: boolean;
  /** m/s. Faster hips count as a jump, which resets the style. Bodies on vehicles need more; 0 or
   * Infinity turns this off. Default: 15. */
  maxSpeed?: number;
  /** How often the active styles play their gestures, at random: 1 as often as the performers did,
   * 0 not at all, up to 10 times as often. A clip that is styled as a loop has none. Default: 1. */
  gestureRate?: number;
  /** An integer; characters with different seeds gesture at different times. Default: 0. */
  gestureSeed?: number;
}
const { easeSeconds, smoothingSeconds, maxSpeed, gestureRate, gestureSeed } = kStylizeOptions.initial;
export const kStylizing: Required<StylizingOptions> = { easeSeconds, smoothingSeconds, holdFeet: true,
  styleRoot: true, maxSpeed, gestureRate, gestureSeed };

export function writeShape(arena: Arena, shape: Partial<Shape>): number {
  return arena.write(kShape, optionsOf<Shape>(kNeutralShape, shape));
}

/** Reads a model from the bytes of its file; `name` is for messages. */
export function createModel(module: Module, bytes: ArrayBuffer | Uint8Array, name: string): number {
  checkBytes(bytes, name);
  return named('model', name, () => module.use((arena) => arena.create((out) =>
    module.wasm.panache_model_create(arena.copy(bytes), bytes.byteLength, out))));
}
/** The styles of a model. */
export function stylesOf(module: Module, model: number): Style[] {
  const { wasm } = module;
  return Array.from({ length: wasm.panache_model_style_count(model) }, (_, style) => {
    const info = infoOf(module, model, style);
    return {
      name: module.text(wasm.panache_model_style_name(model, style)),
      description: module.text(info.description),
      group: module.text(info.group),
      words: module.text(info.words).split(' ').filter(Boolean),
      learnt: info.isLearnt !== 0,
      thumbnail: module.text(info.thumbnail),
      side: info.hasSides ? module.text(info.side) : null,
      gestures: Array.from({ length: info.gestureCount },
        (_, k) => module.text(wasm.panache_model_gesture_name(model, style, k))),
    };
  });
}
/** What the model says of a style; texts are addresses. */
export function infoOf(module: Module, model: number, style: number) {
  return module.use((arena) => {
    const at = arena.write(kStyleInfo);
    arena.check(module.wasm.panache_model_get_style_info(model, style, at));
    return arena.read(kStyleInfo, at);
  });
}

export function styleIndex(styles: readonly Style[], name: string): number {
  // Like the program: an exact match first, then without case, then other words for a style.
  const wanted = String(name).toLowerCase();
  for (const fits of [
    (style: Style) => style.name === name,
    (style: Style) => style.name.toLowerCase() === wanted,
    (style: Style) => style.words.includes(wanted),
  ]) {
    const index = styles.findIndex(fits);
    if (index >= 0) return index;
  }
  const groups = [...new Set(styles.map(({ group }) => group).filter(Boolean))];
  throw new PanacheError(`unknown style '${name}'; the model has ${styles.length} styles: ` +
    (groups.length ? groups : styles.map((style) => style.name)).join(', '));
}

/** Returns the side of a style as a number. */
export function sideNumber(side: Side, { name, side: captured }: Style): number {
  if (captured === null) {
    throw new PanacheError(`the styles of this model have no sides, so '${name}' has none`);
  }
  const words = new Map<unknown, number>([['captured', 1], ['mirrored', -1]]);
  for (const word of captured ? ['left', 'right'] : []) {
    words.set(word, captured.split(' ').includes(word) ? 1 : -1);
  }
  const number = words.get(side) ?? side;
  if (typeof number === 'number' && number >= -1 && number <= 1) return number;
  throw unexpected(`side of '${name}'`,
    `${[...words.keys()].map((word) => `'${word}'`).join(', ')} or a number from -1 to 1`, side);
}
/** Returns the seed and the amount of a person; of null, nobody. */
export function personNumbers(module: Module, person: Person, variety: number): [number, number] {
  if (!(typeof variety === 'number' && variety >= 0 && variety <= 2)) {
    throw unexpected('variety', 'a number from 0 to 2', variety);
  }
  if (person === null) return [0, 0];
  if (typeof person === 'string' && person) {
    return [module.use((arena) => module.wasm.panache_person_seed(arena.text(person))), variety];
  }
  if (Number.isInteger(person) && +person >= 0 && +person < 2 ** 32) return [+person, variety];
  throw unexpected('person', 'a word, a whole number from 0 to 4294967295, or null', person);
}

/** What has styles: characters and players. */
export abstract class Styled {
  /** @internal */ readonly _panache: Panache;
  /** @internal Those of its model. */ abstract get _styles(): readonly Style[];
  /** @internal Its panache_character. */ abstract get _character(): number;
  /** @internal */ constructor(panache: Panache) { this._panache = panache; }
  /** @internal */ protected get _wasm() { return this._panache._module.wasm; }

  /** 0 is neutral, 1 the style as captured, above 1 exaggerates it (-4 to 4). Eased in. Throws if
   * the model has no such style, or the strength is not finite. */
  setStrength(style: string, strength: number): void {
    const character = this._character, index = styleIndex(this._styles, style);
    this._wasm.panache_character_set_strength(
      character, index, checkFinite(strength, `strength of '${style}'`));
  }
  /** Initially 'captured'. Eased in. Throws if the model has no such style or the style no such side. */
  setSide(style: string, side: Side): void {
    const character = this._character, index = styleIndex(this._styles, style);
    this._wasm.panache_character_set_side(character, index, sideNumber(side, this._styles[index]));
  }
  /** Moves as somebody else does, in addition to the styles; initially null, nobody. `variety`: how
   * far from the mean person, 0 to 2; 1, the default, is as people differ. Eased in. Throws if the
   * model has no persons. */
  setPerson(person: Person, variety = 1): void {
    const character = this._character, { _module: module, personAxes } = this._panache;
    const [seed, amount] = personNumbers(module, person, variety);
    if (amount === 0 && personAxes.length === 0) return;
    module.use((arena) => arena.check(
      this._wasm.panache_character_set_person(character, seed, amount)));
  }
  /** Plays a gesture of a style (its index in `gestures`; 0) at the style's strength. Waits up to
   * 3 s until no other gesture plays and a foot is on the floor; otherwise drops it. Throws if the
   * style has no such gesture. */
  trigger(style: string, gesture = 0): void {
    const character = this._character, index = styleIndex(this._styles, style);
    checkInteger(gesture, 'gesture');
    if (this._wasm.panache_character_trigger(character, index, gesture)) return;
    const { name, gestures } = this._styles[index];
    throw new PanacheError(`style '${name}' has no gesture ${gesture}; it has ${gestures.length}`);
  }
  /** Missing amounts are 1. Eased in. */
  setShape(shape: Partial<Shape>): void {
    this._panache._module.use((arena) => arena.check(
      this._wasm.panache_character_set_shape(this._character, writeShape(arena, shape))));
  }
}

/** See style_timing in panache.h. */
export function timingNumber(timing: Timing | boolean, what: string): number {
  const number = new Map<unknown, number>(
    [['off', 0], ['steps', 1], ['all', 2], [false, 0], [true, 1]]).get(timing);
  if (number !== undefined) return number;
  throw unexpected(what, "'steps', 'all', 'off', true or false", timing);
}
