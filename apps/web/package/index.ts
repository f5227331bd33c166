// Panache for JavaScript: a thin wrapper around the WebAssembly module.

import { Character, Skeleton } from './character.js';
import type { CharacterOptions, Clip, Joint, SkeletonOptions } from './character.js';
import { PanacheError, checkBytes, inUse, named } from './checks.js';
import { stylizeClip, type StyledClip, type StylizeOptions } from './clip.js';
import { Module, type Arena, type Exports } from './memory.js';
import { MotionFile, Walk, type Player } from './player.js';
import { Remover } from './remover.js';
import { createModel, stylesOf, type Style } from './styling.js';

export type { CharacterOptions, Clip, Joint, Pose, Report, SkeletonOptions } from './character.js';
export type { ErrorKind } from './checks.js';
export { PoseFilter } from './filter.js';
export { Playback, type Body, type ClipInfo } from './player.js';
export type { StyleShare } from './remover.js';
export type { Person, Shape, Side, Style, StylizingOptions, Timing } from './styling.js';
export { Character, MotionFile, PanacheError, Remover, Skeleton, Walk };
export type { Player, StyledClip, StylizeOptions };

/** The 21 joints of a humanoid, in the order of `parts` and `offsets`; parents before children. */
export const humanJoints: readonly string[] = [
  'hips', 'spine', 'chest', 'neck', 'head',
  'leftShoulder', 'leftUpperArm', 'leftLowerArm', 'leftHand',
  'rightShoulder', 'rightUpperArm', 'rightLowerArm', 'rightHand',
  'leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes',
  'rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes',
];

/** A motion of a file. */
export interface Motion {
  file: MotionFile;
  /** Default: 0. */
  clip?: number;
}

/** How well a neutral and a styled motion matched. */
export interface LearnReport {
  /** File names. */
  neutral: string;
  styled: string;
  /** Duration of the styled motion. */
  seconds: number;
  /** Neutral seconds per styled second. */
  tempo: number;
  /** Mean distance between the two after time alignment; 0 is equal. */
  match: number;
  /** Problems that may spoil the style, and how to fix them. */
  warnings: string[];
  /** Mean joint errors on the last quarter of the styled motion, held out from learning: of the
   * style, of its mean posture alone, of the neutral motion. null if the clips are too short. */
  heldBackCm: number | null;
  meanPostureCm: number | null;
  untouchedCm: number | null;
  /** Based on these errors; 'poor' is no better than the neutral motion. null if they are. */
  verdict: 'good' | 'fair' | 'poor' | null;
  /** Without a neutral motion: the number of people whose mean replaces it, and the share of the
   * posture difference that counts as style rather than personal variation; otherwise null. */
  people: number | null;
  certainty: number | null;
  plot: {
    /** Durations of both motions, from the first frame to the last. */
    styledSeconds: number;
    neutralSeconds: number;
    /** The time alignment: [styled seconds, neutral seconds, distance], 30 per second. */
    instants: [number, number, number][];
    /** A few aligned poses: positions of humanJoints [21][3] in metres, Y up, facing +Z. */
    poses: { styledSeconds: number; neutralSeconds: number; styled: number[];
      neutral: number[] }[];
  };
}

// The module imports a file system but never uses it: imports that are not provided fail.
function importsOf(module: WebAssembly.Module) {
  const imports: WebAssembly.Imports = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    (imports[space] ??= {})[name] = name !== 'proc_exit' ? () => -52 : () => {
      throw new PanacheError('the WebAssembly module stopped; reload the page');
    };
  }
  return imports;
}

/** Objects live in WebAssembly memory: call free() on what you create; after that all its other
 * methods throw a PanacheError. Objects of one Panache do not work with another. Style names are
 * case-insensitive. Typed arrays that are views are valid until the next call into the module. */
export class Panache {
  readonly styles: readonly Style[] = [];
  /** What the numbers of a person change most, "arm swing"; empty if the model has no persons. */
  readonly personAxes: readonly string[] = [];
  #module: Module;
  #players = new Set<Player>();
  #model = 0;     // 0 until there is one.
  #live = true;   // Until free().
  #bytes!: ArrayBuffer | Uint8Array;  // The model file.
  #walker = 0;

  /** `wasm`: panache.wasm; `model`: a .safetensors of panache-lab train; `walker`:
   * walker.safetensors, for createWalker(). Rejects with a PanacheError if a model is invalid.
   * Without a model only the walker walks, neutral, until setModel(). */
  static async create(files: {
    wasm: BufferSource | WebAssembly.Module;
    model?: ArrayBuffer | Uint8Array;
    walker?: ArrayBuffer | Uint8Array;
  }): Promise<Panache> {
    const { wasm, model, walker } = files;
    const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
    const instance = await WebAssembly.instantiate(module, importsOf(module));
    const exports = instance.exports as unknown as Exports;
    exports._initialize();
    return new Panache(exports, model, walker);
  }
  /** @internal */
  constructor(wasm: Exports, model?: ArrayBuffer | Uint8Array, walker?: ArrayBuffer | Uint8Array) {
    this.#module = new Module(wasm);
    if (model) this.setModel(model);
    if (walker) {
      checkBytes(walker, 'the walker');
      this.#walker = this.#module.use((arena) => this.#module.checked(
        wasm.panache_page_walker_create(arena.copy(walker), walker.byteLength)));
    }
  }
  /** @internal */ get _module() { return this.#module; }
  /** @internal */ get _players() { return this.#players; }
  get #wasm() { return this.#module.wasm; }

  /** Replaces the model. Players switch to it, all strengths 0 and sides as captured; characters keep
   * theirs. Error messages begin with `name`. */
  setModel(bytes: ArrayBuffer | Uint8Array, name = 'the model'): void {
    inUse(this.#live, 'Panache');
    const wasm = this.#wasm, module = this.#module, model = createModel(module, bytes, name);
    // Players keep what they need of their old model.
    const old = this.#model;
    this.#model = model;
    this.#bytes = bytes;
    Object.assign(this, {  // Read-only to callers.
      styles: stylesOf(module, model),
      personAxes: Array.from({ length: wasm.panache_model_person_axis_count(model) },
        (_, axis) => module.text(wasm.panache_model_person_axis_name(model, axis))),
    } satisfies Partial<Panache>);
    for (const player of this.#players) player._useModel();
    wasm.panache_model_destroy(old);
  }
  get modelBytes(): ArrayBuffer | Uint8Array { return this.#bytes; }

  /** Learns a style for the current model without changing it. Returns the bytes of a style file,
   * for addStyle(). `neutral` is a motion of the same skeleton, or else the bytes of
   * neutral.safetensors, the mean motion of other people. Takes some tenths of a second. */
  learnStyle(name: string, styled: Motion, neutral: Motion | ArrayBuffer | Uint8Array):
    { bytes: Uint8Array; report: LearnReport } {
    this._model();
    const module = this.#module;
    const [bank, before] = ArrayBuffer.isView(neutral) || neutral instanceof ArrayBuffer
      ? [neutral, null] : [null, neutral];
    return module.use((arena) => {
      const out = arena.zeros(4);
      const bytes = module.take(this.#wasm.panache_page_learn(
        arena.copy(this.#bytes), this.#bytes.byteLength,
        before?.file._handleFor(this) ?? 0, before?.clip ?? 0,
        bank ? arena.copy(bank) : 0, bank?.byteLength ?? 0, styled.file._handleFor(this),
        styled.clip ?? 0, arena.text(name), out));
      return { bytes, report: module.json<LearnReport>(module.words(out, 1)[0]) };
    });
  }
  /** Whether the bytes are a style file, and not a model. */
  isStyle(bytes: ArrayBuffer | Uint8Array): boolean {
    checkBytes(bytes, 'the style');
    try {
      this.#wasm.panache_model_destroy(createModel(this.#module, bytes, ''));
      return false;
    } catch (error) {
      if (!(error instanceof PanacheError)) throw error;
      return error.kind === 'isStyleFile';
    }
  }
  /** Adds the style of a style file to the current model, as in setModel(). */
  addStyle(bytes: ArrayBuffer | Uint8Array, options: {
    /** File name, for messages. */
    name?: string;
    /** Whether to replace a style of the same name; false: fail instead. */
    replace?: boolean;
  } = {}): void {
    const { name = 'the style', replace = false } = options;
    checkBytes(bytes, name);
    this.setModel(named('the style', name, () => this.#changed((model, size, arena, out) =>
      this.#wasm.panache_styles_add(
        model, size, arena.copy(bytes), bytes.byteLength, replace ? 1 : 0, out))));
  }
  /** The bytes of a style file. */
  extractStyle(name: string): Uint8Array {
    return this.#changed((model, size, arena, out) =>
      this.#wasm.panache_styles_extract(model, size, arena.text(name), out));
  }
  removeStyle(name: string): void {
    this.setModel(this.#changed((model, size, arena, out) =>
      this.#wasm.panache_styles_remove(model, size, arena.text(name), out)));
  }
  // The bytes that a call makes of those of the model.
  #changed(call: (model: number, size: number, arena: Arena, out: number) => number) {
    this._model();
    return this.#module.use((arena) => this.#module.take(arena.create((out) =>
      call(arena.copy(this.#bytes), this.#bytes.byteLength, arena, out))));
  }

  /** Reads a .bvh, .glb, .gltf (self-contained), .vrm or .vrma, by the extension of `name`. */
  openFile(bytes: ArrayBuffer | Uint8Array, name: string, options: {
    /** Frames per second, if the file's rate is wrong or missing. */
    fps?: number;
  } = {}): MotionFile {
    return new MotionFile(this, bytes, name, options.fps ?? 0);
  }
  /** A walker to steer, with a skeleton of humanJoints. */
  createWalker(): Walk {
    inUse(this.#live, 'Panache');
    if (!this.#walker) throw new PanacheError('no walker was given to Panache.create');
    const player = this.#wasm.panache_page_player_walk(this.#model, this.#walker);
    return new Walk(this, this.#module.checked(player), '');
  }
  /** Recognises the humanoid in your skeleton, or throws. */
  createSkeleton(joints: readonly Joint[], options: SkeletonOptions = {}): Skeleton {
    inUse(this.#live, 'Panache');
    return Skeleton._create(this, joints, options);
  }
  createCharacter(skeleton: Skeleton, options: CharacterOptions = {}): Character {
    return Character._create(this, skeleton, options);
  }
  /** Takes the bytes of remover-int8.safetensors. Throws if the model adds styles. */
  createRemover(bytes: ArrayBuffer | Uint8Array): Remover { return Remover._create(this, bytes); }
  /** Styles a whole clip, with the tempo of the style. Strengths by style: a number, or keyframes
   * [seconds, strength], interpolated linearly. */
  stylizeClip(skeleton: Skeleton, clip: Clip,
    strengths: Record<string, number | readonly [seconds: number, strength: number][]>,
    options: StylizeOptions = {}): StyledClip {
    return stylizeClip(this, skeleton, clip, strengths, options);
  }

  /** The hash of 300 styled frames, 16 hexadecimal digits; the same on all machines. */
  goldenHash(): string {
    const [low, high] = this.#module.words(this.#wasm.panache_page_golden(this._model()), 2);
    return high.toString(16).padStart(8, '0') + low.toString(16).padStart(8, '0');
  }

  /** Call it after freeing everything that was made with it. */
  free(): void {
    this.#wasm.panache_model_destroy(this.#model);
    this.#wasm.panache_page_walker_free(this.#walker);
    this.#model = this.#walker = 0;
    this.#live = false;
  }

  /** @internal */ _model(): number {
    inUse(this.#live, 'Panache');
    if (this.#model) return this.#model;
    throw new PanacheError('expected a model: give one to Panache.create, or call setModel()');
  }
}
