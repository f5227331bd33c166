// The track under the time line: edits the keys of one style.

import type { Style } from '../package/index.js';
import { button, element, find, positionIn } from './dom';
import { styleOptions } from './groups';
import { kMin, kMax, moved, strengthAt, withKey, type Key } from './keys';
import type { Session } from './session';

const kPush = 0.05;
const kDoubleClick = 1000;  // Milliseconds, for slow fingers.

export class Track {
  readonly toggle = button('Keyframes', () => this.open(find('#keys').hidden),
    { id: 'show-keys', 'aria-pressed': 'false', title: 'Strength of a style over time' });
  #styles = element('select', { id: 'key-style', 'aria-label': 'Style of the keyframes' });
  #field = element('div', { class: 'key-field', role: 'group' });
  #line: SVGElement;
  #zero = element('i', { class: 'zero' });
  #head = element('i', { class: 'head' });
  #keys: HTMLButtonElement[] = [];
  #seconds = 0;
  #frame = 1 / 60;
  #drag: { index: number; pointer: number } | null = null;
  #pressed = -1;  // Index of the key under the last click.
  #added = -Infinity;  // Time of the last click that added a key, milliseconds.

  constructor(private session: Session) {
    this.#field.innerHTML =
      '<svg viewBox="0 0 100 100" preserveAspectRatio="none" aria-hidden="true"><polyline/></svg>';
    this.#line = this.#field.querySelector('polyline')!;
    this.#zero.style.top = `${this.#down(0)}%`;
    this.#field.append(this.#zero, this.#head);
    const add = button('Add keyframe', () => this.add(),
      { id: 'add-key', title: 'Add a keyframe with the current strength (K)' });
    const clear = button('Clear', () => this.#set([]),
      { id: 'clear-keys', title: 'Remove all keyframes of this style' });
    find('#keys').append(this.#styles, this.#field, add, clear);
    this.#styles.addEventListener('change', () => this.#show());
    this.#listenToPointer();
    session.store.listen(() => {
      this.#show();
      clear.disabled = this.keys.length === 0;
    });
  }

  get style() {
    return this.#styles.value;
  }
  get keys(): readonly Key[] {
    return this.session.store.settings.keys[this.style] ?? [];
  }

  open(open: boolean) {
    find('#keys').hidden = !open;
    this.toggle.setAttribute('aria-pressed', String(open));
    if (open && !this.keys.length) this.#choose();
    this.#show();
  }
  setStyles(styles: readonly Style[]) {
    this.#styles.replaceChildren(...styleOptions(styles, this.style));
    this.#choose();
    this.#show();
  }
  /** Sets the durations of the clip and of a frame, seconds. */
  setTime(seconds: number, frame: number) {
    this.#seconds = seconds;
    if (frame > 0) this.#frame = frame;
    this.#show();
  }
  at(seconds: number) {
    this.#head.style.left = `${this.#across(seconds)}%`;
  }

  /** Adds a key at the play head. */
  add() {
    const { source } = this.session;
    const now = source.kind === 'clip' ? source.player.seconds : 0;
    const { keys, index } = withKey(this.keys, now, this.session.strengthOf(this.style));
    this.open(true);
    this.#set(keys);
    this.#keys[index]?.focus();
  }

  // Chooses a style that has keys, else an active one.
  #choose() {
    const { keys, styles } = this.session.store.settings;
    const wanted = [...Object.keys(keys), ...Object.keys(styles)]
      .find((name) => [...this.#styles.options].some((option) => option.value === name));
    if (wanted && !keys[this.style]) this.#styles.value = wanted;
  }

  #set(keys: readonly Key[]) {
    this.session.store.setKeys(this.style, keys);
  }
  #across(seconds: number) {
    return this.#seconds > 0 ? Math.min(100, (100 * seconds) / this.#seconds) : 0;
  }
  #down(strength: number) {
    return (100 * (kMax - strength)) / (kMax - kMin);
  }

  #show() {
    if (find('#keys').hidden) return;
    const { keys } = this;
    this.#field.setAttribute('aria-label',
      `Keyframes of ${this.style}: click to add one, Delete removes the one that has the focus`);
    const points: Key[] = keys.length
      ? [[0, keys[0][1]], ...keys, [this.#seconds, strengthAt(keys, this.#seconds)]]
      : [[0, this.session.strengthOf(this.style)], [this.#seconds, this.session.strengthOf(this.style)]];
    this.#line.setAttribute('points',
      points.map(([t, s]) => `${this.#across(t)},${this.#down(s)}`).join(' '));
    this.#line.classList.toggle('constant', keys.length === 0);
    while (this.#keys.length > keys.length) this.#keys.pop()!.remove();
    while (this.#keys.length < keys.length) this.#keys.push(this.#makeKey(this.#keys.length));
    keys.forEach(([seconds, strength], i) => {
      const key = this.#keys[i];
      key.hidden = seconds > this.#seconds + 1e-3;
      key.style.left = `${this.#across(seconds)}%`;
      key.style.top = `${this.#down(strength)}%`;
      key.setAttribute('aria-label',
        `Keyframe of ${this.style} at ${seconds.toFixed(2)} seconds: ${strength.toFixed(2)}`);
    });
  }

  #makeKey(index: number) {
    const key = element('button', { type: 'button', class: 'key', 'data-arrows': true,
      'data-index': index, title: 'Drag; arrow keys move it, Delete or a double click removes it' });
    key.addEventListener('keydown', (event) => this.#press(index, event));
    this.#field.append(key);
    return key;
  }

  #press(index: number, event: KeyboardEvent) {
    if (event.key === 'Delete' || event.key === 'Backspace') {
      event.preventDefault();
      return this.#remove(index);
    }
    const step = (event.shiftKey ? 10 : 1) * this.#frame;
    const by = ({ ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, kPush],
      ArrowDown: [0, -kPush] } as Record<string, [number, number]>)[event.key];
    if (!by) return;
    event.preventDefault();
    const [seconds, strength] = this.keys[index];
    this.#move(index, seconds + by[0], strength + by[1]);
  }
  #move(index: number, seconds: number, strength: number) {
    const keys = moved(this.keys, index, seconds, strength, this.#seconds);
    this.#set(keys);
    this.session.pause();
    this.session.seek(keys[index][0]);
  }
  #remove(index: number) {
    this.#set(this.keys.filter((_, i) => i !== index));
    (this.#keys[Math.min(index, this.#keys.length - 1)] ?? this.#styles).focus();
  }

  #listenToPointer() {
    const keyAt = (event: PointerEvent): Key => {
      const [x, y] = positionIn(this.#field, event);
      return [Math.min(1, Math.max(0, x)) * this.#seconds, kMax - y * (kMax - kMin)];
    };
    this.#field.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      const on = (event.target as HTMLElement).closest<HTMLElement>('.key');
      let index = Number(on?.dataset.index);
      if (!on) {
        const added = withKey(this.keys, ...keyAt(event));
        this.#set(added.keys);
        index = added.index;
        this.#added = event.timeStamp;
      }
      this.#pressed = index;
      this.#keys[index].focus();
      this.#field.setPointerCapture(event.pointerId);
      this.#drag = { index, pointer: event.pointerId };
    });
    this.#field.addEventListener('pointermove', (event) => {
      if (this.#drag?.pointer === event.pointerId) this.#move(this.#drag.index, ...keyAt(event));
    });
    // The first click of a double click may add a key; do not remove that one again.
    this.#field.addEventListener('dblclick', (event) => {
      if (event.timeStamp - this.#added > kDoubleClick) this.#remove(this.#pressed);
    });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      this.#field.addEventListener(end, () => (this.#drag = null));
    }
  }
}
