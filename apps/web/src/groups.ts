// Lists the styles by group.

import type { ClipInfo, Style } from '../package/index.js';
import { element } from './dom';

/** What lists need to know about a style. */
type Listed = Pick<Style, 'name' | 'group'> & Partial<Pick<Style, 'learnt'>>;

export const capitalized = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Learnt styles first, then the groups in the order of the model. Titles are like "Moods", or ""
 * if the model has no groups. */
export function groupStyles<Own extends Listed>(styles: readonly Own[]) {
  const sorted = [...styles].sort((a, b) => Number(b.learnt ?? false) - Number(a.learnt ?? false));
  if (!styles.some(({ group }) => group)) return [{ title: '', styles: sorted }];
  const groups = new Map<string, Own[]>();
  for (const style of sorted) {
    const title = style.group ? capitalized(style.group) : style.learnt ? 'Yours' : 'Others';
    groups.set(title, [...(groups.get(title) ?? []), style]);
  }
  return [...groups].map(([title, own]) => ({ title, styles: own }));
}

/** Whether a word of the style's name, group, description or other words begins with `word`. */
export const matches = ({ name, group, description, words }: Style, word: string) =>
  `${name} ${group} ${description} ${words.join(' ')}`.toLowerCase().split(/[^\p{L}\p{N}]+/u)
    .some((own) => own.startsWith(word));

/** The options of a menu of a file's motions: only those that move the humanoid. */
export const motionOptions = (clips: readonly ClipInfo[], selected: number) =>
  clips.flatMap(({ name, moves }, i) => (moves
    ? [element('option', { value: i, selected: i === selected }, name || `motion ${i + 1}`)] : []));

/** The options of a menu of styles. */
export function styleOptions(styles: readonly Listed[], selected: string): HTMLElement[] {
  return groupStyles(styles).flatMap(({ title, styles: own }) => {
    const options = own.map(({ name }) =>
      element('option', { value: name, selected: name === selected }, name));
    return title ? [element('optgroup', { label: title }, ...options)] : options;
  });
}
