// The side of an active style: a switch beside its slider.

import type { Style } from '../package/index.js';
import { button, element } from './dom';

/** What is seen of a mirrored style: "left leg" for "right leg". */
export function otherSide(phrase: string): string {
  const other: Record<string, string> = { left: 'right', right: 'left' };
  return phrase.split(' ').map((word) => other[word] ?? word).join(' ');
}

export class SideSwitch {
  readonly element: HTMLElement;
  #captured: HTMLElement;
  #mirrored: HTMLElement;

  /** `style` must have a side. */
  constructor({ name, side }: Style, choose: (side: number) => void) {
    const phrase = side!;
    this.#captured = button(phrase, () => choose(1), { title: 'As captured' });
    this.#mirrored = button(otherSide(phrase), () => choose(-1), { title: 'Mirrored' });
    this.element = element('p', { class: 'sides', role: 'group', 'aria-label': `Side of ${name}` },
      this.#captured, this.#mirrored);
  }

  show(side: number) {
    this.#captured.setAttribute('aria-pressed', String(side >= 0));
    this.#mirrored.setAttribute('aria-pressed', String(side < 0));
  }
}
