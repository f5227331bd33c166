// Strength over time, and what is taken away.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import {
  chooseSave, doubleClick, download, frames, models, pictures, setStyle, start, unfold, workFolder,
} from './browser.mjs';

const model = join(models, 'panache-int8.safetensors');
const { at, panache, remove } = workFolder();

let site, tab;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  panache('walker', '-o', 'stroll.bvh', '--seconds', '2', '--speed', '0.8');
  site = await start();
  tab = await site.open();
  await unfold(tab);
  await tab.setInputFiles('#file', [at('walk.bvh'), at('stroll.bvh')]);
  await tab.waitForFunction(() => window.page.source.kind === 'clip');
  await button('Pause').click();
});
after(async () => {
  await site.close();
  remove();
});

const button = (name) => tab.getByRole('button', { name, exact: true });
const keys = () => tab.evaluate(() => window.page.store.settings.keys.old ?? []);
const seek = async (share) => {
  await tab.locator('#scrub').fill(String(share));
  await frames(tab, 5);
};
const save = (what) => download(tab, () => chooseSave(tab, what));
/** What counts as a change of its own for undo. */
const pause = () => tab.waitForTimeout(550);

test('keyframes are added, moved and removed with the mouse', async () => {
  await button('Keyframes').click();
  await tab.locator('#key-style').selectOption('old');
  const field = await tab.locator('.key-field').boundingBox();
  const pointAt = (x, strength) =>
    [field.x + x * field.width, field.y + ((2 - strength) / 2.5) * field.height];
  await tab.mouse.click(...pointAt(0.25, 0));
  await tab.mouse.click(...pointAt(0.75, 1));
  const [a, b] = await keys();
  const whole = 3 - 1 / 60;
  // A pixel across, and one down.
  const [across, down] = [whole / field.width, 2.5 / field.height];
  for (const [key, seconds, strength] of [[a, 0.25 * whole, 0], [b, 0.75 * whole, 1]]) {
    assert.ok(Math.abs(key[0] - seconds) <= across + 1e-3, `${key}`);
    assert.ok(Math.abs(key[1] - strength) <= down + 0.01, `${key}`);
  }
  await pause();
  await tab.mouse.move(...pointAt(0.75, 1));
  await tab.mouse.down();
  await tab.mouse.move(...pointAt(0.6, 1.4), { steps: 4 });
  await tab.mouse.up();
  const dragged = (await keys())[1];
  assert.ok(Math.abs(dragged[0] - 0.6 * whole) <= across + 1e-3, `${dragged}`);
  assert.ok(Math.abs(dragged[1] - 1.4) <= down + 0.01, `${dragged}`);
  await frames(tab, 5);
  await tab.screenshot({ path: join(pictures, 'keys.png') });
  await tab.waitForTimeout(1000);
  await doubleClick(tab, ...pointAt(0.6, 1.4));
  assert.equal((await keys()).length, 1);
  // A double click on an empty place leaves one key.
  await doubleClick(tab, ...pointAt(0.9, 0.5));
  assert.equal((await keys()).length, 2);
  await pause();
  await tab.keyboard.press('Delete');
  assert.equal((await keys()).length, 1);
  await button('Undo').click();
  await button('Undo').click();
  assert.deepEqual((await keys())[1], dragged);
  await button('Redo').click();
  await button('Redo').click();
  assert.equal((await keys()).length, 1);
  await button('Clear').click();
  assert.deepEqual(await keys(), []);
});

test('keyframes are added, moved and removed with the keyboard', async () => {
  await seek(0.5);
  await setStyle(tab, 'old', '0.5');
  await tab.locator('#view').focus().catch(() => {});
  await tab.evaluate(() => document.activeElement.blur());
  await tab.keyboard.press('k');
  const [[seconds, strength]] = await keys();
  assert.ok(Math.abs(seconds - (3 - 1 / 60) / 2) < 0.003, `${seconds}`);
  assert.equal(strength, 0.5);
  await pause();
  await tab.keyboard.press('ArrowUp');
  await tab.keyboard.press('Shift+ArrowRight');
  const [[later, more]] = await keys();
  assert.ok(Math.abs(later - seconds - 10 / 60) < 0.002, `${later}`);
  assert.equal(more, 0.55);
  await pause();
  await tab.keyboard.press('Delete');
  assert.deepEqual(await keys(), []);
  await tab.keyboard.press('Control+z');
  assert.deepEqual(await keys(), [[later, more]]);
  await tab.keyboard.press('Control+z');
  assert.deepEqual(await keys(), [[seconds, strength]]);
});

test('what is seen follows the keyframes, and the slider sets one', async () => {
  await tab.evaluate(() => window.page.store.set({ styles: {}, keys: { old: [[0, 0], [2, 1]] } }));
  await seek(0.335);
  const now = Number(await tab.locator('#style-old').inputValue());
  assert.ok(Math.abs(now - 0.5) < 0.02, `${now}`);
  assert.equal(await tab.locator('#caption').textContent(), 'old over time');
  await setStyle(tab, 'old', '1.5');
  assert.equal((await keys()).length, 3);
  assert.equal((await keys())[1][1], 1.5);
  // Something is changed by it in the pose itself.
  const head = () => tab.evaluate(() => [...window.page.source.player.parts('styled')]
    .slice(7 * 4, 7 * 4 + 3));
  await frames(tab, 5);
  const bent = await head();
  await tab.waitForTimeout(550);  // What is done within half a second counts as one.
  await button('Reset Old').click();
  assert.deepEqual(await keys(), []);
  await seek(0.335);
  assert.notDeepEqual(await head(), bent);
  await tab.keyboard.press('Control+z');
  assert.equal((await keys()).length, 3);
});

test('what is saved has the keyframes: the file is what the program makes of the same table', async () => {
  await tab.evaluate(() => window.page.store.set({ keys: { old: [[0.25, 0], [1.5, 1.2], [2, 0.3]] } }));
  writeFileSync(at('keys.csv'), 'seconds,old\n0.25,0\n1.5,1.2\n2,0.3\n');
  panache('stylize', 'walk.bvh', '--model', model, '--strengths', 'keys.csv', '-o', 'keyed.bvh');
  const { name, bytes } = await save('BVH');
  assert.equal(name, 'walk-old.bvh');
  assert.deepEqual(bytes, readFileSync(at('keyed.bvh')));
  writeFileSync(at('keyed.glb'), (await save('GLB')).bytes);
  const frameCount = (file) => Number(/(\d+) frames/.exec(panache('info', file))[1]);
  assert.equal(frameCount('keyed.glb'), frameCount('keyed.bvh'));
  // The address brings them back.
  const link = await tab.evaluate(() => location.hash);
  assert.equal(link, '#keys.old=0.25_0*1.5_1.2*2_0.3');
});

test('a VRMA is what the program converts to', async () => {
  const { name, bytes } = await save('VRMA');
  assert.equal(name, 'walk-old.vrma');
  writeFileSync(at('page.vrma'), bytes);
  panache('convert', 'keyed.bvh', '-o', 'keyed.vrma');
  panache('convert', 'keyed.vrma', '-o', 'a.bvh');
  panache('convert', 'page.vrma', '-o', 'b.bvh');
  const numbers = (path) => readFileSync(at(path), 'utf8').split('MOTION')[1].trim().split(/\s+/)
    .map(Number).filter(Number.isFinite);
  const [a, b] = [numbers('a.bvh'), numbers('b.bvh')];
  assert.equal(a.length, b.length);
  // The page's is made of frames that no BVH has rounded: to a hundredth of a degree or centimetre.
  const far = Math.max(...a.map((value, i) => {
    const off = Math.abs(value - b[i]) % 360;
    return Math.min(off, 360 - off);
  }));
  assert.ok(far < 0.02, `${far}`);
});

test('all opened files come in one zip, each in three formats', async () => {
  const { name, bytes } = await save('zip');
  assert.equal(name, '2 motions.zip');
  writeFileSync(at('all.zip'), bytes);
  mkdirSync(at('all'));
  execFileSync('cmake', ['-E', 'tar', 'xf', at('all.zip')], { cwd: at('all') });
  assert.deepEqual(readdirSync(at('all')).sort(), ['stroll-old.bvh', 'stroll-old.glb',
    'stroll-old.vrma', 'walk-old.bvh', 'walk-old.glb', 'walk-old.vrma']);
  assert.deepEqual(readFileSync(at('all/walk-old.bvh')), readFileSync(at('keyed.bvh')));
  assert.match(panache('info', 'all/stroll-old.vrma'), /leftUpperArm/);
});

test('a picture has the size that was asked for', async () => {
  await chooseSave(tab, 'png');
  await tab.getByLabel('Width, pixels').fill('640');
  await tab.getByLabel('Height, pixels').fill('900');
  const { name, bytes } = await download(tab, () => button('Save picture').click());
  assert.equal(name, 'walk-old.png');
  assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [640, 900]);
  assert.ok(bytes.length > 5000, `${bytes.length}`);
  // The view has its own size again.
  await frames(tab, 2);
  const [drawn, seen] = await tab.evaluate(() => {
    const { canvas } = window.page.stage;
    return [canvas.width / canvas.height, canvas.clientWidth / canvas.clientHeight];
  });
  assert.ok(Math.abs(drawn - seen) < 0.02, `${drawn} ${seen}`);
});
