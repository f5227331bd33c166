// The page in Debian's Firefox.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { drop, frames, models, nativeHashes, pictures, startFirefox, styledParts } from './browser.mjs';

const model = join(models, 'panache-int8.safetensors');
const folder = mkdtempSync(join(tmpdir(), 'panache-page-'));
const at = (name) => join(folder, name);
const panache = (...given) => execFileSync(process.env.PANACHE_PROGRAM, given, { cwd: folder });

let site, tab;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  panache('stylize', 'walk.bvh', '--model', model, '--style', 'giant=1', '-o', 'giant.bvh');
  site = await startFirefox();
  tab = await site.open('');
});
after(async () => {
  await site.close();
  rmSync(folder, { recursive: true });
});

test('the page opens and moves', async () => {
  const then = await styledParts(tab);
  await frames(tab, 3);
  assert.notDeepEqual(await styledParts(tab), then);
  assert.equal(await tab.locator('#style-old').inputValue(), '1');
  await tab.screenshot({ path: join(pictures, 'firefox.png') });
});

test('styled frames have the bits of the library', async () => {
  const here = await tab.evaluate(() => window.page.panache.goldenHash());
  for (const hash of nativeHashes()) assert.equal(here, hash);
});

test('a clip opens, is styled by its slider, and is what the program makes of it', async () => {
  await drop(tab, '#view', [['walk.bvh', readFileSync(at('walk.bvh'))]]);
  await tab.waitForFunction(() => window.page.source.kind === 'clip');
  await tab.getByRole('button', { name: 'Neutral', exact: true }).click();
  await tab.locator('#style-giant').fill('1');
  await frames(tab, 2);
  const bytes = await tab.evaluate(() => [...window.page.source.player.exportAs('.bvh')]);
  assert.deepEqual(Buffer.from(bytes), readFileSync(at('giant.bvh')));
});

test('a style is learnt', async () => {
  await tab.getByRole('button', { name: 'Learn a style …', exact: true }).click();
  await drop(tab, '#learn', ['walk.bvh', 'giant.bvh'].map((name) => [name, readFileSync(at(name))]));
  await tab.waitForFunction(() => document.querySelectorAll('.slot.filled').length === 2);
  await tab.locator('#learn-name').fill('lumbering');
  await tab.getByRole('button', { name: 'Learn', exact: true }).click();
  await tab.locator('#style-lumbering').waitFor();
  assert.equal(await tab.locator('#style-lumbering').inputValue(), '1');
});
