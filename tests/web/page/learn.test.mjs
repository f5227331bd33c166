import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import {
  download, drop, frames, listen, models, pictures, start, told, unfold, workFolder,
} from './browser.mjs';

const model = join(models, 'panache-int8.safetensors');
const { at, panache, view, remove } = workFolder();
const file = (name) => [name, readFileSync(at(name))];

let site, tab;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  panache('stylize', 'walk.bvh', '--model', model, '--style', 'gorilla=1', '-o', 'lumbering.bvh');
  site = await start();
  tab = await site.open();
  await unfold(tab);
  await listen(tab);
});
after(async () => {
  await site.close();
  remove();
});

const button = (name) => tab.getByRole('button', { name, exact: true });
const error = async () => {
  await tab.locator('#learn .error').waitFor({ state: 'visible' });
  return tab.locator('#learn .error').textContent();
};
const what = (slot) => tab.locator(`[data-slot=${slot}] .what`).textContent();
const report = () => tab.locator('#learn-report').textContent();
const styles = () => tab.evaluate(() => window.page.panache.styles.map(({ name }) => name));

/** Names the style and learns it; how long its slider took to come, milliseconds. */
async function learn(name) {
  await tab.locator('#learn-name').fill(name);
  return tab.evaluate((style) => new Promise((done) => {
    const begin = performance.now();
    const look = () => {
      const report = document.querySelector('#learn-report');
      const row = document.getElementById(`style-${encodeURIComponent(style)}`);
      const failed = !document.querySelector('#learn .error').hidden;
      if (failed || (row && !report.hidden)) done(performance.now() - begin);
      else requestAnimationFrame(look);
    };
    document.querySelector('#learn-go').click();
    look();
  }), name);
}

test('two clips that are dropped become a style with a slider, as panache learn makes it', async () => {
  await button('Learn a style …').click();
  await drop(tab, '#learn', [file('walk.bvh'), file('lumbering.bvh')]);
  await tab.waitForFunction(() => document.querySelectorAll('.slot.filled').length === 2);
  assert.equal(await what('neutral'), 'walk.bvh, 3.0 s');
  const first = await learn('lumbering');
  const second = await learn('lumbering');  // Replaces it.
  console.log(`a slider after ${Math.round(first)} and ${Math.round(second)} ms`);
  assert.equal((await told(tab)).strengths.lumbering, 1);
  assert.ok((await styles()).includes('lumbering'));

  const said = JSON.parse(panache('learn', 'walk.bvh', 'lumbering.bvh', '--name', 'lumbering',
    '--into', 'mine.safetensors', '--json'));
  const [pair] = said.pairs;
  assert.deepEqual(pair.warnings, []);
  const text = await report();
  assert.ok(text.includes(`match ${pair.match.toFixed(2)}, ` +
    `tempo ${(1 / pair.tempo).toFixed(2)}×`), text);
  assert.ok(text.includes(`Good: joints ${said.held_back_cm.toFixed(1)} cm off on the ` +
    'held-back last quarter (its mean posture alone ' +
    `${said.mean_posture_cm.toFixed(1)}, no style ${said.untouched_cm.toFixed(1)})`), text);
  // A figure at each end, links between them: ink in all three parts of the plot.
  const ink = await tab.evaluate(() => {
    const canvas = document.querySelector('#learn-report canvas');
    const { width, height } = canvas;
    const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    const ink = [0, 0, 0];
    for (let k = 3; k < data.length; k += 4) {
      if (data[k]) ++ink[Math.floor((3 * k) / data.length)];
    }
    return ink;
  });
  assert.ok(ink.every((count) => count > 300), `${ink}`);
  await tab.locator('#learn-report').scrollIntoViewIfNeeded();
  await tab.screenshot({ path: join(pictures, 'learn.png') });
});

test('the style is saved as a file that the program takes, and opens again by drop', async () => {
  const { name, bytes } = await download(tab, () => button('Save style file').click());
  assert.equal(name, 'lumbering.safetensors');
  writeFileSync(at('lumbering.safetensors'), bytes);
  writeFileSync(at('copy.safetensors'), readFileSync(model));
  panache('styles', 'copy.safetensors', '--add', 'lumbering.safetensors');
  assert.match(panache('styles', 'copy.safetensors'), /lumbering/);

  await button('Remove lumbering').click();
  assert.equal(await tab.locator('#style-lumbering').count(), 0);
  assert.ok(!(await styles()).includes('lumbering'));
  assert.doesNotMatch(await tab.locator('#caption').textContent(), /lumbering/);
  await drop(tab, '#view', [file('lumbering.safetensors')]);
  await tab.locator('#style-lumbering').waitFor();
  // Six figures from the clip.
  const picture = tab.locator('.card:has([data-style=lumbering]) img.thumbnail');
  await picture.scrollIntoViewIfNeeded();
  const size = await picture.evaluate(async (image) => {
    await image.decode();
    return [image.naturalWidth / image.naturalHeight, image.clientWidth / image.clientHeight];
  });
  for (const ratio of size) assert.ok(Math.abs(ratio - 540 / 190) < 0.05, `${size}`);
  assert.equal(await tab.locator('.card:has([data-style=old]) img.thumbnail').count(), 0);
  await tab.screenshot({ path: join(pictures, 'thumbnail.png') });
  assert.equal((await told(tab)).strengths.lumbering, 1);
  const again = await download(tab, () => button('Save lumbering as a style file').click());
  assert.deepEqual(again.bytes, bytes);
});

test('what is wrong with clips, names and files is said with the library\'s sentence', async () => {
  panache('convert', 'walk.bvh', '-o', 'walk.glb');
  panache('walker', '-o', 'short.bvh', '--seconds', '0.8', '--speed', '1.6');
  await learn('old');
  assert.match(await error(), /^the model: has a style 'old' already; /);
  await learn('a=b');
  assert.match(await error(), /'='/);
  await drop(tab, '[data-slot=styled]', [file('walk.glb')]);
  await tab.waitForFunction(() => document.querySelector('[data-slot=styled] .what').textContent
    .startsWith('walk.glb'));
  await learn('other');
  assert.match(await error(), /^walk\.bvh and walk\.glb: are the same motion, /);
  writeFileSync(at('cut.bvh'), readFileSync(at('walk.bvh')).subarray(0, 400));
  await drop(tab, '[data-slot=styled]', [file('cut.bvh')]);
  assert.match(await error(), /^cut\.bvh:\d+:\d+: /);
  // A short clip is learnt from, with a warning.
  await drop(tab, '[data-slot=styled]', [file('short.bvh')]);
  await tab.waitForFunction(() => document.querySelector('[data-slot=styled] .what').textContent
    .startsWith('short.bvh'));
  await learn('short');
  const warnings = await tab.locator('#learn .warning').allTextContents();
  assert.match(warnings.join('\n'), /is no better than the input[^]*short\.bvh/);
  const alert = tab.locator('#alert');
  writeFileSync(at('junk.safetensors'), 'no model');
  await drop(tab, '#view', [file('junk.safetensors')]);
  await alert.waitFor({ state: 'visible' });
  assert.match(await alert.textContent(), /^junk\.safetensors: /);
  await drop(tab, '#view', [file('lumbering.safetensors')]);
  await tab.waitForFunction(() =>
    document.querySelector('#alert').textContent.includes('has a style \'lumbering\' already'));
  await frames(tab);
});

test('a style is learnt from what is seen: recorded walk and sliders', async () => {
  await button('Proud robot').click();
  const record = (slot) => tab.locator(`[data-slot=${slot}]`).getByRole('button',
    { name: /^(Record|Take) / });
  await record('neutral').click();
  await record('styled').click();
  // Seconds of the walk, however few frames a second the machine draws.
  await tab.waitForTimeout(3500);
  await record('neutral').click();
  await record('styled').click();
  await tab.waitForFunction(() => /robot.*proud.*s$/.test(
    document.querySelector('[data-slot=styled] .what').textContent));
  await learn('mix');
  assert.ok((await styles()).includes('mix'), await report());
  // What was recorded as styled is far from the input: centimetres of the joints.
  const far = Number(/no style ([\d.]+)/.exec(await report())?.[1]);
  assert.ok(far > 3, `${far}`);
  assert.equal((await told(tab)).strengths.mix, 1);
  assert.equal((await told(tab)).strengths.proud, 0);
});

test('one clip that is dropped becomes a style with a slider', async () => {
  await tab.close();
  tab = await site.open();
  await unfold(tab);
  await listen(tab);
  await button('Learn a style …').click();
  await drop(tab, '#learn', [file('lumbering.bvh')]);
  await tab.waitForFunction(() => /lumbering/.test(
    document.querySelector('[data-slot=styled] .what').textContent));
  await learn('alone');
  assert.ok((await styles()).includes('alone'), await report());
  assert.match(await report(), /Without a neutral clip: \d+ other people move alike/);
});

test('a model opens by drop, and panache view --model shows the page with it', async (t) => {
  await drop(tab, '#view', [file('mine.safetensors')]);
  await tab.waitForFunction(() => !document.querySelector('#style-mix'));
  assert.ok((await styles()).includes('lumbering') && !(await styles()).includes('mix'));
  await tab.close();
  const url = await view(t, '--model', 'mine.safetensors');
  if (!url) return t.skip('this build has no server for the page');
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/\?model=mine\.safetensors$/);
  const served = await site.open('lumbering=1', { url });
  assert.equal(await served.locator('#style-lumbering').inputValue(), '1');
  await served.close();
});
