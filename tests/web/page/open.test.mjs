import assert from 'node:assert/strict';
import { readdir, readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { brotliDecompressSync } from 'node:zlib';

import { frames, nativeHashes, pageFolder, setStyle, start, styledParts } from './browser.mjs';

let site;
before(async () => (site = await start()));
after(() => site.close());

/** The page draws on while a slider is dragged. */
async function draggedSlider(tab) {
  await setStyle(tab, 'old', '0');
  await tab.locator('#style-old').scrollIntoViewIfNeeded();  // Outside the window nothing is dragged.
  const box = await tab.locator('#style-old').boundingBox();
  const moveTo = (share) => tab.mouse.move(box.x + 20 + share * (box.width - 40),
    box.y + box.height / 2);
  const seen = new Set();
  await moveTo(0);
  await tab.mouse.down();
  for (let i = 1; i <= 20; ++i) {
    await moveTo(i / 20);
    await frames(tab, 2);
    seen.add(await tab.evaluate(() => window.page.store.settings.styles.old));
  }
  await tab.mouse.up();
  // Each place of the mouse is another strength, in the frames that are drawn before the next.
  assert.ok(seen.size > 15, `${[...seen]}`);
}

test('the page moves after opening, from any path, with the bits of the library', async () => {
  const tab = await site.open('neutral', { every: 1 });
  const then = await styledParts(tab);
  await frames(tab, 5);
  assert.notDeepEqual(await styledParts(tab), then);
  // Three hundred styled frames.
  const here = await tab.evaluate(() => window.page.panache.goldenHash());
  for (const hash of nativeHashes()) assert.equal(here, hash);
  await draggedSlider(tab);
  await tab.close();
});

test('the walker walks while the styles are still on their way', async () => {
  let release;
  const held = new Promise((done) => (release = done));
  const tab = await site.open('old=1.5&view=over', { route: ['**/panache-int8.safetensors', async (route) => {
    await held;
    await route.continue();
  }] });
  await tab.waitForFunction(() => window.page?.frames > 2);
  const pose = () => styledParts(tab);
  const then = await pose();
  await frames(tab, 5);
  assert.notDeepEqual(await pose(), then);
  assert.equal(await tab.evaluate(() => window.page.ready), false);
  assert.ok(await tab.locator('#styles-wait progress').isVisible());
  assert.ok(!(await tab.locator('#search').isVisible()));
  assert.ok(!(await tab.locator('#wait').isVisible()));
  release();
  await tab.waitForFunction(() => window.page?.ready);
  assert.ok(await tab.locator('#search').isVisible());
  assert.equal(await tab.locator('#style-old').inputValue(), '1.5');
  assert.ok(await tab.locator('#undo').isDisabled());
  await tab.close();
});

test('a load that fails says so', async () => {
  for (const name of ['panache.wasm', 'panache-int8.safetensors']) {
    const tab = await site.open('neutral', { route: [`**/${name}`, (route) => route.abort()],
      fails: true });
    await tab.getByText(`assets/${name} did not load; try again, or reload the page`).waitFor();
    await tab.close();
  }
});

test('the page runs from a disk, without any server', async () => {
  const tab = await site.open('neutral', { url: pathToFileURL(join(pageFolder, 'index.html')).href });
  await frames(tab);
  await tab.close();
});

test('a visitor first sees a neutral walk and an old one, side by side, and what to do', async () => {
  const tab = await site.open('', { steady: true });
  assert.equal(await tab.locator('#style-old').inputValue(), '1');
  assert.equal(await tab.evaluate(() => document.body.dataset.view), 'side');
  assert.match(await tab.locator('#hint').textContent(), /click a style/);
  assert.ok(await tab.locator('#hint').isVisible());
  await frames(tab, 20);
  const heads = [0, 0];
  for (let i = 0; i < 10; ++i) {
    await frames(tab, 4);
    const now = await tab.evaluate(() => ['input', 'styled'].map((which) =>
      window.page.source.player.parts(which)[7 * 4 + 1]));
    now.forEach((height, which) => (heads[which] += height / 10));
  }
  assert.ok(heads[1] < heads[0] - 0.01, `who is old is bowed: ${heads}`);
  const pose = () => tab.evaluate(() => [...window.page.source.player.parts('input')]);
  const before = await pose();
  await frames(tab, 5);
  assert.notDeepEqual(await pose(), before);
  assert.equal(await tab.evaluate(() => location.hash), '');
  await tab.close();
});

// What comes late is not counted: src/late.ts.
test('the first load is under 1.22 MB compressed, model included', async () => {
  const late = ['gif.js', 'neutral.safetensors', 'remover-int8.safetensors', 'zip.js'];
  const fromDisk = ['model.js', 'neutral.js', 'remover.js', 'walker.js', 'wasm.js'];
  const files = (await readdir(pageFolder, { recursive: true, withFileTypes: true }))
    .filter((entry) => entry.isFile() && entry.name !== 'licences.txt');
  let bytes = 0;
  for (const { path, name } of files) {
    if (name.endsWith('.br') || [...late, ...fromDisk].includes(name)) continue;
    const packed = await readFile(join(path, `${name}.br`));
    assert.deepEqual(brotliDecompressSync(packed), await readFile(join(path, name)), name);
    bytes += packed.length;
  }
  console.log(`first load: ${bytes} bytes`);
  assert.ok(bytes < 1.22e6, `${bytes} bytes`);
  for (const name of [...late, ...fromDisk]) {
    assert.ok(!site.requests.some((request) => request.startsWith('http') &&
      request.endsWith(`/${name}`)), `${name} is asked for`);
  }
});

test('no request leaves the page\'s own origin', () => {
  assert.ok(site.requests.length > 5);
  for (const request of site.requests) {
    const own = request.startsWith(site.address) || request.startsWith('file:') ||
      request.startsWith('data:') || request.startsWith('blob:');
    assert.ok(own, request);
  }
});
