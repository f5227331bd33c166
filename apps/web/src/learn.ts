// The form that learns a style from two motions, with the sources, the name and the report.

import type { LearnReport, MotionFile } from '../package/index.js';
import { attempt } from './alerts';
import { button, element } from './dom';
import type { Exporter } from './exporter';
import { capitalized, motionOptions } from './groups';
import { packed } from './late';
import { drawMatch, kMatchPlotHeight } from './match_plot';
import type { Session } from './session';
import { firstMotion, openFile } from './source';

type Role = 'neutral' | 'styled';
const kTitles = { neutral: 'Neutral', styled: 'In the style' };

/** One of the two motions. */
class Slot {
  readonly element: HTMLElement;
  file: MotionFile | null = null;
  #what = element('p', { class: 'what', role: 'status' }, 'Drop a clip here, or');
  #clips = element('select', { 'aria-label': 'Motion of the file', hidden: true });
  #input = element('input', { type: 'file', accept: '.bvh,.glb,.gltf,.vrm,.vrma', hidden: true });
  #record = button('', () => this.attempt(() => this.#press()));
  #begin = 0;
  #timer = 0;

  constructor(readonly role: Role, private session: Session, private exporter: Exporter,
      private attempt: (action: () => Promise<void> | void) => void,
      private onChange: () => void) {
    this.#input.id = `learn-${role}`;
    this.#input.addEventListener('change', () => {
      const file = this.#input.files?.[0];
      if (file) attempt(() => this.open(file));
      this.#input.value = '';
    });
    const buttons = element('div', { class: 'chips' },
      button('Choose …', () => this.#input.click()), this.#record);
    this.element = element('div', { class: 'slot', role: 'group', 'aria-label': kTitles[role],
      'data-slot': role }, element('b', {}, kTitles[role]), this.#what, this.#clips, buttons,
    this.#input);
    this.showSource();
  }

  get clip() {
    return Number(this.#clips.value || 0);
  }

  /** Whether the displayed motion is endless, so it has to be recorded. */
  get #isLive() {
    return this.session.source.kind === 'walk';
  }

  /** Updates the text of the button for the displayed source. */
  showSource() {
    if (this.#timer) return;
    const what = this.role === 'neutral' ? 'the input' : 'the styled motion';
    const live = this.#isLive;
    this.#record.textContent = live ? 'Record' : 'From the view';
    const hint = live ? `Record ${what} of the view; press again to stop`
      : `Take ${what} of the view`;
    this.#record.title = hint;
    this.#record.setAttribute('aria-label', `${hint} (${kTitles[this.role]})`);
  }

  async open(file: File) {
    const opened = (await openFile(this.session.panache, file)).file;
    const first = firstMotion(opened);
    this.file?.free();
    this.file = opened;
    const { clips } = opened;
    this.#clips.replaceChildren(...motionOptions(clips, first));
    this.#clips.hidden = this.#clips.childElementCount < 2;
    this.#what.textContent = `${opened.name}, ${(clips[first]?.seconds ?? 0).toFixed(1)} s`;
    this.element.classList.add('filled');
    this.onChange();
  }

  async #press() {
    const which = this.role === 'neutral' ? 'input' : 'styled';
    const seconds = () => (performance.now() - this.#begin) / 1000;
    if (!this.#isLive && !this.#timer) {
      return this.open(this.exporter.capture(which, Infinity));
    }
    if (!this.#timer) {
      this.#begin = performance.now();
      const show = () => {
        this.#record.textContent = `Stop (${seconds().toFixed(1)} s)`;
      };
      this.#timer = window.setInterval(show, 100);
      this.#record.setAttribute('aria-pressed', 'true');
      return show();
    }
    clearInterval(this.#timer);
    this.#timer = 0;
    this.#record.removeAttribute('aria-pressed');
    this.showSource();
    await this.open(this.exporter.capture(which, seconds()));
  }
}

export class Learn {
  readonly button = button('Learn a style …', () => this.show(this.section.hidden),
    { id: 'show-learn', 'aria-expanded': 'false', 'aria-controls': 'learn' });
  readonly section: HTMLElement;
  #slots: Record<Role, Slot>;
  #name = element('input', { type: 'text', id: 'learn-name', maxlength: 60,
    placeholder: 'Name of the style', 'aria-label': 'Name of the style' });
  #go = button('Learn', () => this.#attempt(() => this.#learn()), { id: 'learn-go', disabled: true });
  #error = element('p', { class: 'error', role: 'alert', hidden: true });
  #report = element('div', { id: 'learn-report', hidden: true });

  constructor(private session: Session, private exporter: Exporter) {
    const slot = (role: Role) =>
      new Slot(role, session, exporter, (action) => this.#attempt(action), () => this.#showButton());
    this.#slots = { neutral: slot('neutral'), styled: slot('styled') };
    this.section = element('section', { id: 'learn', hidden: true, 'aria-label': 'Learn a style' },
      element('p', { class: 'hint' }, 'A clip in the style, 2 to 3 seconds of any action. Better: the ' +
        'same action in neutral too, with the same joints.'),
      this.#slots.neutral.element, this.#slots.styled.element,
      element('div', { class: 'name' }, this.#name, this.#go), this.#error, this.#report);
    this.#name.addEventListener('input', () => this.#showButton());
    this.#name.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && !this.#go.disabled) this.#go.click();
    });
  }

  get open() {
    return !this.section.hidden;
  }
  show(open: boolean) {
    this.section.hidden = !open;
    this.button.setAttribute('aria-expanded', String(open));
  }
  /** Call it when the displayed motion changes. */
  showSource() {
    for (const slot of Object.values(this.#slots)) slot.showSource();
  }

  /** Takes dropped clips: into the slot under the pointer, or else an empty one. */
  take(files: File[], target: EventTarget | null) {
    const slot = target instanceof Element ? target.closest<HTMLElement>('[data-slot]') : null;
    const { neutral, styled } = this.#slots;
    const slots = files.length > 1 ? [neutral, styled]
      : [slot ? this.#slots[slot.dataset.slot as Role]
        : styled.file && !neutral.file ? neutral : styled];
    this.#attempt(async () => {
      for (const [i, slot] of slots.entries()) await slot.open(files[i]);
    });
  }

  #isOwn(name: string) {
    return this.session.panache.styles.some((style) => style.name === name && style.learnt);
  }
  #showButton() {
    const { styled } = this.#slots;
    const name = this.#name.value.trim();
    this.#go.disabled = !styled.file || name === '';
    this.#go.textContent = this.#isOwn(name) ? 'Replace' : 'Learn';
  }

  async #learn() {
    const { neutral, styled } = this.#slots;
    const { panache } = this.session;
    const name = this.#name.value.trim();
    if (!styled.file) return;
    this.#report.hidden = true;
    const begin = performance.now();
    const { bytes, report } = panache.learnStyle(name, { file: styled.file, clip: styled.clip },
      neutral.file ? { file: neutral.file, clip: neutral.clip }
        : await packed('neutral'));
    panache.addStyle(bytes, { replace: this.#isOwn(name) });
    const seconds = (performance.now() - begin) / 1000;
    this.session.stylesChanged(name);
    this.session.playAlone(name);
    this.#showReport(name, report, seconds);
    this.#showButton();
  }

  #showReport(name: string, report: LearnReport, seconds: number) {
    const { match, verdict, tempo, heldBackCm, meanPostureCm, untouchedCm, people, certainty } = report;
    const cm = (value: number | null) => (value ?? 0).toFixed(1);
    const canvas = element('canvas', { role: 'img', 'aria-label':
      `Poses of ${report.styled} at the top, the matching poses of ${report.neutral} at the bottom` });
    canvas.style.height = `${kMatchPlotHeight}px`;
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
      button('Save style file', () => this.exporter.saveStyle(name), { id: 'learn-save' }));
    this.#report.hidden = false;
    drawMatch(canvas, report.plot);
  }

  #attempt(action: () => Promise<void> | void) {
    void attempt(action, (text) => {
      this.#error.textContent = text;
      this.#error.hidden = text === '';
    });
  }
}
