// Styles of the input: the page says which one a clip shows, and takes it off.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import {
  chooseSave, download, drop as dropFiles, frames, models, pageFolder, phone, pictures, start, workFolder,
} from './browser.mjs';

const model = join(models, 'panache-int8.safetensors');
const remover = join(models, 'remover-int8.safetensors');
const { at, panache, remove } = workFolder();

let site, tab;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '4');
  panache('stylize', 'walk.bvh', '--model', model, '--style', 'old=1', '-o', 'old.bvh');
  site = await start();
  tab = await site.open();
});
after(async () => {
  await site.close();
  remove();
});

const button = (name) => tab.getByRole('button', { name, exact: true });
const looks = () => tab.locator('#looks');
const caption = () => tab.locator('#caption').textContent();
/** As if a person dropped the file on the view. */
async function drop(name, page = tab) {
  await dropFiles(page, '#view', [[name, readFileSync(at(name))]]);
  await page.waitForFunction((file) => window.page.source.file?.name === file, name);
}
const loads = () => site.requests.filter((request) => request.endsWith('/assets/remover-int8.safetensors')).length;
/** The largest distance between a joint of the input and the same of the output now, metres. */
const change = (page = tab) => page.evaluate(() => {
  const { player } = window.page.source;
  const a = player.parts('input').slice(), b = player.parts('styled');
  return Math.max(...Array.from({ length: 21 }, (_, j) =>
    Math.hypot(...[0, 1, 2].map((k) => a[7 * j + k] - b[7 * j + k]))));
});
function save() {
  return download(tab, () => chooseSave(tab, 'BVH'));
}

test('a clip that shows a style says so as the program does, and a neutral one does not', async () => {
  await frames(tab, 5);
  assert.equal(loads(), 0, 'the model is no part of the first load');
  assert.ok(await looks().isHidden());
  await drop('old.bvh');
  await looks().waitFor({ state: 'visible' });
  const [{ name, share }] = JSON.parse(panache('info', 'old.bvh', '--styles', '--json')).styles;
  assert.equal(name, 'old');
  assert.equal(await looks().locator('span').textContent(),
    `Looks like: old ${Math.round(100 * share)} %`);
  assert.ok(await change() === 0, 'nothing is taken off unasked');
  await tab.screenshot({ path: join(pictures, 'looks-like.png') });
  await drop('walk.bvh');
  await frames(tab, 5);
  assert.ok(await looks().isHidden());
  assert.equal(loads(), 1);
});

test('what is taken off is seen, and saved as the program does, byte for byte', async () => {
  await drop('old.bvh');
  await button('Take old off').click();
  assert.equal(await tab.locator('#removed').inputValue(), 'old');
  assert.equal(await button('Take old off').getAttribute('aria-pressed'), 'true');
  assert.equal(await caption(), 'old off');
  await frames(tab, 20);
  const far = await change();
  assert.ok(far > 0.03, `${far} m`);
  await tab.screenshot({ path: join(pictures, 'taken-off.png') });
  const options = ['--model', model, '--remover', remover, '--force'];
  for (const tempo of ['off', 'all', 'steps']) {
    await tab.evaluate((wanted) => window.page.store.set({ tempo: wanted }), tempo);
    panache('stylize', 'old.bvh', '--remove', 'old', '--timing', tempo, '-o', 'off.bvh', ...options);
    const saved = await save();
    assert.equal(saved.name, 'old-neutral.bvh');
    assert.deepEqual(saved.bytes, readFileSync(at('off.bvh')), tempo);
  }
  const [first] = JSON.parse(panache('info', 'off.bvh', '--styles', '--json')).styles;
  assert.notEqual(first.name, 'old');
  // Another style goes on what is left.
  await tab.evaluate(() => window.page.store.set({ styles: { proud: 1 } }));
  assert.equal(await caption(), 'old off + proud 1.00');
  panache('stylize', 'old.bvh', '--remove', 'old', '--style', 'proud=1', '-o', 'proud.bvh', ...options);
  assert.deepEqual((await save()).bytes, readFileSync(at('proud.bvh')));
  await tab.evaluate(() => window.page.store.set({ styles: {} }));
  // And it comes back.
  await button('Take old off').click();
  assert.equal(await tab.locator('#removed').inputValue(), '');
  await tab.waitForFunction(() => {
    const { player } = window.page.source;
    const input = [...player.parts('input')];
    return [...player.parts('styled')].every((x, i) => x === input[i]);
  });
  assert.deepEqual((await save()).bytes, readFileSync(at('old.bvh')));
});

test('the select lists all styles, and the walker\'s input is taken as what it says', async () => {
  const names = await tab.locator('#removed option').evaluateAll((all) => all.map(({ value }) => value));
  const header = readFileSync(remover);
  const { styles } = JSON.parse(
    header.toString('utf8', 8, 8 + Number(header.readBigUInt64LE()))).__metadata__;
  assert.deepEqual(names.toSorted(), ['', ...styles.trim().split('\n')].toSorted());
  const other = await site.open('neutral');
  const before = loads();
  await frames(other, 10);
  assert.equal(await change(other), 0);
  assert.equal(loads(), before);
  await other.locator('#removed').selectOption('gorilla');
  await other.waitForFunction(() => {
    const { player } = window.page.source;
    const input = [...player.parts('input')];
    return [...player.parts('styled')].some((x, i) => Math.abs(x - input[i]) > 0.01);
  });
  assert.equal(loads(), before + 1);
  await other.waitForFunction(() => location.hash === '#removed=gorilla');
  // What the walker did is saved so.
  await frames(other, 30);
  const { bytes } = await download(other, () => chooseSave(other, 'BVH'));
  const input = Buffer.from(await other.evaluate(() =>
    [...window.page.source.player.exportAs('.bvh', { which: 'input' })]));
  assert.notDeepEqual(bytes, input);
  await other.getByRole('button', { name: 'Undo', exact: true }).click();
  assert.equal(await other.locator('#removed').inputValue(), '');
  await other.close();
});

test('a link takes a style off, also from a disk, where nothing can be fetched', async () => {
  for (const url of [site.address, pathToFileURL(join(pageFolder, 'index.html')).href]) {
    const other = await site.open('removed=zombie', { url });
    assert.equal(await other.locator('#removed').inputValue(), 'zombie');
    await other.waitForFunction(() => window.page.removal.remover);
    await frames(other, 30);
    const far = await change(other);
    assert.ok(far > 0.005, `${url}: ${far} m`);
    await drop('old.bvh', other);
    await other.locator('#looks').waitFor({ state: 'visible' });
    await other.close();
  }
});

test('on a phone what a clip looks like fits below the view', async () => {
  const other = await site.open('neutral', phone);
  await drop('old.bvh', other);
  await other.locator('#looks').waitFor({ state: 'visible' });
  await other.evaluate(() => document.querySelector('#looks').scrollIntoView({ block: 'end' }));
  for (const part of ['#removed', '#looks', '#looks button']) {
    const { x, width, height } = await other.locator(part).boundingBox();
    assert.ok(x >= 0 && x + width <= 390, `${part}: ${x} ${width}`);
    if (part !== '#looks') assert.ok(height >= 38, `${part}: ${height}`);
  }
  await other.screenshot({ path: join(pictures, 'looks-like-phone.png') });
  await other.close();
});
