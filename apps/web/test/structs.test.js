import { readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import * as structs from '../package/structs.js';

const header = readFileSync(new URL('../../../include/panache/panache.h', import.meta.url), 'utf8')
  .replaceAll(/\/\*[^]*?\*\//g, '');
const kKinds = {
  int32_t: 'i32', uint32_t: 'i32', float: 'f32', double: 'f64',
};
const inC = (name) => name.replaceAll(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

// [name, kind, count] of each field; a pointer of WebAssembly has 32 bits.
function fieldsOf(struct) {
  const [, body] = new RegExp(`typedef struct ${struct} \\{([^}]*)\\}`).exec(header);
  return body.split(';').map((text) => text.trim()).filter(Boolean).flatMap((declaration) => {
    const kind = declaration.includes('*') ? 'i32' : kKinds[declaration.split(' ')[0]];
    return [...declaration.matchAll(/(\w+)(?:\[(\d+)\])?\s*(?:,|$)/g)].map(
      ([, name, count]) => [name, kind, Number(count ?? 1)]);
  });
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
