// Styles characters of three.js: panache/three.
import type { AnimationMixer, Object3D } from 'three';
import type {
  Character, CharacterOptions, Panache, Pose, Side, SkeletonOptions,
} from './index.js';

export interface StyledBonesOptions extends CharacterOptions,
    Pick<SkeletonOptions, 'metresPerUnit' | 'upAxis'> {
  /** The name of the bone for each human joint ("leftHand", as in VRM), if names and shape are not
   * enough; null if there is none. */
  humanBones?: Record<string, string | null>;
}

/** Styles bones in place, however they were posed. Takes the bones below `root` with all nodes in
 * between; scales are read once and have to be uniform. */
export class StyledBones {
  /** The bones have to be in their rest pose or an upright pose. Throws a PanacheError if they are
   * not a humanoid. */
  constructor(panache: Panache, root: Object3D, options?: StyledBonesOptions);
  /** Use it for strengths, the shape of the style, reports and resets. */
  readonly character: Character;
  /** The output of the last step, parents before children, with scales multiplied in. */
  readonly pose: Pose;
  /** Styles the current pose of the bones, `seconds` after the last step. Pose all bones again, or
   * call restore(), before the next step. */
  step(seconds: number): void;
  /** Restores the pose from before the last step. */
  restore(): void;
  /** The bones stay as they are. */
  free(): void;
}

/** Styles the character that an AnimationMixer moves. Call update() instead of the mixer's. */
export class StyledMixer {
  constructor(panache: Panache, mixer: AnimationMixer, options?: StyledBonesOptions);
  /** Use it for the shape of the style, reports and resets. */
  readonly character: Character;
  /** 0 is neutral, 1 the style as captured, -4 to 4. Eased in. */
  setStrength(style: string, strength: number): void;
  /** See Character.setSide(). */
  setSide(style: string, side: Side): void;
  /** Updates the mixer by `seconds`, then styles its pose. */
  update(seconds: number): void;
  /** Restores the mixer's pose, for example before mixer.stopAllAction(). */
  restore(): void;
  /** Restores the mixer's pose, and frees the character. */
  free(): void;
}
