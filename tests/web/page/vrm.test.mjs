// samples/three_vrm in a browser.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pictures, start } from './browser.mjs';
import { serveSample } from './sample.mjs';

let sample, site, tab;
before(async () => {
  sample = await serveSample();
  site = await start();
  tab = await site.plain(sample.address);
  await tab.waitForFunction(() => window.avatar);
});
after(async () => {
  await site.close();
  await sample.close();
});

/** Two seconds later: how far the head is ahead of the hips, how high a hand came, metres, and the
 * weights of the face. */
const seen = () => tab.evaluate(() => {
  const { vrm } = window.avatar;
  const positionOf = (name) => {
    vrm.scene.updateMatrixWorld(true);
    return [12, 13, 14].map((k) => vrm.humanoid.getRawBoneNode(name).matrixWorld.elements[k]);
  };
  let hand = 0;
  for (let i = 0; i < 120; ++i) {
    window.avatar.update(1 / 60);
    hand = Math.max(hand, positionOf('leftHand')[1], positionOf('rightHand')[1]);
  }
  const face = vrm.expressionManager;
  return { ahead: positionOf('head')[2] - positionOf('hips')[2], head: positionOf('head')[1], hand,
    sad: face.getValue('sad'), happy: face.getValue('happy') };
});

test('a mood changes the posture and the face, as far as it is told to', async () => {
  const neutral = await seen();
  assert.ok(neutral.sad < 0.01 && neutral.head > 0.8, JSON.stringify(neutral));
  assert.equal(await tab.evaluate(() => window.mood('sad', 0.6)), 'sad');
  const some = await seen();
  assert.equal(await tab.evaluate(() => window.mood('unhappy', 1.2)), 'sad');
  const more = await seen();
  assert.ok(some.ahead > neutral.ahead + 0.01, `${neutral.ahead} ${some.ahead}`);
  assert.ok(more.ahead > some.ahead + 0.005, `${some.ahead} ${more.ahead}`);
  assert.ok(some.sad > 0.5 && more.sad > some.sad, `${some.sad} ${more.sad}`);
  await tab.screenshot({ path: join(pictures, 'vrm-sad.png') });
  await assert.rejects(tab.evaluate(() => window.mood('purple')), /there is no mood 'purple'; expected one of neutral, happy/);
});

test('a line of text sets the mood, and the avatar talks with its hands', async () => {
  await tab.evaluate(() => window.mood('neutral', 1));
  const idle = await seen();
  await tab.locator('#line').fill('I was sad, but now I am so happy that you came, really, you know!');
  await tab.getByRole('button', { name: 'Say' }).click();
  const mood = await tab.evaluate(() => window.avatar.current.name);
  assert.equal(mood, 'surprised');  // Its last word counts: "really".
  await tab.evaluate(() => window.say('I was sad, but now I am so happy that you came to see me!'));
  assert.equal(await tab.evaluate(() => window.avatar.current.name), 'happy');
  const talking = await seen();
  assert.ok(talking.happy > 0.8 && talking.sad < 0.1, JSON.stringify(talking));
  assert.ok(talking.hand > idle.hand + 0.05, `${idle.hand} ${talking.hand}`);
  await tab.screenshot({ path: join(pictures, 'vrm-happy.png') });
});

test('every mood has styles that the model knows, and moves the joints without a jump', async () => {
  const unknown = await tab.evaluate(async () => {
    const { moods } = await import('./moods.mjs');
    const { Panache } = await import('panache');
    const bytes = async (name) => (await fetch(`./node_modules/panache/${name}`)).arrayBuffer();
    const { styles } = await Panache.create(
      { wasm: await bytes('panache.wasm'), model: await bytes('panache-int8.safetensors') });
    const names = styles.map(({ name }) => name);
    const faces = window.avatar.vrm.expressionManager.expressions.map((e) => e.expressionName);
    return Object.values(moods).flatMap(({ styles: own, face }) =>
      [...Object.keys(own).filter((name) => !names.includes(name)), ...faces.includes(face) ? [] : [face]]);
  });
  assert.deepEqual(unknown, []);
  const jump = await tab.evaluate(async () => {
    const { moods } = await import('./moods.mjs');
    const { vrm } = window.avatar;
    let largest = 0, before = null;
    for (const name of Object.keys(moods)) {
      window.mood(name, 1);
      for (let i = 0; i < 60; ++i) {
        window.avatar.update(1 / 60);
        vrm.scene.updateMatrixWorld(true);
        const e = vrm.humanoid.getRawBoneNode('rightHand').matrixWorld.elements;
        const now = [e[12], e[13], e[14]];
        if (before) largest = Math.max(largest, Math.hypot(...now.map((v, k) => v - before[k])));
        before = now;
      }
    }
    return largest;
  });
  assert.ok(jump > 0 && jump < 0.08, `${jump} m in a frame`);
});
