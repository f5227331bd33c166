// What a loop is made of: the walker at one pace, or a part of a clip.

import type { Panache, Playback, Walk } from '../package/index.js';
import { kLoopStep, type LoopMotion } from './loop';
import { clipSource, walkSource, type Source } from './source';
import { kPaces, type Pace } from './steering';

const kSettle = 3;  // Seconds until the walker has her pace, and styles are eased in.
const kEase = 0.5;  // Seconds until styles are.

/** `prepare` gives a player its strengths. */
export function walkLoop(panache: Panache, pace: Pace, prepare: (player: Walk) => void): LoopMotion {
  const advance = (source: Source) => {
    if (source.kind !== 'walk') return false;
    source.player.steer(kPaces[pace].speed, kPaces[pace].turn);
    source.player.step(kLoopStep);
    return true;
  };
  const open = async () => {
    const source = walkSource(panache);
    if (source.kind === 'walk') prepare(source.player);
    for (let t = 0; t < kSettle; t += kLoopStep) advance(source);
    return source;
  };
  return { open, advance, cyclic: true };
}

/** Of a clip from one second to another; a cycle of it where that is all of the clip, and no
 * strength has keys in it. */
export function clipLoop(of: Source & { kind: 'clip' }, bytes: ArrayBuffer,
    [begin, end]: [number, number], prepare: (player: Playback) => void,
    cyclic: boolean): LoopMotion {
  const open = async () => {
    const source = await clipSource(of.file, bytes, of.clip);
    if (source.kind !== 'clip') return source;
    const { player } = source;
    player.loop = false;
    prepare(player);
    player.seek(begin);
    for (let t = 0; t < kEase; t += kLoopStep) player.step(kLoopStep);
    player.seek(begin);
    player.step(0);
    return source;
  };
  const advance = (source: Source) => {
    if (source.kind !== 'clip' || source.player.seconds >= end - 1e-6) return false;
    source.player.step(kLoopStep);
    return source.player.seconds <= end + 1e-6;
  };
  return { open, advance, cyclic };
}
