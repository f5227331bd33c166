// The buttons in the corner of the view: camera, comparison, full screen, help.

import { kAngles, type Angle } from './camera';
import { button, element, find, hinted } from './dom';
import type { Stage } from './stage';

export function buildViewControls(stage: Stage, look: (angle: Angle) => void, help: HTMLDialogElement) {
  const names = { face: 'Camera', front: 'Front', side: 'Side', top: 'Top', orbit: 'Orbit' };
  const menu = element('select', { id: 'angle', 'aria-label': 'Camera', title: 'Camera (1 to 4)' },
    ...kAngles.map((angle) => element('option', { value: angle }, names[angle])));
  menu.addEventListener('change', () => {
    look(menu.value as Angle);
    menu.blur();
  });
  const compare = button('Show input (hold)', () => {},
    { id: 'compare', ...hinted('Hold to see the input alone (X)') });
  compare.addEventListener('pointerdown', () => (stage.comparing = true));
  for (const end of ['pointerup', 'pointerleave', 'pointercancel']) {
    compare.addEventListener(end, () => (stage.comparing = false));
  }
  const whole = button('Full screen', () => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void find('.stage').requestFullscreen();
  }, { id: 'fullscreen', ...hinted('Full-screen view') });
  whole.hidden = !document.fullscreenEnabled;
  const more = find('#more');
  more.addEventListener('click', () => {
    const open = find('#plots').classList.toggle('open');
    more.setAttribute('aria-pressed', String(open));
  });
  // A phone in landscape only has room for Open and Save in the panel; same query as in style.css.
  const low = matchMedia('(max-height: 480px) and (min-width: 560px)');
  const placeControls = () => {
    if (low.matches) find('#panel').prepend(find('#file-controls'));
    else find('.bar').append(find('#file-controls'));
  };
  low.addEventListener('change', placeControls);
  placeControls();
  find('#camera').append(menu,
    button('Fit', () => {
      menu.value = 'face';
      look('face');
    }, { id: 'fit', ...hinted('Face the character and fit it in the view (F)') }),
    compare, whole,
    button('?', () => help.showModal(), { id: 'show-help', ...hinted('Help: keys and more') }));
}
