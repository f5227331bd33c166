// What is seen, as a picture, a film or a loop.

import { attempt } from './alerts';
import { button } from './dom';
import { kLongest, kLoopStep, makeLoop, type LoopMotion } from './loop';
import { Film, saveBytes } from './saving';
import { askSize } from './size_dialog';
import type { Stage } from './stage';

const kPictures = [[1280, 720], [1920, 1080], [3840, 2160], [1080, 1080], [1080, 1920]] as const;
const kLoops = [[640, 360], [480, 480], [360, 640], [320, 240]] as const;
const kLargestLoop = 800;

export interface ViewSaving {
  stage: Stage;
  /** Of the file with this extension. */
  nameOf(extension: string): string;
  motion(): LoopMotion;
}

export interface ViewSavers {
  /** Each saves the view in another way. */
  savers: HTMLElement[];
  /** Seen while a film or a loop is being made, which they end. */
  stoppers: HTMLElement[];
}

function filmSaver({ stage, nameOf }: ViewSaving) {
  const film = new Film(stage.canvas);
  const stop = button('Stop recording', () => {
    film.stop();
    record.disabled = !(stop.hidden = true);
  }, { id: 'stop-webm', class: 'running', hidden: true });
  const record = button('Video (WebM)', () => {
    film.start(nameOf('.webm'));
    record.disabled = !(stop.hidden = false);
  }, { id: 'save-webm', title: 'Record a video of the view until Stop recording is pressed' });
  record.hidden = !Film.possible;
  return { record, stop };
}

function loopSaver({ stage, nameOf, motion }: ViewSaving) {
  const stop = button('Stop GIF', () => show(false),
    { id: 'stop-gif', class: 'running', hidden: true });
  const show = (making: boolean) => {
    stop.hidden = !making;
    loop.disabled = making;
  };
  const make = async (width: number, height: number) => {
    const name = nameOf('.gif');
    show(true);
    try {
      const bytes = await makeLoop(stage, motion(), width, height, (share) => {
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

export function buildViewSaving(saving: ViewSaving): ViewSavers {
  const { stage, nameOf } = saving;
  const picture = button('Picture (PNG)', () => askSize({
    title: 'Save the view as a picture', action: 'Save picture', sizes: kPictures,
    largest: stage.largestPicture, seen: stage.seen,
    save: async (width, height) => {
      const blob = await stage.picture(width, height);
      if (blob) saveBytes(blob, nameOf('.png'), 'image/png');
    },
  }), { id: 'save-png', title: 'Save the view as a picture' });
  const film = filmSaver(saving), loop = loopSaver(saving);
  return { savers: [picture, film.record, loop.loop], stoppers: [film.stop, loop.stop] };
}
