import assert from 'node:assert/strict';
import { readFileSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import {
  chooseSave, download, drop as dropFiles, frames, models, setStyle, start, unfold, workFolder,
} from './browser.mjs';

const { at, panache, remove } = workFolder();

let site, tab;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  panache('convert', 'walk.bvh', '-o', 'walk.glb');
  writeFileSync(at('damaged.bvh'), readFileSync(at('walk.bvh'), 'utf8').replace('OFFSET', 'OFSET'));
  site = await start();
  tab = await site.open();
  await unfold(tab);
});
after(async () => {
  await site.close();
  remove();
});

const button = (name) => tab.getByRole('button', { name, exact: true });
const kind = () => tab.evaluate(() => window.page.source.kind);
const alertText = async () => {
  await tab.locator('#alert').waitFor({ state: 'visible' });
  return tab.locator('#alert').textContent();
};
const choose = (name) => tab.setInputFiles('#file', at(name));
const isPlaying = () => tab.waitForFunction(() => window.page.source.kind === 'clip');

/** As if a person dropped the file on the view. */
const drop = (name) => dropFiles(tab, '#view', [[name, readFileSync(at(name))]]);

/** What the page called the files that it saved. */
const saved = [];

/** Saves a format of the menu, or presses a button that saves, and puts the file beside the others. */
async function save(name, extension) {
  const { name: title, bytes } = await download(tab, () => (
    ['BVH', 'GLB'].includes(name) ? chooseSave(tab, name) : button(name).click()));
  const path = at(`saved${extension}`);
  saved.push(title);
  writeFileSync(path, bytes);
  return path;
}

test('a dropped BVH plays, pauses, is scrubbed and loops', async () => {
  await drop('walk.bvh');
  await isPlaying();
  await button('Pause').click();
  await tab.locator('#scrub').fill('0.5');
  await frames(tab);
  const seconds = await tab.evaluate(() => window.page.source.player.seconds);
  // Half of 3 s less a frame, to the thousandth that the slider goes by.
  assert.ok(Math.abs(seconds - (3 - 1 / 60) / 2) < 0.002, `${seconds}`);
  await frames(tab);
  assert.equal(await tab.evaluate(() => window.page.source.player.seconds), seconds);
  await button('Loop').click();
  await tab.locator('#scrub').fill('0.98');
  await tab.locator('#speed').selectOption('2');
  await button('Play').click();
  // At the end it stops; playing again begins again.
  await button('Play').waitFor();
  await frames(tab, 4);
  assert.ok(await tab.evaluate(() => window.page.source.player.seconds > 2.98));
  await button('Play').click();
  await tab.waitForFunction(() => window.page.source.player.seconds < 1);
  await button('Loop').click();
});

test('a clip goes frame by frame, and from the loop start to the loop end', async () => {
  await button('Pause').click();
  const seconds = () => tab.evaluate(() => window.page.source.player.seconds);
  const seek = async (share) => {
    await tab.locator('#scrub').fill(String(share));
    await frames(tab, 2);
  };
  await seek(0.4);
  const frame = Math.round((await seconds()) * 60);
  await tab.keyboard.press('.');
  await frames(tab, 2);
  assert.ok(Math.abs((await seconds()) - (frame + 1) / 60) < 1e-6);
  // Frames count from 1.
  assert.equal(await tab.locator('#frame').textContent(), `frame ${frame + 2} / 180`);
  await tab.keyboard.press(',');
  await tab.keyboard.press(',');
  await frames(tab, 2);
  const begin = await seconds();
  await tab.keyboard.press('i');
  await seek(0.6);
  const end = await seconds();
  await tab.keyboard.press('o');
  await tab.locator('#speed').selectOption('1');
  await button('Play').click();
  const seen = await tab.evaluate(() => new Promise((done) => {
    const player = window.page.source.player, all = [];
    const look = () => {
      all.push(player.seconds);
      if (all.length < 40) requestAnimationFrame(look);
      else done(all);
    };
    look();
  }));
  // A frame of a slow machine is at most a tenth of a second, which is how far it may overshoot.
  assert.ok(Math.max(...seen) < end + 0.101 && Math.min(...seen.slice(1)) >= begin - 1e-6,
    `${begin} ${end}: ${seen}`);
  assert.ok(seen.some((s, i) => i > 0 && s < seen[i - 1]), 'it begins again');
  await seek(0);
  await tab.keyboard.press('i');
  await seek(1);
  await tab.keyboard.press('o');
});

test('what is saved reads back: BVH, GLB, a picture and a film', async () => {
  await setStyle(tab, 'proud', '1');
  for (const extension of ['.bvh', '.glb']) {
    const info = panache('info', await save(extension.slice(1).toUpperCase(), extension));
    assert.match(info, /joints  2[12], of which/);  // A GLB has a node above them.
    assert.match(info, /leftUpperArm   leftUpperArm/);
    const kept = Number(/(\d+) frames/.exec(info)[1]);
    assert.notEqual(kept, 180);  // Who is proud takes another time for the same way.
  }
  const picture = await (async () => {
    await chooseSave(tab, 'png');
    return readFileSync(await save('Save picture', '.png'));
  })();
  assert.equal(picture.subarray(1, 4).toString(), 'PNG');
  assert.ok(picture.length > 5000, `${picture.length}`);
  await chooseSave(tab, 'webm');
  await tab.waitForTimeout(1200);
  const film = statSync(await save('Stop recording', '.webm'));
  assert.ok(film.size > 2000, `${film.size}`);
  assert.deepEqual(saved, ['.bvh', '.glb', '.png', '.webm'].map((e) => `walk-proud${e}`));
});

/** The pictures of a GIF, as the browser decodes it: how far each is from the one before, and the
 * first from the last. */
const steps = (bytes) => tab.evaluate(async (text) => {
  const data = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const decoder = new ImageDecoder({ data, type: 'image/gif' });
  await decoder.tracks.ready;
  const { frameCount, repetitionCount } = decoder.tracks.selectedTrack;
  const all = [];
  for (let frameIndex = 0; frameIndex < frameCount; ++frameIndex) {
    const { image } = await decoder.decode({ frameIndex });
    const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    all.push(context.getImageData(0, 0, canvas.width, canvas.height));
    image.close();
  }
  const far = ({ data: a }, { data: b }) =>
    a.reduce((sum, value, k) => sum + Math.abs(value - b[k]), 0) / a.length;
  return { repetitionCount: String(repetitionCount), size: [all[0].width, all[0].height],
    steps: all.map((picture, i) => far(picture, all.at(i - 1))) };
}, bytes.toString('base64'));

test('a loop is saved: a cycle of the clip whose end leads to its beginning, or a part of it', async () => {
  const saveLoop = async () => {
    await chooseSave(tab, 'gif');
    await tab.getByLabel('Width, pixels').fill('150');
    await tab.getByLabel('Height, pixels').fill('200');
    const begin = await tab.evaluate(() => window.page.frames);
    const path = await save('Save loop', '.gif');
    // The page went on.
    assert.ok((await tab.evaluate(() => window.page.frames)) > begin + 5);
    return steps(readFileSync(path));
  };
  await drop('walk.bvh');
  await isPlaying();
  await setStyle(tab, 'proud', '1');
  const cycle = await saveLoop();
  assert.equal(saved.pop(), 'walk-proud.gif');
  assert.equal(cycle.repetitionCount, 'Infinity');
  assert.deepEqual(cycle.size, [150, 200]);
  // A cycle of a proud walk is about two seconds; 25 frames are one.
  assert.ok(cycle.steps.length >= 40 && cycle.steps.length <= 60, `${cycle.steps.length}`);
  const [seam, ...others] = cycle.steps;
  assert.ok(Math.min(...others) > 0.1, `${others}`);
  // No more than between others; a fifth for what the cycle does not close.
  assert.ok(seam <= 1.2 * Math.max(...others), `${seam}: ${others}`);

  for (const [share, key] of [[0.2, 'i'], [0.4, 'o']]) {
    await tab.locator('#scrub').fill(String(share));
    await frames(tab, 2);
    await tab.keyboard.press(key);
  }
  // At 25 frames a second, at the tempo of the clip, which went on between the keys.
  const seconds = await tab.evaluate(() => {
    const { left, right } = document.querySelector('.track .range').style;
    const { file, clip } = window.page.source;
    return (1 - (parseFloat(left) + parseFloat(right)) / 100) * file.clips[clip].seconds;
  });
  assert.ok(seconds > 0.4 && seconds < 0.8, `${seconds}`);
  await setStyle(tab, 'proud', '0');
  const { steps: part } = await saveLoop();
  assert.equal(saved.pop(), 'walk-neutral.gif');
  assert.ok(Math.abs(part.length - 1 - 25 * seconds) <= 1, `${part.length} frames, ${seconds} s`);
  await setStyle(tab, 'proud', '1');
  for (const [share, key] of [[0, 'i'], [1, 'o']]) {
    await tab.locator('#scrub').fill(String(share));
    await frames(tab, 2);
    await tab.keyboard.press(key);
  }
});

test('a clip that is saved is what the program makes of it, byte for byte', async () => {
  const model = join(models, 'panache-int8.safetensors');
  for (const tempo of ['all', 'off', 'steps']) {
    await tab.evaluate((wanted) => window.page.store.set({ tempo: wanted }), tempo);
    panache('stylize', 'walk.bvh', '--model', model, '--style', 'proud=1', '--timing', tempo,
      '-o', 'proud.bvh', '--force');
    assert.deepEqual(readFileSync(await save('BVH', '.bvh')), readFileSync(at('proud.bvh')), tempo);
  }
});

test('a clip that no style changes is saved as it was, byte for byte', async () => {
  await button('Neutral').click();
  assert.deepEqual(readFileSync(await save('BVH', '.bvh')), readFileSync(at('walk.bvh')));
});

test('a GLB is shown with its own meshes', async () => {
  await choose('walk.glb');
  await tab.waitForFunction(() => window.page.source.file?.name === 'walk.glb');
  await frames(tab);
  assert.ok(await tab.evaluate(() => window.page.source.own !== null));
  const info = panache('info', await save('GLB', '.glb'));
  assert.match(info, /joints  22, of which.*\n.*180 frames at 60 a second/);
});

test('a motion and a character that are chosen together are put together', async () => {
  panache('walker', '-o', 'short.bvh', '--seconds', '1', '--speed', '0.6');
  await tab.setInputFiles('#file', [at('short.bvh'), at('walk.glb')]);
  await tab.waitForFunction(() => window.page.source.file?.name === 'short-on-walk.glb');
  assert.ok(await tab.evaluate(() => window.page.source.own !== null), 'the character is shown');
  // The motion that was put on, and no longer the character's own of three seconds.
  const clips = await tab.evaluate(() => window.page.source.file.clips.map((c) => c.frames));
  assert.deepEqual(clips, [60]);
  assert.ok(await tab.evaluate(() => window.page.source.file.joints.length === 22));
});

test('a .vrma opens, and several files become a list', async () => {
  panache('convert', 'short.bvh', '-o', 'short.vrma');
  await tab.setInputFiles('#file', [at('short.vrma'), at('walk.bvh'), at('short.bvh')]);
  await tab.waitForFunction(() => window.page.source.file?.name === 'short.vrma');
  assert.deepEqual(await tab.locator('#files option').allTextContents(),
    ['short.vrma', 'walk.bvh', 'short.bvh']);
  await tab.locator('#files').selectOption('walk.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'walk.bvh');
  await frames(tab);
});

/** The GLB with an animation of a lamp before and one after its own. */
function withLamp(bytes) {
  const length = bytes.readUInt32LE(12), rest = bytes.subarray(20 + length);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const [own] = json.animations;
  const { sampler } = own.channels.find(({ target }) => target.path === 'translation');
  const lamp = (name) => ({ name, samplers: [own.samplers[sampler]],
    channels: [{ sampler: 0, target: { node: json.nodes.length, path: 'translation' } }] });
  json.animations = [lamp('lamp'), own, lamp('lamp again')];
  json.scenes[json.scene ?? 0].nodes.push(json.nodes.length);
  json.nodes.push({ name: 'lamp' });
  const text = JSON.stringify(json), padded = Buffer.from(text.padEnd(4 * Math.ceil(text.length / 4)));
  const out = Buffer.concat([bytes.subarray(0, 20), padded, rest]);
  out.writeUInt32LE(out.length, 8);
  out.writeUInt32LE(padded.length, 12);
  return out;
}

test('animations that move no body are passed over with a note', async () => {
  const lit = withLamp(readFileSync(at('walk.glb')));
  writeFileSync(at('lit.glb'), lit);
  await choose('lit.glb');
  await tab.waitForFunction(() => window.page.source.file?.name === 'lit.glb');
  assert.equal(await alertText(),
    "lit.glb: 'lamp' and 'lamp again' move no joint of the humanoid and are passed over");
  assert.equal(await tab.evaluate(() => window.page.source.clip), 1);
  assert.ok(await tab.locator('#clips').isHidden());
  panache('stylize', 'lit.glb', '--style', 'old=1', '-o', 'lit-old.glb');
  await choose('lit-old.glb');
  await tab.waitForFunction(() => window.page.source.file?.name === 'lit-old.glb');
  assert.deepEqual(await tab.locator('#clips option').allTextContents(), ['walk (old 1)', 'walk']);
  await tab.locator('#clips').selectOption('walk (old 1)');
  await tab.waitForFunction(() => window.page.source.clip === 0);
});

/** The walk with other counts and rates. */
const writeWalk = (name, from, to, walk = 'walk.bvh') =>
  writeFileSync(at(name), readFileSync(at(walk), 'utf8').replace(from, to));

test('what is odd about a file is told, and the file is played', async () => {
  writeWalk('many.bvh', /Frames:\s*\d+/, 'Frames: 999');
  await choose('many.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'many.bvh');
  assert.match(await alertText(), /^many\.bvh:\d+:\d+: expected .*180.*found '999'/);
  assert.equal(await tab.evaluate(() => window.page.source.file.clips[0].frames), 180);
});

test('a wrong rate is noted, corrected, kept and saved', async () => {
  panache('walker', '-o', 'steps.bvh', '--seconds', '8');  // Enough steps to tell their rate by.
  writeWalk('slow.bvh', /Frame Time:.*/, 'Frame Time: 0.1', 'steps.bvh');
  const rate = tab.locator('#fps');
  const seconds = () => tab.evaluate(() => window.page.source.file.clips[0].seconds);
  const takes = (wanted) => tab.waitForFunction((s) =>
    Math.abs(window.page.source.file?.clips[0].seconds - s) < 1e-3, wanted);
  await tab.setInputFiles('#file', [at('slow.bvh'), at('walk.bvh')]);
  await takes(47.9);
  assert.match(await alertText(), /^slow\.bvh: expected steps .*too slow.* give its rate$/);
  assert.equal(await rate.inputValue(), '10');
  await rate.fill('60');
  await rate.press('Enter');
  await takes(479 / 60);
  assert.ok(await tab.locator('#alert').isHidden());
  // It stays with the file while that is listed.
  await tab.locator('#files').selectOption('walk.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'walk.bvh');
  await tab.locator('#files').selectOption('slow.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'slow.bvh');
  assert.equal(await rate.inputValue(), '60');
  panache('convert', 'slow.bvh', '--fps', '60', '-o', 'right.bvh');
  assert.deepEqual(readFileSync(await save('BVH', '.bvh')), readFileSync(at('right.bvh')));
  // What cannot be is refused, and the rate stays.
  await rate.fill('99999');
  await rate.press('Enter');
  assert.match(await alertText(), /expected a rate of 0\.01 to 10000 frames a second, found 99999$/);
  assert.equal(await rate.inputValue(), '60');
  assert.ok(Math.abs(await seconds() - 479 / 60) < 1e-3);
  // Empty: the file's own.
  await rate.fill('');
  await rate.press('Enter');
  await takes(47.9);
  assert.equal(await rate.inputValue(), '10');
});

test('the rate of a file that has none is asked for', async () => {
  writeWalk('zero.bvh', /Frame Time:.*/, 'Frame Time: 0');
  tab.once('dialog', (dialog) => dialog.dismiss());
  await choose('zero.bvh');
  assert.match(await alertText(), /^zero\.bvh:\d+:\d+: .*give its rate$/);
  tab.once('dialog', (dialog) => dialog.accept('60'));
  await choose('zero.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'zero.bvh');
  assert.equal(await tab.locator('#fps').inputValue(), '60');
});

test('a wrong file is refused with the library\'s sentence, and the old one goes on', async () => {
  await drop('damaged.bvh');
  assert.match(await alertText(), /^damaged\.bvh:\d+:\d+: expected .*OFSET/);
  assert.equal(await kind(), 'clip');
  writeFileSync(at('notes.txt'), 'no motion');
  await choose('notes.txt');
  await tab.waitForFunction(() => document.querySelector('#alert').textContent.startsWith('notes'));
  assert.equal(await alertText(), 'notes.txt: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma), ' +
    'found the extension \'.txt\'');
  writeFileSync(at('walk.fbx'), 'Kaydara');
  await choose('walk.fbx');
  await tab.waitForFunction(() => document.querySelector('#alert').textContent.startsWith('walk.fbx'));
  assert.match(await alertText(), /^walk.fbx: is FBX, .* `panache view walk.fbx` shows it/);
  writeFileSync(at('cut.glb'), readFileSync(at('walk.glb')).subarray(0, 500));
  await choose('cut.glb');
  await tab.waitForFunction(() => document.querySelector('#alert').textContent.startsWith('cut'));
  await frames(tab);
});

test('a huge file is refused, or read, and the page lives on', async () => {
  writeFileSync(at('huge.bvh'), 'HIERARCHY');
  truncateSync(at('huge.bvh'), 300 << 20);
  await choose('huge.bvh');
  await tab.waitForFunction(() => document.querySelector('#alert').textContent.startsWith('huge'));
  assert.match(await alertText(), /expected at most 256 MB, found 300 MB/);
  // Ten minutes of motion.
  panache('walker', '-o', 'long.bvh', '--seconds', '600', '--fps', '30');
  await choose('long.bvh');
  await tab.waitForFunction(() => window.page.source.file?.name === 'long.bvh', null,
    { timeout: 60000 });
  await frames(tab);
  await button('Walker').click();
  assert.equal(await kind(), 'walk');
});

test('the walk itself is saved as it was steered', async () => {
  await frames(tab, 30);
  assert.match(panache('info', await save('BVH', '.bvh')), /joints  21, of which/);
});

