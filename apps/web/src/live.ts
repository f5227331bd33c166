// `panache live --view`: draws live what the relay receives and sends.

import { humanJoints, type Panache } from '../package/index.js';
import { find } from './dom';
import { Stage, type Showable } from './stage';

const kAskEvery = 500;  // Milliseconds, until a sender is recognised.
const kNumbers = 7 * humanJoints.length;  // Per body, see Player.parts().
const kEnded = 'panache live has ended';
const kStale = 1000;    // Milliseconds without a pose until the page reports it.

export class LiveView {
  /** For tests: the number of drawn frames, and the last poses: input, then output. */
  frames = 0;
  poses: Float32Array | null = null;
  #stage = new Stage(find('#view') as HTMLCanvasElement);
  #heard = 0;   // Time of the last pose, milliseconds.
  #drawn = 0;

  /** For tests: whether the model has arrived. */
  ready = false;

  constructor(readonly panache: Panache, private model: Promise<ArrayBuffer>) {
    document.body.dataset.source = 'live';
    document.body.dataset.view = this.#stage.view = 'side';
    this.#stage.trail = false;
    void this.#begin();
  }

  /** Waits for the body of the first sender. */
  async #body(): Promise<ArrayBuffer> {
    for (;;) {
      const answer = await fetch('live/body.bvh').catch(() => null);
      if (answer?.ok) return answer.arrayBuffer();
      this.#say(answer ? 'Waiting for motion from a tracker …' : kEnded);
      await new Promise((next) => setTimeout(next, kAskEvery));
    }
  }

  async #begin() {
    this.panache.setModel(await this.model);
    this.ready = true;
    const file = this.panache.openFile(await this.#body(), 'live.bvh');
    const player = file.createPlayer(0);
    const events = new EventSource('live/poses');
    events.addEventListener('message', ({ data }) => {
      this.poses = new Float32Array(JSON.parse(String(data)) as number[]);
      this.#heard = performance.now();
    });
    let ended = false;
    events.addEventListener('error', () => {
      ended = true;
      events.close();
    });
    const shown: Showable['player'] = {
      body: player.body, coarseBody: player.coarseBody, contacts: [0, 0],
      parts: (which) => this.poses?.subarray(...which === 'input'
        ? [0, kNumbers] as const : [kNumbers, 2 * kNumbers] as const) ?? player.parts(which),
      pose: () => new Float32Array(),
    };
    const source: Showable = { player: shown, joints: 0, own: null };
    this.#stage.show(source);
    let first = true;
    const frame = (now: number) => {
      const seconds = (now - this.#drawn) / 1000;
      this.#drawn = now;
      if (this.poses) {
        this.#stage.update(source, first, seconds);
        if (first) this.#stage.look('face', shown);
        first = false;
      }
      const silent = now - this.#heard > kStale;
      this.#say(ended ? kEnded : silent ? 'No motion comes in' : '');
      this.#stage.draw(seconds);
      ++this.frames;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  #say(text: string) {
    const wait = find('#wait');
    wait.hidden = text === '';
    if (wait.textContent !== text) wait.textContent = text;
  }
}
