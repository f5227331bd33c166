// The sliders of the styles: active styles on top, all others in collapsible groups.

import type { Style } from '../package/index.js';
import { attempt } from './alerts';
import { button, element, hinted } from './dom';
import { capitalized, groupStyles } from './groups';
import type { Page } from './page';
import { kLeast, kMost } from './settings';
import { Slider } from './slider';

const kManyStyles = 20;  // With more, only the first group is initially open.

interface Row {
  style: Style;
  slider: Slider;
  /** The row's parent while the style is not active. */
  list: HTMLElement;
}
/** A collapsible group. */
interface Fold {
  title: string;
  box: HTMLDetailsElement;
  list: HTMLElement;
  count: HTMLElement;
}

/** The content of a style's row, to detect changes. */
const said = ({ group, ...rest }: Style) => JSON.stringify(rest);

export class StyleRows {
  readonly element = element('div', { id: 'style-rows' });
  #rows: Row[] = [];
  #folds: Fold[] = [];
  #open = new Map<string, boolean>();  // The groups that the user opened or closed.
  #words: string[] = [];
  #activeRows = element('div');
  #active = element('div',
    { id: 'active-styles', role: 'group', 'aria-label': 'Active styles', hidden: true },
    element('h3', {}, 'Active'), this.#activeRows);
  #pressed = false;

  constructor(private page: Page) {
    page.store.listen(() => this.#show());
    // Move no rows during a press. Exclude menus: an open menu may swallow the end of the press.
    addEventListener('pointerdown', (event) => {
      this.#pressed = !(event.target as Element).closest('select');
    }, true);
    for (const end of ['pointerup', 'pointercancel']) {
      addEventListener(end, () => setTimeout(() => {
        this.#pressed = false;
        this.#arrange();
      }), true);
    }
    this.element.addEventListener('focusout', () => setTimeout(() => this.#arrange()));
  }

  /** The rows by style name. */
  get rows() {
    return new Map(this.#rows.map(({ style, slider }) => [style.name, slider.row]));
  }

  /** Shows the current strengths of styles with keys. */
  showNow() {
    for (const { style: { name }, slider } of this.#rows) {
      if (!(name in this.page.store.settings.keys)) continue;
      slider.show(Math.round(this.page.strengthOf(name) * 100) / 100);
    }
  }

  /** Keeps rows whose content is the same, except that of the style `changed`. */
  set(styles: readonly Style[], changed: string) {
    const known = new Map(this.#rows.map((row) => [row.style.name, row]));
    const groups = groupStyles(styles);
    this.#rows = [];
    this.#folds = [];
    this.element.replaceChildren(this.#active);
    for (const { title, styles: own } of groups) {
      const list = element('div');
      const first = this.#folds.length === 0;
      this.element.append(title
        ? this.#fold(title, list, this.#open.get(title) ?? (first || styles.length <= kManyStyles))
        : list);
      for (const style of own) {
        const before = known.get(style.name);
        const same = before && said(before.style) === said(style) && changed !== style.name;
        const slider = same ? before.slider : this.#make(style);
        list.append(slider.row);
        this.#rows.push({ style, slider, list });
      }
    }
    this.#activeRows.replaceChildren();
    this.#show();
  }

  /** Shows the styles whose name, group or description contains all words, and active styles.
   * Returns the number of matches. */
  filter(words: string[]) {
    this.#words = words.filter((word) => word);
    let found = 0;
    for (const { style: { name, group, description }, slider, list } of this.#rows) {
      const text = `${name} ${group} ${description}`.toLowerCase();
      const fits = this.#words.every((word) => text.includes(word));
      slider.row.hidden = !fits && slider.row.parentElement === list;
      slider.row.dataset.fits = String(fits);
      found += Number(fits);
    }
    for (const { title, box } of this.#folds) {
      box.open = this.#words.length > 0 || this.#open.get(title)!;
    }
    this.#showFolds();
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

  #make({ name, description, learnt, thumbnail, gestures }: Style) {
    const slider = new Slider({
      id: `style-${encodeURIComponent(name)}`, title: capitalized(name),
      hint: description || undefined, least: kLeast, most: kMost, rest: 0,
      onChange: (value) => this.page.setStrength(name, value),
      onReset: () => this.page.store.dropStyle(name),
    });
    const words = element('p', { class: 'words' }, description);
    if (learnt) {
      words.className = 'own';
      words.append(
        button('Save', () => this.page.exporter.saveStyle(name), hinted(`Save ${name} as a style file`)),
        button('Remove', () => void attempt(() => this.page.removeStyle(name)),
          hinted(`Remove ${name}`)));
    }
    slider.row.append(words);
    if (thumbnail) {
      slider.row.append(element('img', { class: 'thumbnail',
        alt: `Figures from the clip that ${name} was learnt from`,
        src: `data:image/svg+xml,${encodeURIComponent(thumbnail)}` }));
    }
    if (gestures.length > 0) {
      slider.row.append(element('p', { class: 'gestures' }, ...gestures.map((gesture, i) =>
        button(capitalized(gesture), () => this.page.trigger(name, i),
          hinted(`Play this gesture of ${name} (G plays one of the active styles)`)))));
    }
    return slider;
  }

  #show() {
    const { styles, keys } = this.page.store.settings;
    for (const { style: { name }, slider } of this.#rows) {
      slider.row.classList.toggle('keyed', name in keys);
      if (!(name in keys)) slider.show(styles[name] ?? 0);
    }
    this.#arrange();
  }

  /** Moves rows to their lists; the focused element keeps its position on the screen. */
  #arrange() {
    if (this.#pressed) return;
    const { styles, keys } = this.page.store.settings;
    const focus = document.activeElement;
    const anchor = focus?.closest('#panel') ? focus : null;
    const top = anchor?.getBoundingClientRect().top ?? 0;
    let moved = false;
    for (const [i, { style: { name }, slider: { row }, list }] of this.#rows.entries()) {
      const wanted = (styles[name] ?? 0) !== 0 || name in keys ? this.#activeRows : list;
      if (row.parentElement === wanted || row.contains(focus)) continue;
      const next = this.#rows.slice(i + 1).find((other) => other.slider.row.parentElement === wanted);
      wanted.insertBefore(row, next?.slider.row ?? null);
      row.hidden = wanted === list && row.dataset.fits === 'false';
      moved = true;
    }
    if (!moved) return;
    this.#showFolds();
    if (!anchor) return;
    const panel = anchor.closest('#panel')!;
    const scrolls = panel.scrollHeight > panel.clientHeight &&
      getComputedStyle(panel).overflowY === 'auto';
    (scrolls ? panel : document.scrollingElement)?.scrollBy({
      top: anchor.getBoundingClientRect().top - top, behavior: 'instant',
    });
  }

  #showFolds() {
    this.#active.hidden = this.#activeRows.childElementCount === 0;
    for (const { box, list, count } of this.#folds) {
      const shown = [...list.children].filter((row) => !(row as HTMLElement).hidden).length;
      count.textContent = String(shown);
      box.hidden = shown === 0;
    }
  }
}
