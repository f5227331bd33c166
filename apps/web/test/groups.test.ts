import { describe, expect, it } from 'vitest';

import type { Style } from '../package/index.js';
import { groupStyles } from '../src/groups';

const style = (name: string, group: string, learnt = false): Style =>
  ({ name, group, learnt, description: '', words: [], side: '', thumbnail: '', gestures: [] });
const shown = (styles: Style[]) =>
  groupStyles(styles).map(({ title, styles: own }) => [title, ...own.map(({ name }) => name)]);

describe('styles in groups', () => {
  it('stand in the order of the model, each group where its first style stands', () => {
    expect(shown([style('sad', 'moods'), style('old', 'ages'), style('shy', 'moods')]))
      .toEqual([['Moods', 'sad', 'shy'], ['Ages', 'old']]);
  });
  it('begin with what was learnt, and have a place for styles without a group', () => {
    expect(shown([style('sad', 'moods'), style('odd', ''), style('mine', '', true)]))
      .toEqual([['Yours', 'mine'], ['Moods', 'sad'], ['Others', 'odd']]);
  });
  it('are one list where the model names no groups', () => {
    expect(shown([style('sad', ''), style('mine', '', true), style('old', '')]))
      .toEqual([['', 'mine', 'sad', 'old']]);
    expect(shown([])).toEqual([['']]);
  });
});
