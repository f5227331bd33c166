// Panache for JavaScript: a thin wrapper around the WebAssembly module. See index.d.ts for the
// interface.

import { Character, Skeleton, stylizeClip, writeShape } from './character.js';
import {
  PanacheError, checkBytes, checkFinite, checkInteger, checkKeys, checkTriggered, handleFor, inUse,
  lastError, personNumbers, sideNumber, timingNumber, unexpected,
} from './checks.js';
import { PoseFilter } from './filter.js';
import { Arena } from './memory.js';
import { Remover, removedIndex, removerHandle } from './remover.js';

const kHumanJoints = 21;
const kPartNumbers = 7;

export const humanJoints = [
  'hips', 'spine', 'chest', 'neck', 'head',
  'leftShoulder', 'leftUpperArm', 'leftLowerArm', 'leftHand',
  'rightShoulder', 'rightUpperArm', 'rightLowerArm', 'rightHand',
  'leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes',
  'rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes',
];

export { Character, PanacheError, PoseFilter, Remover, Skeleton };

// The module imports a file system but never uses it: imports that are not provided fail.
function importsOf(module, given) {
  const imports = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    imports[space] ??= {};
    imports[space][name] = given[name] ?? (() => -52);
  }
  return imports;
}

export class Panache {
  #wasm;
  #model = 0;     // 0 until there is one.
  #live = true;   // Until free().
  #bytes;         // The model file.
  #walker = 0;
  #players = new Set();

  static async create({ wasm, model, walker }) {
    const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
    const given = {
      proc_exit: () => {
        throw new PanacheError('the WebAssembly module stopped; reload the page');
      },
    };
    const instance = await WebAssembly.instantiate(module, importsOf(module, given));
    instance.exports._initialize();
    return new Panache(instance.exports, model, walker);
  }

  constructor(wasm, model, walker) {
    this.#wasm = wasm;
    this.styles = [];
    this.personAxes = [];
    if (model) this.#useModel(model, 'the model');
    if (walker) {
      checkBytes(walker, 'the walker');
      this.#walker = this._arena((arena) => this._checked(
        wasm.panache_page_walker_create(arena.copy(walker), walker.byteLength)));
    }
  }

  setModel(bytes, name = 'the model') {
    this.#useModel(bytes, name);
  }
  #useModel(bytes, name) {
    inUse(this.#live, 'Panache');
    checkBytes(bytes, name);
    const wasm = this.#wasm;
    const model = this._arena((arena) => this._checked(wasm.panache_page_model_create(
      arena.copy(bytes), bytes.byteLength, arena.text(name))));
    // Players keep what they need of their old model.
    const old = this.#model;
    this.#model = model;
    this.#bytes = bytes;
    this.styles = this._stylesOf(model);
    this.personAxes = Array.from({ length: wasm.panache_model_person_axis_count(model) },
      (_, axis) => this._text(wasm.panache_model_person_axis_name(model, axis)));
    for (const player of this.#players) player._useModel();
    wasm.panache_model_destroy(old);
  }
  get modelBytes() { return this.#bytes; }

  isStyle(bytes) {
    checkBytes(bytes, 'the style');
    return this._arena((arena) =>
      this.#wasm.panache_page_is_style(arena.copy(bytes), bytes.byteLength) !== 0);
  }
  addStyle(bytes, { name = 'the style', replace = false } = {}) {
    this._model();
    checkBytes(bytes, name);
    this.setModel(this._arena((arena) => this._take(this._checked(
      this.#wasm.panache_page_style_add(arena.copy(this.#bytes), this.#bytes.byteLength,
        arena.copy(bytes), bytes.byteLength, arena.text(name), replace ? 1 : 0)))));
  }
  extractStyle(style) {
    return this.#withStyle(style, (bytes, size, name, out) =>
      this.#wasm.panache_styles_extract(bytes, size, name, out));
  }
  removeStyle(style) {
    this.setModel(this.#withStyle(style, (bytes, size, name, out) =>
      this.#wasm.panache_styles_remove(bytes, size, name, out)));
  }
  #withStyle(style, change) {
    this._model();
    return this._arena((arena) => this._take(arena.create((out) => change(
      arena.copy(this.#bytes), this.#bytes.byteLength, arena.text(style), out))));
  }

  learnStyle(style, styled, neutral) {
    this._model();
    const bank = ArrayBuffer.isView(neutral) || neutral instanceof ArrayBuffer ? neutral : null;
    return this._arena((arena) => {
      const out = arena.zeros(4);
      const [before, after] = [bank ? null : neutral, styled];
      const bytes = this._take(this._checked(this.#wasm.panache_page_learn(
        arena.copy(this.#bytes), this.#bytes.byteLength,
        before?.file._handleFor(this) ?? 0, before?.clip ?? 0, arena.text(before?.file.name ?? ''),
        bank ? arena.copy(bank) : 0, bank?.byteLength ?? 0, after.file._handleFor(this), after.clip ?? 0,
        arena.text(after.file.name), arena.text(style), out)));
      const [report] = new Uint32Array(this.#wasm.memory.buffer, out, 1);
      return { bytes, report: this._json(report) };
    });
  }

  createSkeleton(joints, options = {}) {
    inUse(this.#live, 'Panache');
    return new Skeleton(this, joints, options);
  }
  createCharacter(skeleton, options = {}) { return new Character(this, skeleton, options); }
  createRemover(bytes) { return new Remover(this, bytes); }
  stylizeClip(skeleton, clip, strengths, options = {}) {
    return stylizeClip(this, skeleton, clip, strengths, options);
  }

  openFile(bytes, name, { fps = 0 } = {}) {
    const extension = (/\.[^.]*$/.exec(name)?.[0] ?? '').toLowerCase();
    if (extension === '.fbx') {
      throw new PanacheError(`${name}: is FBX, which is not read here; \`panache view ${name}\` ` +
        `shows it, and \`panache convert ${name} -o ${name.slice(0, -4)}.glb\` makes a file that is read`);
    }
    if (!['.bvh', '.glb', '.gltf', '.vrm', '.vrma'].includes(extension)) {
      throw new PanacheError(
        `${name}: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma), found ` +
          (extension ? `the extension '${extension}'` : 'no extension'));
    }
    checkBytes(bytes, name);
    return new MotionFile(this, bytes, name, extension, fps);
  }

  createWalker() {
    inUse(this.#live, 'Panache');
    if (!this.#walker) throw new PanacheError('no walker was given to Panache.create');
    const player = this.#wasm.panache_page_player_walk(this.#model, this.#walker);
    return new Walk(this, this._checked(player), '');
  }

  goldenHash() {
    return this._arena((arena) => {
      const at = arena.allocate(8);
      this.#wasm.panache_page_golden(this._model(), at);
      const [low, high] = new Uint32Array(this.#wasm.memory.buffer, at, 2);
      return high.toString(16).padStart(8, '0') + low.toString(16).padStart(8, '0');
    });
  }

  free() {
    this.#wasm.panache_model_destroy(this.#model);
    this.#wasm.panache_page_walker_free(this.#walker);
    this.#model = this.#walker = 0;
    this.#live = false;
  }

  // For the other classes.
  get _wasm() { return this.#wasm; }
  _model() {
    inUse(this.#live, 'Panache');
    if (this.#model) return this.#model;
    throw new PanacheError('expected a model: give one to Panache.create, or call setModel()');
  }
  _players() { return this.#players; }
  _stylesOf(model) { return this._json(this.#wasm.panache_page_styles(model)); }
  _styleIndex(name, styles = this.styles) {
    // Like the program: an exact match first, then without case, then other words for a style.
    const wanted = String(name).toLowerCase();
    for (const fits of [
      (style) => style.name === name,
      (style) => style.name.toLowerCase() === wanted,
      (style) => style.words.includes(wanted),
    ]) {
      const index = styles.findIndex(fits);
      if (index >= 0) return index;
    }
    const groups = [...new Set(styles.map(({ group }) => group).filter(Boolean))];
    throw new PanacheError(`unknown style '${name}'; the model has ${styles.length} styles: ` +
      (groups.length ? groups : styles.map((style) => style.name)).join(', '));
  }
  _checked(handle) {
    if (handle) return handle;
    throw lastError(this.#wasm);
  }
  // A text of the module that ends with a zero.
  _text(at) {
    const bytes = new Uint8Array(this.#wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
  _seedOf(word) {
    return this._arena((arena) => this.#wasm.panache_person_seed(arena.text(word)));
  }
  _arena(use) { return Arena.use(this.#wasm, use); }
  _json(handle) { return JSON.parse(new TextDecoder().decode(this._take(handle))); }
  // Copies the content of a panache_bytes and frees it.
  _take(handle) {
    const at = this.#wasm.panache_bytes_data(handle), size = this.#wasm.panache_bytes_size(handle);
    const bytes = new Uint8Array(this.#wasm.memory.buffer, at, size).slice();
    this.#wasm.panache_bytes_destroy(handle);
    return bytes;
  }
}

export class MotionFile {
  #panache; #wasm; #file;

  constructor(panache, bytes, name, extension, fps) {
    this.#panache = panache;
    this.#wasm = panache._wasm;
    this.#file = panache._arena((arena) => panache._checked(this.#wasm.panache_page_file_create(
      arena.copy(bytes), bytes.byteLength,
      arena.text(name.slice(0, name.length - extension.length) + extension), fps)));
    const { clips, joints, notes } = panache._arena((arena) => panache._json(
      this.#wasm.panache_page_file_describe(this.#file, arena.text(name))));
    Object.assign(this, { name, extension, joints, notes });
    this.clips = clips.map((clip) => (
      { ...clip, seconds: Math.max(0, clip.frames - 1) * clip.frameTime }));
  }

  _handleFor(panache) {
    return handleFor(panache, this.#panache, this.#file, 'file',
      `${this.name}: this file is open in another Panache; open it with openFile()`);
  }

  createPlayer(clip = 0) {
    const player = this.#wasm.panache_page_player_clip(
      this.#panache._model(), this._handleFor(this.#panache), clip);
    return new Playback(this.#panache, this.#panache._checked(player), this.extension);
  }

  putOn(character, clip = 0) {
    return this.#panache._take(this.#panache._checked(
      this.#wasm.panache_page_file_put_on(
        this._handleFor(this.#panache), clip, character._handleFor(this.#panache))));
  }

  free() {
    this.#wasm.panache_page_file_free(this.#file);
    this.#file = 0;
  }
}

class Player {
  #panache; #player; #extension; #remover = null;

  constructor(panache, player, extension) {
    this.#panache = panache;
    this.#extension = extension;
    this._wasm = panache._wasm;
    this.#player = player;
    panache._players().add(this);
  }
  _useModel() {
    this.#panache._arena((arena) => arena.check(
      this._wasm.panache_page_player_use_model(this._player, this.#panache._model())));
  }

  get _player() { return inUse(this.#player, 'player'); }

  setStrength(style, strength) {
    const index = this.#panache._styleIndex(style);
    checkFinite(strength, `strength of '${style}'`);
    const at = this._wasm.panache_page_player_strengths(this._player);
    this._floats(at, index + 1)[index] = strength;
  }
  setSide(style, side) {
    const index = this.#panache._styleIndex(style);
    this._wasm.panache_page_player_set_side(
      this._player, index, sideNumber(side, this.#panache.styles[index]));
  }
  setPerson(person, variety = 1) {
    const [seed, amount] = personNumbers(person, variety, (word) => this.#panache._seedOf(word));
    this._wasm.panache_page_player_set_person(this._player, seed, amount);
  }
  setShape(shape) {
    this.#panache._arena((arena) => arena.check(
      this._wasm.panache_page_player_set_shape(this._player, writeShape(arena, shape))));
  }
  setGestureRate(rate) {
    if (!(checkFinite(rate, 'gesture rate') >= 0 && rate <= 10)) {
      throw unexpected('gesture rate', 'a number from 0 to 10', rate);
    }
    this._wasm.panache_page_player_set_gesture_rate(this._player, rate);
  }
  trigger(style, gesture = 0) {
    const index = this.#panache._styleIndex(style);
    checkTriggered(this._wasm.panache_page_player_trigger(
      this._player, index, checkInteger(gesture, 'gesture')), this.#panache.styles[index], gesture);
  }
  useRemover(remover) {
    this.#panache._arena((arena) => arena.check(this._wasm.panache_page_player_use_remover(
      this._player, removerHandle(this.#panache, remover))));
    this.#remover = remover;
  }
  setRemoved(style) {
    this._wasm.panache_page_player_set_removed(
      this._player, removedIndex(this.#remover, style, 'player'));
  }
  setTiming(timing) {
    this._wasm.panache_page_player_set_timing(this._player, timingNumber(timing, 'timing'));
  }
  step(seconds) { this._wasm.panache_page_player_step(this._player, seconds); }
  measure(count) { this._wasm.panache_page_player_measure(this._player, count); }

  get rate() { return this._wasm.panache_page_player_rate(this._player); }
  get gate() { return this._wasm.panache_page_player_gate(this._player); }
  get contacts() {
    return [0, 1].map((foot) => this._wasm.panache_page_player_contact(this._player, foot));
  }
  pose(which, joints) {
    const at = this._wasm.panache_page_player_pose(this._player, which === 'styled' ? 1 : 0);
    return this._floats(at, joints * kPartNumbers);
  }
  parts(which) {
    const at = this._wasm.panache_page_player_parts(this._player, which === 'styled' ? 1 : 0);
    return this._floats(at, kHumanJoints * kPartNumbers);
  }
  get body() { return this.#makeBody(0); }
  get coarseBody() { return this.#makeBody(1); }
  #makeBody(coarse) {
    return this.#panache._arena((arena) => {
      const at = arena.allocate(40);
      this._wasm.panache_page_player_body(this._player, coarse, at);
      const { buffer } = this._wasm.memory;
      const [vertices, corners, ...places] = new Uint32Array(buffer, at, 10);
      const sizes = [[Float32Array, 3 * kHumanJoints], [Float32Array, 4 * kHumanJoints],
        [Float32Array, 3 * vertices], [Float32Array, 3 * vertices], [Uint8Array, 4 * vertices],
        [Uint8Array, 4 * vertices], [Uint8Array, vertices], [Uint16Array, corners]];
      const [bindPositions, bindRotations, positions, normals, joints, weights, accents, triangles] =
        sizes.map(([type, count], i) => new type(buffer, places[i], count).slice());
      return { bindPositions, bindRotations, positions, normals, joints, weights, accents,
        triangles };
    });
  }
  get placement() {
    return this.#panache._arena((arena) => {
      const at = arena.allocate(24);
      this._wasm.panache_page_player_placement(this._player, at);
      const [x, y, z, w, scale, floor] = this._floats(at, 6);
      return { toYUp: [x, y, z, w], scale, floor };
    });
  }

  exportAs(extension, { which = 'styled', seconds = Infinity } = {}) {
    return this.#panache._arena((arena) => this.#panache._take(this.#panache._checked(
      this._wasm.panache_page_player_export(this._player, arena.text(extension),
        arena.text(this.#extension), which === 'styled' ? 1 : 0, seconds))));
  }

  free() {
    this.#panache._players().delete(this);
    this._wasm.panache_page_player_free(this.#player);
    this.#player = 0;
  }
  _setTrack(style, keys) {
    const index = this.#panache._styleIndex(style);
    checkKeys(keys, style);
    this.#panache._arena((arena) => this._wasm.panache_page_player_set_track(
      this._player, index, arena.copy(Float64Array.from(keys.flat())), keys.length));
  }

  // A view of the module's memory; valid until the next call into it.
  _floats(at, count) { return new Float32Array(this._wasm.memory.buffer, at, count); }
}

export class Walk extends Player {
  steer(speed, turn) { this._wasm.panache_page_player_steer(this._player, speed, turn); }
}

export class Playback extends Player {
  seek(seconds) { this._wasm.panache_page_player_seek(this._player, seconds); }
  setTrack(style, keys) { this._setTrack(style, keys); }
  set loop(loop) { this._wasm.panache_page_player_loop(this._player, loop ? 1 : 0); }
  get seconds() { return this._wasm.panache_page_player_seconds(this._player); }
  get firstFrame() { return this._wasm.panache_page_player_first_frame(this._player); }
}
