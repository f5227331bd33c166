// What moves: the walker, or a clip of a file that was dropped or chosen.

import type { MotionFile, Panache, Playback, Walk } from '../package/index.js';
import { PanacheError } from '../package/index.js';
import { loadSkinned, type SkinnedCharacter } from './skinned';

const kLargestFile = 256 << 20;  // Bytes; a page has about four times that to work in.

export type Source =
  | { kind: 'walk'; player: Walk; joints: number; own: null }
  | { kind: 'clip'; player: Playback; joints: number; file: MotionFile; clip: number;
      own: [SkinnedCharacter, SkinnedCharacter] | null };

export function walkSource(panache: Panache): Source {
  return { kind: 'walk', player: panache.createWalker(), joints: 21, own: null };
}

/** Rejects with the library's message. */
export async function openFile(panache: Panache, file: File): Promise<{ file: MotionFile;
    bytes: ArrayBuffer }> {
  if (file.size > kLargestFile) {
    throw new PanacheError(`${file.name}: expected at most ${kLargestFile >> 20} MB, found ` +
      `${Math.ceil(file.size / (1 << 20))} MB; the program panache takes files of any size`);
  }
  const bytes = await file.arrayBuffer();
  return { file: panache.openFile(bytes, file.name), bytes };
}

export async function clipSource(file: MotionFile, bytes: ArrayBuffer, clip: number):
    Promise<Source> {
  const player = file.createPlayer(clip);
  let own: [SkinnedCharacter, SkinnedCharacter] | null = null;
  if (file.extension !== '.bvh') {
    // What three.js cannot show is shown as a mannequin.
    own = await loadSkinned(bytes, file, player).catch(() => null);
  }
  return { kind: 'clip', player, joints: file.joints.length, file, clip, own };
}
