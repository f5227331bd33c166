// A style from two motions: where they come from, its name, and how it went.

import type { LearnReport, MotionFile, Panache } from '../package/index.js';
import { PanacheError } from '../package/index.js';
import { element } from './dom';
import { capitalized } from './groups';
import { late } from './late';
import { drawMatch, kMatchPlotHeight } from './match_plot';
import { firstMotion, openFile } from './source';
import { unpack } from './unpack';

type Role = 'neutral' | 'styled';
const kTitles = { neutral: 'Neutral', styled: 'In the style' };

/** What the page does for this. */
export interface LearnHost {
  panache: Panache;
  /** The view's input or output as a motion file: of a clip all, of a walk the last seconds. */
  capture(which: 'input' | 'styled', seconds: number): File;
  /** Whether what is seen goes on for ever, so that it has to be recorded. */
  isLive(): boolean;
  /** A style has come into the model. */
  onLearnt(name: string): void;
  onSave(name: string): void;
}

/** One of the two motions. */
class Slot {
  readonly element: HTMLElement;
  file: MotionFile | null = null;
  #what = element('p', { class: 'what', role: 'status' }, 'Drop a clip here, or');
  #clips = element('select', { 'aria-label': 'Motion of the file', hidden: true });
  #input = element('input', { type: 'file', accept: '.bvh,.glb,.gltf,.vrm,.vrma', hidden: true });
  #record = element('button', { type: 'button' });
  #begin = 0;
  #timer = 0;

  constructor(readonly role: Role, private host: LearnHost,
      attempt: (action: () => Promise<void> | void) => void,
      private onChange: () => void) {
    const choose = element('button', { type: 'button' }, 'Choose …');
    choose.addEventListener('click', () => this.#input.click());
    this.#input.id = `learn-${role}`;
    this.#input.addEventListener('change', () => {
      const file = this.#input.files?.[0];
      if (file) attempt(() => this.open(file));
      this.#input.value = '';
    });
    this.#record.addEventListener('click', () => attempt(() => this.#press()));
    const buttons = element('div', { class: 'chips' }, choose, this.#record);
    this.element = element('div', { class: 'slot', role: 'group', 'aria-label': kTitles[role],
      'data-slot': role }, element('b', {}, kTitles[role]), this.#what, this.#clips, buttons,
    this.#input);
    this.showSource();
  }

  get clip() {
    return Number(this.#clips.value || 0);
  }
  get filled() {
    return this.file !== null;
  }

  /** The button says what it does with what is seen. */
  showSource() {
    if (this.#timer) return;
    const what = this.role === 'neutral' ? 'the input' : 'the styled motion';
    const live = this.host.isLive();
    this.#record.textContent = live ? 'Record' : 'From the view';
    const hint = live ? `Record ${what} of the view; press again to stop`
      : `Take ${what} of the view`;
    this.#record.title = hint;
    this.#record.setAttribute('aria-label', `${hint} (${kTitles[this.role]})`);
  }

  async open(file: File) {
    const opened = (await openFile(this.host.panache, file)).file;
    const first = firstMotion(opened);
    this.file?.free();
    this.file = opened;
    const { clips } = opened;
    this.#clips.replaceChildren(...clips.flatMap(({ name, moves }, i) =>
      (moves ? [element('option', { value: i }, name || `motion ${i + 1}`)] : [])));
    this.#clips.hidden = this.#clips.childElementCount < 2;
    this.#say(`${opened.name}, ${(clips[first]?.seconds ?? 0).toFixed(1)} s`);
  }

  async #press() {
    const which = this.role === 'neutral' ? 'input' : 'styled';
    if (!this.host.isLive() && !this.#timer) {
      return this.open(this.host.capture(which, Infinity));
    }
    if (!this.#timer) {
      this.#begin = performance.now();
      const show = () => {
        const seconds = (performance.now() - this.#begin) / 1000;
        this.#record.textContent = `Stop (${seconds.toFixed(1)} s)`;
      };
      this.#timer = window.setInterval(show, 100);
      this.#record.setAttribute('aria-pressed', 'true');
      return show();
    }
    clearInterval(this.#timer);
    this.#timer = 0;
    this.#record.removeAttribute('aria-pressed');
    this.showSource();
    const seconds = (performance.now() - this.#begin) / 1000;
    await this.open(this.host.capture(which, seconds));
  }

  #say(text: string) {
    this.#what.textContent = text;
    this.element.classList.add('filled');
    this.onChange();
  }
}

export class Learn {
  readonly button = element('button', { type: 'button', id: 'show-learn', 'aria-expanded': 'false',
    'aria-controls': 'learn' }, 'Learn a style …');
  readonly section: HTMLElement;
  #slots: Record<Role, Slot>;
  #name = element('input', { type: 'text', id: 'learn-name', maxlength: 60,
    placeholder: 'Name of the style', 'aria-label': 'Name of the style' });
  #go = element('button', { type: 'button', id: 'learn-go', disabled: true }, 'Learn');
  #error = element('p', { class: 'error', role: 'alert', hidden: true });
  #report = element('div', { id: 'learn-report', hidden: true });

  constructor(private host: LearnHost) {
    const slot = (role: Role) =>
      new Slot(role, host, (action) => void this.#attempt(action), () => this.#showButton());
    this.#slots = { neutral: slot('neutral'), styled: slot('styled') };
    this.section = element('section', { id: 'learn', hidden: true, 'aria-label': 'Learn a style' },
      element('p', { class: 'hint' }, 'A clip in the style, 2 to 3 seconds of any action. Better: the ' +
        'same action in neutral too, with the same joints.'),
      this.#slots.neutral.element, this.#slots.styled.element,
      element('div', { class: 'name' }, this.#name, this.#go), this.#error, this.#report);
    this.button.addEventListener('click', () => this.show(this.section.hidden));
    this.#name.addEventListener('input', () => this.#showButton());
    this.#name.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && !this.#go.disabled) this.#go.click();
    });
    this.#go.addEventListener('click', () => void this.#attempt(() => this.#learn()));
  }

  get open() {
    return !this.section.hidden;
  }
  show(open: boolean) {
    this.section.hidden = !open;
    this.button.setAttribute('aria-expanded', String(open));
  }
  /** Another motion is seen. */
  showSource() {
    for (const slot of Object.values(this.#slots)) slot.showSource();
  }

  /** Takes clips that were dropped: on one of the two places, or wherever there is room. */
  take(files: File[], target: EventTarget | null) {
    const place = target instanceof Element ? target.closest<HTMLElement>('[data-slot]') : null;
    const { neutral, styled } = this.#slots;
    const slots = files.length > 1 ? [neutral, styled]
      : [place ? this.#slots[place.dataset.slot as Role]
        : styled.filled && !neutral.filled ? neutral : styled];
    void this.#attempt(async () => {
      for (const [i, slot] of slots.entries()) await slot.open(files[i]);
    });
  }

  #isOwn(name: string) {
    return this.host.panache.styles.some((style) => style.name === name && style.learnt);
  }
  #showButton() {
    const { styled } = this.#slots;
    const name = this.#name.value.trim();
    this.#go.disabled = !styled.filled || name === '';
    this.#go.textContent = this.#isOwn(name) ? 'Replace' : 'Learn';
  }

  async #learn() {
    const { neutral, styled } = this.#slots;
    const { panache } = this.host;
    const name = this.#name.value.trim();
    if (!styled.file) return;
    this.#report.hidden = true;
    const begin = performance.now();
    const { bytes, report } = panache.learnStyle(name, { file: styled.file, clip: styled.clip },
      neutral.file ? { file: neutral.file, clip: neutral.clip }
        : await unpack((await late('neutral')).packed));
    panache.addStyle(bytes, { replace: this.#isOwn(name) });
    const seconds = (performance.now() - begin) / 1000;
    this.host.onLearnt(name);
    this.#showReport(name, report, seconds);
    this.#showButton();
  }

  #showReport(name: string, report: LearnReport, seconds: number) {
    const { match, verdict, tempo, heldBackCm, meanPostureCm, untouchedCm, people, certainty } = report;
    const cm = (value: number | null) => (value ?? 0).toFixed(1);
    const canvas = element('canvas', { role: 'img', 'aria-label':
      `Poses of ${report.styled} at the top, the matching poses of ${report.neutral} at the bottom` });
    canvas.style.height = `${kMatchPlotHeight}px`;
    const save = element('button', { type: 'button', id: 'learn-save' }, 'Save style file');
    save.addEventListener('click', () => this.host.onSave(name));
    this.#report.replaceChildren(
      element('p', {}, element('b', {}, name), ` learnt in ${seconds.toFixed(1)} s: match ` +
        `${match.toFixed(2)}, tempo ${(1 / tempo).toFixed(2)}×`),
      ...(people === null ? [] : [element('p', { class: 'hint' }, `Without a neutral clip: ${people} ` +
        `other people move alike; ${Math.round(100 * (certainty ?? 0))} % of the difference in ` +
        'posture counts as style.')]),
      canvas,
      element('p', { class: 'hint' }, 'Top: the styled clip. Bottom: the matching frames of the neutral clip.'),
      ...report.warnings.map((text) => element('p', { class: 'warning' }, text)),
      element('p', { class: 'hint' }, heldBackCm === null
        ? 'Too short to validate; error unknown.'
        : `${capitalized(verdict ?? '')}: joints ${cm(heldBackCm)} cm off on the held-back last ` +
          'quarter (its mean posture alone ' +
          `${cm(meanPostureCm)}, no style ${cm(untouchedCm)}).`),
      save);
    this.#report.hidden = false;
    drawMatch(canvas, report.plot);
  }

  /** Tells what is wrong with clips and names; everything else is a fault of ours. */
  async #attempt(action: () => Promise<void> | void) {
    this.#error.hidden = true;
    try {
      await action();
    } catch (error) {
      if (!(error instanceof PanacheError)) throw error;
      this.#error.textContent = error.message;
      this.#error.hidden = false;
    }
  }
}
