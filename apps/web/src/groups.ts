// The styles by what they are listed under.

import type { Style } from '../package/index.js';
import { element } from './dom';

/** What is said of a style in a list. */
type Listed = Pick<Style, 'name' | 'group'> & Partial<Pick<Style, 'learnt'>>;

export interface StyleGroup<Own> {
  /** "Moods"; empty for the only group of a model that has none. */
  title: string;
  styles: Own[];
}

/** "old" as it begins a line: "Old". */
export const capitalized = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

function titleOf({ group, learnt }: Listed): string {
  return group ? capitalized(group) : learnt ? 'Yours' : 'Others';
}

/** Learnt styles first, then the groups in the order of the model. */
export function groupStyles<Own extends Listed>(styles: readonly Own[]): StyleGroup<Own>[] {
  const sorted = [...styles].sort((a, b) => Number(b.learnt ?? false) - Number(a.learnt ?? false));
  if (!styles.some(({ group }) => group)) return [{ title: '', styles: sorted }];
  const groups = new Map<string, Own[]>();
  for (const style of sorted) {
    const title = titleOf(style);
    groups.set(title, [...(groups.get(title) ?? []), style]);
  }
  return [...groups].map(([title, own]) => ({ title, styles: own }));
}

/** What a menu of styles holds. */
export function styleOptions(styles: readonly Listed[], selected: string): HTMLElement[] {
  return groupStyles(styles).flatMap(({ title, styles: own }) => {
    const options = own.map(({ name }) =>
      element('option', { value: name, selected: name === selected }, name));
    return title ? [element('optgroup', { label: title }, ...options)] : options;
  });
}
