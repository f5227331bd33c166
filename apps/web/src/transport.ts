// Play, pause, scrub, loop, speed.

import type { MotionFile } from '../package/index.js';
import { attempt } from './alerts';
import { button, element, find, hinted } from './dom';
import { motionOptions } from './groups';
import type { Session } from './session';
import type { ClipSource } from './source';

const kSpeeds = [0.25, 0.5, 1, 1.5, 2];

/** The frame number at this time, 1 to `frames`; `first` is the index of the first played frame. */
export function frameAt(seconds: number, frameTime: number, first: number, frames: number): number {
  const frame = frameTime > 0 ? Math.round(seconds / frameTime) : 0;
  return Math.max(1, Math.min(frames, first + frame + 1));
}

/** "0:04.2" */
export function clock(seconds: number): string {
  const tenths = Math.round(seconds * 10);
  const rest = (tenths % 600) / 10;
  return `${Math.floor(tenths / 600)}:${rest < 10 ? '0' : ''}${rest.toFixed(1)}`;
}

export class TransportBar {
  readonly state = { playing: true, loop: true, speed: 1 };
  #play = button('', () => this.setPlaying(!this.state.playing), { id: 'play' });
  #scrub = element('input', { type: 'range', id: 'scrub', min: 0, max: 1, step: 0.001,
    'aria-label': 'Time in the clip' });
  #time = element('span', { class: 'seconds' });
  #frameNow = element('span', { id: 'frame' });
  #clips = element('select', { id: 'clips', 'aria-label': 'Motion of the file' });
  #rate = element('input', { type: 'number', id: 'fps', min: 0.01, max: 10000, step: 'any',
    ...hinted('Frames a second of the file; empty: its own rate') });
  #range = element('span', { class: 'range', title: 'From the loop start to the loop end' });
  #loop = button('Loop', () => {
    this.state.loop = !this.state.loop;
    this.#loop.setAttribute('aria-pressed', String(this.state.loop));
    if (this.session.source.kind === 'clip') this.session.source.player.loop = this.state.loop;
  }, { id: 'loop', 'aria-pressed': 'true' });
  #seconds = 0;
  /** "73 / 180" */
  #frame: (seconds: number) => string = () => '';
  #now = 0;
  #in = 0;
  #out: number | null = null;

  constructor(private session: Session) {
    const speed = element('select', { id: 'speed', 'aria-label': 'Speed' },
      ...kSpeeds.map((s) => element('option', { value: s, selected: s === 1 }, `${s}×`)));
    const row = (name: string, ...parts: HTMLElement[]) =>
      find('#clip-controls').append(element('div', { class: name }, ...parts));
    row('time-row',
      button('‹', () => session.stepFrames(-1),
        { id: 'back-frame', ...hinted('One frame back (comma)') }),
      this.#play,
      button('›', () => session.stepFrames(1),
        { id: 'next-frame', ...hinted('One frame on (full stop)') }),
      element('span', { class: 'track' }, this.#scrub, this.#range),
      element('output', { 'aria-live': 'off' }, this.#time, this.#frameNow));
    row('clip-row',
      button('Loop start', () => this.setIn(), { id: 'in',
        title: 'Start of the loop (I); press again to reset' }),
      button('Loop end', () => this.setOut(), { id: 'out',
        title: 'End of the loop (O); press again to reset' }),
      this.#clips, this.#loop, speed,
      element('label', { class: 'word rate', for: 'fps' }, 'fps'), this.#rate);
    this.#scrub.addEventListener('input', () => {
      session.seek(Number(this.#scrub.value) * this.#seconds);
    });
    this.#clips.addEventListener('change',
      () => void attempt(() => session.playClip(Number(this.#clips.value))));
    this.#rate.addEventListener('change', () => {
      const fps = Number(this.#rate.value), { source } = session;
      if (source.kind === 'clip') this.showRate(source.file, source.clip);  // Kept if opening fails.
      void attempt(() => session.setRate(fps));
    });
    speed.addEventListener('change', () => (this.state.speed = Number(speed.value)));
    session.pause = () => this.setPlaying(false);
    this.setPlaying(true);
  }

  /** The start and end of playback, seconds. */
  get range(): [number, number] {
    return [this.#in, this.#out ?? this.#seconds];
  }
  /** Whether the range is less than the whole clip. */
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
    // Playing from the end starts again.
    const [begin, end] = this.range;
    if (playing && !this.state.loop && this.#now >= end - 1e-3) this.session.seek(begin);
    this.state.playing = playing;
    this.#play.textContent = playing ? 'Pause' : 'Play';
  }

  /** Advances by `seconds` while playing, from the loop start to the loop end. Returns the seconds
   * of motion that passed, and whether the motion jumped. */
  play({ file, clip, player }: ClipSource, seconds: number): { passed: number; cut: boolean } {
    const { playing, speed, loop } = this.state;
    const before = player.seconds;
    // Step even when paused, so new settings are applied when the clip continues or is scrubbed.
    player.step(playing ? seconds * speed : 0);
    let cut = player.seconds < before;
    const [begin, end] = this.range;
    const whole = end >= file.clips[clip]?.seconds;
    if (playing && (player.seconds < begin || (loop && !whole && player.seconds >= end))) {
      player.seek(begin);
      cut = true;
    } else if (playing && !loop && player.seconds >= end) {
      this.setPlaying(false);
    }
    this.at(player.seconds);
    return { passed: playing ? seconds * speed : 0, cut };
  }

  show({ file, clip, player }: ClipSource) {
    const { seconds, frames, frameTime } = file.clips[clip] ??
      { seconds: 0, frames: 1, frameTime: 0 };
    this.#seconds = seconds;
    const first = player.firstFrame;
    this.#frame = (now) => `${frameAt(now, frameTime, first, frames)} / ${frames}`;
    this.#clips.replaceChildren(...motionOptions(file.clips, clip));
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
    const frame = this.#frame(seconds);
    this.#scrub.setAttribute('aria-valuetext', `${seconds.toFixed(1)} seconds, frame ${frame}`);
    const show = (field: HTMLElement, text: string) => {
      if (field.textContent !== text) field.textContent = text;
    };
    show(this.#time, `${clock(seconds)} / ${clock(this.#seconds)}`);
    show(this.#frameNow, `frame ${frame}`);
  }
}
