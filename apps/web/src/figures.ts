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

/** Lines from joint to joint, and how thick, metres; those behind come first. */
const kLines: [string[], number][] = [
  [['rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes'], 0.11],
  [['rightUpperArm', 'rightLowerArm', 'rightHand'], 0.075],
  [['hips', 'spine', 'chest', 'neck'], 0.2],
  [['leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes'], 0.12],
  [['leftUpperArm', 'leftLowerArm', 'leftHand'], 0.08],
];

/** A person of strokes in a box, from where its joints are: metres, Y up, facing +Z. `near` is the
 * colour of the side that is nearer. */
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
      this.#walk.setStrength(this.style, 1);  // Another model may have come.
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

/** Makes the figures of rows one after the other, so that the page opens without waiting. */
export class Figures {
  #figures = new Map<HTMLElement, Figure>();
  #moving: Figure | null = null;
  #waiting: Figure[] = [];

  constructor(private panache: Panache, rows: Map<string, HTMLElement>) {
    this.show(rows, 400);
  }

  /** Gives each row a figure, and forgets those of rows that are gone. */
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
