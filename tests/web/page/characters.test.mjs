// Characters with meshes of their own: made to walk, fitted in, and seen through.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { chooseSave, download, frames, pictures, start, workFolder } from './browser.mjs';
import { boxCharacter } from './character.mjs';

const { at, panache, remove } = workFolder();

let site, tab;
before(async () => {
  site = await start();
  tab = await site.open('neutral', { steady: true });
});
after(async () => {
  await site.close();
  remove();
});

async function open(name, ...others) {
  await tab.setInputFiles('#file', [name, ...others].map(at));
  await tab.waitForFunction((file) => window.page.source.file?.name === file, name);
}
async function openBoxes(name, options) {
  writeFileSync(at(name), boxCharacter(options));
  await open(name);
  assert.ok(await tab.evaluate(() => window.page.source.own !== null), 'its meshes are shown');
}
const alertText = () => tab.locator('#alert').textContent();
const pause = () => tab.evaluate(() => {
  const play = document.querySelector('#play');
  if (play.textContent === 'Pause') play.click();
});
const walks = /has no motion of its own, so the walker's walk is put on it/;

/** Waits until a foot has gone a good step ahead of the other, and then the other ahead of it. */
const takesSteps = () => tab.waitForFunction(() => {
  const parts = window.page.source.player.parts('input');
  const [left, right] = [15, 19].map((foot) => [parts[7 * foot], parts[7 * foot + 2]]);
  window.lead ??= new Set();
  const far = Math.hypot(left[0] - right[0], left[1] - right[1]);
  if (far > 0.25) window.lead.add(left[1] > right[1]);
  return window.lead.size === 2;
});

test('a character without motion walks, and a note says why', async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  const [head, motion] = readFileSync(at('walk.bvh'), 'utf8').split('MOTION');
  const [, , time, ...lines] = motion.split('\n');
  writeFileSync(at('pose.bvh'), [`${head}MOTION`, 'Frames: 1', time, lines[0], ''].join('\n'));
  writeFileSync(at('still.glb'), boxCharacter());
  writeFileSync(at('held.glb'), boxCharacter({ motion: 0, name: 'T-Pose' }));
  for (const name of ['still.glb', 'held.glb', 'pose.bvh']) {
    await tab.evaluate(() => delete window.lead);
    await open(name);
    assert.match(await alertText(), walks, name);
    await takesSteps();
    assert.equal(await tab.evaluate(() => window.page.source.own !== null), name !== 'pose.bvh');
  }
  // What is saved is the character with that walk.
  await open('still.glb');
  const { name, bytes } = await download(tab, () => chooseSave(tab, 'glb'));
  assert.equal(name, 'still-neutral.glb');
  writeFileSync(at(name), bytes);
  assert.match(panache('info', name), /721 frames/);
});

test('a character with a motion keeps it, and gets that of a file opened with it', async () => {
  await openBoxes('wave.glb', { motion: 1 });
  assert.doesNotMatch(await alertText(), walks);
  assert.equal(await tab.evaluate(() => window.page.source.file.clips[0].name), 'motion');
  await tab.setInputFiles('#file', [at('walk.bvh'), at('still.glb')]);
  await tab.waitForFunction(() => window.page.source.file?.name === 'walk-on-still.glb');
  assert.doesNotMatch(await alertText(), walks);
});

test('a zip of characters without motion has their walks', async () => {
  await open('still.glb', 'held.glb');
  const { bytes } = await download(tab, () => chooseSave(tab, 'zip'));
  writeFileSync(at('all.zip'), bytes);
  mkdirSync(at('all'));
  execFileSync('cmake', ['-E', 'tar', 'xf', at('all.zip')], { cwd: at('all') });
  assert.deepEqual(readdirSync(at('all')).filter((name) => name.endsWith('.bvh')).sort(),
    ['held-neutral.bvh', 'still-neutral.bvh']);
  assert.match(panache('info', 'all/held-neutral.bvh'), /721 frames/);
});

/** The view as the boxes are seen in it, a letter for each pixel: S solid, G through a ghost, B the
 * inside, which is to be seen nowhere, - anything else. */
const look = () => tab.evaluate(() => {
  const { stage } = window.page;
  stage.draw(0);
  const { width, height } = stage.canvas;
  const context = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
  context.drawImage(stage.canvas, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  let pixels = '';
  for (let k = 0; k < data.length; k += 4) {
    const [r, g, b] = data.subarray(k, k + 3);
    pixels += b > r + 60 && b > g + 60 ? 'B' : g < r + 35 || g < b + 35 ? '-' : r < 60 ? 'S' : 'G';
  }
  return { width, height, pixels };
});
const count = ({ pixels }, kind) => pixels.split(kind).length - 1;

test('Fit takes in all of the mesh: wings, a hat and a tail, from every side', async () => {
  await tab.evaluate(() => window.page.store.set({ view: 'styled', trail: false }));
  const wings = [[-2.6, 1.3, -0.2], [2.6, 1.42, -0.1], 'chest'];
  const hat = [[-0.05, 1.7, -0.05], [0.05, 3.4, 0.05], 'head'];
  const tail = [[-0.05, 0.9, -3], [0.05, 1, 0], 'hips'];
  for (const [name, extra] of [['bare', []], ['winged', [wings]], ['hat', [hat]], ['tail', [tail]],
    ['all', [wings, hat, tail]]]) {
    await openBoxes(`${name}.glb`, { motion: 0.5, extra });
    await pause();
    for (const angle of ['face', 'front', 'side', 'top']) {
      await tab.locator('#angle').selectOption(angle);
      if (angle === 'face') await tab.locator('#fit').click();
      await frames(tab, 2);
      const { width, height, pixels } = await look();
      const what = `${name}, ${angle}`;
      if (angle === 'face') await tab.screenshot({ path: join(pictures, `fit-${name}.png`) });
      let [left, right, top, bottom] = [width, -1, height, -1];
      for (let k = pixels.indexOf('S'); k >= 0; k = pixels.indexOf('S', k + 1)) {
        const x = k % width, y = Math.floor(k / width);
        [left, right] = [Math.min(left, x), Math.max(right, x)];
        [top, bottom] = [Math.min(top, y), Math.max(bottom, y)];
      }
      assert.ok(left > 0 && right < width - 1 && top > 0 && bottom < height - 1,
        `${what}: ${left} to ${right} of ${width}, ${top} to ${bottom} of ${height}`);
      // Nor is it lost in the view.
      const share = Math.max((right - left) / width, (bottom - top) / height);
      assert.ok(share > (angle === 'top' ? 0.15 : 0.4), `${what}: ${share}`);
    }
  }
});

test('the ghost of a textured character is whole, and nothing inside it is seen', async () => {
  await tab.evaluate(() => window.page.store.set({ view: 'over', styles: { gorilla: 1.5 } }));
  for (const blend of [false, true]) {
    const name = blend ? 'blended' : 'opaque';
    await openBoxes(`${name}.glb`, { inside: true, blend });
    await frames(tab, 60);
    await pause();
    await tab.locator('#fit').click();
    await frames(tab, 2);
    await tab.screenshot({ path: join(pictures, `ghost-${name}.png`) });
    const over = await look();
    await tab.evaluate(() => (window.page.stage.comparing = true));
    const input = await look();
    await tab.evaluate(() => (window.page.stage.comparing = false));
    assert.equal(count(over, 'B'), 0, name);
    assert.equal(count(input, 'B'), 0, name);
    assert.ok(count(over, 'G') > 0.1 * count(input, 'S'), `${name}: ${count(over, 'G')}`);
    // Wherever the input is seen alone, its ghost is seen, or the styled body is.
    let seen = 0, missing = 0;
    for (let k = 0; k < input.pixels.length; ++k) {
      if (input.pixels[k] !== 'S') continue;
      ++seen;
      if (over.pixels[k] === '-') ++missing;
    }
    // Half a pixel along the outline: a hundredth.
    assert.ok(seen > 1000 && missing < 0.01 * seen, `${name}: ${missing} of ${seen}`);
  }
});
