// The styles by what they are listed under.

import type { Style } from '../package/index.js';
import { element } from './dom';

export interface StyleGroup {
  /** "Moods"; empty for the only group of a model that has none. */
  title: string;
  styles: Style[];
}

/** "old" as it begins a line: "Old". */
export const capitalized = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

function titleOf({ group, learnt }: Style): string {
  return group ? capitalized(group) : learnt ? 'Yours' : 'Others';
}

/** Learnt styles first, then the groups in the order of the model. */
export function groupStyles(styles: readonly Style[]): StyleGroup[] {
  const sorted = [...styles].sort((a, b) => Number(b.learnt) - Number(a.learnt));
  if (!styles.some(({ group }) => group)) return [{ title: '', styles: sorted }];
  const groups = new Map<string, Style[]>();
  for (const style of sorted) {
    const title = titleOf(style);
    groups.set(title, [...(groups.get(title) ?? []), style]);
  }
  return [...groups].map(([title, own]) => ({ title, styles: own }));
}

/** What a menu of styles holds. */
export function styleOptions(styles: readonly Style[], selected: string): HTMLElement[] {
  return groupStyles(styles).flatMap(({ title, styles: own }) => {
    const options = own.map(({ name }) =>
      element('option', { value: name, selected: name === selected }, name));
    return title ? [element('optgroup', { label: title }, ...options)] : options;
  });
}
