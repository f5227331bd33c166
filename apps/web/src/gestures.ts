// The gestures of all styles in one list, in words for people who animate.

import type { Style } from '../package/index.js';
import { button, element, hinted } from './dom';
import { capitalized } from './groups';
import type { Page } from './page';

/** What the library says about a movement, and what an animator would. */
const kWords: Record<string, string> = {
  'head turns left': 'Glance left', 'head turns right': 'Glance right',
  'head nods': 'Nod', 'head looks up': 'Look up',
  'head leans left': 'Tilt head left', 'head leans right': 'Tilt head right',
  'body turns left': 'Twist left', 'body turns right': 'Twist right',
  'body bends forward': 'Bow', 'body bends back': 'Lean back',
  'body leans left': 'Lean left', 'body leans right': 'Lean right',
  'left arm': 'Left arm', 'right arm': 'Right arm', 'both arms': 'Both arms',
  hop: 'Hop', dip: 'Duck',
};

/** The titles of a style's gestures: "Glance left 1.7 s"; equal ones are numbered. */
export function gestureTitles(gestures: readonly string[]): string[] {
  const titles = gestures.map((gesture) => {
    const comma = gesture.lastIndexOf(', ');
    const [what, time] = [gesture.slice(0, comma), gesture.slice(comma + 2)];
    return `${kWords[what] ?? capitalized(what)} ${time}`;
  });
  return titles.map((title, i) => {
    const same = titles.slice(0, i).filter((other) => other === title).length;
    return same ? `${title} (${same + 1})` : title;
  });
}

export class Gestures {
  #list = element('div');
  readonly element = element('details', { class: 'fold', id: 'gestures' },
    element('summary', {}, element('h3', {}, 'Gestures')),
    element('p', { class: 'hint' }, 'Short movements on top of a style. G plays one of the active styles.'),
    this.#list);

  constructor(private page: Page) {
    page.store.listen(() => this.#mark());
  }

  set(styles: readonly Style[]) {
    const own = styles.filter(({ gestures }) => gestures.length > 0);
    this.element.hidden = own.length === 0;
    this.#list.replaceChildren(...own.map(({ name, gestures }) => element('p',
      { class: 'gestures', 'data-style': name }, element('span', {}, capitalized(name)),
      ...gestureTitles(gestures).map((title, i) => button(title,
        () => this.page.trigger(name, i), hinted(`${title}, a gesture of ${name}`))))));
    this.#mark();
  }

  #mark() {
    for (const row of this.#list.children as HTMLCollectionOf<HTMLElement>) {
      row.classList.toggle('active', this.page.isActive(row.dataset.style!));
    }
  }
}
