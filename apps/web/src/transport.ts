// Play, pause, scrub, loop, speed.

import type { MotionFile } from '../package/index.js';
import { button, element, find, hinted } from './dom';

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
  /** Frames a second of the file; 0: its own. */
  onRate(fps: number): void;
  onLoop(loop: boolean): void;
  /** One frame on, or back. */
  onStep(frames: number): void;
}

export class TransportBar {
  readonly state: Transport = { playing: true, loop: true, speed: 1 };
  #play = element('button', { type: 'button', id: 'play' });
  #scrub = element('input', { type: 'range', id: 'scrub', min: 0, max: 1, step: 0.001,
    'aria-label': 'Time in the clip' });
  #time = element('output', { 'aria-live': 'off' });
  #clips = element('select', { id: 'clips', 'aria-label': 'Motion of the file' });
  #rate = element('input', { type: 'number', id: 'fps', min: 0.01, max: 10000, step: 'any',
    ...hinted('Frames a second of the file; empty: its own rate') });
  #range = element('span', { class: 'range', title: 'From the in point to the out point' });
  #loop = element('button', { type: 'button', id: 'loop', 'aria-pressed': 'true' }, 'Loop');
  #seconds = 0;
  #now = 0;
  #in = 0;
  #out: number | null = null;

  constructor(private events: TransportEvents) {
    const speed = element('select', { id: 'speed', 'aria-label': 'Speed' },
      ...kSpeeds.map((s) => element('option', { value: s, selected: s === 1 }, `${s}×`)));
    find('#clip-controls').append(
      button('‹', () => this.events.onStep(-1),
        { id: 'back-frame', ...hinted('One frame back (comma)') }),
      this.#play,
      button('›', () => this.events.onStep(1),
        { id: 'next-frame', ...hinted('One frame on (full stop)') }),
      element('span', { class: 'track' }, this.#scrub, this.#range), this.#time,
      button('In', () => this.setIn(),
        { id: 'in', ...hinted('Begin here (I); again at the same place: at the beginning') }),
      button('Out', () => this.setOut(),
        { id: 'out', ...hinted('End here (O); again at the same place: at the end') }),
      this.#clips, this.#loop, speed,
      element('label', { class: 'word', for: 'fps' }, 'fps'), this.#rate);
    this.#play.addEventListener('click', () => this.setPlaying(!this.state.playing));
    this.#scrub.addEventListener('input', () => {
      this.events.onSeek(Number(this.#scrub.value) * this.#seconds);
    });
    this.#clips.addEventListener('change', () => this.events.onClip(Number(this.#clips.value)));
    this.#rate.addEventListener('change', () => this.events.onRate(Number(this.#rate.value)));
    this.#loop.addEventListener('click', () => {
      this.state.loop = !this.state.loop;
      this.#loop.setAttribute('aria-pressed', String(this.state.loop));
      this.events.onLoop(this.state.loop);
    });
    speed.addEventListener('change', () => (this.state.speed = Number(speed.value)));
    this.setPlaying(true);
  }

  /** Where playing begins and ends, seconds. */
  get range(): [number, number] {
    return [this.#in, this.#out ?? this.#seconds];
  }
  /** Whether that is less than the clip. */
  get isPart() {
    return this.#in > 0 || this.#out !== null;
  }
  setIn() {
    this.#in = Math.abs(this.#in - this.#now) < 1e-3 ? 0 : Math.min(this.#now, this.range[1]);
    this.#showRange();
  }
  setOut() {
    const same = Math.abs(this.range[1] - this.#now) < 1e-3;
    this.#out = same || this.#now <= this.#in ? null : this.#now;
    this.#showRange();
  }
  clearRange() {
    this.#in = 0;
    this.#out = null;
    this.#showRange();
  }
  #showRange() {
    const [begin, end] = this.range.map((s) => (this.#seconds > 0 ? (100 * s) / this.#seconds : 0));
    this.#range.hidden = !this.isPart;
    this.#range.style.cssText = `left: ${begin}%; right: ${100 - end}%`;
  }

  setPlaying(playing: boolean) {
    // Who stands at the end begins again.
    const [begin, end] = this.range;
    if (playing && !this.state.loop && this.#now >= end - 1e-3) this.events.onSeek(begin);
    this.state.playing = playing;
    this.#play.textContent = playing ? 'Pause' : 'Play';
  }

  show(file: MotionFile, clip: number) {
    this.#seconds = file.clips[clip]?.seconds ?? 0;
    this.#clips.replaceChildren(...file.clips.flatMap(({ name, moves }, i) => (moves
      ? [element('option', { value: i, selected: i === clip }, name || `motion ${i + 1}`)] : [])));
    this.#clips.hidden = this.#clips.childElementCount < 2;
    this.showRate(file, clip);
    this.#now = 0;
    this.clearRange();
  }
  showRate(file: MotionFile, clip: number) {
    const frameTime = file.clips[clip]?.frameTime ?? 0;
    this.#rate.value = frameTime > 0 ? String(Number((1 / frameTime).toFixed(2))) : '';
  }

  at(seconds: number) {
    this.#now = seconds;
    const share = this.#seconds > 0 ? seconds / this.#seconds : 0;
    this.#scrub.value = String(share);
    this.#scrub.style.setProperty('--to', String(share));
    this.#scrub.setAttribute('aria-valuetext', `${seconds.toFixed(1)} seconds`);
    const text = `${clock(seconds)} / ${clock(this.#seconds)}`;
    if (this.#time.textContent !== text) this.#time.textContent = text;
  }
}
