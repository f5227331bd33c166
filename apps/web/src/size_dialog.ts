// Which size a picture or a loop of the view has.

import { button, element, find } from './dom';

const kLeast = 16;

export interface SizeDialog {
  title: string;
  /** Of the button that saves. */
  action: string;
  sizes: readonly (readonly [number, number])[];
  /** Pixels, in either direction. */
  largest: number;
  /** What the view has. */
  seen: [number, number];
  hint?: string;
  save(width: number, height: number): void | Promise<void>;
}

export function askSize(what: SizeDialog) {
  const field = (id: string, title: string) => element('input', { type: 'number', id,
    'aria-label': title, min: kLeast, max: what.largest, step: 1, required: true });
  const width = field('picture-width', 'Width, pixels');
  const height = field('picture-height', 'Height, pixels');
  const set = (wide: number, high: number) => {
    width.value = String(wide);
    height.value = String(high);
  };
  const [wide, high] = what.seen;
  const smaller = Math.min(1, what.largest / Math.max(wide, high));
  const seen = () => set(Math.round(smaller * wide), Math.round(smaller * high));
  const form = element('form', { method: 'dialog' },
    element('div', { class: 'chips' }, button('As seen', seen),
      ...what.sizes.filter((size) => Math.max(...size) <= what.largest)
        .map(([w, h]) => button(`${w} × ${h}`, () => set(w, h)))),
    element('p', { class: 'size' }, width, ' × ', height, ' pixels'),
    ...(what.hint ? [element('p', { class: 'hint' }, what.hint)] : []),
    element('div', { class: 'chips' },
      element('button', { type: 'submit', id: 'save-picture' }, what.action),
      button('Close', () => dialog.close())));
  const dialog = element('dialog', { id: 'picture', 'aria-labelledby': 'picture-title' },
    element('h2', { id: 'picture-title' }, what.title), form);
  form.addEventListener('submit', () =>
    void what.save(width.valueAsNumber, height.valueAsNumber));
  dialog.addEventListener('close', () => dialog.remove());
  find('main').append(dialog);
  seen();
  dialog.showModal();
}
