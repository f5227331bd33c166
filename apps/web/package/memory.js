// The memory of the WebAssembly module: temporary allocations for calls, and the layout of the
// structs of panache.h.

import { lastError, PanacheError } from './checks.js';

const kSizes = { i32: 4, f32: 4, f64: 8 };

// Lays out a struct from its fields, in order: [name, type, count].
export function struct(...fields) {
  let size = 0;
  const places = new Map();
  for (const [name, type, count = 1] of fields) {
    size = Math.ceil(size / kSizes[type]) * kSizes[type];
    places.set(name, { at: size, type, count });
    size += kSizes[type] * count;
  }
  const align = Math.max(...fields.map(([, type]) => kSizes[type]));
  return { places, size: Math.ceil(size / align) * align };
}

const kAccess = {
  i32: ['setInt32', 'getInt32'], f32: ['setFloat32', 'getFloat32'], f64: ['setFloat64', 'getFloat64'],
};

// Allocates memory for the duration of a call.
export class Arena {
  #wasm;
  #blocks = [];

  static use(wasm, work) {
    const arena = new Arena(wasm);
    try {
      return work(arena);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      throw new PanacheError('there is not enough memory for this file; reload the page');
    } finally {
      for (const block of arena.#blocks) wasm.free(block);
    }
  }
  constructor(wasm) { this.#wasm = wasm; }

  allocate(size) {
    const at = this.#wasm.malloc(Math.max(size, 1));
    if (!at) throw new PanacheError('there is not enough memory for this file');
    this.#blocks.push(at);
    return at;
  }
  copy(bytes) {
    const at = this.allocate(bytes.byteLength);
    new Uint8Array(this.#wasm.memory.buffer, at, bytes.byteLength).set(new Uint8Array(
      bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength));
    return at;
  }
  text(text) { return this.copy(new TextEncoder().encode(text + '\0')); }

  // Writes `values` (numbers or arrays, by name) to the struct at `at`; by default a new one.
  write(type, values, at = this.zeros(type.size)) {
    const view = new DataView(this.#wasm.memory.buffer, at, type.size);
    for (const [name, value] of Object.entries(values)) {
      const place = type.places.get(name);
      const numbers = place.count === 1 ? [value] : value;
      for (let i = 0; i < place.count; ++i) {
        view[kAccess[place.type][0]](place.at + i * kSizes[place.type], numbers[i], true);
      }
    }
    return at;
  }
  // Writes an array of structs. [list.length]
  array(type, list) {
    const at = this.zeros(type.size * list.length);
    list.forEach((values, i) => this.write(type, values, at + i * type.size));
    return at;
  }
  // Returns the values of a struct by name, as write() takes them.
  read(type, at) {
    const view = new DataView(this.#wasm.memory.buffer, at, type.size);
    return Object.fromEntries(Array.from(type.places, ([name, { at: offset, type: kind, count }]) => {
      const numbers = Array.from({ length: count },
        (_, i) => view[kAccess[kind][1]](offset + i * kSizes[kind], true));
      return [name, count === 1 ? numbers[0] : numbers];
    }));
  }
  zeros(size) {
    const at = this.allocate(size);
    new Uint8Array(this.#wasm.memory.buffer, at, size).fill(0);
    return at;
  }

  // Returns the handle created by a function of panache.h that returns a status.
  create(call) {
    const out = this.zeros(4);
    this.check(call(out));
    return new Uint32Array(this.#wasm.memory.buffer, out, 1)[0];
  }
  check(status) {
    if (status === 0) return;
    throw lastError(this.#wasm);
  }
}
