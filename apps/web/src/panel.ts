// Everything that is set by hand: presets, styles, the pad, how much, and of which part.

import type { Style } from '../package/index.js';
import { element, find } from './dom';
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
  const button = element('button', { type: 'button', title: hint }, text);
  button.addEventListener('click', () => store.set(press(store.settings)));
  store.listen((settings) => button.setAttribute('aria-pressed', String(pressed(settings))));
  return button;
}

function presets(store: Store) {
  const buttons = kPresets.map((preset) => {
    const button = element('button', { type: 'button' }, preset.title);
    button.addEventListener('click', () => store.set({ styles: { ...preset.styles } }));
    store.listen(({ styles }) => {
      const same = JSON.stringify(Object.entries(styles).sort()) ===
        JSON.stringify(Object.entries(preset.styles).sort());
      button.setAttribute('aria-pressed', String(same));
    });
    return button;
  });
  return element('div', { class: 'chips', id: 'presets', role: 'group', 'aria-label': 'Presets' },
    ...buttons);
}

function styleSliders(store: Store, styles: readonly Style[]) {
  return styles.map(({ name, description }) => {
    const slider = new Slider({
      id: `style-${name}`, title: title(name), hint: description,
      least: kLeast, most: kMost, rest: 0,
      onChange: (value) => store.setStyle(name, value),
    });
    store.listen((settings) => slider.show(settings.styles[name] ?? 0));
    slider.row.append(element('p', { class: 'words' }, description));
    return [name, slider.row] as const;
  });
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
function search(rows: Map<string, HTMLElement>, styles: readonly Style[]) {
  const field = element('input', { type: 'search', id: 'search', placeholder: 'Search: slow, arms …',
    'aria-label': 'Search the styles' });
  const none = element('p', { class: 'hint', role: 'status' });
  field.addEventListener('input', () => {
    const words = field.value.toLowerCase().split(/\s+/);
    let found = 0;
    for (const { name, description } of styles) {
      const text = `${name} ${description}`.toLowerCase();
      const shown = words.every((word) => text.includes(word));
      rows.get(name)!.hidden = !shown;
      found += Number(shown);
    }
    none.textContent = found ? '' : 'No style is described like that.';
  });
  return [field, none];
}

/** Puts the panel together; the rows of the styles, by name. */
export function buildPanel(store: Store, styles: readonly Style[]): Map<string, HTMLElement> {
  const names = styles.map((style) => style.name);
  const regions = kRegions.map((key) => toggle(kRegionTitles[key], kRegionHints[key],
    (s) => s[key], store, (s) => ({ [key]: !s[key] })));
  const feet = toggle('Feet lock', 'Planted feet stay in place', (s) => s.feet, store,
    (s) => ({ feet: !s.feet }));
  const trail = toggle('Foot trails', 'Paths of the toes', (s) => s.trail, store,
    (s) => ({ trail: !s.trail }));
  const onion = toggle('Onion skin', 'Poses of the last second (N)', (s) => s.onion, store,
    (s) => ({ onion: !s.onion }));
  const rows = new Map(styleSliders(store, styles));
  const act = (id: string, text: string, hint: string, press: () => void, can: () => boolean) => {
    const button = element('button', { type: 'button', id, title: hint }, text);
    button.addEventListener('click', press);
    store.listen(() => (button.disabled = !can()));
    return button;
  };
  find('#panel').append(
    element('div', { class: 'chips', id: 'history', role: 'group', 'aria-label': 'Changes' },
      act('undo', 'Undo', 'Undo (Ctrl Z)', () => store.undo(), () => store.canUndo),
      act('redo', 'Redo', 'Redo (Ctrl Shift Z)', () => store.redo(), () => store.canRedo),
      act('reset-all', 'Reset all', 'Everything as it was, without a style',
        () => store.set({ ...kDefaults, styles: {} }), () => true)),
    element('h2', {}, 'Presets'), presets(store),
    element('h2', { id: 'styles', tabindex: -1 }, 'Styles'),
    element('p', { class: 'hint' }, '0 is neutral, 1 as captured; beyond that it is exaggerated.'),
    ...search(rows, styles), ...rows.values(),
    element('h2', {}, 'Blend of four'),
    buildPad(store, names,
      kCorners.map((corner, i) => (names.includes(corner) ? corner : names[i]))),
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
    find('#caption').textContent = captionOf(settings);
  });
  return rows;
}

/** "old 1.00 + proud 0.50" */
export function captionOf({ styles }: Settings): string {
  const parts = Object.entries(styles).map(([name, value]) => `${name} ${value.toFixed(2)}`);
  return parts.length ? parts.join(' + ') : 'neutral: move a slider';
}
