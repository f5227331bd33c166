// The plots under the view, and the numbers in their captions, in step with what is seen.

import type { Playback, Walk } from '../package/index.js';
import { find } from './dom';
import type { Plots } from './plots';

const kMeasuredSteps = 16;   // At once: a browser's clock is too coarse for one.
const kMeasureEvery = 6;     // Frames.
const kPlotEvery = 3;        // Frames.

export class Readout {
  #frames = 0;

  constructor(private plots: Plots) {}

  /** Adds what the player did in a frame, at a time of the motion in seconds, with these strengths;
   * whether it was drawn. */
  add(player: Walk | Playback, time: number, strengths: [string, number][]): boolean {
    const { gate, rate, contacts } = player;
    this.plots.add({ time, strengths, gate, rate, contacts });
    if (this.#frames % kMeasureEvery === 0) {
      const begin = performance.now();
      player.measure(kMeasuredSteps);
      this.plots.addStep(((performance.now() - begin) * 1000) / kMeasuredSteps);
    }
    if (this.#frames++ % kPlotEvery !== 0) return false;
    this.plots.draw();
    find('#gate-now').textContent = gate.toFixed(2);
    find('#rate-now').textContent = `${rate.toFixed(2)}×`;
    find('#step-now').textContent = `${Math.round(this.plots.stepMedian)} µs (median)`;
    return true;
  }
}
