// Panache for JavaScript. Objects live in WebAssembly memory: call free() on what you create; after
// that all its other methods throw a PanacheError. Objects of one Panache do not work with another.
// Style names are case-insensitive. Typed arrays that are views are valid until the next call into
// the module.

/** The 21 joints of a humanoid, in the order of `parts` and `offsets`; parents before children. */
export const humanJoints: readonly string[];

/** The kind of an error, for programs that handle it; most are 'other'. */
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
  /** What the style looks like, for people. */
  description: string;
  /** The group of the style, "moods"; "" for learnt styles, and in models without groups. */
  group: string;
  /** Other words for it in lower case, as people search for it: "elderly"; may be empty. */
  words: readonly string[];
  /** Whether learnStyle() made it. */
  learnt: boolean;
  /** A row of poses from the styled clip, SVG; "" for styles that were not learnt. */
  thumbnail: string;
  /** The side that was captured, as one sees it: "right leg", "to the left". It has the word left or
   * right in it once; with the other one it tells what is seen of the mirrored style. "" if the model
   * does not say, null if its styles have no sides. */
  side: string | null;
  /** What its gestures do and how long they take, "glances left, 1.2 s"; often empty. */
  gestures: string[];
}

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

/** The side of a style, such as the leg of a limp: 1 or 'captured', -1 or 'mirrored', between them
 * the mean of both; 'left' and 'right' if the style's `side` tells which was captured. */
export type Side = number | 'captured' | 'mirrored' | 'left' | 'right';

/** A person by a seed: each whole number and each word is another one; null is nobody. */
export type Person = number | string | null;

/** Scales the parts of what the styles do, 0 to 2; 1 is the style as the model has it. Posture is
 * the constant part of the change, dynamics the rest. Parts of the body are relative to what they
 * are attached to. */
export interface Shape {
  strength: number;
  posture: number;
  dynamics: number;
  timing: number;
  /** Includes the hips, their height and the root motion. */
  legs: number;
  /** Includes the head. */
  torso: number;
  leftArm: number;
  rightArm: number;
  /** 0 to 1. */
  footLock: number;
  /** How firmly hands keep what they touch, 0 to 1. */
  handContacts: number;
  /** From calm to lively: how much of the input's own movement of torso, head and arms is kept, with
   * or without a style. */
  energy: number;
}

/** One joint of your skeleton. */
export interface Joint {
  name: string;
  /** Index of the parent, smaller than the joint's own; -1 for a root. */
  parent: number;
  /** Rest transform relative to the parent: rotation x y z w, and translation in any unit. */
  rotation: ArrayLike<number>;
  translation: ArrayLike<number>;
}

/** Local rotations [joints][4] and translations [joints][3], in the skeleton's units and axes. */
export interface Pose {
  rotations: Float32Array;
  translations: Float32Array;
}

export interface SkeletonOptions {
  /** 0 (the default): detected from the length of the legs. */
  metresPerUnit?: number;
  /** "+Y", "-Z", ...; null (the default): detected. */
  upAxis?: string | null;
  /** The joint map, if names and shape are not enough: the index of the joint for each human joint
   * ("leftHand", as in VRM), -1 if there is none. */
  humanJoints?: Record<string, number>;
  /** A few poses of ordinary motion, to detect axes and floor more reliably than from the rest pose
   * alone. */
  poses?: readonly Pose[];
}

interface StylizingOptions {
  /** A change of strength takes about this long. Default: 0.15. */
  easeSeconds?: number;
  /** Time constant of the filter on the change. Default: 0.04. */
  smoothingSeconds?: number;
  /** Hold planted feet in place. Default: true. */
  holdFeet?: boolean;
  /** Style the root motion too. Default: true. */
  styleRoot?: boolean;
  /** m/s. Faster hips count as a jump, which resets the style. Bodies on vehicles need more; 0 or
   * Infinity turns this off. Default: 15. */
  maxSpeed?: number;
  /** How often the active styles play their gestures, at random: 1 as often as the performers did,
   * 0 not at all, up to 10 times as often. A clip that is styled as a loop has none. Default: 1. */
  gestureRate?: number;
  /** An integer; characters with different seeds gesture at different times. Default: 0. */
  gestureSeed?: number;
}
export interface CharacterOptions extends StylizingOptions {
  /** How far the output may lag or lead the input, seconds. Default: 0. */
  maxLag?: number;
  maxLead?: number;
  /** Skip or repeat whole cycles to stay within these limits. Default: false. */
  skipCycles?: boolean;
  /** For setRemoved(). Default: null. */
  remover?: Remover | null;
}
/** Where a motion takes the tempo of its styles: only where the feet step, so talk and gestures
 * keep their length; everywhere; or nowhere. */
export type Timing = 'steps' | 'all' | 'off';
export interface StylizeOptions extends StylizingOptions {
  /** Where the clip takes the tempo of the style. true is 'steps', the default; false is 'off'. */
  styleTiming?: Timing | boolean;
  shape?: Partial<Shape>;
  /** Sides of styles that are not put on as captured, by style. */
  sides?: Record<string, Side>;
  /** See Character.setPerson(); default: null and 1. */
  person?: Person;
  variety?: number;
  /** Whether the last pose of the result equals its first, except for travel: if it does in the
   * clip ('auto'), always, or an error if the two are too far apart ('on'), or never ('off'). */
  loop?: 'auto' | 'on' | 'off';
  /** The style of the clip, to remove first, including its tempo; 'any' for an unknown style. Needs
   * a remover. */
  remove?: string | null;
  remover?: Remover | null;
}

/** Measurements of the last step. */
export interface Report {
  /** 1 if the input resembles the training motion; towards 0 styles only add their mean posture. */
  gate: number;
  /** Probability that each foot is planted: left, right. */
  contacts: [number, number];
  /** Input seconds per output second that the style asks for. */
  rate: number;
  /** Seconds by which the output leads the newest input; below 0: it lags. */
  ahead: number;
}

export interface Clip extends Pose {
  frameSeconds: number;
}
export interface StyledClip extends Clip {
  frameCount: number;
  /** The (fractional) input frame that each output frame shows. */
  sourceFrames: Float64Array;
  /** [frames][2]: 1 where the left and the right foot are planted. */
  contacts: Uint8Array;
  gates: Float32Array;
  /** Whether it was styled as a loop. */
  isLoop: boolean;
}

/** The share of a style in a motion. */
export interface StyleShare {
  /** Name of one of the remover's styles, or 'neutral'. */
  name: string;
  /** 0 to 1. */
  share: number;
}

/** A model that removes styles and recognises which ones a motion shows. */
export class Remover {
  private constructor();
  /** The styles that it removes; 'any' is for motion in a style that it does not know. */
  readonly styles: readonly Style[];
  /** The shares of all styles and neutral in a clip, largest first; they add up to 1. */
  recognise(skeleton: Skeleton, clip: Clip): StyleShare[];
  /** The same for a clip of a file. */
  recogniseFile(file: MotionFile, clip?: number): StyleShare[];
  /** Characters and players that use it keep working. */
  free(): void;
}

/** Your rig, shared by all its characters. */
export class Skeleton {
  private constructor();
  readonly jointCount: number;
  /** Index of the joint mapped to a human joint, or -1. */
  find(humanJoint: string): number;
  /** Characters that use it keep working. */
  free(): void;
}

/** Prepares tracked poses for a character: step(filtered, ...). */
export class PoseFilter {
  /** `joints`: those of the skeleton, whose rest pose is symmetric about x = 0. `mirror` exchanges
   * left and right, as a mirror does; joints that are not human, such as fingers, go by "left" and
   * "right" in their names. `smooth`: cuts jitter, delaying any movement by at most this long;
   * seconds, 0 to 1. */
  constructor(skeleton: Skeleton, joints: readonly Joint[],
    options?: { mirror?: boolean; smooth?: number });
  /** Changes a pose in place, `seconds` after the last one. */
  apply(pose: Pose, seconds: number): void;
  /** The next pose is not smoothed with those before. */
  reset(): void;
}

/** One of your characters in motion. */
export class Character {
  private constructor();
  /** 0 is neutral, 1 the style as captured, above 1 exaggerates it (-4 to 4). Eased in. Throws if
   * the model has no such style, or the strength is not finite. */
  setStrength(style: string, strength: number): void;
  /** Initially 'captured'. Eased in. Throws if the model has no such style or the style no such side. */
  setSide(style: string, side: Side): void;
  /** Moves as somebody else does, in addition to the styles; initially null, nobody. `variety`: how
   * far from the mean person, 0 to 2; 1, the default, is as people differ. Eased in. Throws if the
   * model has no persons. */
  setPerson(person: Person, variety?: number): void;
  /** Plays a gesture of a style (its index in `gestures`; 0) at the style's strength. Waits up to
   * 3 s until no other gesture plays and a foot is on the floor; otherwise drops it. Throws if the
   * style has no such gesture. */
  trigger(style: string, gesture?: number): void;
  /** Removes a style of the remover from the input before styles are added. Keeps the input's
   * tempo. null: none, the default. Eased in. Throws if the character has no remover. */
  setRemoved(style: string | null): void;
  /** Missing amounts are 1. Eased in. */
  setShape(shape: Partial<Shape>): void;
  /** Styles the next pose, `seconds` after the last. Input and output may be the same arrays. */
  step(input: Pose, output: Pose, seconds: number): void;
  report(): Report;
  /** Forgets the motion so far. */
  reset(): void;
  free(): void;
}

export class Panache {
  /** `wasm`: panache.wasm; `model`: a .safetensors of panache-lab train; `walker`:
   * walker.safetensors, for createWalker(). Rejects with a PanacheError if a model is invalid.
   * Without a model only the walker walks, neutral, until setModel(). */
  static create(files: {
    wasm: BufferSource | WebAssembly.Module;
    model?: ArrayBuffer | Uint8Array;
    walker?: ArrayBuffer | Uint8Array;
  }): Promise<Panache>;
  readonly styles: readonly Style[];
  /** What the numbers of a person change most, "arm swing"; empty if the model has no persons. */
  readonly personAxes: readonly string[];
  /** Replaces the model. Players switch to it, all strengths 0 and sides as captured; characters keep
   * theirs.
   * Error messages begin with `name`. */
  setModel(bytes: ArrayBuffer | Uint8Array, name?: string): void;
  readonly modelBytes: ArrayBuffer | Uint8Array;
  /** Learns a style for the current model without changing it. Returns the bytes of a style file,
   * for addStyle(). `neutral` is a motion of the same skeleton, or else the bytes of
   * neutral.safetensors, the mean motion of other people. Takes some tenths of a second. */
  learnStyle(name: string, styled: Motion, neutral: Motion | ArrayBuffer | Uint8Array):
    { bytes: Uint8Array; report: LearnReport };
  /** Whether the bytes are a style file, and not a model. */
  isStyle(bytes: ArrayBuffer | Uint8Array): boolean;
  /** Adds the style of a style file to the current model, as in setModel(). */
  addStyle(bytes: ArrayBuffer | Uint8Array, options?: {
    /** File name, for messages. */
    name?: string;
    /** Whether to replace a style of the same name; false: fail instead. */
    replace?: boolean;
  }): void;
  /** The bytes of a style file. */
  extractStyle(name: string): Uint8Array;
  removeStyle(name: string): void;
  /** Reads a .bvh, .glb, .gltf (self-contained), .vrm or .vrma, by the extension of `name`. */
  openFile(bytes: ArrayBuffer | Uint8Array, name: string, options?: {
    /** Frames per second, if the file's rate is wrong or missing. */
    fps?: number;
  }): MotionFile;
  /** A walker to steer, with a skeleton of humanJoints. */
  createWalker(): Walk;
  /** Recognises the humanoid in your skeleton, or throws. */
  createSkeleton(joints: readonly Joint[], options?: SkeletonOptions): Skeleton;
  createCharacter(skeleton: Skeleton, options?: CharacterOptions): Character;
  /** Takes the bytes of remover-int8.safetensors. Throws if the model adds styles. */
  createRemover(bytes: ArrayBuffer | Uint8Array): Remover;
  /** Styles a whole clip, with the tempo of the style. Strengths by style: a number, or keyframes
   * [seconds, strength], interpolated linearly. */
  stylizeClip(skeleton: Skeleton, clip: Clip,
    strengths: Record<string, number | readonly [seconds: number, strength: number][]>,
    options?: StylizeOptions): StyledClip;
  /** The hash of 300 styled frames, 16 hexadecimal digits; the same on all machines. */
  goldenHash(): string;
  /** Call it after freeing everything that was made with it. */
  free(): void;
}

export interface ClipInfo {
  name: string;
  frames: number;
  /** Seconds. */
  frameTime: number;
  /** From the first frame to the last. */
  seconds: number;
  /** Whether it moves a humanoid joint; animations of morph weights or props do not. */
  moves: boolean;
}

export class MotionFile {
  readonly name: string;
  /** ".bvh", lower case. */
  readonly extension: string;
  /** Empty if the file has a skeleton but no motion; clip 0 is then its rest pose. */
  readonly clips: readonly ClipInfo[];
  /** Oddities of the file that did not prevent reading it. */
  readonly notes: readonly string[];
  /** Parents before children; the parent of a root is -1. */
  readonly joints: readonly { name: string; parent: number }[];
  /** Throws if the skeleton is not a humanoid. The file may be freed before the player. */
  createPlayer(clip?: number): Playback;
  /** The bytes of the character's file, with its motions replaced by this one, retargeted. */
  putOn(character: MotionFile, clip?: number): Uint8Array;
  free(): void;
}

/** A skinned mesh of a person, moved by `parts`. */
export interface Body {
  /** [21][3], [21][4]: the bind pose of the vertices. */
  bindPositions: Float32Array;
  bindRotations: Float32Array;
  /** [vertices][3], metres. */
  positions: Float32Array;
  normals: Float32Array;
  /** [vertices][4]: human joints, and their weights, which sum to 255. */
  joints: Uint8Array;
  weights: Uint8Array;
  /** [vertices]: 255 where the body has its second colour. */
  accents: Uint8Array;
  /** [triangles][3]: vertex indices. */
  triangles: Uint16Array;
}

/** A source of motion and the character that it moves. */
declare class Player {
  /** Like the methods of Character. */
  setStrength(style: string, strength: number): void;
  setSide(style: string, side: Side): void;
  /** Nobody in a model without persons. */
  setPerson(person: Person, variety?: number): void;
  setShape(shape: Partial<Shape>): void;
  /** See StylizingOptions.gestureRate; 1 at first. */
  setGestureRate(rate: number): void;
  trigger(style: string, gesture?: number): void;
  /** Sets the model for setRemoved(); the motion continues. */
  useRemover(remover: Remover): void;
  /** Removes a style of the remover from the input, including its tempo, before styles are added;
   * null: none, the default. Eased in. Throws before useRemover(). */
  setRemoved(style: string | null): void;
  /** Initially 'steps'; the motion continues. */
  setTiming(timing: Timing): void;
  /** Advances by `seconds`, at most a tenth per call. */
  step(seconds: number): void;
  /** Steps a copy `count` times with the current pose, to measure the speed. */
  measure(count: number): void;
  /** Input seconds per output second: the tempo of the style, 1 where the timing is off. */
  readonly rate: number;
  /** How much of the styles' change is applied: 1 if the input resembles the training motion; 0 if
   * it does not, so that styles only add their mean posture. */
  readonly gate: number;
  /** Probability that each foot is planted: left, right. */
  readonly contacts: number[];
  /** View, [joints][7]: local rotation x y z w and translation, in the file's units and axes. */
  pose(which: 'input' | 'styled', joints: number): Float32Array;
  /** View, [21][7]: world position (metres, Y up) and orientation x y z w of each human joint. The
   * orientation is relative to the T-pose: left arm along +x, legs along -y, feet along +z. */
  parts(which: 'input' | 'styled'): Float32Array;
  /** A body with the rig's proportions; takes some tenths of a second the first time. */
  readonly body: Body;
  /** The same with a third of the triangles, for machines without a graphics card. */
  readonly coarseBody: Body;
  /** world = scale * rotate(toYUp, point in the file) - {0, floor, 0}. */
  readonly placement: { toYUp: number[]; scale: number; floor: number };
  /** A file with this extension (".bvh", ".glb", ".vrma", or that of the file played): the whole
   * clip with the current settings, or the last seconds of a walk, at most 20. */
  exportAs(extension: string, options?: { which?: 'input' | 'styled'; seconds?: number }):
    Uint8Array;
  free(): void;
}

export class Walk extends Player {
  /** `speed`: m/s, 0 to 4.5; `turn`: rad/s, positive to the left. Eased. */
  steer(speed: number, turn: number): void;
}

export class Playback extends Player {
  /** Jumps to `seconds` after the first frame; takes effect at the next step. */
  seek(seconds: number): void;
  /** Sets the strength of a style over time instead of a constant one: keyframes, interpolated
   * linearly, with ascending seconds after the first frame. Empty: constant again. */
  setTrack(style: string, keys: readonly (readonly [seconds: number, strength: number])[]): void;
  set loop(loop: boolean);
  readonly seconds: number;
  /** The first frame that plays, from 0; earlier frames of the file are a reference pose. */
  readonly firstFrame: number;
}
