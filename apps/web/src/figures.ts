// A small figure of each style next to its slider: a pose of a walk in that style, animated while
// the pointer is over it.

import type { Panache, Walk } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { colour } from './dom';

const kWide = 42, kHigh = 52;  // CSS pixels.
const kWarmUp = 1.3;           // Seconds until a style is fully eased in.
const kPace = 1.3;             // m/s
const kHeight = 1.75;          // Metres, the height of the box.
const kTurn = -0.9;            // Radians; at 0 the figure faces the viewer.

/** Lines from joint to joint, and their widths in metres, back to front. */
const kLines: [string[], number][] = [
  [['rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes'], 0.11],
  [['rightUpperArm', 'rightLowerArm', 'rightHand'], 0.075],
  [['hips', 'spine', 'chest', 'neck'], 0.2],
  [['leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes'], 0.12],
  [['leftUpperArm', 'leftLowerArm', 'leftHand'], 0.08],
];

/** Draws a stick figure in a box from joint positions: metres, Y up, facing +Z. `near` is the
 * colour of the nearer side. */
export function paintFigure(context: CanvasRenderingContext2D, width: number, height: number,
    joint: (name: string) => readonly [number, number, number], near: string) {
  const scale = height / kHeight;
  const [cos, sin] = [Math.cos(kTurn), Math.sin(kTurn)];
  const [hipsX, , hipsZ] = joint('hips');
  const place = (name: string): [number, number] => {
    const [px, py, pz] = joint(name);
    const x = px - hipsX, z = pz - hipsZ;
    return [width / 2 + (x * cos + z * sin) * scale, height - (py + 0.06) * scale];
  };
  context.lineCap = context.lineJoin = 'round';
  kLines.forEach(([joints, thick], i) => {
    context.strokeStyle = colour(i < 2 ? 'soft' : near);
    context.lineWidth = thick * scale;
    context.beginPath();
    for (const name of joints) context.lineTo(...place(name));
    context.stroke();
  });
  const [x, y] = place('head'), [nx, ny] = place('neck');
  context.fillStyle = colour(near);
  context.beginPath();
  context.arc(x + (x - nx) * 0.7, y + (y - ny) * 0.7, 0.105 * scale, 0, 2 * Math.PI);
  context.fill();
}

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

  /** Draws the figure after some steps. */
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
      this.#walk.setStrength(this.style, 1);  // The model may have changed.
      this.#walk.step(seconds);
      this.#last = this.#walk.parts('styled').slice();
    }
    if (this.#last) this.#paint(this.#last);
  }

  #paint(parts: Float32Array) {
    const context = this.canvas.getContext('2d')!;
    const { width, height } = this.canvas;
    context.clearRect(0, 0, width, height);
    paintFigure(context, width, height, (joint) => {
      const k = 7 * humanJoints.indexOf(joint);
      return [parts[k], parts[k + 1], parts[k + 2]];
    }, 'accent');
  }
}

/** Draws the figures of the rows one at a time, so the page opens without a delay. */
export class Figures {
  #figures = new Map<HTMLElement, Figure>();
  #moving: Figure | null = null;
  #waiting: Figure[] = [];

  constructor(private panache: Panache, rows: Map<string, HTMLElement>) {
    this.show(rows, 400);
  }

  /** Gives each row a figure, and drops the figures of removed rows. */
  show(rows: Map<string, HTMLElement>, wait = 0) {
    const kept = new Set(rows.values());
    for (const [row, figure] of this.#figures) {
      if (kept.has(row)) continue;
      if (this.#moving === figure) this.#move(null);
      this.#figures.delete(row);
    }
    const idle = this.#waiting.length === 0;
    this.#waiting = this.#waiting.filter((figure) => [...this.#figures.values()].includes(figure));
    for (const [style, row] of rows) if (!this.#figures.has(row)) this.#add(style, row);
    if (idle && this.#waiting.length) setTimeout(() => this.#next(), wait);
  }

  #add(style: string, row: HTMLElement) {
    const figure = new Figure(this.panache, style);
    row.prepend(figure.canvas);
    this.#figures.set(row, figure);
    this.#waiting.push(figure);
    const start = () => this.#move(figure);
    const stop = () => this.#moving === figure && this.#move(null);
    for (const event of ['pointerenter', 'focusin']) row.addEventListener(event, start);
    for (const event of ['pointerleave', 'focusout']) row.addEventListener(event, stop);
  }
  #next() {
    const figure = this.#waiting.shift();
    if (!figure) return;
    figure.begin();
    figure.end();
    if (this.#waiting.length) setTimeout(() => this.#next(), 30);
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
    for (const figure of this.#figures.values()) figure.draw(0);
  }
}
