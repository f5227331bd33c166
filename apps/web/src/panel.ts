// Everything that is set by hand: presets, styles, the pad, how much, and of which part.

import type { Style } from '../package/index.js';
import { button, element, find, hinted } from './dom';
import { buildPad } from './pad';
import { kCorners, kPresets } from './presets';
import {
  kAmounts, kDefaults, kLeast, kMost, kRegions, type Region, type Settings, type Store, type View,
} from './settings';
import { Slider } from './slider';

const kAmountHints = {
  strength: 'Multiplies all styles',
  posture: 'Slow part of the change: how the body is held',
  dynamics: 'Fast part of the change: swing, bounce, step length',
  timing: 'Change of tempo',
};
const kRegionTitles: Record<Region, string> = {
  legs: 'Legs', torso: 'Torso', leftArm: 'Left arm', rightArm: 'Right arm',
};
const kRegionHints: Record<Region, string> = {
  legs: 'Style the legs and the way they go, or not',
  torso: 'Style the torso and the head, or not',
  leftArm: 'Style the left arm, or not',
  rightArm: 'Style the right arm, or not',
};
const kViewTitles: Record<View, string> = {
  styled: 'Styled', side: 'Side by side', over: 'Overlaid',
};

const title = (name: string) => name[0].toUpperCase() + name.slice(1);

function toggle(text: string, hint: string, pressed: (s: Settings) => boolean, store: Store,
    press: (s: Settings) => Partial<Settings>) {
  const out = button(text, () => store.set(press(store.settings)), { title: hint });
  store.listen((settings) => out.setAttribute('aria-pressed', String(pressed(settings))));
  return out;
}

function presets(store: Store) {
  const buttons = kPresets.map((preset) => {
    const chip = button(preset.title,
      () => store.set({ styles: { ...preset.styles }, keys: {} }));
    store.listen(({ styles }) => {
      const same = JSON.stringify(Object.entries(styles).sort()) ===
        JSON.stringify(Object.entries(preset.styles).sort());
      chip.setAttribute('aria-pressed', String(same));
    });
    return chip;
  });
  const group = element('div',
    { class: 'chips', id: 'presets', role: 'group', 'aria-label': 'Presets' }, ...buttons);
  /** Hides those that need a style which the model has not. */
  const setStyles = (names: readonly string[]) => kPresets.forEach((preset, i) =>
    (buttons[i].hidden = !Object.keys(preset.styles).every((name) => names.includes(name))));
  return { group, setStyles };
}

export interface StyleEvents {
  /** A slider was pushed. */
  onStrength(name: string, value: number): void;
  /** Back to neutral. */
  onReset(name: string): void;
  /** Of a style that was learnt. */
  onSave(name: string): void;
  onRemove(name: string): void;
}

/** A slider for each style; those that were learnt come first. */
class StyleRows {
  readonly element = element('div', { id: 'style-rows' });
  readonly rows = new Map<string, HTMLElement>();
  #styles: readonly Style[] = [];
  #sliders = new Map<string, Slider>();

  constructor(private store: Store, private events: StyleEvents) {
    store.listen(() => this.#show());
  }

  /** The strengths of styles that have keys. */
  showNow(strengths: Record<string, number>) {
    for (const [name, value] of Object.entries(strengths)) {
      this.#sliders.get(name)?.show(Math.round(value * 100) / 100);
    }
  }

  /** Leaves rows as they are where they say the same, and `changed` is not theirs. */
  set(styles: readonly Style[], changed: string) {
    const known = new Map(this.#styles.map((style) => [style.name, style]));
    const sliders = new Map<string, Slider>();
    this.#styles = [...styles].sort((a, b) => Number(b.learnt) - Number(a.learnt));
    for (const style of this.#styles) {
      const before = known.get(style.name);
      const same = before && before.description === style.description &&
        before.learnt === style.learnt && changed !== style.name;
      sliders.set(style.name, (same && this.#sliders.get(style.name)) || this.#make(style));
    }
    this.#sliders = sliders;
    this.rows.clear();
    for (const [name, { row }] of sliders) this.rows.set(name, row);
    this.element.replaceChildren(...this.rows.values());
    this.#show();
  }
  /** Leaves the styles whose name or description holds all words; how many these are. */
  filter(words: string[]) {
    let found = 0;
    for (const { name, description } of this.#styles) {
      const text = `${name} ${description}`.toLowerCase();
      const shown = words.every((word) => text.includes(word));
      this.rows.get(name)!.hidden = !shown;
      found += Number(shown);
    }
    return found;
  }

  #make({ name, description, learnt }: Style) {
    const slider = new Slider({
      id: `style-${encodeURIComponent(name)}`, title: title(name), hint: description || undefined,
      least: kLeast, most: kMost, rest: 0,
      onChange: (value) => this.events.onStrength(name, value),
      onReset: () => this.events.onReset(name),
    });
    const words = element('p', { class: 'words' }, description);
    if (learnt) {
      words.className = 'own';
      words.append(
        button('Save', () => this.events.onSave(name), hinted(`Save ${name} as a style file`)),
        button('Remove', () => this.events.onRemove(name), hinted(`Remove ${name}`)));
    }
    slider.row.append(words);
    return slider;
  }
  #show() {
    const { styles, keys } = this.store.settings;
    for (const [name, slider] of this.#sliders) {
      slider.row.classList.toggle('keyed', name in keys);
      if (!(name in keys)) slider.show(styles[name] ?? 0);
    }
  }
}

function amountSliders(store: Store) {
  return kAmounts.map((key) => {
    const slider = new Slider({
      id: `amount-${key}`, title: title(key), hint: kAmountHints[key], least: 0, most: 2, rest: 1,
      onChange: (value) => store.set({ [key]: value }),
    });
    store.listen((settings) => slider.show(settings[key]));
    return slider.row;
  });
}

/** A field that leaves the styles whose name or description holds all its words. */
function search(rows: StyleRows) {
  const field = element('input', { type: 'search', id: 'search', placeholder: 'Search: slow, arms …',
    'aria-label': 'Search the styles' });
  const none = element('p', { class: 'hint', role: 'status' });
  const filter = () => {
    const found = rows.filter(field.value.toLowerCase().split(/\s+/));
    none.textContent = found ? '' : 'No style is described like that.';
  };
  field.addEventListener('input', filter);
  return { field, none, filter };
}

export interface Panel {
  /** Of the styles, by name. */
  rows: Map<string, HTMLElement>;
  /** Shows the styles of another model. The one called `changed` is another than before. */
  setStyles(styles: readonly Style[], changed?: string): void;
  /** Shows the strengths of styles that have keys. */
  showNow(strengths: Record<string, number>): void;
}

/** Puts the panel together. `learn` is what opens under the heading of the styles. */
export function buildPanel(store: Store, styles: readonly Style[], events: StyleEvents,
    learn: { button: HTMLElement; section: HTMLElement }): Panel {
  const regions = kRegions.map((key) => toggle(kRegionTitles[key], kRegionHints[key],
    (s) => s[key], store, (s) => ({ [key]: !s[key] })));
  const feet = toggle('Feet lock', 'Planted feet stay in place', (s) => s.feet, store,
    (s) => ({ feet: !s.feet }));
  const trail = toggle('Foot trails', 'Paths of the toes', (s) => s.trail, store,
    (s) => ({ trail: !s.trail }));
  const onion = toggle('Onion skin', 'Poses of the last second (N)', (s) => s.onion, store,
    (s) => ({ onion: !s.onion }));
  const rows = new StyleRows(store, events);
  const chips = presets(store), found = search(rows);
  const pad = buildPad(store, kCorners);
  const act = (id: string, text: string, hint: string, press: () => void, can: () => boolean) => {
    const out = button(text, press, { id, title: hint });
    store.listen(() => (out.disabled = !can()));
    return out;
  };
  find('#panel').append(
    element('div', { class: 'chips', id: 'history', role: 'group', 'aria-label': 'Changes' },
      act('undo', 'Undo', 'Undo (Ctrl Z)', () => store.undo(), () => store.canUndo),
      act('redo', 'Redo', 'Redo (Ctrl Shift Z)', () => store.redo(), () => store.canRedo),
      act('reset-all', 'Reset all', 'Everything as it was, without a style',
        () => store.set({ ...kDefaults, styles: {}, keys: {} }), () => true)),
    element('h2', {}, 'Presets'), chips.group,
    element('div', { class: 'heading' },
      element('h2', { id: 'styles', tabindex: -1 }, 'Styles'), learn.button),
    learn.section,
    element('p', { class: 'hint' }, '0 is neutral, 1 as captured; beyond that it is exaggerated.'),
    found.field, found.none, rows.element,
    element('h2', {}, 'Blend of four'), pad.element,
    element('h2', {}, 'Amount'), ...amountSliders(store),
    element('h2', {}, 'Body parts'),
    element('div', { class: 'chips', role: 'group', 'aria-label': 'Body parts' },
      ...regions),
    element('h2', {}, 'Ground'),
    element('div', { class: 'chips', role: 'group', 'aria-label': 'Ground' }, feet, trail,
      onion));
  find('#views').append(...(Object.keys(kViewTitles) as View[]).map((view) =>
    toggle(kViewTitles[view], 'View', (s) => s.view === view, store, () => ({ view }))));
  store.listen((settings) => {
    document.body.dataset.view = settings.view;
  });
  const setStyles = (now: readonly Style[], changed = '') => {
    const names = now.map((style) => style.name);
    rows.set(now, changed);
    found.filter();
    chips.setStyles(names);
    pad.setStyles(names);
  };
  setStyles(styles);
  return { rows: rows.rows, setStyles, showNow: (strengths) => rows.showNow(strengths) };
}

/** "old 1.00 + proud over time"; only clips have keys. */
export function captionOf({ styles, keys }: Settings, isClip: boolean): string {
  const keyed = isClip ? Object.keys(keys) : [];
  const parts = Object.entries(styles).filter(([name]) => !keyed.includes(name))
    .map(([name, value]) => `${name} ${value.toFixed(2)}`);
  parts.push(...keyed.map((name) => `${name} over time`));
  return parts.length ? parts.join(' + ') : 'neutral: move a slider';
}
