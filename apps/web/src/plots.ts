// Plots the last seconds under the view, in sync with it, and updates the values in the captions.

import type { Playback, Walk } from '../package/index.js';
import { colour, find } from './dom';

const kSeconds = 6;
const kBins = 24;
const kBinMicroseconds = 4;
const kMeasuredSteps = 16;   // Per measurement: a browser's clock is too coarse for a single step.
const kMeasureEvery = 6;     // Frames.
const kPlotEvery = 3;        // Frames.

interface Moment {
  time: number;
  strengths: [string, number][];
  gate: number;  // How much of the change is applied: 1 if the input resembles the training motion.
  rate: number;
  contacts: number[];
}

/** The values drawn as a line, their range, and the values of its grid lines. */
const kLines: ['gate' | 'rate', number, number, number[]][] = [
  ['gate', 0, 1, [0, 1]], ['rate', 0, 2.5, [1, 2]],
];

/** The median; 0 if there are no numbers. */
export function median(numbers: readonly number[]): number {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted.length ? sorted[Math.floor(sorted.length / 2)] : 0;
}

/** Counts `numbers` in `bins` ranges of this width; the last bin takes the rest. */
export function histogram(numbers: readonly number[], bins: number, width: number): number[] {
  const out = new Array<number>(bins).fill(0);
  for (const n of numbers) ++out[Math.max(0, Math.min(bins - 1, Math.floor(n / width)))];
  return out;
}

const kGoldenAngle = 137.508;  // Degrees: many colours, far apart for neighbours in the list.

/** The fixed colour of a style. */
export function styleColour(index: number): string {
  return `hsl(${(index * kGoldenAngle + 18) % 360} 65% var(--plot-light))`;
}

export class Plots {
  #moments: Moment[] = [];
  #steps: number[] = [];  // Microseconds per step.
  #frames = 0;
  #canvases = new Map<string, HTMLCanvasElement>();

  /** `styles`: names, in the order of their colours. */
  constructor(root: HTMLElement, public styles: readonly string[]) {
    for (const figure of root.querySelectorAll<HTMLElement>('figure')) {
      this.#canvases.set(figure.dataset.plot ?? '', figure.querySelector('canvas')!);
    }
  }

  clear() {
    this.#moments = [];
  }

  add(moment: Moment) {
    this.#moments.push(moment);
    while (moment.time - this.#moments[0].time > kSeconds) this.#moments.shift();
  }

  /** Adds a frame of the player, at a time of the motion in seconds, with these strengths. Returns
   * whether the plots were redrawn. */
  follow(player: Walk | Playback, time: number, strengths: [string, number][]): boolean {
    const { gate, rate, contacts } = player;
    this.add({ time, strengths, gate, rate, contacts });
    if (this.#frames % kMeasureEvery === 0) {
      const begin = performance.now();
      player.measure(kMeasuredSteps);
      this.#steps.push(((performance.now() - begin) * 1000) / kMeasuredSteps);
      if (this.#steps.length > 600) this.#steps.shift();
    }
    if (this.#frames++ % kPlotEvery !== 0) return false;
    this.draw();
    find('#gate-now').textContent = gate.toFixed(2);
    find('#rate-now').textContent = `${rate.toFixed(2)}×`;
    find('#step-now').textContent = `${Math.round(median(this.#steps))} µs (median)`;
    return true;
  }

  draw() {
    const now = this.#moments.at(-1)?.time ?? 0;
    this.#paint('styles', (context, width, height) => {
      this.#scale(context, width, height, -0.5, 2, [0, 1, 2]);
      const names = new Set(this.#moments.flatMap((m) => m.strengths.map(([name]) => name)));
      for (const name of names) {
        context.strokeStyle = styleColour(this.styles.indexOf(name))
          .replace('var(--plot-light)', colour('plot-light'));
        this.#line(context, width, height, now, -0.5, 2,
          (m) => m.strengths.find(([n]) => n === name)?.[1] ?? 0);
      }
    });
    for (const [name, min, max, marks] of kLines) {
      this.#paint(name, (context, width, height) => {
        this.#scale(context, width, height, min, max, marks);
        context.strokeStyle = colour('accent');
        this.#line(context, width, height, now, min, max, (m) => m[name]);
      });
    }
    this.#paint('contacts', (context, width, height) => {
      context.fillStyle = colour('accent');
      for (const foot of [0, 1]) {
        const top = (foot + 0.18) * (height / 2), tall = 0.64 * (height / 2);
        this.#moments.forEach((m, i) => {
          const from = this.#across(width, now, m.time);
          const to = this.#across(width, now, this.#moments[i + 1]?.time ?? m.time);
          context.globalAlpha = Math.max(0.07, Math.min(1, (m.contacts[foot] - 0.3) / 0.4));
          context.fillRect(from, top, Math.max(0.5, to - from + 0.3), tall);
        });
      }
      context.globalAlpha = 1;
    });
    this.#paint('steps', (context, width, height) => {
      const bins = histogram(this.#steps, kBins, kBinMicroseconds);
      const max = Math.max(1, ...bins);
      context.fillStyle = colour('accent');
      bins.forEach((count, i) => {
        const tall = (count / max) * (height - 14);
        context.fillRect((i * width) / kBins + 0.5, height - 12 - tall, width / kBins - 1, tall);
      });
      context.fillStyle = colour('soft');
      context.fillText('0', 0, height - 1);
      context.textAlign = 'center';
      context.fillText(String((kBins / 2) * kBinMicroseconds), width / 2, height - 1);
      context.textAlign = 'right';
      context.fillText(`${kBins * kBinMicroseconds}+`, width, height - 1);
    });
  }

  #across(width: number, now: number, time: number) {
    return width * (1 - (now - time) / kSeconds);
  }

  #scale(context: CanvasRenderingContext2D, width: number, height: number, min: number,
      max: number, marks: number[]) {
    context.strokeStyle = context.fillStyle = colour('soft');
    for (const mark of marks) {
      const y = height - 3 - ((mark - min) / (max - min)) * (height - 6);
      context.globalAlpha = 0.35;
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(12, Math.round(y) + 0.5);
      context.lineTo(width, Math.round(y) + 0.5);
      context.stroke();
      context.globalAlpha = 1;
      context.fillText(String(mark), 0, Math.max(8, y + 3));
    }
  }

  #line(context: CanvasRenderingContext2D, width: number, height: number, now: number,
      min: number, max: number, value: (moment: Moment) => number) {
    context.lineWidth = 1.8;
    context.lineJoin = 'round';
    context.beginPath();
    for (const m of this.#moments) {
      const y = height - 3 - ((value(m) - min) / (max - min)) * (height - 6);
      context.lineTo(this.#across(width, now, m.time), y);
    }
    context.stroke();
  }

  #paint(name: string,
      paint: (context: CanvasRenderingContext2D, width: number, height: number) => void) {
    const canvas = this.#canvases.get(name);
    const context = canvas?.getContext('2d');
    if (!canvas || !context || canvas.clientWidth === 0) return;
    const ratio = Math.min(2, devicePixelRatio);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = '9.5px system-ui, sans-serif';
    context.textAlign = 'left';
    paint(context, width, height);
  }
}
