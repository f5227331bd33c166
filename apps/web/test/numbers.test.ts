import { describe, expect, it } from 'vitest';

import { positionOf, shares } from '../src/pad';
import { histogram, median } from '../src/plots';
import { keyWish, kPaces, stickWish } from '../src/steering';

describe('the pad', () => {
  it('gives all to a corner and a quarter to each in the middle', () => {
    expect(shares(0, 0)).toEqual([1, 0, 0, 0]);
    expect(shares(1, 1)).toEqual([0, 0, 0, 1]);
    expect(shares(0.5, 0.5)).toEqual([0.25, 0.25, 0.25, 0.25]);
  });
  it('finds the place that it gave the shares of', () => {
    for (const [x, y] of [[0, 0], [0.3, 0.8], [1, 0.25]]) {
      const found = positionOf(shares(x, y));
      expect(found.x).toBeCloseTo(x);
      expect(found.y).toBeCloseTo(y);
    }
  });
  it('stays in the middle without any strength', () => {
    expect(positionOf([0, 0, 0, -0.5])).toEqual({ x: 0.5, y: 0.5 });
  });
});

describe('steering', () => {
  it('goes at the pace when no key is down, and faster or not at all with one', () => {
    expect(keyWish(new Set(), 'walk')).toEqual(kPaces.walk);
    expect(keyWish(new Set(['ArrowDown']), 'walk').speed).toBe(0);
    expect(keyWish(new Set(['KeyW', 'ShiftLeft']), 'idle').speed).toBe(kPaces.run.speed);
  });
  it('turns to the left by what is on the left', () => {
    expect(keyWish(new Set(['KeyA']), 'idle').turn).toBeGreaterThan(0);
    expect(keyWish(new Set(), 'turn').turn).toBeGreaterThan(0);
    expect(keyWish(new Set(['KeyD']), 'turn').turn).toBeLessThan(0);
    expect(stickWish(-1, 0).turn).toBeGreaterThan(0);
  });
  it('takes a stick that barely moves for one at rest', () => {
    expect(stickWish(0.05, 0.05)).toEqual({ speed: 0, turn: 0 });
    expect(stickWish(0, 1).speed).toBeGreaterThan(kPaces.run.speed);
  });
});

describe('the plots', () => {
  it('count what is beyond the last bin in the last bin', () => {
    expect(histogram([0, 3.9, 4, 1000], 3, 4)).toEqual([2, 1, 1]);
  });
  it('take the middle one for the median', () => {
    expect(median([9, 1, 5])).toBe(5);
    expect(median([])).toBe(0);
  });
});
