// All settings, and their conversion to and from the page's address.

import type { Person, Shape, Timing } from '../package/index.js';
import { bounded, fromText, kMax, kMin, toText, type Key } from './keys';

export const kRegions = ['legs', 'torso', 'leftArm', 'rightArm'] as const;
export const kAmounts =
  ['strength', 'posture', 'dynamics', 'timing', 'gestures', 'energy', 'variety'] as const;
export const kTempos = ['steps', 'all', 'off'] as const satisfies readonly Timing[];
export const kViews = ['styled', 'side', 'over', 'crowd'] as const;
const kLongestPerson = 40;  // Characters.
const kSwitches = [...kRegions, 'feet', 'hands', 'trail', 'onion', 'mixed'] as const;
export type Switch = (typeof kSwitches)[number];
export type View = (typeof kViews)[number];

export interface Settings extends Record<(typeof kAmounts)[number], number>, Record<Switch, boolean> {
  /** Strength of each style that is not 0. */
  styles: Record<string, number>;
  /** For clips: keyframes by style, which replace its strength. */
  keys: Record<string, readonly Key[]>;
  /** Side of each style that is not as captured: -1 mirrored, to 1. */
  sides: Record<string, number>;
  /** A number or a word: who the character is; empty: nobody. */
  person: string;
  /** The style to remove from the input: one of the remover's, or empty. */
  removed: string;
  /** Where the motion takes the tempo of its styles. */
  tempo: Timing;
  view: View;
}

/** The settings after "Reset all". */
export const kDefaults: Readonly<Settings> = {
  styles: {},
  keys: {},
  sides: {},
  person: '',
  removed: '',
  strength: 1, posture: 1, dynamics: 1, timing: 1, gestures: 1, energy: 1, variety: 1,
  tempo: 'steps',
  legs: true, torso: true, leftArm: true, rightArm: true, feet: true, hands: true,
  view: 'side',
  trail: true,
  onion: false,
  mixed: false,
};
/** What a visitor sees first. */
export const kOpening: Readonly<Settings> = { ...kDefaults, styles: { old: 1 } };

// Styles have a prefix in the address, as a learnt style may have the name of a setting.
const kStyle = 'style.';
const kKeys = 'keys.';
const kSide = 'side.';

/** "style.old=0.5&view=over": all differences from the defaults; "neutral" if there are none, and
 * empty for kOpening. */
export function toAddress(settings: Settings): string {
  if (same(settings, kOpening)) return '';
  const out = new URLSearchParams();
  for (const [name, value] of Object.entries(settings.styles)) {
    if (value !== 0) out.set(kStyle + name, String(value));
  }
  for (const [name, keys] of Object.entries(settings.keys)) out.set(kKeys + name, toText(keys));
  for (const [name, side] of Object.entries(settings.sides)) {
    out.set(kSide + name, side === -1 ? 'mirrored' : String(side));
  }
  if (settings.person) out.set('person', settings.person);
  if (settings.removed) out.set('removed', settings.removed);
  for (const key of kAmounts) if (settings[key] !== 1) out.set(key, String(settings[key]));
  for (const key of kSwitches) {
    if (settings[key] !== kDefaults[key]) out.set(key, settings[key] ? 'on' : 'off');
  }
  for (const key of ['tempo', 'view'] as const) {
    if (settings[key] !== kDefaults[key]) out.set(key, settings[key]);
  }
  return out.toString() || 'neutral';
}

const same = (a: object, b: object): boolean => JSON.stringify(a) === JSON.stringify(b);

const isOne = <Name extends string>(names: readonly Name[], name: string): name is Name =>
  names.includes(name as Name);

/** Parses an address, for a model and a remover with these styles. Ignores unknown and invalid
 * parts. Also reads "old=0.5" and "old.keys=...", unless a setting has that name. */
export function fromAddress(text: string, styles: readonly string[],
    removable: readonly string[]): Settings {
  const given = new URLSearchParams(text.replace(/^#/, ''));
  if (given.size === 0) return { ...kOpening, styles: { ...kOpening.styles } };
  const settings: Settings = { ...kDefaults, styles: {}, keys: {}, sides: {} };
  const choices: Record<string, readonly string[]> =
    { view: kViews, tempo: kTempos, removed: removable };
  for (const [key, value] of given) {
    const number = value.trim() === '' ? NaN : Number(value);
    const setStyle = (name: string) => {
      const strength = bounded(number, kMin, kMax, 0);
      if (strength !== 0) settings.styles[name] = strength;
    };
    const setKeys = (name: string) => {
      const keys = fromText(value);
      if (keys.length) settings.keys[name] = keys;
    };
    const setSide = (name: string) => {
      const side = value === 'mirrored' ? -1 : bounded(number, -1, 1, 1);
      if (side !== 1) settings.sides[name] = side;
    };
    if (key.startsWith(kStyle) && styles.includes(key.slice(kStyle.length))) {
      setStyle(key.slice(kStyle.length));
    } else if (key.startsWith(kKeys) && styles.includes(key.slice(kKeys.length))) {
      setKeys(key.slice(kKeys.length));
    } else if (key.startsWith(kSide) && styles.includes(key.slice(kSide.length))) {
      setSide(key.slice(kSide.length));
    } else if (key === 'person') {
      settings.person = value.trim().slice(0, kLongestPerson);
    } else if (isOne(kAmounts, key)) {
      settings[key] = bounded(number, 0, 2, 1);
    } else if (isOne(kSwitches, key)) {
      if (value === 'on' || value === 'off') settings[key] = value === 'on';
    } else if (Object.hasOwn(choices, key)) {
      if (choices[key].includes(value)) Object.assign(settings, { [key]: value });
    } else if (styles.includes(key)) {
      setStyle(key);
    } else if (key.endsWith('.keys') && styles.includes(key.slice(0, -5))) {
      setKeys(key.slice(0, -5));
    }
  }
  return settings;
}

/** The settings as the library's Shape. */
export function shapeOf(settings: Settings): Partial<Shape> {
  const { posture, dynamics, timing, energy } = settings;
  const regions = Object.fromEntries(kRegions.map((key) => [key, Number(settings[key])]));
  return { posture, dynamics, timing, ...regions, footLock: Number(settings.feet),
    handContacts: Number(settings.hands), energy };
}

/** The person as the library takes it. */
export function personOf({ person }: Settings): Person {
  return person || null;
}

const kTogether = 500;  // Milliseconds; closer changes, as in a drag, are undone together.
const kMaxSteps = 200;

/** Holds the settings, notifies listeners of changes, and undoes changes. */
export class Store {
  #listeners: ((settings: Settings) => void)[] = [];
  #done: Settings[] = [];
  #undone: Settings[] = [];
  #lastChange = -kTogether;
  constructor(public settings: Settings) {}

  listen(listener: (settings: Settings) => void) {
    this.#listeners.push(listener);
    listener(this.settings);
  }
  set(patch: Partial<Settings>) {
    const next = { ...this.settings, ...patch };
    if (same(next, this.settings)) return;
    const now = performance.now();
    if (now - this.#lastChange >= kTogether) {
      this.#done.push(this.settings);
      if (this.#done.length > kMaxSteps) this.#done.shift();
    }
    this.#lastChange = now;
    this.#undone = [];
    this.#tell(next);
  }
  /** Changes the settings without a step of the undo history. */
  begin(patch: Partial<Settings>) {
    this.#tell({ ...this.settings, ...patch });
  }
  setStyle(name: string, value: number) {
    const styles = { ...this.settings.styles, [name]: value };
    if (value === 0) delete styles[name];
    this.set({ styles });
  }
  setKeys(name: string, list: readonly Key[]) {
    const keys = { ...this.settings.keys, [name]: list };
    if (list.length === 0) delete keys[name];
    this.set({ keys });
  }
  setSide(name: string, side: number) {
    const sides = { ...this.settings.sides, [name]: side };
    if (side === 1) delete sides[name];
    this.set({ sides });
  }
  /** Removes a style's strength, keys and side. */
  dropStyle(name: string) {
    const { [name]: _style, ...styles } = this.settings.styles;
    const { [name]: _keys, ...keys } = this.settings.keys;
    const { [name]: _side, ...sides } = this.settings.sides;
    this.set({ styles, keys, sides });
  }
  /** Drops all styles that no longer exist, in the settings and in the undo history. */
  keepStyles(names: readonly string[]) {
    const kept = <T>(all: Record<string, T>) =>
      Object.fromEntries(Object.entries(all).filter(([name]) => names.includes(name)));
    const without = (settings: Settings) =>
      ({ ...settings, styles: kept(settings.styles), keys: kept(settings.keys),
        sides: kept(settings.sides) });
    this.#done = this.#done.map(without);
    this.#undone = this.#undone.map(without);
    this.#tell(without(this.settings));
  }
  get canUndo() { return this.#done.length > 0; }
  get canRedo() { return this.#undone.length > 0; }
  undo() { this.#step(this.#done, this.#undone); }
  redo() { this.#step(this.#undone, this.#done); }

  #step(from: Settings[], to: Settings[]) {
    const next = from.pop();
    if (!next) return;
    to.push(this.settings);
    this.#lastChange = -kTogether;
    this.#tell(next);
  }
  #tell(settings: Settings) {
    this.settings = settings;
    for (const listener of this.#listeners) listener(settings);
  }
}

/** Keeps the page's address and the settings in sync. */
export function rememberInAddress(store: Store, read: () => Settings) {
  let timer = 0;
  store.listen((settings) => {
    clearTimeout(timer);
    timer = window.setTimeout(() => {
      const text = toAddress(settings);
      if (text === location.hash.replace(/^#/, '')) return;
      history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
    }, 200);
  });
  addEventListener('hashchange', () => store.set(read()));
}
