// A loop of what is seen: an animated GIF of one cycle of the motion, else of all of it.

import { humanJoints } from '../package/index.js';
import { findCycle } from './cycle';
import { late } from './late';
import type { Source } from './source';
import type { Stage } from './stage';

export const kLoopStep = 0.04;  // Seconds of a frame; a GIF counts in hundredths.
export const kLongest = 15;     // Seconds.
const kShortest = 1;            // Seconds.
const kColours = 256;
const kPaletteEvery = 4;  // Pixels that the colours are taken from.
const kSharper = 2;       // Pixels drawn for one of the loop's, in each direction.

/** A motion that plays by itself, from the same pose whenever it is opened. */
export interface LoopMotion {
  open(): Promise<Source>;
  /** One frame on; false: there is none. */
  advance(source: Source): boolean;
  /** Whether a cycle of it is wanted. */
  cyclic: boolean;
}

/** The hips over the ground, and where all joints are from there, of the input and of the output. */
function posesOf({ player }: Source, seen: readonly ('input' | 'styled')[]) {
  const place: number[] = [], pose: number[] = [];
  for (const which of seen) {
    const parts = player.parts(which);
    place.push(parts[0], parts[2]);
    for (let j = 0; j < humanJoints.length; ++j) {
      pose.push(parts[7 * j] - parts[0], parts[7 * j + 1], parts[7 * j + 2] - parts[2]);
    }
  }
  return { place, pose: new Float32Array(pose) };
}

/** Which frames [first, end) make the loop, and how far each body goes in it, metres. */
async function plan(motion: LoopMotion, seen: readonly ('input' | 'styled')[]) {
  const source = await motion.open();
  const all: ReturnType<typeof posesOf>[] = [];
  try {
    do {
      all.push(posesOf(source, seen));
    } while (all.length * kLoopStep < kLongest && motion.advance(source));
  } finally {
    free(source);
  }
  const cycle = motion.cyclic
    ? findCycle(all.map(({ pose }) => pose), Math.round(kShortest / kLoopStep)) : null;
  const [first, end] = cycle ?? [0, all.length];
  const way = cycle ? all[end].place.map((at, k) => at - all[first].place[k]) : [];
  return { first, end, way };
}

function free(source: Source) {
  for (const body of source.own ?? []) body.free();
  source.player.free();
}

const breathe = () => new Promise((next) => setTimeout(next));

/** The bytes of a GIF of what `stage` shows of the motion. `onProgress` gets shares of 1, and says
 * whether to go on; null: it did not. A frame at a time, so that the page goes on meanwhile. */
export async function makeLoop(stage: Stage, motion: LoopMotion, width: number, height: number,
    onProgress: (share: number) => boolean): Promise<Uint8Array | null> {
  const { applyPalette, GIFEncoder, quantize } = await late('gif');
  const { first, end, way } = await plan(motion, stage.seenBodies);
  const source = await motion.open();
  let studio: ReturnType<Stage['studio']> | undefined;
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true })!;
  const gif = GIFEncoder();
  let palette: ReturnType<typeof quantize> | undefined;
  try {
    studio = stage.studio(source);
    for (let i = 0; i < first; ++i) motion.advance(source);
    for (let i = first; i < end; ++i) {
      studio.drawStill(source, kSharper * width, kSharper * height, way, (i - first) / (end - first));
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
      motion.advance(source);
    }
  } finally {
    studio?.free();
    free(source);
  }
  gif.finish();
  return gif.bytes();
}

/** Some of the pixels. */
function everyFew(pixels: Uint8ClampedArray): Uint8ClampedArray {
  const words = new Uint32Array(pixels.buffer);
  return new Uint8ClampedArray(words.filter((_, i) => i % kPaletteEvery === 0).buffer);
}
