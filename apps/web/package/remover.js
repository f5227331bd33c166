// A model that removes styles and recognises which ones a motion shows. See index.d.ts.
import { PanacheError, checkBytes, checkClip, handleFor, unexpected } from './checks.js';
import { kClip } from './structs.js';

const kAnyStyle = 'any', kNeutral = 'neutral';

export class Remover {
  #panache; #wasm; #remover;

  constructor(panache, bytes) {
    checkBytes(bytes, 'the remover');
    this.#panache = panache;
    this.#wasm = panache._wasm;
    this.#remover = panache._arena((arena) => panache._checked(
      this.#wasm.panache_page_remover_create(arena.copy(bytes), bytes.byteLength)));
    this.styles = panache._stylesOf(this.#remover);
  }

  recognise(skeleton, clip) {
    return this.#recognise((arena, remover, shares, count) =>
      this.#wasm.panache_recognise_styles(
        remover, writeClip(arena, this.#panache, skeleton, clip), shares, count));
  }
  recogniseFile(file, clip = 0) {
    return this.#recognise((_, remover, shares) => this.#wasm.panache_page_file_recognise(
      file._handleFor(this.#panache), clip, remover, shares));
  }
  // `tell` writes the share of each style, then of neutral.
  #recognise(tell) {
    const names = [...this.styles.map(({ name }) => name), kNeutral];
    return this.#panache._arena((arena) => {
      const at = arena.zeros(4 * names.length);
      arena.check(tell(arena, this._handleFor(this.#panache), at, names.length));
      const shares = new Float32Array(this.#wasm.memory.buffer, at, names.length);
      return names.map((name, i) => ({ name, share: shares[i] }))
        .filter(({ name }) => name !== kAnyStyle)
        .sort((a, b) => b.share - a.share);
    });
  }

  _handleFor(panache) {
    return handleFor(panache, this.#panache, this.#remover, 'remover',
      'this remover is of another Panache; create one with createRemover()');
  }
  _styleIndex(style) { return this.#panache._styleIndex(style, this.styles); }

  free() {
    this.#wasm.panache_model_destroy(this.#remover);
    this.#remover = 0;
  }
}

// Writes the caller's clip to the module's memory, as a panache_clip.
export function writeClip(arena, panache, skeleton, clip) {
  return arena.write(kClip, {
    skeleton: skeleton._handleFor(panache), frameCount: checkClip(clip, skeleton.jointCount),
    frameSeconds: clip.frameSeconds, rotations: arena.copy(clip.rotations),
    translations: arena.copy(clip.translations),
  });
}

export function removerHandle(panache, remover) {
  if (!(remover instanceof Remover)) throw unexpected('remover', 'a Remover', remover);
  return remover._handleFor(panache);
}

// The module's index of the style to remove from `what`, which has this remover; null: none.
export function removedIndex(remover, style, what) {
  if (!remover) throw new PanacheError(`setRemoved: expected a ${what} that was given a remover`);
  return style === null ? -1 : remover._styleIndex(style);
}
