// A small walking figure of each style on its card. A figure is recorded once its card is seen, and
// its cycle played while it is.

import type { Panache } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { findCycle } from './cycle';
import { colour } from './dom';
import { freed } from './source';

const kCanvasWidth = 92, kCanvasHeight = 100;  // CSS pixels.
const kWarmUp = 1.3;            // Seconds until a style is fully eased in.
const kRecorded = 3;            // Seconds, at least one cycle of most styles.
const kShortest = 0.7;          // Seconds of a cycle.
const kStep = 1 / 24;           // Seconds.
const kPace = 1.3;              // m/s
const kHeight = 1.82;           // Metres, the height of the box.
const kTurn = -0.9;             // Radians; at 0 the figure faces the viewer.

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
  const positionOf = (name: string): [number, number] => {
    const [px, py, pz] = joint(name);
    const x = px - hipsX, z = pz - hipsZ;
    return [width / 2 + (x * cos + z * sin) * scale, height - (py + 0.06) * scale];
  };
  context.lineCap = context.lineJoin = 'round';
  kLines.forEach(([joints, thick], i) => {
    context.strokeStyle = colour(i < 2 ? 'soft' : near);
    context.lineWidth = thick * scale;
    context.beginPath();
    for (const name of joints) context.lineTo(...positionOf(name));
    context.stroke();
  });
  const [x, y] = positionOf('head'), [nx, ny] = positionOf('neck');
  context.fillStyle = colour(near);
  context.beginPath();
  context.arc(x + (x - nx) * 0.7, y + (y - ny) * 0.7, 0.105 * scale, 0, 2 * Math.PI);
  context.fill();
}

/** Frames of a style's walk that repeat, kStep apart: parts [21][7]. */
function recordWalk(panache: Panache, style: string): Float32Array[] {
  return freed(panache.createWalker(), (walk) => {
    walk.setStrength(style, 1);
    walk.steer(kPace, 0);
    for (let t = 0; t < kWarmUp; t += kStep) walk.step(kStep);
    const frames: Float32Array[] = [];
    for (let t = 0; t < kRecorded; t += kStep) {
      walk.step(kStep);
      frames.push(walk.parts('styled').slice());
    }
    const poses = frames.map((parts) => Float32Array.from(humanJoints.flatMap((_, j) =>
      [parts[7 * j] - parts[0], parts[7 * j + 1], parts[7 * j + 2] - parts[2]])));
    const cycle = findCycle(poses, Math.round(kShortest / kStep));
    return cycle ? frames.slice(...cycle) : frames;
  });
}

class Figure {
  readonly canvas = document.createElement('canvas');
  #frames: Float32Array[] = [];
  #seconds = 0;

  constructor(private style: string) {
    this.canvas.className = 'figure';
    this.canvas.setAttribute('aria-hidden', 'true');
    const ratio = Math.min(2, Math.max(1.5, devicePixelRatio));
    this.canvas.width = kCanvasWidth * ratio;
    this.canvas.height = kCanvasHeight * ratio;
  }

  get isRecorded() { return this.#frames.length > 0; }
  record(panache: Panache) {
    this.#frames = recordWalk(panache, this.style);
    this.draw(0);
  }

  draw(seconds: number) {
    if (!this.isRecorded) return;
    this.#seconds += seconds;
    const parts = this.#frames[Math.floor(this.#seconds / kStep) % this.#frames.length];
    const context = this.canvas.getContext('2d')!;
    const { width, height } = this.canvas;
    context.clearRect(0, 0, width, height);
    paintFigure(context, width, height, (joint) => {
      const k = 7 * humanJoints.indexOf(joint);
      return [parts[k], parts[k + 1], parts[k + 2]];
    }, 'accent');
  }
}

export class Figures {
  #figures = new Map<Element, Figure>();  // By card.
  #seen = new Set<Figure>();
  #still = matchMedia('(prefers-reduced-motion: reduce)');
  #pointed: Figure | null = null;
  #unpainted = 0;  // Seconds.
  #watch = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const figure = this.#figures.get(target);
      if (figure && isIntersecting) this.#seen.add(figure);
      else if (figure) this.#seen.delete(figure);
    }
  });

  constructor(private panache: Panache) {}

  /** Gives each card a figure, and drops the figures of removed cards. */
  show(cards: Map<string, HTMLElement>) {
    const kept = new Set<Element>(cards.values());
    for (const [card, figure] of this.#figures) {
      if (kept.has(card)) continue;
      this.#watch.unobserve(card);
      this.#seen.delete(figure);
      this.#figures.delete(card);
    }
    for (const [style, card] of cards) if (!this.#figures.has(card)) this.#add(style, card);
  }

  #add(style: string, card: HTMLElement) {
    const figure = new Figure(style);
    card.prepend(figure.canvas);
    this.#figures.set(card, figure);
    card.addEventListener('pointerenter', () => (this.#pointed = figure));
    card.addEventListener('pointerleave', () => (this.#pointed = null));
    this.#watch.observe(card);
  }

  /** Draws the figures in sight, and records one of them at most, so that the view stays smooth. */
  step(seconds: number) {
    const next = [...this.#seen].find((figure) => !figure.isRecorded);
    next?.record(this.panache);
    this.#unpainted += seconds;
    if (this.#unpainted < kStep) return;
    for (const figure of this.#seen) {
      if (!this.#still.matches || figure === this.#pointed) figure.draw(this.#unpainted);
    }
    this.#unpainted = 0;
  }
  paint() {
    for (const figure of this.#figures.values()) figure.draw(0);
  }
}
