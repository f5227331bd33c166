// Each style as a small figure beside its slider: a pose of a walk in that style, and the walk
// itself while it is pointed at.

import type { Panache, Walk } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { colour } from './dom';

const kWide = 42, kHigh = 52;  // Pixels of the page.
const kWarmUp = 1.3;           // Seconds until a style is there.
const kPace = 1.3;             // m/s
const kHeight = 1.75;          // Metres that fit in.
const kTurn = -0.9;            // From where the figure faces the viewer, radians.

const at = (name: string) => 7 * humanJoints.indexOf(name);
/** Lines from joint to joint, and how thick, metres; those behind come first. */
const kLines: [string[], number][] = [
  [['rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes'], 0.11],
  [['rightUpperArm', 'rightLowerArm', 'rightHand'], 0.075],
  [['hips', 'spine', 'chest', 'neck'], 0.2],
  [['leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes'], 0.12],
  [['leftUpperArm', 'leftLowerArm', 'leftHand'], 0.08],
];

class Figure {
  readonly canvas = document.createElement('canvas');
  #walk: Walk | null = null;
  #last: Float32Array | null = null;

  constructor(private panache: Panache, private style: string) {
    this.canvas.className = 'figure';
    this.canvas.setAttribute('aria-hidden', 'true');
    const ratio = Math.min(2, Math.max(1.5, devicePixelRatio));
    this.canvas.width = kWide * ratio;
    this.canvas.height = kHigh * ratio;
  }

  /** Draws the figure as it stands after some steps. */
  begin() {
    this.#walk = this.panache.createWalker();
    this.#walk.setStrength(this.style, 1);
    this.#walk.steer(kPace, 0);
    for (let i = 0; i < kWarmUp * 30; ++i) this.#walk.step(1 / 30);
    this.draw(0);
  }
  end() {
    this.#walk?.free();
    this.#walk = null;
  }
  draw(seconds: number) {
    if (this.#walk) {
      this.#walk.step(seconds);
      this.#last = this.#walk.parts('styled').slice();
    }
    if (this.#last) this.#paint(this.#last);
  }

  #paint(parts: Float32Array) {
    const context = this.canvas.getContext('2d')!;
    const { width, height } = this.canvas;
    const scale = height / kHeight;
    const [cos, sin] = [Math.cos(kTurn), Math.sin(kTurn)];
    const place = (name: string): [number, number] => {
      const k = at(name);
      const x = parts[k] - parts[0], z = parts[k + 2] - parts[2];
      return [width / 2 + (x * cos + z * sin) * scale, height - (parts[k + 1] + 0.06) * scale];
    };
    context.clearRect(0, 0, width, height);
    context.lineCap = context.lineJoin = 'round';
    kLines.forEach(([joints, thick], i) => {
      context.strokeStyle = colour(i < 2 ? 'soft' : 'accent');
      context.lineWidth = thick * scale;
      context.beginPath();
      for (const joint of joints) context.lineTo(...place(joint));
      context.stroke();
    });
    const [x, y] = place('head'), [nx, ny] = place('neck');
    context.fillStyle = colour('accent');
    context.beginPath();
    context.arc(x + (x - nx) * 0.7, y + (y - ny) * 0.7, 0.105 * scale, 0, 2 * Math.PI);
    context.fill();
  }
}

/** Makes the figures of `rows` one after the other, so that the page opens without waiting. */
export class Figures {
  #figures: Figure[] = [];
  #moving: Figure | null = null;

  constructor(panache: Panache, rows: Map<string, HTMLElement>) {
    for (const [style, row] of rows) {
      const figure = new Figure(panache, style);
      row.prepend(figure.canvas);
      this.#figures.push(figure);
      const start = () => this.#move(figure);
      const stop = () => this.#moving === figure && this.#move(null);
      row.addEventListener('pointerenter', start);
      row.addEventListener('pointerleave', stop);
      row.addEventListener('focusin', start);
      row.addEventListener('focusout', stop);
    }
    const waiting = [...this.#figures];
    const next = () => {
      const figure = waiting.shift();
      if (!figure) return;
      figure.begin();
      figure.end();
      setTimeout(next, 30);
    };
    setTimeout(next, 400);
  }

  #move(figure: Figure | null) {
    this.#moving?.end();
    this.#moving = figure;
    figure?.begin();
  }

  step(seconds: number) {
    this.#moving?.draw(seconds);
  }
  paint() {
    for (const figure of this.#figures) figure.draw(0);
  }
}
