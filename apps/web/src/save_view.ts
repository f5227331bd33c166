// What is seen, as a picture, a film or a loop.

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
  /** Tells what is wrong with an action. */
  attempt(action: () => Promise<void> | void): Promise<void>;
}

export function buildViewSaving({ stage, nameOf, motion, attempt }: ViewSaving): HTMLElement[] {
  const picture = button('PNG', () => askSize({
    title: 'Save the view as a picture', action: 'Save picture', sizes: kPictures,
    largest: stage.largestPicture, seen: stage.seen,
    save: async (width, height) => {
      const blob = await stage.picture(width, height);
      if (blob) saveBytes(blob, nameOf('.png'), 'image/png');
    },
  }), { id: 'save-png', title: 'Save the view as a picture' });

  const film = new Film(stage.canvas);
  const record = button('WebM', () => {
    if (film.running) film.stop();
    else film.start(nameOf('.webm'));
    record.setAttribute('aria-pressed', String(film.running));
    record.textContent = film.running ? 'Stop recording' : 'WebM';
  }, { id: 'save-webm', title: 'Record a video of the view; press again to stop' });
  record.hidden = !Film.possible;

  let making = false;
  const show = (text: string) => {
    loop.setAttribute('aria-pressed', String(making));
    loop.textContent = text;
  };
  const make = async (width: number, height: number) => {
    const name = nameOf('.gif');
    making = true;
    show('Stop GIF');
    try {
      const bytes = await makeLoop(stage, motion(), width, height, (share) => {
        if (making) show(`Stop GIF, ${Math.round(100 * share)} %`);
        return making;
      });
      if (bytes) saveBytes(bytes as BlobPart, name, 'image/gif');
    } finally {
      making = false;
      show('GIF');
    }
  };
  const loop = button('GIF', () => {
    if (making) {
      making = false;
      return;
    }
    askSize({
      title: 'Save a loop of the view', action: 'Save loop', sizes: kLoops,
      largest: kLargestLoop, seen: stage.seen,
      hint: 'An animated GIF: one cycle of the motion, or what is between the in and the out point ' +
        `of a clip, ${Math.round(1 / kLoopStep)} frames a second, ${kLongest} s at most.`,
      save: (width, height) => attempt(() => make(width, height)),
    });
  }, { id: 'save-gif', title: 'Save a loop of the view as an animated GIF' });
  return [picture, record, loop];
}
