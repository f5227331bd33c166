// The gestures of all styles in one list, in words for people who animate.

import type { Style } from '../package/index.js';
import { button, element, hinted } from './dom';
import { capitalized } from './groups';
import type { Session } from './session';

export class Gestures {
  #list = element('div');
  readonly element = element('details', { class: 'fold', id: 'gestures' },
    element('summary', {}, element('h3', {}, 'Gestures')),
    element('p', { class: 'hint' }, 'Short movements on top of a style. G plays one of the active styles.'),
    this.#list);

  constructor(private session: Session) {
    session.store.listen(() => this.#mark());
  }

  set(styles: readonly Style[]) {
    const own = styles.filter(({ gestures }) => gestures.length > 0);
    this.element.hidden = own.length === 0;
    this.#list.replaceChildren(...own.map(({ name, gestures }) => element('p',
      { class: 'gestures', 'data-style': name }, element('span', {}, capitalized(name)),
      ...gestures.map((gesture, i) => button(capitalized(gesture),
        () => this.session.trigger(name, i), hinted(`${capitalized(gesture)}, a gesture of ${name}`))))));
    this.#mark();
  }

  #mark() {
    for (const row of this.#list.children as HTMLCollectionOf<HTMLElement>) {
      row.classList.toggle('active', this.session.isActive(row.dataset.style!));
    }
  }
}
