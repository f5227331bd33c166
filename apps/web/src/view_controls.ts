// The buttons in the corner of the view: camera, comparing, full screen, help.

import { kAngles, type Angle } from './camera';
import { element, find } from './dom';

export interface ViewActions {
  onLook: (angle: Angle) => void;
  /** Whether the button is held that shows the input alone. */
  onCompare: (held: boolean) => void;
  onHelp: () => void;
}

export function buildViewControls(on: ViewActions) {
  const button = (id: string, text: string, hint: string, press: () => void) => {
    const out = element('button', { type: 'button', id, title: hint, 'aria-label': hint }, text);
    out.addEventListener('click', press);
    return out;
  };
  const names = { face: 'Camera', front: 'Front', side: 'Side', top: 'Top', orbit: 'Orbit' };
  const menu = element('select', { id: 'angle', 'aria-label': 'Camera', title: 'Camera (1 to 4)' },
    ...kAngles.map((angle) => element('option', { value: angle }, names[angle])));
  menu.addEventListener('change', () => {
    on.onLook(menu.value as Angle);
    menu.blur();
  });
  const compare = button('compare', 'Hold: input', 'Hold to see the input alone (X)', () => {});
  compare.addEventListener('pointerdown', () => on.onCompare(true));
  for (const end of ['pointerup', 'pointerleave', 'pointercancel']) {
    compare.addEventListener(end, () => on.onCompare(false));
  }
  const whole = button('fullscreen', 'Full screen', 'The view alone, on the whole screen', () => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void find('.stage').requestFullscreen();
  });
  whole.hidden = !document.fullscreenEnabled;
  const more = find('#more');
  more.addEventListener('click', () => {
    const open = find('#plots').classList.toggle('open');
    more.setAttribute('aria-pressed', String(open));
  });
  find('#camera').append(menu,
    button('fit', 'Fit', 'Face the character and fit it in (F)', () => {
      menu.value = 'face';
      on.onLook('face');
    }),
    compare, whole, button('show-help', '?', 'Help: keys and more', () => on.onHelp()));
}
