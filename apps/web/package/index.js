// Panache for JavaScript: a thin hand over the WebAssembly module. See index.d.ts for what it
// promises.

const kHumanJoints = 21;
const kPartNumbers = 7;
// In the order in which the module takes them.
const kShape = {
  posture: 1, dynamics: 1, timing: 1, legs: 1, spine: 1, arms: 1, head: 1, footLock: 1,
};

export const humanJoints = [
  'hips', 'spine', 'chest', 'neck', 'head',
  'leftShoulder', 'leftUpperArm', 'leftLowerArm', 'leftHand',
  'rightShoulder', 'rightUpperArm', 'rightLowerArm', 'rightHand',
  'leftUpperLeg', 'leftLowerLeg', 'leftFoot', 'leftToes',
  'rightUpperLeg', 'rightLowerLeg', 'rightFoot', 'rightToes',
];

export class PanacheError extends Error {}

// The module asks for a file system, which it never gets to use: whatever is not given fails.
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
  #model = 0;
  #walker = 0;

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
    this.#model = this._with(model, (at, size) => wasm.panache_model_create(at, size));
    if (walker) {
      this.#walker = this._with(walker, (at, size) => wasm.panache_walker_create(at, size));
    }
    this.styles = JSON.parse(this._text(wasm.panache_model_describe(this.#model)));
  }

  openFile(bytes, name) {
    const ending = (/\.[^.]*$/.exec(name)?.[0] ?? '').toLowerCase();
    if (!['.bvh', '.glb', '.gltf', '.vrm'].includes(ending)) {
      throw new PanacheError(
        `${name}: expected a motion file (.bvh, .glb, .gltf, .vrm), found ` +
          (ending ? `the extension '${ending}'` : 'no extension'));
    }
    return new MotionFile(this, this.#wasm, bytes, name, ending);
  }

  createWalker() {
    if (!this.#walker) throw new PanacheError('no walker was given to Panache.create');
    const actor = this.#wasm.panache_actor_walk(this.#model, this.#walker);
    return new Walk(this, this.#wasm, this._checked(actor), '');
  }

  goldenHash() {
    return this._scratch(8, (at) => {
      this.#wasm.panache_model_golden(this.#model, at);
      const [low, high] = new Uint32Array(this.#wasm.memory.buffer, at, 2);
      return high.toString(16).padStart(8, '0') + low.toString(16).padStart(8, '0');
    });
  }

  free() {
    this.#wasm.panache_model_free(this.#model);
    this.#wasm.panache_walker_free(this.#walker);
    this.#model = this.#walker = 0;
  }

  // For the classes below.
  _model() { return this.#model; }
  _checked(handle) {
    if (handle) return handle;
    throw new PanacheError(this._read(this.#wasm.panache_error()));
  }
  _scratch(size, use) {
    const at = this.#wasm.malloc(Math.max(size, 1));
    if (!at) throw new PanacheError('there is not enough memory for this file');
    try {
      return use(at);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      throw new PanacheError('there is not enough memory for this file; reload the page');
    } finally {
      this.#wasm.free(at);
    }
  }
  _with(bytes, create) {
    return this._scratch(bytes.byteLength, (at) => {
      new Uint8Array(this.#wasm.memory.buffer, at, bytes.byteLength).set(new Uint8Array(
        bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength));
      return this._checked(create(at, bytes.byteLength));
    });
  }
  _withText(text, use) {
    const bytes = new TextEncoder().encode(text + '\0');
    return this._scratch(bytes.length, (at) => {
      new Uint8Array(this.#wasm.memory.buffer, at, bytes.length).set(bytes);
      return use(at);
    });
  }
  _bytes(handle) {
    const at = this.#wasm.panache_bytes_data(handle), size = this.#wasm.panache_bytes_size(handle);
    return new Uint8Array(this.#wasm.memory.buffer, at, size).slice();
  }
  _read(handle) { return new TextDecoder().decode(this._bytes(handle)); }
  _text(handle) {
    const text = this._read(handle);
    this.#wasm.panache_bytes_free(handle);
    return text;
  }
}

export class MotionFile {
  #panache; #wasm; #file; #ending;

  constructor(panache, wasm, bytes, name, ending) {
    this.#panache = panache;
    this.#wasm = wasm;
    this.#ending = ending;
    this.#file = panache._with(bytes, (at, size) => panache._withText(
      name.slice(0, name.length - ending.length) + ending,
      (text) => wasm.panache_file_create(at, size, text)));
    const { clips, joints } = JSON.parse(panache._text(wasm.panache_file_describe(this.#file)));
    this.name = name;
    this.ending = ending;
    this.joints = joints;
    this.clips = clips.map(({ name: title, frames, frameTime }) => (
      { name: title, frames, frameTime, seconds: Math.max(0, frames - 1) * frameTime }));
  }

  createActor(clip = 0) {
    const actor = this.#wasm.panache_actor_clip(this.#panache._model(), this.#file, clip);
    return new Playback(this.#panache, this.#wasm, this.#panache._checked(actor), this.#ending);
  }

  free() {
    this.#wasm.panache_file_free(this.#file);
    this.#file = 0;
  }
}

class Actor {
  #panache; #ending;

  constructor(panache, wasm, actor, ending) {
    this.#panache = panache;
    this.#ending = ending;
    this._wasm = wasm;
    this._actor = actor;
    this.styleCount = panache.styles.length;
    this.styles = new Map(panache.styles.map(({ name }, index) => [name, index]));
  }

  setStrength(style, strength) {
    const index = this.styles.get(style);
    if (index === undefined) throw new PanacheError(`there is no style '${style}'`);
    const at = this._wasm.panache_actor_strengths(this._actor);
    this._floats(at, this.styleCount)[index] = strength;
  }
  setShape(shape) {
    const all = { ...kShape, ...shape };
    this._wasm.panache_actor_shape(this._actor, ...Object.keys(kShape).map((key) => all[key]));
  }
  step(seconds) { this._wasm.panache_actor_step(this._actor, seconds); }
  measure(count) { this._wasm.panache_actor_measure(this._actor, count); }

  get rate() { return this._wasm.panache_actor_rate(this._actor); }
  get gate() { return this._wasm.panache_actor_gate(this._actor); }
  get contacts() {
    return [0, 1].map((foot) => this._wasm.panache_actor_contact(this._actor, foot));
  }
  pose(which, joints) {
    const at = this._wasm.panache_actor_pose(this._actor, which === 'styled' ? 1 : 0);
    return this._floats(at, joints * kPartNumbers);
  }
  parts(which) {
    const at = this._wasm.panache_actor_parts(this._actor, which === 'styled' ? 1 : 0);
    return this._floats(at, kHumanJoints * kPartNumbers);
  }
  get offsets() {
    return this._floats(this._wasm.panache_actor_offsets(this._actor), kHumanJoints * 3).slice();
  }
  get placement() {
    return this.#panache._scratch(24, (at) => {
      this._wasm.panache_actor_placement(this._actor, at);
      const [x, y, z, w, scale, floor] = this._floats(at, 6);
      return { toYUp: [x, y, z, w], scale, floor };
    });
  }

  exportAs(ending) {
    const file = this.#panache._withText(ending, (wanted) => this.#panache._withText(
      this.#ending, (own) => this._wasm.panache_actor_export(this._actor, wanted, own)));
    this.#panache._checked(file);
    const bytes = this.#panache._bytes(file);
    this._wasm.panache_bytes_free(file);
    return bytes;
  }

  free() {
    this._wasm.panache_actor_free(this._actor);
    this._actor = 0;
  }

  // A view of the module's memory; good until the next call into it.
  _floats(at, count) { return new Float32Array(this._wasm.memory.buffer, at, count); }
}

export class Walk extends Actor {
  steer(speed, turn) { this._wasm.panache_actor_steer(this._actor, speed, turn); }
}

export class Playback extends Actor {
  seek(seconds) { this._wasm.panache_actor_seek(this._actor, seconds); }
  set loop(loop) { this._wasm.panache_actor_loop(this._actor, loop ? 1 : 0); }
  get seconds() { return this._wasm.panache_actor_seconds(this._actor); }
}
