import { readdirSync, readFileSync } from 'node:fs';

import { expect, it } from 'vitest';

const folder = new URL('../src/', import.meta.url);
const files = readdirSync(folder).filter((name) => name.endsWith('.ts'));

// Files that import only from those that are left out already can be left out, too.
it('the files of the page import each other without circles', () => {
  const left = new Map(files.map((name) => [name.slice(0, -3), Array.from(
    readFileSync(new URL(name, folder), 'utf8').matchAll(/from '\.\/(\w+)'/g), ([, from]) => from)]));
  for (let before = Infinity; left.size < before;) {
    before = left.size;
    for (const [name, from] of left) if (!from.some((one) => left.has(one))) left.delete(name);
  }
  expect([...left.keys()]).toEqual([]);
});
