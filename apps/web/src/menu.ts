// A button that opens a list of others, each an action.

import { element } from './dom';

export interface MenuGroup {
  title: string;
  buttons: readonly HTMLElement[];
}

/** The button and its list, which closes after a choice, by Escape, and when one goes elsewhere. */
export function buildMenu(id: string, text: string, title: string,
    groups: readonly MenuGroup[]): HTMLElement {
  const list = element('div', { id: `${id}-menu`, class: 'menu-list', role: 'group',
    'aria-label': text, hidden: true },
  ...groups.map((group) => element('div', { role: 'group', 'aria-label': group.title },
    element('h2', {}, group.title), ...group.buttons)));
  const opener = element('button', { type: 'button', id, title, 'aria-expanded': 'false',
    'aria-controls': list.id }, text);
  const menu = element('div', { class: 'menu' }, opener, list);
  const open = (wanted: boolean) => {
    list.hidden = !wanted;
    opener.setAttribute('aria-expanded', String(wanted));
    if (wanted) list.scrollIntoView({ block: 'nearest' });
  };
  opener.addEventListener('click', () => open(list.hidden));
  list.addEventListener('click', (event) => {
    if ((event.target as Element).closest('button')) open(false);
  });
  addEventListener('pointerdown', (event) => {
    if (!menu.contains(event.target as Node)) open(false);
  }, true);
  menu.addEventListener('focusout', ({ relatedTarget }) => {
    if (relatedTarget instanceof Node && !menu.contains(relatedTarget)) open(false);
  });
  // A button that was clicked does not keep the focus.
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || list.hidden) return;
    if (menu.contains(document.activeElement)) opener.focus();
    open(false);
  });
  return menu;
}
