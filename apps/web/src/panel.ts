// The panel of controls: presets, styles, the pad, amounts, and parts of the body.

import type { Style, Timing } from '../package/index.js';
import { button, element, find } from './dom';
import type { Exporter } from './exporter';
import { capitalized } from './groups';
import type { Learn } from './learn';
import { buildPad } from './pad';
import { kAnyStyle } from './removal';
import type { Session } from './session';
import {
  kAmounts, kDefaults, kRegions, kTempos, type Settings, type Store, type Switch, type View,
} from './settings';
import { Slider } from './slider';
import { ActiveStyles } from './active_styles';
import { Gestures } from './gestures';
import { StyleCards } from './style_cards';

/** Mixes of styles with a button. */
const kPresets: readonly { title: string; styles: Record<string, number> }[] = [
  { title: 'Neutral', styles: {} },
  { title: 'Old', styles: { old: 1 } },
  { title: 'Very old', styles: { old: 2 } },
  { title: 'Zombie', styles: { zombie: 1 } },
  { title: 'Proud robot', styles: { robot: 0.8, proud: 0.6 } },
  { title: 'Drunken pirate', styles: { drunk: 0.8, 'dragging a leg': 0.6 } },
  { title: 'Sneaking cat', styles: { cat: 0.7, sneaking: 0.5 } },
  { title: 'Scared chicken', styles: { chicken: 0.8, scared: 0.5 } },
  { title: 'Sulking teenager', styles: { teenager: 0.8, depressed: 0.6 } },
  { title: 'Friday', styles: { joyful: 0.7, strutting: 0.6 } },
];
/** The initial corners of the pad. */
const kCorners = ['old', 'proud', 'childlike', 'zombie'];

const kAmountHints = {
  strength: 'Multiplies all styles',
  posture: 'Slow part of the change: how the body is held',
  dynamics: 'Fast part of the change: swing, bounce, step length',
  timing: 'Change of tempo',
  gestures: 'How often the styles make their gestures: 1 as often as the performers, 0 never',
  energy: 'From calm to lively: the input\'s own movement of torso, head and arms',
  variety: 'How far the person is from the mean of people',
};
const kSwitchTitles: Record<Switch, [string, string]> = {
  legs: ['Legs', 'Apply the style to legs and root motion'],
  torso: ['Torso', 'Apply the style to torso and head'],
  leftArm: ['Left arm', 'Apply the style to the left arm'],
  rightArm: ['Right arm', 'Apply the style to the right arm'],
  feet: ['Foot lock', 'Planted feet stay in place'],
  hands: ['Hand contacts', 'Hands keep what they touch'],
  trail: ['Foot trails', 'Paths of the toes'],
  onion: ['Past poses', 'Poses of the last second (N)'],
  mixed: ['A style each', 'Each of the crowd in another style'],
};
const kTempoTitles: Record<Timing, [string, string]> = {
  steps: ['Steps', 'The style\'s tempo only where the feet step; talk and gestures keep their length'],
  all: ['All', 'The tempo of the style everywhere'],
  off: ['Off', 'The input\'s tempo, frame by frame'],
};
const kViewTitles: Record<View, string> = {
  styled: 'Styled', side: 'Side by side', over: 'Overlaid', crowd: 'Crowd',
};

function toggle(text: string, hint: string, pressed: (s: Settings) => boolean, store: Store,
    press: (s: Settings) => Partial<Settings>) {
  const out = button(text, () => store.set(press(store.settings)), { title: hint });
  store.listen((settings) => out.setAttribute('aria-pressed', String(pressed(settings))));
  return out;
}

function presets(store: Store) {
  const buttons = kPresets.map((preset) => {
    const chip = button(preset.title,
      () => store.set({ styles: { ...preset.styles }, keys: {}, sides: {} }));
    store.listen(({ styles }) => {
      const same = JSON.stringify(Object.entries(styles).sort()) ===
        JSON.stringify(Object.entries(preset.styles).sort());
      chip.setAttribute('aria-pressed', String(same));
    });
    return chip;
  });
  const group = element('div',
    { class: 'chips', id: 'presets', role: 'group', 'aria-label': 'Presets' }, ...buttons);
  /** Hides presets that need a style that the model lacks. */
  const setStyles = (names: readonly string[]) => kPresets.forEach((preset, i) =>
    (buttons[i].hidden = !Object.keys(preset.styles).every((name) => names.includes(name))));
  return { group, setStyles };
}

function amountSliders(store: Store, amounts: readonly (typeof kAmounts)[number][]) {
  return amounts.map((key) => {
    const slider = new Slider({
      id: `amount-${key}`, title: capitalized(key), hint: kAmountHints[key], min: 0, max: 2, rest: 1,
      onChange: (value) => store.set({ [key]: value }),
    });
    store.listen((settings) => slider.show(settings[key]));
    return slider.row;
  });
}

/** Who the character is, and how far from the mean of people. */
function personControls(store: Store) {
  const field = element('input', { type: 'text', id: 'person', maxlength: 40,
    placeholder: 'Nobody: a number or a word …', 'aria-label': 'Person' });
  field.addEventListener('change', () => store.set({ person: field.value.trim() }));
  store.listen(({ person }) => {
    if (document.activeElement !== field) field.value = person;
  });
  const another = button('Another', () => {
    const person = String(1 + Math.floor(Math.random() * 9999));
    store.set({ person });
  }, { id: 'another', title: 'Another person, at random' });
  const nobody = button('Nobody', () => store.set({ person: '' }), { id: 'nobody' });
  store.listen(({ person }) => nobody.setAttribute('aria-pressed', String(person === '')));
  return [field, element('div', { class: 'chips', role: 'group', 'aria-label': 'Person' },
    another, nobody), ...amountSliders(store, ['variety'])];
}

/** A field that filters the styles. */
function search(cards: StyleCards) {
  const field = element('input', { type: 'search', id: 'search', placeholder: 'Search: sad, elderly, ninja …',
    'aria-label': 'Search the styles' });
  const none = element('p', { class: 'hint', role: 'status' });
  const filter = () => {
    const found = cards.filter(field.value.toLowerCase().split(/\s+/));
    none.textContent = found ? '' : 'No matching style';
  };
  field.addEventListener('input', filter);
  return { field, none, filter };
}

/** Builds the panel. `setStyles` shows the model's styles; `changed` names a style that was
 * replaced. */
export function buildPanel(session: Session, exporter: Exporter, learn: Learn) {
  const { store } = session;
  const switches = (keys: readonly Switch[]) => keys.map((key) =>
    toggle(...kSwitchTitles[key], (s) => s[key], store, (s) => ({ [key]: !s[key] })));
  const tempos = kTempos.map((tempo) => toggle(...kTempoTitles[tempo], (s) => s.tempo === tempo,
    store, () => ({ tempo })));
  const cards = new StyleCards(session, exporter), active = new ActiveStyles(session);
  const gestures = new Gestures(session);
  const chips = presets(store), found = search(cards);
  const pad = buildPad(store, kCorners);
  const act = (id: string, text: string, hint: string, press: () => void, can: () => boolean) => {
    const out = button(text, press, { id, title: hint });
    store.listen(() => (out.disabled = !can()));
    return out;
  };
  find('#panel').after(active.element);
  find('#panel').append(
    element('div', { class: 'chips', id: 'history', role: 'group', 'aria-label': 'Changes' },
      act('undo', 'Undo', 'Undo (Ctrl Z)', () => store.undo(), () => store.canUndo),
      act('redo', 'Redo', 'Redo (Ctrl Shift Z)', () => store.redo(), () => store.canRedo),
      act('reset-all', 'Reset all', 'Reset all settings',
        () => store.set({ ...kDefaults, styles: {}, keys: {} }), () => true)),
    element('div', { class: 'heading' },
      element('h2', { id: 'styles', tabindex: -1 }, 'Styles'), learn.button),
    learn.section,
    found.field, found.none, cards.element, gestures.element,
    element('h2', {}, 'Mixes'), chips.group,
    element('h2', {}, 'Input'), session.removal.element,
    element('h2', {}, 'Blend of four'), pad.element,
    element('h2', {}, 'Person'), ...personControls(store),
    element('div', { class: 'chips', role: 'group', 'aria-label': 'Crowd' }, ...switches(['mixed'])),
    element('h2', {}, 'Amount'),
    ...amountSliders(store, kAmounts.filter((key) => key !== 'variety')),
    element('div', { class: 'chips', id: 'tempo', role: 'group', 'aria-label': 'Tempo of the style' },
      element('span', { class: 'word' }, 'Tempo of the style'), ...tempos),
    element('h2', {}, 'Body parts'),
    element('div', { class: 'chips', role: 'group', 'aria-label': 'Body parts' },
      ...switches(kRegions)),
    element('h2', {}, 'Ground'),
    element('div', { class: 'chips', role: 'group', 'aria-label': 'Ground' },
      ...switches(['feet', 'hands', 'trail', 'onion'])));
  find('#views').append(...(Object.keys(kViewTitles) as View[]).map((view) =>
    toggle(kViewTitles[view], 'View', (s) => s.view === view, store, () => ({ view }))));
  store.listen((settings) => {
    document.body.dataset.view = settings.view;
  });
  const setStyles = (now: readonly Style[], changed = '') => {
    const names = now.map((style) => style.name);
    cards.set(now, changed);
    active.set();
    gestures.set(now);
    found.filter();
    chips.setStyles(names);
    pad.setStyles(now);
  };
  /** Shows the panel once there are styles. */
  const showStyles = () => {
    find('#styles-wait').remove();
    find('#panel').removeAttribute('aria-busy');
  };
  return { cards, active, setStyles, showStyles };
}

/** "drunk off + old 1.00 + proud over time"; only clips have keys. */
export function captionOf({ styles, keys, removed }: Settings, isClip: boolean): string {
  const keyed = isClip ? Object.keys(keys) : [];
  const parts = Object.entries(styles).filter(([name]) => !keyed.includes(name))
    .map(([name, value]) => `${name} ${value.toFixed(2)}`);
  if (removed) parts.unshift(removed === kAnyStyle ? 'style off' : `${removed} off`);
  parts.push(...keyed.map((name) => `${name} over time`));
  return parts.length ? parts.join(' + ') : 'neutral: click a style';
}
