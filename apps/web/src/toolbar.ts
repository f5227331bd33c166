// The buttons under the view: the walker's paces, opening files, and saving.

import { attempt } from './alerts';
import { button, element, find } from './dom';
import type { Exporter } from './exporter';
import { capitalized } from './groups';
import { buildViewSaving } from './save_view';
import type { Session } from './session';
import { toAddress, type Store } from './settings';
import { walkSource } from './source';
import type { Stage } from './stage';
import { kPaces, type Pace } from './steering';

/** Shows the walker's pace. */
export function showPace(pace: Pace) {
  for (const chip of document.querySelectorAll<HTMLElement>('[data-pace]')) {
    chip.setAttribute('aria-pressed', String(chip.dataset.pace === pace));
  }
}

export function buildWalkerControls(onPace: (pace: Pace) => void) {
  const buttons = (Object.keys(kPaces) as Pace[]).map((pace) =>
    button(capitalized(pace), () => onPace(pace), { 'data-pace': pace }));
  const keys = element('span', { class: 'keys' });
  for (const key of ['W', 'A', 'S', 'D']) keys.append(element('kbd', {}, key), ' ');
  keys.append('steer');
  find('#walker-controls').append(...buttons, keys);
}

/** A button that reports errors. */
const act = (id: string, text: string, title: string, press: () => void | Promise<void>) =>
  button(text, () => void attempt(press), { id, title });

/** A button with a menu, which closes after a choice, on Escape, and when the focus leaves. */
function buildMenu(id: string, text: string, title: string,
    groups: readonly { title: string; buttons: readonly HTMLElement[] }[]): HTMLElement {
  const list = element('div', { id: `${id}-menu`, class: 'menu-list', role: 'group',
    'aria-label': text, hidden: true },
  ...groups.map((group) => element('div', { role: 'group', 'aria-label': group.title },
    element('h2', {}, group.title), ...group.buttons)));
  const opener = button(text, () => open(list.hidden),
    { id, title, 'aria-expanded': 'false', 'aria-controls': list.id });
  const menu = element('div', { class: 'menu' }, opener, list);
  const open = (wanted: boolean) => {
    list.hidden = !wanted;
    opener.setAttribute('aria-expanded', String(wanted));
    if (wanted) list.scrollIntoView({ block: 'nearest' });
  };
  list.addEventListener('click', (event) => {
    if ((event.target as Element).closest('button')) open(false);
  });
  addEventListener('pointerdown', (event) => {
    if (!menu.contains(event.target as Node)) open(false);
  }, true);
  menu.addEventListener('focusout', ({ relatedTarget }) => {
    if (relatedTarget instanceof Node && !menu.contains(relatedTarget)) open(false);
  });
  // A clicked button does not keep the focus.
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || list.hidden) return;
    if (menu.contains(document.activeElement)) opener.focus();
    open(false);
  });
  return menu;
}

function saveMenu(stage: Stage, exporter: Exporter, store: Store) {
  const view = buildViewSaving(stage, exporter);
  const link = act('copy-link', 'Copy link', 'A link to this page with these settings',
    async () => {
      await navigator.clipboard.writeText(
        location.href.replace(/#.*$/, '') + `#${toAddress(store.settings)}`);
      find('#save').textContent = 'Link copied';
      setTimeout(() => (find('#save').textContent = kSave), 1500);
    });
  link.hidden = !navigator.clipboard;
  const kSave = 'Save ▾';
  const menu = buildMenu('save', kSave, 'Save the motion or the view', [
    { title: 'Motion', buttons: [
      act('save-bvh', 'BVH', 'The motion, as a BVH file', () => exporter.save('.bvh')),
      act('save-glb', 'GLB', 'The motion, as a GLB file', () => exporter.save('.glb')),
      act('save-vrma', 'VRMA', 'The motion, as a VRM animation', () => exporter.save('.vrma')),
      act('save-zip', 'All files (zip)',
        'All opened files, each as BVH, GLB and VRMA, in one zip', () => exporter.saveAll()),
    ] },
    { title: 'View', buttons: [...view.savers, link] },
  ]);
  return [...view.stoppers, menu];
}

export function buildFileControls(session: Session, stage: Stage, exporter: Exporter) {
  const input = find<HTMLInputElement>('#file');
  input.addEventListener('change', () => {
    const files = [...(input.files ?? [])];
    input.value = '';
    void attempt(() => session.openAll(files));
  });
  const menu = element('select', { id: 'files', 'aria-label': 'Opened files', hidden: true });
  menu.addEventListener('change',
    () => void attempt(() => session.open(session.files[Number(menu.value)])));
  session.listen('files', () => {
    const { files } = session;
    menu.replaceChildren(...files.map(({ name }, i) => element('option', { value: i }, name)));
    menu.hidden = files.length < 2;
  });
  find('#file-controls').append(menu,
    act('back', 'Walker', 'Close the file and steer the walker again',
      () => session.use(walkSource(session.panache))),
    act('open', 'Open …',
      'BVH, GLB, glTF, VRM or VRMA files, a model or a style; or drop them on the view',
      () => input.click()),
    ...saveMenu(stage, exporter, session.store));
}
