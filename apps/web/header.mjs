// Writes package/header.ts: the structs, constants, kinds of errors and functions of panache.h, and
// the page's functions, for the package.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';

const at = (path) => new URL(path, import.meta.url);
const header = readFileSync(at('../../include/panache/panache.h'), 'utf8')
  .replaceAll(/\/\*[^]*?\*\//g, '').replaceAll('\\\n', '');
const camel = (name) => name.toLowerCase().replaceAll(/_(.)/g, (_, letter) => letter.toUpperCase());

const structs = new Map();  // [name, type, count] of each field, by the struct's name.
// The fields of a declaration; those of a struct in it have its name in front.
function fieldsOf(declaration) {
  const [type] = declaration.replaceAll(/\bconst\b/g, '').trim().split(/\W/);
  const names = declaration.matchAll(/(\w+)(?:\[(\d+)\])?\s*(?:,|$)/g);
  const isPointer = declaration.includes('*'), inner = isPointer ? undefined : structs.get(type);
  const kind = isPointer ? 'i32' : { float: 'f32', double: 'f64' }[type] ?? 'i32';
  return [...names].flatMap(([, name, count = 1]) => inner?.map(
    ([field, ...rest]) => [`${name}_${field}`, ...rest]) ?? [[name, kind, +count]]);
}
for (const [, body, name] of header.matchAll(/typedef struct \w+ \{([^]*?)\} (\w+);/g)) {
  structs.set(name, body.split(';').filter((text) => text.trim()).flatMap(fieldsOf));
}

// The layout for WebAssembly, where pointers have 32 bits, and the values of the struct's macro.
function layOut(name, fields) {
  let size = 0, align = 4;
  const macro = new RegExp(`#define ${name.toUpperCase()}\\s+\\{(.*)\\}`).exec(header)?.[1] ?? '';
  const values = Array.from(macro.matchAll(/sizeof|NULL|[\d.]+/g), ([text]) => Number(text) || 0);
  const layout = {}, initial = {};
  for (const [field, type, count] of fields) {
    const bytes = type === 'f64' ? 8 : 4;
    const begin = Math.ceil(size / bytes) * bytes, own = values.splice(0, count);
    layout[camel(field)] = [begin, type, count];
    if (own.length) initial[camel(field)] = count === 1 ? own[0] : own;
    size = begin + bytes * count;
    align = Math.max(align, bytes);
  }
  size = Math.ceil(size / align) * align;
  if (macro) initial.structSize = size;
  return { size, initial, layout };
}
// All arguments are numbers: handles and addresses, too.
const functions = Array.from(
  [header, ...readdirSync(at('wasm')).map((name) => readFileSync(at(`wasm/${name}`), 'utf8'))].join('')
    .matchAll(/PANACHE_(?:API|EXPORT) [^(]*?(panache_\w+)\(([^)]*)\)/g),
  ([, name, list]) => `  ${name}(${list === 'void' ? '' : list.split(',').map((_, i) => `a${i}: number`)})` +
    ': number;\n');
const constants = Array.from(header.matchAll(/PANACHE_(?!ERROR_)(\w+) = (\d+)/g),
  ([, name, value]) => `${camel(`k_${name}`)} = ${value}`);
const kinds = Array.from(header.matchAll(/PANACHE_ERROR_(\w+) =/g), ([, name]) => camel(name));
const lines = Array.from(structs, ([name, fields]) =>
  `export const ${camel(name.replace('panache', 'k'))} = ${JSON.stringify(layOut(name, fields))} as const;\n`);
writeFileSync(at('package/header.ts'),
  `export const ${constants.join(', ')};\n` +
  `export const kErrorKinds = ${JSON.stringify(kinds)} as const;\n${lines.join('')}` +
  `export interface Functions {\n${functions.join('')}}\n`);
