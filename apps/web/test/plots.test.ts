import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { Plots } from '../src/plots';

const kHeight = 58;

// A canvas that records the points of the last line, and ignores all other calls.
function fakeCanvas() {
  const points: [number, number][] = [];
  const own = {
    beginPath: () => points.splice(0),
    lineTo: (x: number, y: number) => points.push([x, y]),
  };
  const context = new Proxy(own, { get: (of, name) => Reflect.get(of, name) ?? (() => {}) });
  return { clientWidth: 120, clientHeight: kHeight, points, getContext: () => context };
}

describe('a line under the view', () => {
  beforeEach(() => {
    vi.stubGlobal('devicePixelRatio', 1);
    vi.stubGlobal('document', {});
    vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: () => '#000' }));
  });
  afterEach(() => vi.unstubAllGlobals());

  function drawn(plot: string, moments: { gate: number; rate: number }[]) {
    const canvas = fakeCanvas();
    const figure = { dataset: { plot }, querySelector: () => canvas };
    const root = { querySelectorAll: () => [figure] } as unknown as HTMLElement;
    const plots = new Plots(root, []);
    moments.forEach((m, i) => plots.add({ time: i, strengths: [], contacts: [0, 0], ...m }));
    plots.draw();
    return canvas.points;
  }

  const kMoments = [{ gate: 1, rate: 0 }, { gate: 0, rate: 2.5 }, { gate: 0.5, rate: 1.25 }];

  it('is at the top where the styles know the motion, and at the bottom where they do not', () => {
    const points = drawn('gate', kMoments);
    // The canvas is six seconds wide, and its right edge is the last moment.
    expect(points.map(([x]) => Math.round(x))).toEqual([80, 100, 120]);
    expect(points.map(([, y]) => y)).toEqual([3, kHeight - 3, kHeight / 2]);
  });
  it('shows the rate of time from nothing to two and a half', () => {
    expect(drawn('rate', kMoments).map(([, y]) => y)).toEqual([kHeight - 3, 3, kHeight / 2]);
  });
});
