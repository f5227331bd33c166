// Files with motion, and what plays: the walker and their clips.

import { PanacheError, checkBytes, checkFinite, checkKeys, inUse, unexpected } from './checks.js';
import { kClip, kClipEdit, kJoint, kReplace } from './header.js';
import type { Panache } from './index.js';
import type { Arena } from './memory.js';
import { removedIndex, removerHandle, type Remover } from './remover.js';
import { Styled, styleIndex, timingNumber, type Person, type Shape, type Timing } from './styling.js';

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
  #panache: Panache; #file: number;

  /** @internal */
  constructor(panache: Panache, bytes: ArrayBuffer | Uint8Array, name: string, fps: number) {
    this.name = name;
    this.extension = (/\.[^.]*$/.exec(name)?.[0] ?? '').toLowerCase();
    if (this.extension === '.fbx') {
      throw new PanacheError(`${name}: is FBX, which is not read here; \`panache view ${name}\` ` +
        `shows it, and \`panache convert ${name} -o ${name.slice(0, -4)}.glb\` makes a file that is read`);
    }
    if (!['.bvh', '.glb', '.gltf', '.vrm', '.vrma'].includes(this.extension)) {
      throw new PanacheError(`${name}: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma), found ` +
        (this.extension ? `the extension '${this.extension}'` : 'no extension'));
    }
    checkBytes(bytes, name);
    const { _module: module, _module: { wasm } } = panache;
    this.#panache = panache;
    const file = this.#file = module.use((arena) => {
      const at = arena.copy(bytes), size = bytes.byteLength, path = arena.text(name);
      return arena.create((out) => (fps
        ? wasm.panache_motion_file_create_at_rate(at, size, path, fps, out)
        : wasm.panache_motion_file_create(at, size, path, out)));
    });
    this.joints = module.use((arena) => {
      const at = arena.write(kJoint);
      return Array.from({ length: wasm.panache_motion_file_joint_count(file) }, (_, i) => {
        wasm.panache_motion_file_get_joint(file, i, at);
        const joint = arena.read(kJoint, at);
        return { name: module.text(joint.name), parent: joint.parent };
      });
    });
    this.clips = module.use((arena) => {
      const at = arena.write(kClip);
      return Array.from({ length: wasm.panache_motion_file_clip_count(file) }, (_, i) => {
        arena.check(wasm.panache_motion_file_get_clip(file, i, at));
        const { frameCount: frames, frameSeconds: frameTime } = arena.read(kClip, at);
        return { name: module.text(wasm.panache_motion_file_clip_name(file, i)), frames, frameTime,
          seconds: Math.max(0, frames - 1) * frameTime,
          moves: wasm.panache_motion_file_clip_moves(file, i) !== 0 };
      });
    });
    const notes = module.use((arena) => module.take(
      arena.create((out) => wasm.panache_motion_file_get_notes(file, out))));
    this.notes = new TextDecoder().decode(notes).split('\n').filter(Boolean);
  }

  /** @internal */ _handleFor(panache: Panache): number {
    if (panache === this.#panache) return inUse(this.#file, 'file');
    throw new PanacheError(`${this.name}: this file is open in another Panache; open it with openFile()`);
  }

  #skeleton(arena: Arena, clip: number) {
    const { _module: { wasm } } = this.#panache;
    return arena.create((out) => wasm.panache_motion_file_create_skeleton(this.#file, clip, 0, out),
      wasm.panache_skeleton_destroy);
  }
  /** @internal A motion as a panache_clip, valid as long as the arena; without motions the rest pose. */
  _clip(panache: Panache, arena: Arena, clip: number): number {
    const file = this._handleFor(panache), which = this.clips.length ? clip : -1;
    const at = arena.write(kClip);
    arena.check(panache._module.wasm.panache_motion_file_get_clip(file, which, at));
    return arena.write(kClip, { skeleton: this.#skeleton(arena, which) }, at);
  }

  /** Throws if the skeleton is not a humanoid. The file may be freed before the player. */
  createPlayer(clip = 0): Playback {
    const { _module: module } = this.#panache;
    const player = module.wasm.panache_page_player_clip(
      this.#panache._model(), this._handleFor(this.#panache), clip);
    return new Playback(this.#panache, module.checked(player), this.extension);
  }

  /** The bytes of the character's file, with its motions replaced by this one, retargeted. */
  putOn(character: MotionFile, clip = 0): Uint8Array {
    const { _module: module, _module: { wasm } } = this.#panache;
    const onto = character._handleFor(this.#panache);
    return module.use((arena) => {
      const from = this._clip(this.#panache, arena, clip);
      const put = arena.create(
        (out) => wasm.panache_retarget_clip(from, character.#skeleton(arena, -1), 0, out),
        wasm.panache_styled_clip_destroy);
      const edit = arena.write(kClipEdit, {
        clip: -1, name: arena.text(this.clips[clip]?.name || 'motion'),
        framesFrameCount: wasm.panache_styled_clip_frame_count(put),
        framesFrameSeconds: arena.read(kClip, from).frameSeconds,
        framesRotations: wasm.panache_styled_clip_rotations(put),
        framesTranslations: wasm.panache_styled_clip_translations(put),
      });
      return module.take(arena.create(
        (out) => wasm.panache_motion_file_write(onto, edit, 1, kReplace, out)));
    });
  }

  free(): void {
    this.#panache._module.wasm.panache_motion_file_destroy(this.#file);
    this.#file = 0;
  }
}

const kHumanJoints = 21, kPartNumbers = 7;

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
export class Player extends Styled {
  #player: number; #extension: string; #remover: Remover | null = null;
  #person: [Person, number] = [null, 1]; #shape: Partial<Shape> = {};

  /** @internal */ constructor(panache: Panache, player: number, extension: string) {
    super(panache);
    this.#player = player;
    this.#extension = extension;
    panache._players.add(this);
  }
  /** @internal */ _useModel(): void {
    this._panache._module.use((arena) => arena.check(
      this._wasm.panache_page_player_use_model(this._player, this._panache._model())));
    this.setShape(this.#shape);
    this.setPerson(...this.#person);
  }
  /** @internal */ get _styles() { return this._panache.styles; }
  /** @internal 0: there is no model yet. */ get _character() {
    return this._wasm.panache_page_player_character(this._player);
  }
  /** @internal */ protected get _player() { return inUse(this.#player, 'player'); }
  /** @internal */ protected get _facts() {
    return this._panache._module.copy(
      Float64Array, this._wasm.panache_page_player_facts(this._player), 16);
  }

  /** Nobody in a model without persons. */
  override setPerson(person: Person, variety = 1): void {
    this.#person = [person, variety];
    if (this._panache.personAxes.length) super.setPerson(person, variety);
  }
  override setShape(shape: Partial<Shape>): void {
    this.#shape = shape;
    if (this._character) super.setShape(shape);
  }
  /** See StylizingOptions.gestureRate; 1 at first. */
  setGestureRate(rate: number): void {
    if (!(checkFinite(rate, 'gesture rate') >= 0 && rate <= 10)) {
      throw unexpected('gesture rate', 'a number from 0 to 10', rate);
    }
    this._wasm.panache_page_player_set_gesture_rate(this._player, rate);
  }
  /** Sets the model for setRemoved(); the motion continues. */
  useRemover(remover: Remover): void {
    this._panache._module.use((arena) => arena.check(this._wasm.panache_page_player_use_remover(
      this._player, removerHandle(this._panache, remover))));
    this.#remover = remover;
  }
  /** Removes a style of the remover from the input, including its tempo, before styles are added;
   * null: none, the default. Eased in. Throws before useRemover(). */
  setRemoved(style: string | null): void {
    this._wasm.panache_page_player_set_removed(this._player, removedIndex(this.#remover, style, 'player'));
  }
  /** Initially 'steps'; the motion continues. */
  setTiming(timing: Timing): void {
    this._wasm.panache_page_player_set_timing(this._player, timingNumber(timing, 'timing'));
  }
  /** Advances by `seconds`, at most a tenth per call. */
  step(seconds: number): void { this._wasm.panache_page_player_step(this._player, seconds); }
  /** Steps a copy `count` times with the current pose, to measure the speed. */
  measure(count: number): void { this._wasm.panache_page_player_measure(this._player, count); }

  /** Input seconds per output second: the tempo of the style, 1 where the timing is off. */
  get rate(): number { return this._facts[1]; }
  /** How much of the styles' change is applied: 1 if the input resembles the training motion; 0 if
   * it does not, so that styles only add their mean posture. */
  get gate(): number { return this._facts[2]; }
  /** Probability that each foot is planted: left, right. */
  get contacts(): number[] { return [...this._facts.subarray(3, 5)]; }
  /** View, [joints][7]: local rotation x y z w and translation, in the file's units and axes. */
  pose(which: 'input' | 'styled', joints: number): Float32Array {
    return this._panache._module.floats(this._facts[which === 'styled' ? 13 : 12], joints * kPartNumbers);
  }
  /** View, [21][7]: world position (metres, Y up) and orientation x y z w of each human joint. The
   * orientation is relative to the T-pose: left arm along +x, legs along -y, feet along +z. */
  parts(which: 'input' | 'styled'): Float32Array {
    return this._panache._module.floats(this._facts[which === 'styled' ? 15 : 14],
      kHumanJoints * kPartNumbers);
  }
  /** A body with the rig's proportions; takes some tenths of a second the first time. */
  get body(): Body { return this.#makeBody(0); }
  /** The same with a third of the triangles, for machines without a graphics card. */
  get coarseBody(): Body { return this.#makeBody(1); }
  #makeBody(coarse: number): Body {
    const { _module: module } = this._panache;
    return module.use((arena) => {
      const at = arena.allocate(40);
      this._wasm.panache_page_player_body(this._player, coarse, at);
      const [vertices, corners, ...addresses] = module.words(at, 10);
      const floats = (i: number, count: number) => module.copy(Float32Array, addresses[i], count);
      const bytes = (i: number, count: number) => module.copy(Uint8Array, addresses[i], count);
      return {
        bindPositions: floats(0, 3 * kHumanJoints), bindRotations: floats(1, 4 * kHumanJoints),
        positions: floats(2, 3 * vertices), normals: floats(3, 3 * vertices),
        joints: bytes(4, 4 * vertices), weights: bytes(5, 4 * vertices), accents: bytes(6, vertices),
        triangles: module.copy(Uint16Array, addresses[7], corners),
      };
    });
  }
  /** world = scale * rotate(toYUp, point in the file) - {0, floor, 0}. */
  get placement(): { toYUp: number[]; scale: number; floor: number } {
    const [x, y, z, w, scale, floor] = this._facts.subarray(6);
    return { toYUp: [x, y, z, w], scale, floor };
  }

  /** A file with this extension (".bvh", ".glb", ".vrma", or that of the file played): the whole
   * clip with the current settings, or the last seconds of a walk, at most 20. */
  exportAs(extension: string, options: { which?: 'input' | 'styled'; seconds?: number } = {}): Uint8Array {
    const { which = 'styled', seconds = Infinity } = options, { _module: module } = this._panache;
    return module.use((arena) => module.take(
      this._wasm.panache_page_player_export(this._player, arena.text(extension),
        arena.text(this.#extension), which === 'styled' ? 1 : 0, seconds)));
  }

  free(): void {
    this._panache._players.delete(this);
    this._wasm.panache_page_player_free(this.#player);
    this.#player = 0;
  }
}

export class Walk extends Player {
  /** `speed`: m/s, 0 to 4.5; `turn`: rad/s, positive to the left. Eased. */
  steer(speed: number, turn: number): void {
    this._wasm.panache_page_player_steer(this._player, speed, turn);
  }
}

export class Playback extends Player {
  /** Jumps to `seconds` after the first frame; takes effect at the next step. */
  seek(seconds: number): void { this._wasm.panache_page_player_seek(this._player, seconds); }
  /** Sets the strength of a style over time instead of a constant one: keyframes, interpolated
   * linearly, with ascending seconds after the first frame. Empty: constant again. */
  setTrack(style: string, keys: readonly (readonly [seconds: number, strength: number])[]): void {
    const index = styleIndex(this._panache.styles, style);
    checkKeys(keys, style);
    this._panache._module.use((arena) => this._wasm.panache_page_player_set_track(
      this._player, index, arena.copy(Float64Array.from(keys.flat())), keys.length));
  }
  set loop(loop: boolean) { this._wasm.panache_page_player_loop(this._player, loop ? 1 : 0); }
  get seconds(): number { return this._facts[0]; }
  /** The first frame that plays, from 0; earlier frames of the file are a reference pose. */
  get firstFrame(): number { return this._facts[5]; }
}
