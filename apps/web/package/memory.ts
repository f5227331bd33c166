// The WebAssembly module and its memory: temporary allocations for calls, and the layout of the
// structs of panache.h.

import { PanacheError, kErrorKinds } from './checks.js';

/** What the module exports. Pointers and handles are numbers; an interface test counts arguments. */
export interface Exports {
  memory: WebAssembly.Memory;
  malloc(size: number): number;
  free(at: number): void;
  _initialize(): void;
  [call: `panache_${string}`]: (...numbers: number[]) => number;
}

const kAccess = { i32: 'Int32', f32: 'Float32', f64: 'Float64' } as const;
type Kind = keyof typeof kAccess;
const sizeOf = (type: Kind) => (type === 'f64' ? 8 : 4);

export interface Struct<Name extends string> {
  places: Map<Name, { at: number; type: Kind; count: number }>;
  size: number;
}
type Values<Name extends string> = Partial<Record<Name, number | boolean | ArrayLike<number>>>;

/** Lays out a struct from its fields, in order: their types, or [type, count]. */
export function struct<Name extends string>(
  fields: Record<Name, Kind | [type: Kind, count: number]>): Struct<Name> {
  let size = 0, align = 1;
  const places: Struct<Name>['places'] = new Map();
  for (const name in fields) {
    const [type, count] = [fields[name], 1].flat() as [Kind, number];
    const at = Math.ceil(size / sizeOf(type)) * sizeOf(type);
    places.set(name, { at, type, count });
    size = at + sizeOf(type) * count;
    align = Math.max(align, sizeOf(type));
  }
  return { places, size: Math.ceil(size / align) * align };
}

export class Module {
  constructor(readonly wasm: Exports) {}

  /** Returns work(arena) and frees what it allocated. */
  use<Out>(work: (arena: Arena) => Out): Out {
    const blocks: number[] = [];
    try {
      return work(new Arena(this, blocks));
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      throw new PanacheError('there is not enough memory for this file; reload the page');
    } finally {
      for (const block of blocks) this.wasm.free(block);
    }
  }
  /** A view; valid until the next call into the module. */
  floats(at: number, count: number) { return new Float32Array(this.wasm.memory.buffer, at, count); }
  words(at: number, count: number) { return new Uint32Array(this.wasm.memory.buffer, at, count); }
  copy<List extends { slice(): List }>(
    type: new (buffer: ArrayBuffer, at: number, count: number) => List, at: number, count: number,
  ): List {
    return new type(this.wasm.memory.buffer, at, count).slice();
  }
  /** A text that ends with a zero. */
  text(at: number): string {
    const bytes = new Uint8Array(this.wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
  /** Copies the content of a panache_bytes and frees it; of none, throws the last error. */
  take(handle: number): Uint8Array {
    const at = this.wasm.panache_bytes_data(this.checked(handle));
    const bytes = this.copy(Uint8Array, at, this.wasm.panache_bytes_size(handle));
    this.wasm.panache_bytes_destroy(handle);
    return bytes;
  }
  json<Out>(handle: number): Out { return JSON.parse(new TextDecoder().decode(this.take(handle))); }

  lastError(): PanacheError {
    return new PanacheError(this.text(this.wasm.panache_last_error()),
      kErrorKinds[this.wasm.panache_last_error_kind()]);
  }
  checked(handle: number): number {
    if (handle) return handle;
    throw this.lastError();
  }
}

/** Allocates memory for the duration of a call. */
export class Arena {
  constructor(private module: Module, private blocks: number[]) {}

  allocate(size: number): number {
    const at = this.module.wasm.malloc(Math.max(size, 1));
    if (!at) throw new PanacheError('there is not enough memory for this file');
    this.blocks.push(at);
    return at;
  }
  zeros(size: number): number {
    const at = this.allocate(size);
    new Uint8Array(this.buffer, at, size).fill(0);
    return at;
  }
  copy(bytes: ArrayBuffer | ArrayBufferView): number {
    const at = this.allocate(bytes.byteLength);
    new Uint8Array(this.buffer, at, bytes.byteLength).set(ArrayBuffer.isView(bytes)
      ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) : new Uint8Array(bytes));
    return at;
  }
  text(text: string): number { return this.copy(new TextEncoder().encode(text + '\0')); }

  /** Writes `values` to the struct at `at`; by default a new one. */
  write<Name extends string>(
    { places, size }: Struct<Name>, values: Values<Name>, at = this.zeros(size)): number {
    const view = new DataView(this.buffer, at, size);
    for (const [name, value] of Object.entries(values)) {
      const { at: offset, type, count } = places.get(name as Name)!;
      const numbers = (count === 1 ? [value] : value) as ArrayLike<number | boolean>;
      for (let i = 0; i < count; ++i) {
        view[`set${kAccess[type]}`](offset + i * sizeOf(type), +numbers[i], true);
      }
    }
    return at;
  }
  /** Writes an array of structs. [list.length] */
  array<Name extends string>(type: Struct<Name>, list: Values<Name>[]): number {
    const at = this.zeros(type.size * list.length);
    list.forEach((values, i) => this.write(type, values, at + i * type.size));
    return at;
  }
  /** Returns the values of a struct by name, as write() takes them. */
  read<Name extends string>({ places, size }: Struct<Name>, at: number): Record<Name, unknown> {
    const view = new DataView(this.buffer, at, size);
    return Object.fromEntries(Array.from(places, ([name, { at: offset, type, count }]) => {
      const numbers = Array.from({ length: count },
        (_, i) => view[`get${kAccess[type]}`](offset + i * sizeOf(type), true));
      return [name, count === 1 ? numbers[0] : numbers];
    })) as Record<Name, unknown>;
  }

  /** Returns the handle created by a function of panache.h that returns a status. */
  create(call: (out: number) => number): number {
    const out = this.zeros(4);
    this.check(call(out));
    return this.module.words(out, 1)[0];
  }
  check(status: number): void {
    if (status !== 0) throw this.module.lastError();
  }
  private get buffer() { return this.module.wasm.memory.buffer; }
}
