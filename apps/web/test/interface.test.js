// Checks what mirrors panache.h: the declarations in the C# file.

import { readFileSync } from 'node:fs';

import { expect, it } from 'vitest';

const at = (path) => new URL(`../../../${path}`, import.meta.url);
const read = (path) => readFileSync(at(path), 'utf8');
const header = read('include/panache/panache.h').replaceAll(/\/\*[^]*?\*\//g, '');
const enums = Array.from(header.matchAll(/typedef enum (\w+)/g), ([, name]) => name);

// The kind of the type in a declaration: "const panache_clip* clip" is a pointer.
function kindOf(declaration) {
  const [type] = declaration.replace('const ', '').trim().split(' ');
  return declaration.includes('*') ? 'pointer' : enums.includes(type) ? 'int32_t' : type;
}
// [result, ...parameters] of each function, by name.
function functionsOf(text) {
  return new Map(Array.from(
    text.matchAll(/PANACHE_API ([^(]*?)(panache_\w+)\(([^)]*)\)/g),
    ([, result, name, list]) => [name, [result, ...(list === 'void' ? [] : list.split(','))]
      .map(kindOf)]));
}

const kCSharp = { int: 'int32_t', uint: 'uint32_t', UIntPtr: 'size_t', IntPtr: 'pointer' };

it('the file for C# declares the functions and kinds of errors of panache.h', () => {
  const text = read('apps/csharp/Panache.cs');
  const kinds = Array.from(header.matchAll(/PANACHE_ERROR_(\w+) =/g),
    ([, name]) => name.replaceAll('_', ''));
  expect(/enum ErrorKind \{([^}]*)\}/.exec(text)[1].toUpperCase().match(/\w+/g)).toEqual(kinds);
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
