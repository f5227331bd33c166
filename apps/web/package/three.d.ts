// Styles characters of three.js: panache/three.
import type { AnimationMixer, Object3D } from 'three';
import type {
  Character, CharacterOptions, Panache, Pose, SkeletonOptions,
} from './index.js';

export interface StyledBonesOptions extends CharacterOptions,
    Pick<SkeletonOptions, 'metresPerUnit' | 'upAxis'> {
  /** The name of the bone by the name of the humanoid's joint ("leftHand", as in VRM), where names
   * and shape are not enough; null where there is none. */
  humanBones?: Record<string, string | null>;
}

/** Styles bones in place, whatever has posed them. Bones are those below `root`, together with what
 * they hang on; scales are read once and have to be the same along all axes. */
export class StyledBones {
  /** The bones are at rest now, or in an upright pose. Throws a PanacheError where they are no
   * humanoid. */
  constructor(panache: Panache, root: Object3D, options?: StyledBonesOptions);
  /** For strengths, the shape of the style, reports and resets. */
  readonly character: Character;
  /** What the last step gave, parents before children, with scales multiplied in. */
  readonly pose: Pose;
  /** Styles the bones as they are posed; `seconds` have gone by since the last step. All have to be
   * posed anew before the next step, or restore()d. */
  step(seconds: number): void;
  /** Puts the pose before the last step back. */
  restore(): void;
  /** The bones stay as they are. */
  free(): void;
}

/** Styles the character that an AnimationMixer moves. Call update() in place of the mixer's. */
export class StyledMixer {
  constructor(panache: Panache, mixer: AnimationMixer, options?: StyledBonesOptions);
  /** For the shape of the style, reports and resets. */
  readonly character: Character;
  /** 0 is neutral, 1 the style as captured, -4 to 4. Eased in. */
  setStrength(style: string, strength: number): void;
  /** Updates the mixer by `seconds`, then styles what it has posed. */
  update(seconds: number): void;
  /** Puts the mixer's own pose back, for example before mixer.stopAllAction(). */
  restore(): void;
  /** Puts the mixer's own pose back, and frees the character. */
  free(): void;
}
