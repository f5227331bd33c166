// The styles as cards with a moving figure, in groups that fold. A click plays a style alone.

import type { Style } from '../package/index.js';
import { attempt } from './alerts';
import { button, element, hinted } from './dom';
import type { Exporter } from './exporter';
import { capitalized, groupStyles, matches } from './groups';
import type { Session } from './session';

const kManyStyles = 20;  // With more, only the first group is initially open.

interface Card {
  style: Style;
  element: HTMLElement;
  /** Plays the style alone. */
  play: HTMLButtonElement;
}
interface Fold {
  title: string;
  box: HTMLDetailsElement;
  list: HTMLElement;
  count: HTMLElement;
}

/** The content of a style's card, to detect changes. */
const said = ({ group, ...rest }: Style) => JSON.stringify(rest);

export class StyleCards {
  readonly element = element('div', { id: 'style-cards' });
  #cards: Card[] = [];
  #folds: Fold[] = [];
  #open = new Map<string, boolean>();  // The groups that the user opened or closed.
  #words: string[] = [];

  constructor(private session: Session, private exporter: Exporter) {
    session.store.listen(() => this.#show());
  }

  /** The buttons with a figure, by style name. */
  get buttons(): Map<string, HTMLElement> {
    return new Map(this.#cards.map(({ style, play }) => [style.name, play]));
  }

  /** Keeps cards whose content is the same, except that of the style `changed`. */
  set(styles: readonly Style[], changed: string) {
    const known = new Map(this.#cards.map((card) => [card.style.name, card]));
    this.#cards = [];
    this.#folds = [];
    this.element.replaceChildren();
    for (const { title, styles: own } of groupStyles(styles)) {
      const list = element('div', { class: 'cards' });
      const first = this.#folds.length === 0;
      this.element.append(title
        ? this.#fold(title, list, this.#open.get(title) ?? (first || styles.length <= kManyStyles))
        : list);
      for (const style of own) {
        const before = known.get(style.name);
        const same = before && said(before.style) === said(style) && changed !== style.name;
        const card = same ? before : this.#make(style);
        list.append(card.element);
        this.#cards.push(card);
      }
    }
    this.#show();
  }

  /** Shows the styles that match all words. Returns their number. */
  filter(words: string[]) {
    this.#words = words.filter((word) => word);
    let found = 0;
    for (const card of this.#cards) {
      const fits = this.#words.every((word) => matches(card.style, word));
      card.element.hidden = !fits;
      found += Number(fits);
    }
    for (const { title, box, list, count } of this.#folds) {
      const shown = [...list.children].filter((card) => !(card as HTMLElement).hidden).length;
      count.textContent = String(shown);
      box.hidden = shown === 0;
      box.open = this.#words.length > 0 || this.#open.get(title)!;
    }
    return found;
  }

  #fold(title: string, list: HTMLElement, open: boolean) {
    const count = element('span', { class: 'count' });
    const summary = element('summary', {}, element('h3', {}, title), count);
    const box = element('details', { class: 'fold', open }, summary, list);
    this.#open.set(title, open);
    // Not `toggle`: it fires later, when the search may have changed. A click fires before the box
    // changes.
    summary.addEventListener('click', () => {
      if (this.#words.length === 0) this.#open.set(title, !box.open);
    });
    this.#folds.push({ title, box, list, count });
    return box;
  }

  #make(style: Style): Card {
    const { name, description, learnt, thumbnail } = style;
    const play = button('', () => this.session.playStyle(name), { class: 'play', title: description,
      'data-style': name, 'data-arrows': true });
    play.append(element('span', { class: 'name' }, capitalized(name)));
    play.addEventListener('keydown', (event) => this.#walk(play, event));
    const card = element('div', { class: 'card' }, play, button('+', () => this.session.addStyle(name),
      { class: 'add', ...hinted(`Add ${name} to the active styles`) }));
    if (learnt) {
      card.append(element('p', { class: 'own' },
        button('Save', () => this.exporter.saveStyle(name),
          hinted(`Save ${name} as a style file`)),
        button('Remove', () => void attempt(() => this.session.removeStyle(name)),
          hinted(`Remove ${name}`))));
    }
    if (thumbnail) {
      card.classList.add('wide');
      card.append(element('img', { class: 'thumbnail',
        alt: `Figures from the clip that ${name} was learnt from`,
        src: `data:image/svg+xml,${encodeURIComponent(thumbnail)}` }));
    }
    return { style, element: card, play };
  }

  #show() {
    for (const { style: { name }, element: card, play } of this.#cards) {
      const active = this.session.isActive(name);
      card.classList.toggle('active', active);
      play.setAttribute('aria-pressed', String(active));
    }
  }

  /** Arrow keys go through the cards and play them. */
  #walk(from: HTMLElement, event: KeyboardEvent) {
    const next = this.#neighbour(from, event.key);
    if (next === undefined) return;
    event.preventDefault();
    if (!next) return;
    const fold = next.element.closest('details');
    if (fold && !fold.open) fold.querySelector('summary')!.click();
    next.play.focus();
    next.element.scrollIntoView({ block: 'nearest' });
    this.session.playStyle(next.style.name, true);
  }

  /** The card that an arrow key leads to, null if there is none; undefined for other keys. */
  #neighbour(from: HTMLElement, key: string): Card | null | undefined {
    const shown = this.#cards.filter(({ element: card }) => !card.hidden);
    const at = shown.findIndex(({ play }) => play === from);
    if (key === 'ArrowLeft' || key === 'ArrowRight') {
      return shown[at + (key === 'ArrowLeft' ? -1 : 1)] ?? null;
    }
    if (key !== 'ArrowUp' && key !== 'ArrowDown') return undefined;
    const here = from.getBoundingClientRect();
    const column = ({ play }: Card) => Math.abs(play.getBoundingClientRect().left - here.left) < 2;
    const [before, after] = [shown.slice(0, at).reverse(), shown.slice(at + 1)];
    const side = key === 'ArrowUp' ? before : after;
    return side.find(column) ?? side[0] ?? null;
  }
}
