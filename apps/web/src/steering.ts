// Steers the walker by keys, a stick on the screen or a gamepad; until someone steers, it wanders.

import { listenToDrags } from './dom';

const kWalk = 1.35, kRun = 3, kTurn = 1.5;  // m/s, m/s, rad/s.
const kFastest = 4;

/** The walker's paces: m/s, and rad/s to the left. */
export const kPaces = {
  idle: { speed: 0, turn: 0 },
  creep: { speed: 0.45, turn: 0 },
  stroll: { speed: 0.85, turn: 0 },
  walk: { speed: kWalk, turn: 0 },
  run: { speed: kRun, turn: 0 },
  turn: { speed: 1.1, turn: 0.8 },
} as const;
export type Pace = keyof typeof kPaces;

export interface Wish {
  speed: number;
  /** To the left, rad/s. */
  turn: number;
}

/** The wish of a stick pushed `x` to the right and `y` forward (-1 to 1). */
export function stickWish(x: number, y: number): Wish {
  const push = Math.min(1, Math.hypot(x, y));
  if (push < 0.12) return { speed: 0, turn: 0 };
  return { speed: Math.max(0, y) * kFastest * push, turn: -x * kTurn * (y < -0.3 ? 1.3 : 1) };
}

/** The wish of the keys held down, on top of the pace. */
export function keyWish(held: ReadonlySet<string>, pace: Pace): Wish {
  const on = (...codes: string[]) => codes.some((code) => held.has(code));
  const turn = (on('KeyA', 'ArrowLeft') ? kTurn : 0) - (on('KeyD', 'ArrowRight') ? kTurn : 0);
  let speed: number = kPaces[pace].speed;
  if (on('KeyW', 'ArrowUp')) speed = Math.max(speed, kWalk);
  if (on('ShiftLeft', 'ShiftRight') && speed > 0) speed = kRun;
  if (on('KeyS', 'ArrowDown')) speed = 0;
  return { speed, turn: turn || kPaces[pace].turn };
}

const kSteeringKeys = /^(Key[WASD]|Arrow(Up|Down|Left|Right)|Shift(Left|Right))$/;

export class Steering {
  pace: Pace = 'walk';
  #held = new Set<string>();
  #stick: { x: number; y: number } | null = null;
  #free = true;  // Nobody has steered yet.
  #seconds = 0;

  constructor(stick: HTMLElement) {
    // Arrows steer unless the focused element uses them.
    addEventListener('keydown', (event) => {
      const target = event.target as HTMLElement;
      const taken = target.matches('input, select, textarea, [data-arrows]') &&
        event.code.startsWith('Arrow');
      const typing = target.matches('input:is([type=number], [type=search], [type=text])');
      if (taken || typing || event.ctrlKey || event.metaKey || event.altKey) return;
      if (!kSteeringKeys.test(event.code)) return;
      this.#held.add(event.code);
      this.#free = false;
      if (event.code.startsWith('Arrow')) event.preventDefault();
    });
    addEventListener('keyup', (event) => this.#held.delete(event.code));
    addEventListener('blur', () => this.#held.clear());
    this.#listenToStick(stick);
  }

  setPace(pace: Pace) {
    this.pace = pace;
    this.#held.clear();
  }

  /** Call it once per frame. */
  wish(seconds: number): Wish {
    this.#seconds += seconds;
    if (this.#stick) return stickWish(this.#stick.x, this.#stick.y);
    const pad = navigator.getGamepads?.().find((p) => p?.connected);
    if (pad && Math.hypot(pad.axes[0] ?? 0, pad.axes[1] ?? 0) > 0.2) {
      this.#free = false;
      return stickWish(pad.axes[0], -pad.axes[1]);
    }
    const wish = keyWish(this.#held, this.pace);
    if (this.#free && this.pace !== 'turn' && wish.speed > 0) wish.turn = 0.22 * Math.sin(0.35 * this.#seconds);
    return wish;
  }

  #listenToStick(stick: HTMLElement) {
    const knob = stick.firstElementChild as HTMLElement;
    listenToDrags(stick, (across, down) => {
      const x = 2 * across - 1, y = 1 - 2 * down, far = Math.max(1, Math.hypot(x, y));
      this.#free = false;
      this.#stick = { x: x / far, y: y / far };
      knob.style.transform = `translate(${(x / far) * 34}px, ${(-y / far) * 34}px)`;
    }, () => {
      this.#stick = null;
      knob.style.transform = '';
    });
  }
}
