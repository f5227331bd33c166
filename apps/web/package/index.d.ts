// Panache for JavaScript. Objects live in WebAssembly memory: call free() on what you made. Typed
// arrays that are views are good until the next call into the module.

/** The 21 joints of a humanoid, in the order of `parts` and `offsets`; parents before children. */
export const humanJoints: readonly string[];

/** Bad input; the message says where, what was expected and what was found. */
export class PanacheError extends Error {}

export interface Style {
  /** "old" */
  name: string;
  /** What it looks like, for people. */
  description: string;
}

/** How much of a style is given, 0 to 2; 1 is as trained. Posture is the lasting part of the
 * change, dynamics what goes beyond it; the parts of the body are relative to what they hang on. */
export interface Shape {
  posture: number;
  dynamics: number;
  timing: number;
  legs: number;
  spine: number;
  arms: number;
  head: number;
  /** 0 to 1. */
  footLock: number;
}

export class Panache {
  /** `wasm`: panache.wasm; `model`: a .safetensors of panache train; `walker`: walker.safetensors,
   * for createWalker(). Fails with a PanacheError where a model is none. */
  static create(files: {
    wasm: BufferSource | WebAssembly.Module;
    model: ArrayBuffer | Uint8Array;
    walker?: ArrayBuffer | Uint8Array;
  }): Promise<Panache>;
  readonly styles: readonly Style[];
  /** Reads a .bvh, .glb, .gltf (self-contained) or .vrm; the extension of `name` decides. */
  openFile(bytes: ArrayBuffer | Uint8Array, name: string): MotionFile;
  /** Somebody who walks as she is steered, on a skeleton of humanJoints. */
  createWalker(): Walk;
  /** The hash of 300 styled frames, 16 hexadecimal digits: the same on every machine. */
  goldenHash(): string;
  /** After everything that was made with it. */
  free(): void;
}

export interface ClipInfo {
  name: string;
  frames: number;
  /** Seconds. */
  frameTime: number;
  /** From the first frame to the last. */
  seconds: number;
}

export class MotionFile {
  readonly name: string;
  /** ".bvh", lower case. */
  readonly ending: string;
  /** Empty where the file has a skeleton and no motion; clip 0 is then its rest pose. */
  readonly clips: readonly ClipInfo[];
  /** Parents before children; -1 above a root. */
  readonly joints: readonly { name: string; parent: number }[];
  /** Fails where the skeleton is no humanoid. The file may be freed first. */
  createActor(clip?: number): Playback;
  free(): void;
}

/** A source of motion and the character that it moves. */
declare class Actor {
  /** 0 is neutral, 1 the style as captured, more exaggerates it (-4 to 4). Eased in. */
  setStrength(style: string, strength: number): void;
  /** What is left out is 1. Eased in. */
  setShape(shape: Partial<Shape>): void;
  /** Goes on by so many seconds, at most a tenth at once. */
  step(seconds: number): void;
  /** Steps a copy so often with the present pose, to see how long that takes. */
  measure(count: number): void;
  /** Input seconds per output second that the style asks for. */
  readonly rate: number;
  /** How much of the styles' answer to this very motion is given: 1 where they know a motion like
   * it, 0 where they do not and give no more than their mean posture. */
  readonly gate: number;
  /** Probability that each foot is planted: left, right. */
  readonly contacts: number[];
  /** View, [joints][7]: local rotation x y z w and translation, the file's own units and axes. */
  pose(which: 'input' | 'styled', joints: number): Float32Array;
  /** View, [21][7]: world position (metres, Y up) and orientation x y z w of each human joint. In
   * its own frame a part lies as in the T-pose: left arm along +x, legs along -y, feet along +z. */
  parts(which: 'input' | 'styled'): Float32Array;
  /** [21][3]: where each joint is in its parent's frame, metres; zero where the rig has none. */
  readonly offsets: Float32Array;
  /** world = scale * rotate(toYUp, point of the file) - {0, floor, 0}. */
  readonly placement: { toYUp: number[]; scale: number; floor: number };
  /** A file with this extension (".bvh", ".glb", or that of the file played): the whole clip as styled
   * now, or the last twenty seconds of a walk. */
  exportAs(ending: string): Uint8Array;
  free(): void;
}

export class Walk extends Actor {
  /** m/s, 0 to 4.5, and rad/s, to the left. Eased. */
  steer(speed: number, turn: number): void;
}

export class Playback extends Actor {
  /** To so many seconds after the first frame; shown by the next step. */
  seek(seconds: number): void;
  set loop(loop: boolean);
  readonly seconds: number;
}
