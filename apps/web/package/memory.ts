// The WebAssembly module and its memory: temporary allocations for calls, and the structs of
// panache.h.

import { PanacheError } from './checks.js';
import { kErrorKinds, kOk, type Functions } from './header.js';

/** What the module exports. Pointers and handles are numbers. */
export interface Exports extends Functions {
  memory: WebAssembly.Memory;
  malloc(size: number): number;
  free(at: number): void;
  _initialize(): void;
}

const kAccess = { i32: 'Int32', f32: 'Float32', f64: 'Float64' } as const;
type Kind = keyof typeof kAccess;
const sizeOf = (type: Kind) => (type === 'f64' ? 8 : 4);

type Values<Name extends string> = Partial<Record<Name, number | boolean | ArrayLike<number>>>;
/** A struct of header.ts. */
interface Struct<Name extends string> {
  size: number;
  initial: Values<Name>;
  layout: Record<Name, readonly [at: number, type: Kind, count: number]>;
}

export class Module {
  constructor(readonly wasm: Exports) {}

  /** Returns work(arena) and frees what it allocated. */
  use<Out>(work: (arena: Arena) => Out): Out {
    const ends: (() => void)[] = [];
    try {
      return work(new Arena(this, ends));
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      throw new PanacheError('there is not enough memory for this file; reload the page');
    } finally {
      for (const end of ends) end();
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
  constructor(private module: Module, private ends: (() => void)[]) {}

  allocate(size: number): number {
    const at = this.module.wasm.malloc(Math.max(size, 1));
    if (!at) throw new PanacheError('there is not enough memory for this file');
    this.ends.push(() => this.module.wasm.free(at));
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

  /** Writes `values`, and initial values of others, to the struct at `at`; by default a new one. */
  write<Name extends string>({ layout, size, initial }: Struct<Name>, values: Values<Name> = {},
    at = this.zeros(size)): number {
    const view = new DataView(this.buffer, at, size);
    for (const [name, value] of Object.entries({ ...initial, ...values })) {
      const [offset, type, count] = layout[name as Name];
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
  read<Name extends string>({ layout, size }: Struct<Name>, at: number): Record<Name, number> {
    const view = new DataView(this.buffer, at, size);
    return Object.fromEntries(Object.entries<Struct<Name>['layout'][Name]>(layout).map(
      ([name, [offset, type, count]]) => {
        const numbers = Array.from({ length: count },
          (_, i) => view[`get${kAccess[type]}`](offset + i * sizeOf(type), true));
        return [name, count === 1 ? numbers[0] : numbers];
      })) as Record<Name, number>;
  }

  /** Returns the handle created by a function of panache.h that returns a status. `destroy` ends it
   * with the arena. */
  create(call: (out: number) => number, destroy?: (handle: number) => void): number {
    const out = this.zeros(4);
    this.check(call(out));
    const [handle] = this.module.words(out, 1);
    if (destroy) this.ends.push(() => destroy(handle));
    return handle;
  }
  check(status: number): void {
    if (status !== kOk) throw this.module.lastError();
  }
  private get buffer() { return this.module.wasm.memory.buffer; }
}
