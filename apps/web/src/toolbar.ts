// The buttons under the view: paces of the walker, opening files, and all ways of saving.

import { attempt } from './alerts';
import { button, element, find } from './dom';
import { buildMenu } from './menu';
import { buildViewSaving, type ViewSaving } from './save_view';
import { kPaces, type Pace } from './steering';

/** Shows which pace the walker has. */
export function showPace(pace: Pace) {
  for (const chip of document.querySelectorAll<HTMLElement>('[data-pace]')) {
    chip.setAttribute('aria-pressed', String(chip.dataset.pace === pace));
  }
}

export function buildWalkerControls(onPace: (pace: Pace) => void) {
  const buttons = (Object.keys(kPaces) as Pace[]).map((pace) => {
    const title = pace[0].toUpperCase() + pace.slice(1);
    return button(title, () => onPace(pace), { 'data-pace': pace });
  });
  const keys = element('span', { class: 'keys' });
  for (const key of ['W', 'A', 'S', 'D']) keys.append(element('kbd', {}, key), ' ');
  keys.append('steer');
  find('#walker-controls').append(...buttons, keys);
}

export interface FileActions extends ViewSaving {
  onOpen(files: File[]): Promise<void>;
  /** Another of the files that are listed. */
  onFile(index: number): Promise<void>;
  onWalker(): void;
  onSave(extension: string): void;
  onSaveAll(): Promise<void>;
  /** The address of the page with its settings. */
  link(): string;
}

/** A button whose faults are told. */
const act = (id: string, text: string, title: string, press: () => void | Promise<void>) =>
  button(text, () => void attempt(press), { id, title });

function saveMenu(on: FileActions) {
  const view = buildViewSaving(on);
  const link = act('copy-link', 'Copy link', 'A link to this page with these settings',
    async () => {
      await navigator.clipboard.writeText(on.link());
      find('#save').textContent = 'Link copied';
      setTimeout(() => (find('#save').textContent = kSave), 1500);
    });
  link.hidden = !navigator.clipboard;
  const kSave = 'Save ▾';
  const menu = buildMenu('save', kSave, 'Save the motion or the view', [
    { title: 'Motion', buttons: [
      act('save-bvh', 'BVH', 'The motion, as a BVH file', () => on.onSave('.bvh')),
      act('save-glb', 'GLB', 'The motion, as a GLB file', () => on.onSave('.glb')),
      act('save-vrma', 'VRMA', 'The motion, as a VRM animation', () => on.onSave('.vrma')),
      act('save-zip', 'All files (zip)',
        'All opened files, each as BVH, GLB and VRMA, in one zip', () => on.onSaveAll()),
    ] },
    { title: 'View', buttons: [...view.savers, link] },
  ]);
  return [...view.stoppers, menu];
}

/** Lists files to choose from, where there are several. */
export function listFiles(files: readonly File[]) {
  const menu = find<HTMLSelectElement>('#files');
  menu.replaceChildren(...files.map(({ name }, i) => element('option', { value: i }, name)));
  menu.hidden = files.length < 2;
}

export function buildFileControls(on: FileActions) {
  const input = find<HTMLInputElement>('#file');
  input.addEventListener('change', () => {
    const files = [...(input.files ?? [])];
    input.value = '';
    void attempt(() => on.onOpen(files));
  });
  const menu = element('select', { id: 'files', 'aria-label': 'Opened files', hidden: true });
  menu.addEventListener('change', () => void attempt(() => on.onFile(Number(menu.value))));
  find('#file-controls').append(menu,
    act('back', 'Walker', 'Close the file and steer the walker again', () => on.onWalker()),
    act('open', 'Open …',
      'BVH, GLB, glTF, VRM or VRMA files, a model or a style; or drop them on the view',
      () => input.click()),
    ...saveMenu(on));
}
