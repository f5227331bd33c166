// Panache for JavaScript. Objects live in WebAssembly memory: call free() on what you made; after
// that all its other methods throw a PanacheError. Objects of one Panache are no use to another.
// Names of styles match without case. Typed arrays that are views are good until the next call into
// the module.

/** The 21 joints of a humanoid, in the order of `parts` and `offsets`; parents before children. */
export const humanJoints: readonly string[];

/** What kind of mistake an error is, for programs that help with it; most are 'other'. */
export type ErrorKind =
  'other' | 'fileExists' | 'rateNeeded' | 'notHumanoid' | 'unknownStyle' | 'noStyles' | 'styleExists' |
  'isModel' | 'isStyleFile' | 'styleOfAnother' | 'notSafetensors' | 'modelCannotLearn' |
  'otherSkeletons' | 'loopOpen' | 'loopStrengths' | 'badStyleName';
/** Bad input; the message says where, what was expected and what was found. */
export class PanacheError extends Error {
  readonly kind: ErrorKind;
  constructor(message: string, kind?: ErrorKind);
}

export interface Style {
  /** "old" */
  name: string;
  /** What it looks like, for people. */
  description: string;
  /** What it is listed under, "moods"; "" for learnt styles, and in models without groups. */
  group: string;
  /** From a pair of clips, see learnStyle(). */
  learnt: boolean;
  /** A row of figures from the styled clip, SVG; "" for styles that were not learnt. */
  thumbnail: string;
  /** What its gestures do and how long, "head turns left, 1.2 s"; most styles have none. */
  gestures: string[];
}

/** A motion of a file. */
export interface Motion {
  file: MotionFile;
  /** 0 where it is left out. */
  clip?: number;
}

/** How a neutral and a styled motion went together. */
export interface LearnReport {
  /** Names of files. */
  neutral: string;
  styled: string;
  /** Of the styled motion. */
  seconds: number;
  /** Neutral seconds per styled second. */
  tempo: number;
  /** Mean distance of the two after time alignment; 0 is equal. */
  match: number;
  /** What may spoil the style, and what helps. */
  warnings: string[];
  /** Mean distance of the joints from the last quarter of the styled motion, when the style was
   * learnt without it: of the style, of its mean posture alone, of the neutral motion. null where
   * the clips are too short for that. */
  heldBackCm: number | null;
  meanPostureCm: number | null;
  untouchedCm: number | null;
  /** By these distances; 'poor' is no better than the neutral motion. null as they are. */
  verdict: 'good' | 'fair' | 'poor' | null;
  /** Without a neutral motion: how many people's mean takes its place, and the share of the
   * difference in posture that counts as style, not as what people differ by; otherwise null. */
  people: number | null;
  certainty: number | null;
  plot: {
    /** Of both, from the first frame to the last. */
    styledSeconds: number;
    neutralSeconds: number;
    /** [styled seconds, neutral seconds, distance] of what goes together, 30 a second. */
    instants: [number, number, number][];
    /** A few of them, with positions of humanJoints [21][3] in metres: Y up, facing +Z. */
    poses: { styledSeconds: number; neutralSeconds: number; styled: number[];
      neutral: number[] }[];
  };
}

/** How much is given of what the styles do, 0 to 2; 1 is the style as the model has it. Posture is
 * the lasting part of the change, dynamics what goes beyond it; the parts of the body are relative
 * to what they are attached to. */
export interface Shape {
  strength: number;
  posture: number;
  dynamics: number;
  timing: number;
  /** With the hips, their height and the root motion. */
  legs: number;
  /** With the head. */
  torso: number;
  leftArm: number;
  rightArm: number;
  /** 0 to 1. */
  footLock: number;
}

/** One joint of a skeleton of yours. */
export interface Joint {
  name: string;
  /** Index of the parent, smaller than the joint's own; -1 for a root. */
  parent: number;
  /** At rest, relative to the parent: x y z w, and a translation in any unit. */
  rotation: ArrayLike<number>;
  translation: ArrayLike<number>;
}

/** Local rotations [joints][4] and translations [joints][3], in the skeleton's own units and axes. */
export interface Pose {
  rotations: Float32Array;
  translations: Float32Array;
}

export interface SkeletonOptions {
  /** 0 (the default): judged by the length of the legs. */
  metresPerUnit?: number;
  /** "+Y", "-Z", ...; null (the default): found. */
  upAxis?: string | null;
  /** The joint map, where names and shape are not enough: index of the joint by the name of the
   * humanoid's ("leftHand", as in VRM), -1 where there is none. */
  humanJoints?: Record<string, number>;
  /** A few poses of ordinary motion; they tell axes and floor better than the rest pose alone. */
  poses?: readonly Pose[];
}

interface StylizingOptions {
  /** A change of strength takes about this long; 0.15. */
  easeSeconds?: number;
  /** Time constant of the filter on what a style adds; 0.04. */
  smoothingSeconds?: number;
  /** Planted feet are held in place; true. */
  holdFeet?: boolean;
  /** The root motion is styled too; true. */
  styleRoot?: boolean;
  /** Hips that are faster, in m/s, have jumped, and the style starts afresh; 15. A body on a vehicle
   * needs more; 0 or Infinity: nothing is a jump. */
  maxSpeed?: number;
  /** Gestures of the active styles at random, per second, 0 to 10; 0. */
  gestureRate?: number;
  /** Characters with different whole numbers make them at different times; 0. */
  gestureSeed?: number;
}
export interface CharacterOptions extends StylizingOptions {
  /** How far the character may be shown behind its input, and ahead of it, seconds; 0. */
  maxLag?: number;
  maxLead?: number;
  /** Leave out or repeat whole cycles to stay within them; false. */
  skipCycles?: boolean;
  /** For setRemoved(); none. */
  remover?: Remover | null;
}
/** Where a motion gets the tempo of its styles: where the feet step, so that talk and gestures keep
 * their length; everywhere; or nowhere, frame by frame. */
export type Timing = 'steps' | 'all' | 'off';
export interface StylizeOptions extends StylizingOptions {
  /** Where the clip gets the tempo of the style; 'steps'. true is 'steps', false 'off'. */
  styleTiming?: Timing | boolean;
  shape?: Partial<Shape>;
  /** Whether the last pose of the result is its first, travel aside: where that is so in the clip
   * ('auto'), always, or an error where the two are too far apart ('on'), or never. */
  loop?: 'auto' | 'on' | 'off';
  /** The style that the clip shows, which is taken off first, also its tempo; 'any' for one without
   * a name. Needs a remover. */
  remove?: string | null;
  remover?: Remover | null;
}

/** What went on at the last step. */
export interface Report {
  /** 1 where the styles know a motion like this one, towards 0 they give their mean posture. */
  gate: number;
  /** Probability that each foot is planted: left, right. */
  contacts: [number, number];
  /** Input seconds per output second that the style asks for. */
  rate: number;
  /** Seconds from the newest input to what is shown; below 0: it is late. */
  ahead: number;
}

export interface Clip extends Pose {
  frameSeconds: number;
}
export interface StyledClip extends Clip {
  frameCount: number;
  /** The frame of the input that each frame shows, with fractions. */
  sourceFrames: Float64Array;
  /** [frames][2]: 1 where the left and the right foot are planted. */
  contacts: Uint8Array;
  gates: Float32Array;
  /** Whether it was styled as a loop. */
  isLoop: boolean;
}

/** How much of a motion shows a style. */
export interface StyleShare {
  /** Of the remover's style, or 'neutral'. */
  name: string;
  /** 0 to 1. */
  share: number;
}

/** A model that takes styles off, and tells which ones a motion shows. */
export class Remover {
  private constructor();
  /** What it takes off; its style 'any' suits motion in a style that it does not know. */
  readonly styles: readonly Style[];
  /** The styles that a clip shows, and neutral, the largest share first; together 1. */
  recognise(skeleton: Skeleton, clip: Clip): StyleShare[];
  /** The same of a clip of a file. */
  recogniseFile(file: MotionFile, clip?: number): StyleShare[];
  /** Characters and players keep what they need of it. */
  free(): void;
}

/** A rig of yours, shared by all its characters. */
export class Skeleton {
  private constructor();
  readonly jointCount: number;
  /** Index of the joint that a human joint was found to be, or -1. */
  find(humanJoint: string): number;
  /** Characters keep what they need of it. */
  free(): void;
}

/** One character of yours in motion. */
export class Character {
  private constructor();
  /** 0 is neutral, 1 the style as captured, more exaggerates it (-4 to 4). Eased in. Throws where
   * the model has no such style, or the strength is not finite. */
  setStrength(style: string, strength: number): void;
  /** Plays a gesture of a style (its place in `gestures`, 0) on top of it, as strongly as the style
   * acts: when no other plays and a foot is on the floor, within 3 s or not at all. Throws where the
   * style has none there. */
  trigger(style: string, gesture?: number): void;
  /** Takes a style of the remover off the input, at the input's tempo, before styles are put on;
   * null: none, as at first. Eased in. Throws where the character was given no remover. */
  setRemoved(style: string | null): void;
  /** What is left out is 1. Eased in. */
  setShape(shape: Partial<Shape>): void;
  /** Styles the next pose; `seconds` have gone by since the last. Both may be the same arrays. */
  step(input: Pose, output: Pose, seconds: number): void;
  report(): Report;
  /** Forgets the motion so far. */
  reset(): void;
  free(): void;
}

export class Panache {
  /** `wasm`: panache.wasm; `model`: a .safetensors of panache-lab train; `walker`: walker.safetensors,
   * for createWalker(). Fails with a PanacheError where a model is none. */
  static create(files: {
    wasm: BufferSource | WebAssembly.Module;
    model: ArrayBuffer | Uint8Array;
    walker?: ArrayBuffer | Uint8Array;
  }): Promise<Panache>;
  readonly styles: readonly Style[];
  /** Another model in place of the present one. Players go on with it, with all strengths at 0;
   * characters keep theirs. `name` stands in front of the message of a failure. */
  setModel(bytes: ArrayBuffer | Uint8Array, name?: string): void;
  readonly modelBytes: ArrayBuffer | Uint8Array;
  /** Learns a style for the present model, which stays as it is: the bytes of a style file, for
   * addStyle(). `neutral` is a motion of the same skeleton; without one, pass the bytes of
   * neutral.safetensors, the mean motion of other people. Takes some tenths of a second. */
  learnStyle(name: string, styled: Motion, neutral: Motion | ArrayBuffer | Uint8Array):
    { bytes: Uint8Array; report: LearnReport };
  /** Whether bytes say that they are a style file, and not a model. */
  isStyle(bytes: ArrayBuffer | Uint8Array): boolean;
  /** As setModel() with the style of a style file in the present model. */
  addStyle(bytes: ArrayBuffer | Uint8Array, options?: {
    /** Of the file, for messages. */
    name?: string;
    /** A style of the same name; false: that fails. */
    replace?: boolean;
  }): void;
  /** The bytes of a style file. */
  extractStyle(name: string): Uint8Array;
  removeStyle(name: string): void;
  /** Reads a .bvh, .glb, .gltf (self-contained), .vrm or .vrma; the extension of `name` decides. */
  openFile(bytes: ArrayBuffer | Uint8Array, name: string, options?: {
    /** Frames a second, where the file's rate is wrong or missing. */
    fps?: number;
  }): MotionFile;
  /** Somebody who walks as she is steered, on a skeleton of humanJoints. */
  createWalker(): Walk;
  /** Finds the humanoid among the joints of a skeleton of yours, or throws. */
  createSkeleton(joints: readonly Joint[], options?: SkeletonOptions): Skeleton;
  createCharacter(skeleton: Skeleton, options?: CharacterOptions): Character;
  /** Of the bytes of remover-int8.safetensors. Throws where the model puts styles on. */
  createRemover(bytes: ArrayBuffer | Uint8Array): Remover;
  /** Styles a whole clip, with the tempo of the style. Strengths by style: a number, or keys
   * [seconds, strength] with straight lines between them. */
  stylizeClip(skeleton: Skeleton, clip: Clip,
    strengths: Record<string, number | readonly [seconds: number, strength: number][]>,
    options?: StylizeOptions): StyledClip;
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
  /** Whether it moves a joint of the humanoid; animations of morph weights or props do not. */
  moves: boolean;
}

export class MotionFile {
  readonly name: string;
  /** ".bvh", lower case. */
  readonly extension: string;
  /** Empty where the file has a skeleton and no motion; clip 0 is then its rest pose. */
  readonly clips: readonly ClipInfo[];
  /** What is odd about the file although it was read, a sentence each. */
  readonly notes: readonly string[];
  /** Parents before children; -1 above a root. */
  readonly joints: readonly { name: string; parent: number }[];
  /** Fails where the skeleton is no humanoid. The file may be freed first. */
  createPlayer(clip?: number): Playback;
  /** The bytes of the character's file with this motion put on it, in place of its own. */
  putOn(character: MotionFile, clip?: number): Uint8Array;
  free(): void;
}

/** A skinned mesh of a person, moved by `parts`. */
export interface Body {
  /** [21][3], [21][4]: the pose that the vertices stand in. */
  bindPositions: Float32Array;
  bindRotations: Float32Array;
  /** [vertices][3], metres. */
  positions: Float32Array;
  normals: Float32Array;
  /** [vertices][4]: human joints, and their weights, which add up to 255. */
  joints: Uint8Array;
  weights: Uint8Array;
  /** [vertices]: 255 where the body has its second colour. */
  accents: Uint8Array;
  /** Three vertices each. */
  triangles: Uint16Array;
}

/** A source of motion and the character that it moves. */
declare class Player {
  /** As those of a Character. */
  setStrength(style: string, strength: number): void;
  setShape(shape: Partial<Shape>): void;
  trigger(style: string, gesture?: number): void;
  /** A model for setRemoved(); the motion goes on. */
  useRemover(remover: Remover): void;
  /** Takes a style of the remover off the input, also its tempo, before styles are put on; null:
   * none, as at first. Eased in. Throws before useRemover(). */
  setRemoved(style: string | null): void;
  /** 'steps' at first; the motion goes on. */
  setTiming(timing: Timing): void;
  /** Goes on by so many seconds, at most a tenth at once. */
  step(seconds: number): void;
  /** Steps a copy so often with the present pose, to see how long that takes. */
  measure(count: number): void;
  /** Input seconds per output second: the tempo of the style, 1 where the timing is off. */
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
  /** A body to the measure of the rig; takes some tenths of a second the first time. */
  readonly body: Body;
  /** The same of a third of the triangles, for where no graphics card draws them. */
  readonly coarseBody: Body;
  /** world = scale * rotate(toYUp, point of the file) - {0, floor, 0}. */
  readonly placement: { toYUp: number[]; scale: number; floor: number };
  /** A file with this extension (".bvh", ".glb", ".vrma", or that of the file played): the whole
   * clip as styled now, or the last seconds of a walk, twenty at most. */
  exportAs(extension: string, options?: { which?: 'input' | 'styled'; seconds?: number }):
    Uint8Array;
  free(): void;
}

export class Walk extends Player {
  /** m/s, 0 to 4.5, and rad/s, to the left. Eased. */
  steer(speed: number, turn: number): void;
}

export class Playback extends Player {
  /** To so many seconds after the first frame; shown by the next step. */
  seek(seconds: number): void;
  /** The strength of a style over time instead of a constant one: keys with straight lines between
   * them, seconds after the first frame, rising. None: constant again. */
  setTrack(style: string, keys: readonly (readonly [seconds: number, strength: number])[]): void;
  set loop(loop: boolean);
  readonly seconds: number;
  /** The frame of the file that plays first, from 0; those before it are a calibration pose. */
  readonly firstFrame: number;
}
