// Recognises the style of the input and removes it, with a model that is loaded when first needed.

import removable from 'virtual:panache-removable';

import type { Panache, Remover } from '../package/index.js';
import { button, element } from './dom';
import { styleOptions } from './groups';
import { packed } from './late';
import type { Store } from './settings';
import type { Source } from './source';

/** The remover's style for unknown styles. */
export const kAnyStyle = 'any';
export const kRemovable = removable.map(({ name }) => name);

export class Removal {
  readonly element: HTMLElement;
  /** Set once it is loaded. */
  remover: Remover | null = null;
  #coming: Promise<Remover> | null = null;
  #style = '';  // The recognised style of the clip.
  #text = element('span');
  #take = button('', () => this.store.set(
    { removed: this.store.settings.removed === this.#style ? '' : this.#style }));
  #looks = element('p', { id: 'looks', role: 'status' });

  constructor(private panache: Panache, private store: Store) {
    const menu = element('select', { id: 'removed', title: 'This style is taken off the input' },
      element('option', { value: '' }, 'as it is'),
      element('option', { value: kAnyStyle }, 'in any style'),
      ...styleOptions(removable.filter(({ name }) => name !== kAnyStyle), ''));
    menu.addEventListener('change', () => store.set({ removed: menu.value }));
    store.listen(({ removed }) => {
      menu.value = removed;
      this.#take.setAttribute('aria-pressed', String(removed === this.#style));
    });
    this.#looks.append(this.#text, this.#take);
    this.#looks.hidden = true;
    this.element = element('div', { id: 'removal' },
      element('label', { for: 'removed' }, 'The input is'), menu, this.#looks);
  }

  /** The model; the first call loads it. */
  load(): Promise<Remover> {
    return this.#coming ??= packed('remover').then((bytes) =>
      this.remover = this.panache.createRemover(bytes),
    ).catch((error: unknown) => {
      this.#coming = null;
      throw error;
    });
  }

  /** Shows the style of a clip, if any, once the model is loaded and if `isSeen()` still holds. */
  async look(source: Source, isSeen: () => boolean) {
    this.#looks.hidden = true;
    if (source.kind !== 'clip' || !(source.file.clips[source.clip]?.frames > 1)) return;
    const remover = await this.load();
    if (!isSeen()) return;
    const [{ name, share }] = remover.recogniseFile(source.file, source.clip);
    if (name === 'neutral') return;
    this.#style = name;
    this.#text.textContent = `Looks like: ${name} ${Math.round(100 * share)} %`;
    this.#take.textContent = `Take ${name} off`;
    this.#take.setAttribute('aria-pressed', String(this.store.settings.removed === name));
    this.#looks.hidden = false;
  }
}
