import { describe, expect, it } from 'vitest';

import { clock, frameAt } from '../src/transport';

describe('the frame that is shown', () => {
  it('counts from 1 to the number of frames', () => {
    const at = (seconds: number) => frameAt(seconds, 1 / 60, 0, 180);
    expect([0, 1 / 60, 0.5, 179 / 60].map(at)).toEqual([1, 2, 31, 180]);
    expect(at(99)).toBe(180);
  });
  it('counts frames that do not play', () => {
    expect(frameAt(0, 1 / 30, 1, 50)).toBe(2);
    expect(frameAt(48 / 30, 1 / 30, 1, 50)).toBe(50);
  });
  it('is the only one where frames take no time', () => expect(frameAt(0, 0, 0, 1)).toBe(1));
});

describe('the clock', () => {
  it('shows minutes and tenths', () => {
    expect([0, 4.25, 59.96, 61].map(clock)).toEqual(['0:00.0', '0:04.3', '1:00.0', '1:01.0']);
  });
});
