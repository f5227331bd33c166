// Play, pause, scrub, loop, speed.

import type { MotionFile } from '../package/index.js';
import { element, find } from './dom';

const kSpeeds = [0.25, 0.5, 1, 1.5, 2];

export interface Transport {
  playing: boolean;
  loop: boolean;
  speed: number;
}

/** "0:04.2" */
export function clock(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  const rest = (tenths % 600) / 10;
  return `${Math.floor(tenths / 600)}:${rest < 10 ? '0' : ''}${rest.toFixed(1)}`;
}

export interface TransportEvents {
  onSeek(seconds: number): void;
  onClip(clip: number): void;
  onLoop(loop: boolean): void;
}

export class TransportBar {
  readonly state: Transport = { playing: true, loop: true, speed: 1 };
  #play = element('button', { type: 'button', id: 'play' });
  #scrub = element('input', { type: 'range', id: 'scrub', min: 0, max: 1, step: 0.001,
    'aria-label': 'Time in the clip' });
  #time = element('output', { 'aria-live': 'off' });
  #clips = element('select', { id: 'clips', 'aria-label': 'Motion of the file' });
  #loop = element('button', { type: 'button', id: 'loop', 'aria-pressed': 'true' }, 'Loop');
  #seconds = 0;

  constructor(private events: TransportEvents) {
    const speed = element('select', { id: 'speed', 'aria-label': 'Speed' },
      ...kSpeeds.map((s) => element('option', { value: s, selected: s === 1 }, `${s}×`)));
    find('#clip-controls').append(
      this.#play, this.#scrub, this.#time, this.#clips, this.#loop, speed);
    this.#play.addEventListener('click', () => this.setPlaying(!this.state.playing));
    this.#scrub.addEventListener('input', () => {
      this.events.onSeek(Number(this.#scrub.value) * this.#seconds);
    });
    this.#clips.addEventListener('change', () => this.events.onClip(Number(this.#clips.value)));
    this.#loop.addEventListener('click', () => {
      this.state.loop = !this.state.loop;
      this.#loop.setAttribute('aria-pressed', String(this.state.loop));
      this.events.onLoop(this.state.loop);
    });
    speed.addEventListener('change', () => (this.state.speed = Number(speed.value)));
    this.setPlaying(true);
  }

  setPlaying(playing: boolean) {
    this.state.playing = playing;
    this.#play.textContent = playing ? 'Pause' : 'Play';
  }

  show(file: MotionFile, clip: number) {
    this.#seconds = file.clips[clip]?.seconds ?? 0;
    this.#clips.replaceChildren(...file.clips.map(({ name }, i) =>
      element('option', { value: i, selected: i === clip }, name || `motion ${i + 1}`)));
    this.#clips.hidden = file.clips.length < 2;
  }

  at(seconds: number) {
    const share = this.#seconds > 0 ? seconds / this.#seconds : 0;
    this.#scrub.value = String(share);
    this.#scrub.style.setProperty('--to', String(share));
    this.#scrub.setAttribute('aria-valuetext', `${seconds.toFixed(1)} seconds`);
    const text = `${clock(seconds)} / ${clock(this.#seconds)}`;
    if (this.#time.textContent !== text) this.#time.textContent = text;
  }
}
