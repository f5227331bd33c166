// Saves the view as a picture, a film or a loop.

import { attempt } from './alerts';
import { button, element, find, saveBytes } from './dom';
import type { Exporter } from './exporter';
import { kLongest, kLoopStep, makeLoop } from './loop';
import type { Stage } from './stage';

const kPictures = [[1280, 720], [1920, 1080], [3840, 2160], [1080, 1080], [1080, 1920]] as const;
const kLoops = [[640, 360], [480, 480], [360, 640], [320, 240]] as const;
const kLargestLoop = 800;
const kMin = 16;

interface SizeDialog {
  title: string;
  /** Text of the save button. */
  action: string;
  sizes: readonly (readonly [number, number])[];
  /** Maximum size in either direction, pixels. */
  largest: number;
  /** The size of the view, pixels. */
  seen: [number, number];
  hint?: string;
  save(width: number, height: number): void | Promise<void>;
}

/** Asks for the size of a picture or a loop. */
function askSize(what: SizeDialog) {
  const field = (id: string, title: string) => element('input', { type: 'number', id,
    'aria-label': title, min: kMin, max: what.largest, step: 1, required: true });
  const width = field('picture-width', 'Width, pixels');
  const height = field('picture-height', 'Height, pixels');
  const set = (across: number, down: number) => {
    width.value = String(across);
    height.value = String(down);
  };
  const [across, down] = what.seen;
  const smaller = Math.min(1, what.largest / Math.max(across, down));
  const seen = () => set(Math.round(smaller * across), Math.round(smaller * down));
  const form = element('form', { method: 'dialog' },
    element('div', { class: 'chips' }, button('As seen', seen),
      ...what.sizes.filter((size) => Math.max(...size) <= what.largest)
        .map(([w, h]) => button(`${w} × ${h}`, () => set(w, h)))),
    element('p', { class: 'size' }, width, ' × ', height, ' pixels'),
    ...(what.hint ? [element('p', { class: 'hint' }, what.hint)] : []),
    element('div', { class: 'chips' },
      element('button', { type: 'submit', id: 'save-picture' }, what.action),
      button('Close', () => dialog.close())));
  const dialog = element('dialog', { id: 'picture', 'aria-labelledby': 'picture-title' },
    element('h2', { id: 'picture-title' }, what.title), form);
  form.addEventListener('submit', () =>
    void what.save(width.valueAsNumber, height.valueAsNumber));
  dialog.addEventListener('close', () => dialog.remove());
  find('main').append(dialog);
  seen();
  dialog.showModal();
}

function filmSaver(stage: Stage, exporter: Exporter) {
  let recorder: MediaRecorder | undefined;
  const show = (recording: boolean) => {
    stop.hidden = !recording;
    record.disabled = recording;
  };
  const stop = button('Stop recording', () => {
    recorder?.stop();
    show(false);
  }, { id: 'stop-webm', class: 'running', hidden: true });
  const record = button('Video (WebM)', () => {
    const name = exporter.nameOf('.webm'), pieces: Blob[] = [];
    recorder = new MediaRecorder(stage.canvas.captureStream(60),
      { mimeType: 'video/webm', videoBitsPerSecond: 8e6 });
    recorder.ondataavailable = (event) => pieces.push(event.data);
    recorder.onstop = () => saveBytes(new Blob(pieces), name, 'video/webm');
    recorder.start();
    show(true);
  }, { id: 'save-webm', title: 'Record a video of the view until Stop recording is pressed' });
  record.hidden = typeof MediaRecorder === 'undefined' ||
    !MediaRecorder.isTypeSupported('video/webm');
  return { record, stop };
}

function loopSaver(stage: Stage, exporter: Exporter) {
  const stop = button('Stop GIF', () => show(false),
    { id: 'stop-gif', class: 'running', hidden: true });
  const show = (making: boolean) => {
    stop.hidden = !making;
    loop.disabled = making;
  };
  const make = async (width: number, height: number) => {
    const name = exporter.nameOf('.gif');
    show(true);
    try {
      const bytes = await makeLoop(stage, exporter.loopMotion(), width, height, (share) => {
        stop.textContent = `Stop GIF, ${Math.round(100 * share)} %`;
        return !stop.hidden;
      });
      if (bytes) saveBytes(bytes as BlobPart, name, 'image/gif');
    } finally {
      show(false);
    }
  };
  const loop = button('Loop (GIF)', () => askSize({
    title: 'Save a loop of the view', action: 'Save loop', sizes: kLoops,
    largest: kLargestLoop, seen: stage.seen,
    hint: 'An animated GIF: one cycle of the motion, or what is between the loop start and the ' +
      `loop end of a clip, ${Math.round(1 / kLoopStep)} frames a second, ${kLongest} s at most.`,
    save: (width, height) => attempt(() => make(width, height)),
  }), { id: 'save-gif', title: 'Save a loop of the view as an animated GIF' });
  return { loop, stop };
}

/** `savers` save the view in different ways; `stoppers` are visible while a film or a loop is being
 * made, and stop it. */
export function buildViewSaving(stage: Stage, exporter: Exporter) {
  const picture = button('Picture (PNG)', () => askSize({
    title: 'Save the view as a picture', action: 'Save picture', sizes: kPictures,
    largest: stage.largestPicture, seen: stage.seen,
    save: async (width, height) => {
      const blob = await stage.picture(width, height);
      if (blob) saveBytes(blob, exporter.nameOf('.png'), 'image/png');
    },
  }), { id: 'save-png', title: 'Save the view as a picture' });
  const film = filmSaver(stage, exporter), loop = loopSaver(stage, exporter);
  return { savers: [picture, film.record, loop.loop], stoppers: [film.stop, loop.stop] };
}
