// Removes styles, and recognises which ones a motion shows.

import type { Clip, Skeleton } from './character.js';
import { PanacheError, checkClip, inUse, unexpected } from './checks.js';
import { kClip } from './header.js';
import type { Panache } from './index.js';
import type { Arena } from './memory.js';
import type { MotionFile } from './player.js';
import { createModel, infoOf, styleIndex, stylesOf, type Style } from './styling.js';

const kAnyStyle = 'any', kNeutral = 'neutral';

/** The share of a style in a motion. */
export interface StyleShare {
  /** Name of one of the remover's styles, or 'neutral'. */
  name: string;
  /** 0 to 1. */
  share: number;
}

/** A model that removes styles and recognises which ones a motion shows. */
export class Remover {
  /** The styles that it removes; 'any' is for motion in a style that it does not know. */
  readonly styles: readonly Style[];
  #panache: Panache; #remover: number;

  /** @internal */ static _create(panache: Panache, bytes: ArrayBuffer | Uint8Array): Remover {
    return new Remover(panache, bytes);
  }
  private constructor(panache: Panache, bytes: ArrayBuffer | Uint8Array) {
    this.#panache = panache;
    this.#remover = createModel(panache._module, bytes, 'the remover');
    this.styles = stylesOf(panache._module, this.#remover);
    if (this.styles.length && infoOf(panache._module, this.#remover, 0).takesOff) return;
    this.free();
    throw new PanacheError('the remover: the model puts styles on; expected one that takes them off');
  }

  /** The shares of all styles and neutral in a clip, largest first; they add up to 1. */
  recognise(skeleton: Skeleton, clip: Clip): StyleShare[] {
    return this.#recognise((arena) => writeClip(arena, this.#panache, skeleton, clip));
  }
  /** The same for a clip of a file. */
  recogniseFile(file: MotionFile, clip = 0): StyleShare[] {
    return this.#recognise((arena) => file._clip(this.#panache, arena, clip));
  }
  #recognise(clipIn: (arena: Arena) => number) {
    const { _module: module } = this.#panache;
    const names = [...this.styles.map(({ name }) => name), kNeutral];
    return module.use((arena) => {
      const at = arena.zeros(4 * names.length);
      arena.check(module.wasm.panache_recognise_styles(
        this._handleFor(this.#panache), clipIn(arena), at, names.length));
      const shares = module.floats(at, names.length);
      return names.map((name, i) => ({ name, share: shares[i] }))
        .filter(({ name }) => name !== kAnyStyle)
        .sort((a, b) => b.share - a.share);
    });
  }

  /** @internal */ _handleFor(panache: Panache): number {
    if (panache === this.#panache) return inUse(this.#remover, 'remover');
    throw new PanacheError('this remover is of another Panache; create one with createRemover()');
  }

  /** Characters and players that use it keep working. */
  free(): void {
    this.#panache._module.wasm.panache_model_destroy(this.#remover);
    this.#remover = 0;
  }
}

/** Writes the caller's clip to the module's memory, as a panache_clip. */
export function writeClip(arena: Arena, panache: Panache, skeleton: Skeleton, clip: Clip): number {
  return arena.write(kClip, {
    skeleton: skeleton._handleFor(panache), frameCount: checkClip(clip, skeleton.jointCount),
    frameSeconds: clip.frameSeconds, rotations: arena.copy(clip.rotations),
    translations: arena.copy(clip.translations),
  });
}

export function removerHandle(panache: Panache, remover: Remover): number {
  if (!(remover instanceof Remover)) throw unexpected('remover', 'a Remover', remover);
  return remover._handleFor(panache);
}

/** The module's index of the style to remove from `what`, which has this remover; null: none. */
export function removedIndex(remover: Remover | null, style: string | null, what: string): number {
  if (!remover) throw new PanacheError(`setRemoved: expected a ${what} that was given a remover`);
  return style === null ? -1 : styleIndex(remover.styles, style);
}
