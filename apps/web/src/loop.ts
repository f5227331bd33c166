// Makes a loop of the view: an animated GIF of one cycle of the motion, or else of all of it.

import { humanJoints, type Panache, type Playback, type Walk } from '../package/index.js';
import { findCycle } from './cycle';
import { late } from './late';
import { clipSource, walkSource, type ClipSource, type Source } from './source';
import type { Stage } from './stage';
import { kPaces, type Pace } from './steering';

export const kLoopStep = 0.04;  // Seconds per frame; GIF times are in hundredths.
export const kLongest = 15;     // Seconds.
const kShortest = 1;            // Seconds.
const kSettle = 3;  // Seconds until the walker has its pace and styles are eased in.
const kEase = 0.5;  // Seconds until styles are eased in.
const kColours = 256;
const kPaletteEvery = 4;  // The palette is made from every fourth pixel.
const kSharper = 2;       // Supersampling factor in each direction.

/** A motion that starts from the same pose each time it is opened. */
export interface LoopMotion {
  /** `advance` moves on by one frame; false: the motion has ended. */
  open(): Promise<{ source: Source; advance(): boolean }>;
  /** Whether to loop one cycle of it. */
  cyclic: boolean;
}

/** `prepare` gives a player its strengths. */
export function walkLoop(panache: Panache, pace: Pace, prepare: (player: Walk) => void): LoopMotion {
  const open = async () => {
    const source = walkSource(panache);
    const advance = () => {
      source.player.steer(kPaces[pace].speed, kPaces[pace].turn);
      source.player.step(kLoopStep);
      return true;
    };
    prepare(source.player);
    for (let t = 0; t < kSettle; t += kLoopStep) advance();
    return { source, advance };
  };
  return { open, cyclic: true };
}

/** A loop of a range of a clip, in seconds. `cyclic`: only for a whole clip without keyframes. */
export function clipLoop(of: ClipSource, bytes: ArrayBuffer,
    [begin, end]: [number, number], prepare: (player: Playback) => void,
    cyclic: boolean): LoopMotion {
  const open = async () => {
    const source = await clipSource(of.file, bytes, of.clip);
    const { player } = source;
    player.loop = false;
    prepare(player);
    player.seek(begin);
    for (let t = 0; t < kEase; t += kLoopStep) player.step(kLoopStep);
    player.seek(begin);
    player.step(0);
    const advance = () => {
      if (player.seconds >= end - 1e-6) return false;
      player.step(kLoopStep);
      return player.seconds <= end + 1e-6;
    };
    return { source, advance };
  };
  return { open, cyclic };
}

/** The hips' positions on the ground, and all joint positions relative to them, per body. */
function posesOf({ player }: Source, seen: readonly ('input' | 'styled')[]) {
  const positions: number[] = [], pose: number[] = [];
  for (const which of seen) {
    const parts = player.parts(which);
    positions.push(parts[0], parts[2]);
    for (let j = 0; j < humanJoints.length; ++j) {
      pose.push(parts[7 * j] - parts[0], parts[7 * j + 1], parts[7 * j + 2] - parts[2]);
    }
  }
  return { positions, pose: new Float32Array(pose) };
}

/** Returns the frames [first, end) of the loop, and each body's travel in it, metres. */
async function plan(motion: LoopMotion, seen: readonly ('input' | 'styled')[]) {
  const { source, advance } = await motion.open();
  const all: ReturnType<typeof posesOf>[] = [];
  do {
    all.push(posesOf(source, seen));
  } while (all.length * kLoopStep < kLongest && advance());
  free(source);
  const cycle = motion.cyclic
    ? findCycle(all.map(({ pose }) => pose), Math.round(kShortest / kLoopStep)) : null;
  const [first, end] = cycle ?? [0, all.length];
  const travel = cycle ? all[end].positions.map((at, k) => at - all[first].positions[k]) : [];
  return { first, end, travel };
}

function free(source: Source) {
  for (const body of source.own ?? []) body.free();
  source.player.free();
}

const breathe = () => new Promise((next) => setTimeout(next));

/** The bytes of a GIF of the motion as `stage` shows it. `onProgress` gets values from 0 to 1 and
 * returns whether to continue; null: cancelled. Yields after each frame to keep the page live. */
export async function makeLoop(stage: Stage, motion: LoopMotion, width: number, height: number,
    onProgress: (share: number) => boolean): Promise<Uint8Array | null> {
  const { applyPalette, GIFEncoder, quantize } = await late('gif');
  const { first, end, travel } = await plan(motion, stage.seenBodies);
  const { source, advance } = await motion.open();
  let studio: ReturnType<Stage['studio']> | undefined;
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true })!;
  const gif = GIFEncoder();
  let palette: ReturnType<typeof quantize> | undefined;
  try {
    studio = stage.studio(source);
    for (let i = 0; i < first; ++i) advance();
    for (let i = first; i < end; ++i) {
      const share = (i - first) / (end - first);
      studio.drawStill(source, kSharper * width, kSharper * height, travel, share);
      context.drawImage(studio.canvas, 0, 0, width, height);
      const { data } = context.getImageData(0, 0, width, height);
      const delay = 1000 * kLoopStep;
      if (palette) {
        gif.writeFrame(applyPalette(data, palette), width, height, { delay });
      } else {
        palette = quantize(everyFew(data), kColours);
        gif.writeFrame(applyPalette(data, palette), width, height, { palette, delay, repeat: 0 });
      }
      await breathe();
      if (!onProgress((i + 1 - first) / (end - first))) return null;
      advance();
    }
  } finally {
    studio?.free();
    free(source);
  }
  gif.finish();
  return gif.bytes();
}

/** A sample of the pixels. */
function everyFew(pixels: Uint8ClampedArray): Uint8ClampedArray {
  const words = new Uint32Array(pixels.buffer);
  return new Uint8ClampedArray(words.filter((_, i) => i % kPaletteEvery === 0).buffer);
}
