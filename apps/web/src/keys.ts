// Keyframes: the strength of a style over the time of a clip, interpolated linearly.

/** The range of strengths. */
export const kMin = -0.5;
export const kMax = 2;

/** Clamps to the bounds and rounds to two decimals; returns `otherwise` if not finite. */
export function bounded(value: number, min: number, max: number, otherwise: number): number {
  if (!Number.isFinite(value)) return otherwise;
  return Math.round(Math.min(max, Math.max(min, value)) * 100) / 100 || 0;
}

/** Seconds after the first frame, rounded to the millisecond, and a strength. */
export type Key = readonly [seconds: number, strength: number];

const kSameTime = 0.004;  // Seconds: less than half of any frame.

const atMillisecond = (seconds: number) => Math.round(Math.max(0, seconds) * 1000) / 1000;
const strengthOf = (value: number) => bounded(value, kMin, kMax, 0);

/** Interpolates like the library. There has to be at least one key, in ascending time. */
export function strengthAt(keys: readonly Key[], seconds: number): number {
  const after = keys.findIndex(([time]) => time > seconds);
  if (after === 0) return keys[0][1];
  if (after < 0) return keys[keys.length - 1][1];
  const [[t0, s0], [t1, s1]] = [keys[after - 1], keys[after]];
  return s0 + ((seconds - t0) / (t1 - t0)) * (s1 - s0);
}

/** Adds a key, or replaces the one at this time; also returns its index. */
export function withKey(keys: readonly Key[], seconds: number, strength: number):
    { keys: Key[]; index: number } {
  const time = atMillisecond(seconds);
  const others = keys.filter(([t]) => Math.abs(t - time) > kSameTime);
  const index = others.filter(([t]) => t < time).length;
  const added: Key = [time, strengthOf(strength)];
  return { keys: [...others.slice(0, index), added, ...others.slice(index)], index };
}

/** Moves a key, at most to its neighbours or the end. */
export function moved(keys: readonly Key[], index: number, seconds: number, strength: number,
    end: number): Key[] {
  const min = index > 0 ? keys[index - 1][0] + 2 * kSameTime : 0;
  const max = index + 1 < keys.length ? keys[index + 1][0] - 2 * kSameTime : end;
  const time = atMillisecond(Math.max(min, Math.min(max, seconds)));
  return keys.map((key, i) => (i === index ? [time, strengthOf(strength)] as const : key));
}

/** "0_0*1.5_1" */
export const toText = (keys: readonly Key[]) => keys.map((key) => key.join('_')).join('*');

/** Ignores invalid keys. */
export function fromText(text: string): Key[] {
  let keys: Key[] = [];
  for (const part of text.split('*')) {
    const numbers = part.split('_').map((number) => (number.trim() === '' ? NaN : Number(number)));
    if (numbers.length !== 2 || !numbers.every(Number.isFinite)) continue;
    ({ keys } = withKey(keys, numbers[0], numbers[1]));
  }
  return keys;
}
