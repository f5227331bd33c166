// The view as a picture of any size.

import { element, find } from './dom';
import { saveBytes } from './saving';
import type { Stage } from './stage';

const kSizes = [[1280, 720], [1920, 1080], [3840, 2160], [1080, 1080], [1080, 1920]];
const kLeast = 16;

/** What opens the dialog. */
export function buildPictureDialog(stage: Stage, name: () => string): () => void {
  const field = (id: string, title: string) => element('input', { type: 'number', id,
    'aria-label': title, min: kLeast, max: stage.largestPicture, step: 1, required: true });
  const width = field('picture-width', 'Width, pixels');
  const height = field('picture-height', 'Height, pixels');
  const set = (wide: number, high: number) => {
    width.value = String(wide);
    height.value = String(high);
  };
  const seen = () => set(...stage.seen);
  const chip = (text: string, press: () => void) => {
    const button = element('button', { type: 'button' }, text);
    button.addEventListener('click', press);
    return button;
  };
  const close = chip('Close', () => dialog.close());
  const form = element('form', { method: 'dialog' },
    element('div', { class: 'chips' }, chip('As seen', seen),
      ...kSizes.filter(([w, h]) => Math.max(w, h) <= stage.largestPicture)
        .map(([w, h]) => chip(`${w} × ${h}`, () => set(w, h)))),
    element('p', { class: 'size' }, width, ' × ', height, ' pixels'),
    element('div', { class: 'chips' },
      element('button', { type: 'submit', id: 'save-picture' }, 'Save picture'), close));
  const dialog = element('dialog', { id: 'picture', 'aria-labelledby': 'picture-title' },
    element('h2', { id: 'picture-title' }, 'Save the view as a picture'), form);
  form.addEventListener('submit', () => void (async () => {
    const blob = await stage.picture(width.valueAsNumber, height.valueAsNumber);
    if (blob) saveBytes(blob, name(), 'image/png');
  })());
  find('main').append(dialog);
  return () => {
    seen();
    dialog.showModal();
  };
}
