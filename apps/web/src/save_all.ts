// Motions in all formats that the page writes, for one zip.

import { PanacheError, type MotionFile, type Panache, type Playback, type Walk } from '../package/index.js';
import { openMoving, titleOf } from './source';

const kFormats = ['.bvh', '.glb', '.vrma'];

export type Exports = Record<string, Uint8Array>;  // By file name.

/** What the player has, under a title that none of the others has. */
export function addMotion(out: Exports, player: Walk | Playback, title: string) {
  while (`${title}${kFormats[0]}` in out) title += '-2';
  for (const extension of kFormats) out[title + extension] = player.exportAs(extension);
}

function addFile(out: Exports, file: MotionFile, prepare: (player: Playback) => void,
    nameOf: (source: string) => string) {
  const title = titleOf(file.name);
  try {
    file.clips.forEach(({ name, moves }, i) => {
      if (!moves) return;
      const player = file.createPlayer(i);
      try {
        prepare(player);
        addMotion(out, player, nameOf(file.clips.length > 1 ? `${title}-${name || i + 1}` : title));
      } finally {
        player.free();
      }
    });
  } finally {
    file.free();
  }
}

/** Each motion of these files, with a player that is prepared for it; returns what failed. */
export async function addFiles(out: Exports, panache: Panache, files: File[],
    prepare: (player: Playback) => void, nameOf: (source: string) => string): Promise<string[]> {
  const failed: string[] = [];
  for (const file of files) {
    await new Promise((next) => setTimeout(next));  // The page goes on in between.
    try {
      addFile(out, (await openMoving(panache, file)).file, prepare, nameOf);
    } catch (error) {
      if (!(error instanceof PanacheError)) throw error;
      failed.push(error.message);
    }
  }
  return failed;
}
