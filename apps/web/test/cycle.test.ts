import { expect, test } from 'vitest';

import { findCycle } from '../src/cycle';

/** Two points that circle in `period` frames; the circle grows by `grow` per frame. */
const turning = (frames: number, period: number, grow = 0) => Array.from({ length: frames }, (_, i) => {
  const angle = (2 * Math.PI * i) / period, size = 1 + grow * i;
  return new Float32Array([size * Math.cos(angle), 1, size * Math.sin(angle), 0, 1, size]);
});

test('a cycle is found with its period', () => {
  const [first, end] = findCycle(turning(120, 31), 10)!;
  expect(end - first).toBe(31);
});

test('a cycle is no shorter than the minimum', () => {
  const [first, end] = findCycle(turning(120, 17), 25)!;
  expect(end - first).toBe(34);
});

test('a pose that comes back on another way is no cycle', () => {
  // Forward, then backward: the same poses in another order.
  const there = turning(121, 60).map((_, i, all) => all[i % 60 < 30 ? i % 60 : 60 - (i % 60)]);
  const [first, end] = findCycle(there, 10)!;
  expect(end - first).toBe(60);
});

test('a motion that never comes back has no cycle', () => {
  expect(findCycle(turning(120, 31, 0.02), 10)).toBeNull();
  expect(findCycle(turning(20, 31), 10)).toBeNull();
  expect(findCycle([], 10)).toBeNull();
});
