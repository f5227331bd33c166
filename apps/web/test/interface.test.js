// Checks what mirrors panache.h: the structs of the npm package, the functions that it calls, and
// the declarations in the C# file.

import { readdirSync, readFileSync } from 'node:fs';

import ts from 'typescript';
import { describe, expect, it } from 'vitest';

import * as structs from '../package/structs.ts';

const at = (path) => new URL(`../../../${path}`, import.meta.url);
const read = (path) => readFileSync(at(path), 'utf8');
const sources = (folder, extension) => readdirSync(at(folder))
  .filter((name) => name.endsWith(extension)).map((name) => read(`${folder}/${name}`));
const header = read('include/panache/panache.h').replaceAll(/\/\*[^]*?\*\//g, '');
const enums = Array.from(header.matchAll(/typedef enum (\w+)/g), ([, name]) => name);
const inC = (name) => name.replaceAll(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

// The kind of the type in a declaration: "const panache_clip* clip" is a pointer.
function kindOf(declaration) {
  const [type] = declaration.replace('const ', '').trim().split(' ');
  return declaration.includes('*') ? 'pointer' : enums.includes(type) ? 'int32_t' : type;
}
// [result, ...parameters] of each function, by name.
function functionsOf(text) {
  return new Map(Array.from(
    text.matchAll(/PANACHE_(?:API|EXPORT) ([^(]*?)(panache_\w+)\(([^)]*)\)/g),
    ([, result, name, list]) => [name, [result, ...(list === 'void' ? [] : list.split(','))]
      .map(kindOf)]));
}

// A pointer of WebAssembly has 32 bits.
const kKinds = { pointer: 'i32', int32_t: 'i32', uint32_t: 'i32', float: 'f32', double: 'f64' };
// [name, kind, count] of each field.
function fieldsOf(struct) {
  const [, body] = new RegExp(`typedef struct ${struct} \\{([^}]*)\\}`).exec(header);
  return body.split(';').map((text) => text.trim()).filter(Boolean).flatMap((declaration) =>
    [...declaration.matchAll(/(\w+)(?:\[(\d+)\])?\s*(?:,|$)/g)].map(
      ([, name, count]) => [name, kKinds[kindOf(declaration)], Number(count ?? 1)]));
}

describe('the structs of the package', () => {
  for (const [name, { places }] of Object.entries(structs)) {
    const struct = `panache${inC(name.slice(1))}`;
    it(`${struct} is that of panache.h`, () => {
      expect([...places].map(([field, { type, count }]) => [inC(field), type, count])).toEqual(
        fieldsOf(struct));
    });
  }
});

// A call converts numbers to what the module takes, so only the number of arguments can drift.
it('the package calls the functions of the module with as many arguments as they take', () => {
  const functions = functionsOf(header + sources('apps/web/wasm', '.cpp').join(''));
  const calls = sources('apps/web/package', '.ts').flatMap((text) => callsIn(
    ts.createSourceFile('', text, ts.ScriptTarget.ESNext, true)));
  expect(calls.length).toBeGreaterThan(50);
  for (const call of calls) {
    const parameters = functions.get(call.expression.name.text)?.slice(1);
    expect(parameters, call.getText()).toHaveLength(call.arguments.length);
  }
});
function callsIn(node) {
  const own = ts.isCallExpression(node) && /^panache_/.test(node.expression.name?.text) ? [node] : [];
  return [...own, ...node.getChildren().flatMap(callsIn)];
}

const kCSharp = { int: 'int32_t', uint: 'uint32_t', UIntPtr: 'size_t', IntPtr: 'pointer' };

it('the file for C# declares the functions of panache.h', () => {
  const text = read('apps/csharp/Panache.cs');
  const byValue = Array.from(text.matchAll(/\bstruct (\w+)/g), ([, name]) => name);
  // Classes, handles and arrays are passed as pointers.
  const kindIn = (declaration) => {
    const [type] = declaration.trim().split(' ');
    if (/^(out|ref)$|\]$/.test(type)) return 'pointer';
    if (byValue.includes(type)) return 'struct';
    return kCSharp[type] ?? (/^[a-z]/.test(type) ? type : 'pointer');
  };
  const declared = Array.from(
    text.replaceAll(/\[(In|Out|In, Out)\] /g, '')
      .matchAll(/static extern (\w+) (panache_\w+)\(([^)]*)\)/g),
    ([, result, name, list]) => [name, [result, ...(list ? list.split(',') : [])].map(kindIn)]);
  expect(declared.length).toBe(text.match(/DllImport\(/g).length);
  const functions = functionsOf(header);
  for (const [name, kinds] of declared) {
    expect(kinds, name).toEqual(functions.get(name)?.map(
      (kind) => (kind.startsWith('panache_') ? 'struct' : kind)));
  }
});
