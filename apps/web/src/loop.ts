// A loop of what is seen: an animated GIF of one cycle of the motion, else of all of it.

import { humanJoints, type Panache, type Playback, type Walk } from '../package/index.js';
import { findCycle } from './cycle';
import { late } from './late';
import { clipSource, walkSource, type ClipSource, type Source } from './source';
import type { Stage } from './stage';
import { kPaces, type Pace } from './steering';

export const kLoopStep = 0.04;  // Seconds of a frame; a GIF counts in hundredths.
export const kLongest = 15;     // Seconds.
const kShortest = 1;            // Seconds.
const kSettle = 3;  // Seconds until the walker has her pace, and styles are eased in.
const kEase = 0.5;  // Seconds until styles are.
const kColours = 256;
const kPaletteEvery = 4;  // Pixels that the colours are taken from.
const kSharper = 2;       // Pixels drawn for one of the loop's, in each direction.

/** A motion that plays by itself, from the same pose whenever it is opened. */
export interface LoopMotion {
  /** `advance` goes one frame on; false: there is none. */
  open(): Promise<{ source: Source; advance(): boolean }>;
  /** Whether a cycle of it is wanted. */
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

/** Of a clip from one second to another; a cycle of it where that is all of the clip, and no
 * strength has keys in it. */
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
  const { source, advance } = await motion.open();
  const all: ReturnType<typeof posesOf>[] = [];
  do {
    all.push(posesOf(source, seen));
  } while (all.length * kLoopStep < kLongest && advance());
  free(source);
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
      advance();
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
