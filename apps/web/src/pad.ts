// The pad: mixes four styles, chosen at its corners, by dragging a point between them.

import type { Style } from '../package/index.js';
import { element, listenToDrags } from './dom';
import { styleOptions } from './groups';
import type { Store } from './settings';

const kStep = 0.05;
const kCornerNames = ['top left', 'top right', 'bottom left', 'bottom right'];

/** Weights of the corners (top left, top right, bottom left, bottom right) at x, y in 0 to 1. */
export function shares(x: number, y: number): [number, number, number, number] {
  return [(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y];
}

/** The position of these strengths on the pad; the middle if they are all 0. */
export function positionOf(strengths: readonly number[]): { x: number; y: number } {
  const [a, b, c, d] = strengths.map((s) => Math.max(0, s));
  const sum = a + b + c + d;
  if (sum <= 0) return { x: 0.5, y: 0.5 };
  return { x: (b + d) / sum, y: (c + d) / sum };
}

export function buildPad(store: Store, first: readonly string[]) {
  const corners = [...first];
  const knob = element('span');
  const field = element('div', {
    class: 'pad-field', role: 'application', tabindex: 0, id: 'pad', 'data-arrows': true,
    'aria-label': 'Blend of four styles; arrow keys move it',
  }, knob);
  const at = { x: 0.5, y: 0.5 };

  const apply = (x: number, y: number) => {
    at.x = Math.min(1, Math.max(0, x));
    at.y = Math.min(1, Math.max(0, y));
    const strengths: Record<string, number> = {};
    shares(at.x, at.y).forEach((share, i) => {
      strengths[corners[i]] = (strengths[corners[i]] ?? 0) + share;
    });
    for (const [name, share] of Object.entries(strengths)) {
      const rounded = Math.round(share * 100) / 100;
      if (rounded > 0) strengths[name] = rounded;
      else delete strengths[name];
    }
    store.set({ styles: strengths, keys: {} });
  };
  listenToDrags(field, apply);
  field.addEventListener('keydown', (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[
      event.key];
    if (!move) return;
    event.preventDefault();
    apply(at.x + move[0] * kStep, at.y + move[1] * kStep);
  });

  const menus = corners.map((_, i) => {
    const menu = element('select', { 'aria-label': `Style of the pad, ${kCornerNames[i]}` });
    menu.addEventListener('change', () => {
      corners[i] = menu.value;
      apply(at.x, at.y);
    });
    return menu;
  });
  /** Sets the styles to choose from; a corner whose style is gone gets another. */
  const setStyles = (styles: readonly Style[]) => menus.forEach((menu, i) => {
    const known = styles.some(({ name }) => name === corners[i]);
    if (!known && styles.length) corners[i] = styles[i % styles.length].name;
    menu.replaceChildren(...styleOptions(styles, corners[i]));
  });
  store.listen(({ styles: strengths }) => {
    Object.assign(at, positionOf(corners.map((corner) => strengths[corner] ?? 0)));
    knob.style.left = `${at.x * 100}%`;
    knob.style.top = `${at.y * 100}%`;
    const said = corners.map((corner) => `${corner} ${(strengths[corner] ?? 0).toFixed(2)}`);
    field.setAttribute('aria-description', said.join(', '));
  });
  return { setStyles,
    element: element('div', { class: 'pad' }, menus[0], menus[1], field, menus[2], menus[3]) };
}
