// The help dialog: keyboard shortcuts, and about the page.

import { button, element, find } from './dom';

const kKeys: [string, string][] = [
  ['W A S D, arrows', 'steer the walker; Shift runs'],
  ['Arrows (on a style)', 'go through the styles'],
  ['Space', 'play and pause, or walk and stand'],
  ['X (hold)', 'show the input alone'],
  ['F', 'face the character and fit it in'],
  ['1 2 3 4', 'front, side, top, orbit'],
  [', and .', 'one frame back, one frame on'],
  ['I and O', 'loop start, loop end: play from here, to here'],
  ['K', 'a keyframe: the strength of a style at this moment of a clip'],
  ['Arrows, Delete (on a keyframe)', 'move it, with Shift by ten frames; remove it'],
  ['G', 'a gesture of the active styles'],
  ['N', 'poses of the last second'],
  ['0', 'no style'],
  ['Ctrl Z, Ctrl Shift Z', 'undo, redo'],
  ['?', 'this page'],
];

export function buildHelp(): HTMLDialogElement {
  const list = element('dl', {}, ...kKeys.flatMap(([keys, what]) =>
    [element('dt', {}, keys), element('dd', {}, what)]));
  const dialog = element('dialog', { id: 'help', 'aria-labelledby': 'help-title' },
    // The focus would scroll to the button at the end.
    element('h2', { id: 'help-title', tabindex: -1, autofocus: true }, 'Help'),
    element('p', {}, 'Click a style: the same motion in that style, computed in this browser. ' +
      'Arrow keys go on to the next one, + adds one to those that are active, and sliders set their ' +
      'strengths: 0 is neutral, 1 as captured, above 1 exaggerated. ' +
      'Drag the view to look around, scroll to zoom. Drop a motion or a character ' +
      '(BVH, GLB, glTF, VRM, VRMA) on the view and style it; a motion dropped with a character ' +
      'is retargeted to it, and a character alone walks. Save the result as BVH, GLB or VRMA, or all opened files as one zip, ' +
      'the view as a picture (PNG), a film (WebM) or a loop (GIF). ' +
      'Nothing is uploaded.'),
    element('p', {}, 'Learn a style: give a neutral clip of an action and one of the same action ' +
      'in the style, from files or recorded from the view; a card for it appears. Save it as a ' +
      'style file (.safetensors), and drop that, or a model, on the view to open it again. ' +
      'Keyframes, beside the time line of a clip, change the strength of a style over time.'),
    list, button('Close', () => dialog.close()));
  find('main').append(dialog);
  return dialog;
}
