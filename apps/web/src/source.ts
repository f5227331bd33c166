// The source of motion: the walker, or a clip of an opened file.

import type { MotionFile, Panache, Playback, Walk } from '../package/index.js';
import { PanacheError } from '../package/index.js';
import { loadSkinned, type SkinnedCharacter } from './skinned';
import { kPaces } from './steering';

const kLargestFile = 256 << 20;  // Bytes; a page has about four times that of memory.

export interface WalkSource { kind: 'walk'; player: Walk; joints: number; own: null }
export interface ClipSource { kind: 'clip'; player: Playback; joints: number; file: MotionFile;
  clip: number; own: [SkinnedCharacter, SkinnedCharacter] | null }
export type Source = WalkSource | ClipSource;

export const walkSource = (panache: Panache): WalkSource =>
  ({ kind: 'walk', player: panache.createWalker(), joints: 21, own: null });

/** The frame rates given for files whose own rate is wrong or missing; 0: the file's. */
const rates = new WeakMap<File, number>();

/** Reads a file at `fps` frames per second, or at its own rate if that is 0. Remembers the rate for
 * the file. Rejects with the library's message. */
export async function openFile(panache: Panache, file: File, fps = rates.get(file) ?? 0):
    Promise<{ file: MotionFile; bytes: ArrayBuffer }> {
  if (file.size > kLargestFile) {
    throw new PanacheError(`${file.name}: expected at most ${kLargestFile >> 20} MB, found ` +
      `${Math.ceil(file.size / (1 << 20))} MB; the program panache takes files of any size`);
  }
  const bytes = await file.arrayBuffer();
  const open = (rate: number) => {
    const opened = panache.openFile(bytes, file.name, { fps: rate });
    rates.set(file, rate);
    return { file: opened, bytes };
  };
  try {
    return open(fps);
  } catch (error) {
    // The library's error if the file's rate is missing or impossible.
    if (!(error instanceof PanacheError) || error.kind !== 'rateNeeded') throw error;
    const given = Number(window.prompt(`${error.message}\n\nFrames a second of ${file.name}:`));
    if (!(given > 0)) throw error;
    return open(given);
  }
}

const kWalkSeconds = 12;  // Length of the walk for a character without motion.
const kSettle = 3;        // Seconds until the walker has its pace.

/** Whether no clip of a file moves the humanoid in more than one frame. */
const isStill = ({ clips }: MotionFile) => !clips.some(({ moves, frames }) => moves && frames > 1);

/** Returns use(thing), and frees the thing. */
export function freed<Thing extends { free(): void }, Out>(thing: Thing, use: (thing: Thing) => Out) {
  try {
    return use(thing);
  } finally {
    thing.free();
  }
}

/** The walker's walk as a file. */
const walkFile = (panache: Panache) => freed(panache.createWalker(), (walker) => {
  walker.steer(kPaces.walk.speed, kPaces.walk.turn);
  for (let t = 0; t < kSettle + kWalkSeconds; t += 1 / 60) walker.step(1 / 60);
  const bytes = walker.exportAs('.bvh', { which: 'input', seconds: kWalkSeconds });
  return panache.openFile(bytes, 'walk.bvh');
});

/** For files of characters without motion: the same with the walk. */
const walking = new WeakMap<File, File>();

/** Like openFile(), but puts the walker's walk onto a character without motion: `from` then has the
 * walk, and `notes` say so. */
export async function openMoving(panache: Panache, from: File, fps?: number):
    Promise<{ file: MotionFile; bytes: ArrayBuffer; from: File; notes: readonly string[] }> {
  const known = walking.get(from);
  if (known) return { ...await openFile(panache, known, fps), from: known, notes: [] };
  const opened = await openFile(panache, from, fps);
  const { file } = opened, { notes } = file;
  const asItIs = { ...opened, from, notes };
  if (!isStill(file) || file.extension === '.vrma') return asItIs;
  try {
    freed(walkFile(panache), (walk) =>
      walking.set(from, new File([walk.putOn(file) as BlobPart], from.name)));
  } catch (error) {
    if (!(error instanceof PanacheError)) throw error;
    return { ...asItIs, notes: [...notes, error.message] };
  }
  file.free();
  return { ...await openMoving(panache, from, fps), notes: [...notes,
    `${from.name} has no motion of its own, so the walker's walk is put on it; ` +
    'open a motion together with it to use that one instead'] };
}

/** The first motion of the humanoid. Throws if the file only has other motions. */
export function firstMotion({ clips, name }: MotionFile): number {
  const first = clips.findIndex(({ moves }) => moves);
  if (first < 0 && clips.length > 0) {
    throw new PanacheError(`${name}: none of its motions moves a joint of the humanoid; expected ` +
      'an animation that does');
  }
  return Math.max(first, 0);
}

/** A file's name without its extension. */
export const titleOf = (name: string) => name.replace(/\.[^.]*$/, '');

/** Whether it is a model or a style. */
export const isModel = ({ name }: File) => /\.safetensors$/i.test(name);
const isCharacter = (name: string) => /\.(glb|gltf|vrm)$/i.test(name);
const isMotionAlone = (name: string) => /\.(bvh|vrma)$/i.test(name);

/** Combines a motion and a character that were dropped together into one file: the motion on the
 * character. Returns other files unchanged. */
export async function putTogether(panache: Panache, files: File[]): Promise<File[]> {
  const motion = files.find(({ name }) => isMotionAlone(name));
  const character = files.find(({ name }) => isCharacter(name));
  if (files.length !== 2 || !motion || !character) return files;
  const from = (await openFile(panache, motion)).file;
  const onto = await openFile(panache, character).catch((error: unknown) => {
    from.free();
    throw error;
  });
  const title = `${titleOf(motion.name)}-on-${character.name}`;
  return freed(from, () => freed(onto.file, (body) =>
    [new File([from.putOn(body, firstMotion(from)) as BlobPart], title)]));
}

export async function clipSource(file: MotionFile, bytes: ArrayBuffer, clip: number):
    Promise<ClipSource> {
  const player = file.createPlayer(clip);
  let own: [SkinnedCharacter, SkinnedCharacter] | null = null;
  if (!['.bvh', '.vrma'].includes(file.extension)) {
    // Fall back to the mannequin if three.js cannot show the character.
    own = await loadSkinned(bytes, file, player).catch(() => null);
  }
  return { kind: 'clip', player, joints: file.joints.length, file, clip, own };
}
