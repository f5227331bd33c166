import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import {
  card, frames, listen, models, pictures, setStyle, slider, start, styledParts, told, unfold,
  workFolder,
} from './browser.mjs';

let site, tab;
before(async () => {
  site = await start();
  tab = await site.open();
  await unfold(tab);
  await listen(tab);
});
after(() => site.close());

// The address follows after a moment.
const address = (wanted, where = tab) =>
  where.waitForFunction((hash) => location.hash === hash, wanted);
const field = (title) => tab.getByLabel(`${title}, exact`);
const button = (name) => tab.getByRole('button', { name, exact: true });

const stylesOf = (where) =>
  where.evaluate(() => window.page.panache.styles.map((style) => style.name));

test('a click plays a style alone, another takes it off, and a slider sets its strength', async () => {
  const styles = await stylesOf(tab);
  assert.ok(styles.length >= 50);
  const only = async (style, strength) => {
    const { strengths } = await told(tab);
    for (const other of styles) {
      assert.equal(strengths[other], other === style ? strength : 0, `${style}: ${other}`);
    }
  };
  for (const style of styles.filter((_, i) => i % 9 === 0)) {
    await card(tab, style).click();
    await only(style, 1);
    assert.equal(await card(tab, style).getAttribute('aria-pressed'), 'true');
    await slider(tab, style).fill('1.5');
    await only(style, 1.5);
    await card(tab, style).click();
    await only(style, 1);
    await card(tab, style).click();
    await only(style, 0);
    assert.equal(await card(tab, style).getAttribute('aria-pressed'), 'false');
  }
  await button('Neutral').click();
});

test('five clicks on a fresh page show five styles, and the cards stay where they are', async () => {
  const other = await site.open('');
  await other.locator('#search').fill('');
  const top = () => card(other, 'angry').evaluate((play) => play.getBoundingClientRect().top);
  const before = await top();
  for (const style of ['angry', 'attitude', 'depressed', 'drunk', 'graceful']) {
    await card(other, style).click();
    assert.deepEqual(await other.evaluate(() => window.page.store.settings.styles), { [style]: 1 });
    assert.equal(await top(), before);
  }
  // Arrow keys go on from there: sideways, and down to the card below, into the next group.
  const playing = () => other.evaluate(() => Object.keys(window.page.store.settings.styles).join());
  await other.keyboard.press('ArrowRight');
  assert.equal(await playing(), 'happy');
  await other.keyboard.press('ArrowLeft');
  assert.equal(await playing(), 'graceful');
  await other.keyboard.press('ArrowUp');
  assert.equal(await playing(), 'attitude');
  await other.keyboard.press('ArrowLeft');
  await other.keyboard.press('ArrowLeft');
  assert.equal(await playing(), 'angry');
  await card(other, 'strutting').click();
  await other.keyboard.press('ArrowRight');
  assert.equal(await playing(), 'childlike');
  assert.ok(await card(other, 'childlike').isVisible());
  // The walker does not turn by these keys.
  await listen(other);
  await other.keyboard.down('ArrowLeft');
  await frames(other, 2);
  assert.ok((await told(other)).steer.turn < 1);
  await other.keyboard.up('ArrowLeft');
  // + adds to the active ones.
  await card(other, 'angry').evaluate((play) => play.nextElementSibling.click());
  assert.equal(await playing(), 'strutting,angry');
  await other.close();
});

test('a field takes the exact value, and holds it within the bounds', async () => {
  await setStyle(tab, 'old', '1');
  await field('Old').fill('0.37');
  await field('Old').press('Enter');
  assert.equal((await told(tab)).strengths.old, 0.37);
  await field('Old').fill('99');
  await field('Old').press('Enter');
  assert.equal((await told(tab)).strengths.old, 2);
  await address('#style.old=2');
});

test('an amount counts for all styles, or for what it says', async () => {
  await field('Strength').fill('0.5');
  await field('Strength').press('Enter');
  assert.equal((await told(tab)).strengths.old, 1);
  for (const amount of ['Posture', 'Dynamics', 'Timing']) {
    await field(amount).fill('0.25');
    await field(amount).press('Enter');
    assert.equal((await told(tab)).shape[amount.toLowerCase()], 0.25);
    await button(`Reset ${amount}`).click();
    assert.equal((await told(tab)).shape[amount.toLowerCase()], 1);
  }
  await button('Reset Strength').click();
});

test('the tempo of the style is taken where the feet step, everywhere or nowhere', async () => {
  const rate = () => tab.evaluate(() => window.page.source.player.rate);
  const tempo = (name) => tab.locator('#tempo').getByRole('button', { name, exact: true });
  assert.equal(await tempo('Steps').getAttribute('aria-pressed'), 'true');
  await tempo('Off').click();
  assert.equal((await told(tab)).timing, 'off');
  await setStyle(tab, 'old', '2');
  await frames(tab, 20);
  assert.equal(await rate(), 1);
  await address('#style.old=2&tempo=off');
  // Who stands has the tempo of the style only where that is everywhere.
  await button('Idle').click();
  await tempo('All').click();
  assert.equal(await tempo('Off').getAttribute('aria-pressed'), 'false');
  await tab.waitForFunction(() => Math.abs(window.page.source.player.rate - 1) > 0.01);
  await tempo('Steps').click();
  await tab.waitForFunction(() => window.page.source.player.rate === 1);
  await button('Walk').click();
  await tab.waitForFunction(() => Math.abs(window.page.source.player.rate - 1) > 0.01);
  await address('#style.old=2');
});

test('a part of the body is switched off and on', async () => {
  for (const [name, key] of [['Legs', 'legs'], ['Torso', 'torso'], ['Left arm', 'leftArm'],
    ['Right arm', 'rightArm'], ['Foot lock', 'footLock'],
    ['Hand contacts', 'handContacts']]) {
    await button(name).click();
    assert.equal((await told(tab)).shape[key], 0);
    assert.equal(await button(name).getAttribute('aria-pressed'), 'false');
    await button(name).click();
    assert.equal((await told(tab)).shape[key], 1);
  }
});

test('presets mix, and say that they are on', async () => {
  await button('Proud robot').click();
  const { strengths } = await told(tab);
  assert.equal(strengths.proud, 0.6);
  assert.equal(strengths.robot, 0.8);
  assert.equal(strengths.old, 0);
  assert.equal(await button('Proud robot').getAttribute('aria-pressed'), 'true');
  // The model has the styles of every preset, so none is hidden.
  assert.equal(await tab.locator('#presets button:visible').count(),
    await tab.locator('#presets button').count());
  await button('Neutral').click();
  assert.equal((await told(tab)).strengths.proud, 0);
});

test('the pad blends four styles, by mouse and by keys', async () => {
  const pad = tab.locator('#pad');
  await pad.scrollIntoViewIfNeeded();
  const box = await pad.boundingBox();
  await tab.mouse.click(box.x + 3, box.y + 3);
  assert.ok((await told(tab)).strengths.old > 0.9);
  await tab.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  for (const style of ['old', 'proud', 'childlike', 'zombie']) {
    assert.ok(Math.abs((await told(tab)).strengths[style] - 0.25) < 0.02, style);
  }
  await pad.focus();
  for (let i = 0; i < 4; ++i) await tab.keyboard.press('ArrowRight');
  assert.ok((await told(tab)).strengths.proud > 0.3);
  await tab.getByLabel('Style of the pad, top right').selectOption('angry');
  assert.ok((await told(tab)).strengths.angry > 0.3);
  assert.equal((await told(tab)).strengths.proud, 0);
  await button('Neutral').click();
});

test('what is set is in the address, and comes back from it', async () => {
  const link = 'old=1.2&on+toes=-0.3&strength=0.8&posture=0.5&leftArm=off&trail=off&view=over';
  const other = await site.open(link);
  const settings = await other.evaluate(() => ({
    old: document.querySelector('#style-old').value,
    toes: document.querySelector('[id="style-on%20toes"]').value,
    posture: document.querySelector('#amount-posture').value,
    view: document.body.dataset.view,
  }));
  assert.deepEqual(settings, { old: '1.2', toes: '-0.3', posture: '0.5', view: 'over' });
  const renewed = link.replace('old=', 'style.old=').replace('on+', 'style.on+');
  await address(`#${renewed}`, other);
  await other.close();
});

test('each view shows something else', async () => {
  await setStyle(tab, 'old', '2');
  await button('Idle').click();
  await frames(tab, 20);
  const pictures = new Set();
  for (const view of ['Styled', 'Side by side', 'Overlaid']) {
    await button(view).click();
    await frames(tab, 2);
    pictures.add((await tab.locator('#view').screenshot()).toString('base64'));
  }
  assert.equal(pictures.size, 3);
  await button('Styled').click();
  await button('Neutral').click();
});

test('a body is drawn by one call', async () => {
  const bodies = (view) => tab.evaluate((name) => {
    const kinds = WebGL2RenderingContext.prototype, own = kinds.drawElements;
    let large = 0;
    kinds.drawElements = function (mode, count, ...rest) {
      if (count > 9000) ++large;
      own.call(this, mode, count, ...rest);
    };
    window.page.store.set({ view: name });
    window.page.stage.draw(0);
    kinds.drawElements = own;
    return large;
  }, view);
  assert.equal(await bodies('side'), 2);
  assert.equal(await bodies('over'), 3);  // The depth of a ghost comes before its colour.
  assert.equal(await bodies('styled'), 1);
});

test('the walker stands, walks and jogs, and turns by keys, stick and gamepad', async () => {
  const steer = async () => {
    await frames(tab, 2);
    return (await told(tab)).steer;
  };
  await button('Idle').click();
  assert.deepEqual(await steer(), { speed: 0, turn: 0 });
  await button('Run').click();
  assert.equal((await steer()).speed, 3);
  await button('Walk').click();
  await tab.locator('#view').click({ position: { x: 300, y: 300 } });
  await tab.evaluate(() => document.activeElement.blur());
  await tab.keyboard.down('a');
  assert.ok((await steer()).turn > 1);
  await tab.keyboard.up('a');
  await tab.keyboard.down('ArrowDown');
  assert.equal((await steer()).speed, 0);
  await tab.keyboard.up('ArrowDown');

  const box = await tab.locator('#stick').boundingBox();
  await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await tab.mouse.down();
  await tab.mouse.move(box.x + box.width, box.y);
  const pushed = await steer();
  assert.ok(pushed.speed > 2 && pushed.turn < -0.8, JSON.stringify(pushed));
  await tab.mouse.up();

  await tab.evaluate(() => {
    window.pad = { connected: true, axes: [-1, 0], buttons: Array(17).fill({ pressed: false }) };
    navigator.getGamepads = () => [window.pad];
  });
  assert.ok((await steer()).turn > 1);
  await tab.evaluate(() => {
    window.pad.axes = [0, 0];
    document.querySelector('.play[data-style=old] + .add').click();
    document.querySelector('#style-old').value = 0;
    document.querySelector('#style-old').focus();
    window.pad.buttons[15] = { pressed: true };
  });
  await tab.waitForFunction(() => window.told.strengths.old > 0.1);
  await tab.evaluate(() => (navigator.getGamepads = () => []));
});

test('every plot shows what it says', async () => {
  await button('Walk').click();
  await setStyle(tab, 'old', '1');
  await button('More plots').click();
  const captions = await tab.locator('figcaption').allTextContents();
  assert.deepEqual(captions.map((text) => text.replace(/[\d.]+(×| µs \(median\))?$/, '').trim()), ['Style strength',
    'Tempo', 'Feet on the ground, left and right', 'Familiar motion', 'Computing time of a step']);
  const gate = await tab.evaluate(() => window.page.source.player.gate);
  assert.ok(gate > 0.5 && gate <= 1, `a walk is known: ${gate}`);

  // From now on the styles know a quarter of the motion, and the rest is made up as well.
  await tab.evaluate(() => {
    const own = { gate: 0.25, rate: 1.25, contacts: [1, 0] };
    for (const [name, value] of Object.entries(own)) {
      Object.defineProperty(window.page.source.player, name,
        { get: () => value, configurable: true });
    }
  });
  await frames(tab, 6);
  assert.equal(await tab.locator('#gate-now').textContent(), '0.25');
  assert.equal(await tab.locator('#rate-now').textContent(), '1.25×');
  // How high the ink at the right edge lies on the whole: 0 is the bottom, 1 the top.
  const inks = await tab.evaluate(() => Object.fromEntries(
    ['styles', 'gate', 'rate', 'contacts'].map((name) => {
      const canvas = document.querySelector(`[data-plot=${name}] canvas`);
      const { width, height } = canvas;
      const { data } = canvas.getContext('2d').getImageData(width - 1, 0, 1, height);
      let sum = 0, weighed = 0;
      for (let y = 0; y < height; ++y) {
        if (data[4 * y + 3] < 128) continue;  // The scale and a foot in the air are fainter.
        ++sum;
        weighed += y + 0.5;
      }
      return [name, 1 - (weighed / sum - 3) / (height - 6)];
    })));
  const wanted = { styles: 1.5 / 2.5, gate: 0.25, rate: 0.5, contacts: 0.78 };
  for (const [name, value] of Object.entries(wanted)) {
    // Half of a line that is two pixels thick, and as much for whole pixels: 2 of 52.
    assert.ok(Math.abs(inks[name] - value) < 0.04, `${name}: ${inks[name]}`);
  }
  await tab.evaluate((names) => {
    for (const name of names) delete window.page.source.player[name];
  }, ['gate', 'rate', 'contacts']);
});

test('a crowd is of different people who are steered together', async () => {
  await button('Reset all').click();
  await button('Crowd').click();
  await tab.waitForFunction(() => window.page.crowd.count === 60, null, { timeout: 60000 });
  await button('Idle').click();
  await tab.waitForTimeout(4000);  // Until all stand.
  // The mean distance of joints, relative to the hips, from their mean over the standing crowd.
  await tab.evaluate(() => (window.spread = () => {
    const poses = window.page.crowd.poses.map((parts) => Array.from({ length: 63 }, (_, i) =>
      parts[7 * Math.floor(i / 3) + i % 3] - parts[i % 3]));
    const mean = poses[0].map((_, i) => poses.reduce((sum, pose) => sum + pose[i], 0) / 60);
    return poses.reduce((sum, pose) => sum + pose.reduce(
      (all, value, i) => all + Math.abs(value - mean[i]), 0) / 63, 0) / 60;
  }));
  const people = await tab.evaluate(() => window.spread());
  await tab.locator('#amount-variety').fill('0');
  await tab.waitForFunction((were) => window.spread() < were / 2, people);
  assert.ok(people > 0.008, `${people} m apart`);
  assert.match(await tab.locator('#crowd-facts').textContent(),
    /^60 characters, \d+ frames a second, \d+ µs a character/);
  await button('Styled').click();
  assert.equal(await tab.evaluate(() => window.page.crowd.count), 0);
  await button('Walk').click();
  await button('Reset all').click();
});

test('every change is undone and redone, and Reset all resets all', async () => {
  await button('Reset all').click();
  await tab.waitForTimeout(550);  // What is done within half a second counts as one.
  await setStyle(tab, 'old', '1.5');
  await tab.waitForTimeout(550);
  await button('Legs').click();
  await tab.keyboard.press('Control+z');
  assert.equal((await told(tab)).shape.legs, 1);
  assert.equal((await told(tab)).strengths.old, 1.5);
  await button('Undo').click();
  assert.equal((await told(tab)).strengths.old, 0);
  await tab.keyboard.press('Control+Shift+z');
  await button('Redo').click();
  assert.equal((await told(tab)).strengths.old, 1.5);
  assert.equal((await told(tab)).shape.legs, 0);
  await tab.locator('#amount-posture').fill('0.3');
  await button('Overlaid').click();
  await button('Reset all').click();
  const { strengths, shape } = await told(tab);
  assert.deepEqual(Object.values(strengths).filter((s) => s !== 0), []);
  assert.deepEqual(Object.values(shape).filter((s) => s !== 1), []);
  await address('#neutral');
});

test('the description of an active style is shown whole', async () => {
  for (const style of ['hobbling', 'legs apart', 'angry']) await setStyle(tab, style, '1');
  const cut = await tab.evaluate(() => [...document.querySelectorAll('.words')]
    .filter((e) => e.checkVisibility() && (e.scrollWidth > e.clientWidth ||
      e.scrollHeight > e.clientHeight || getComputedStyle(e).whiteSpace === 'nowrap'))
    .map((e) => e.textContent));
  assert.deepEqual(cut, []);
  assert.equal(await tab.locator('.words:visible').count(), 3);
  await button('Neutral').click();
});

test('Open is the largest button under the view, and one menu has all that is saved', async () => {
  const sizes = await tab.evaluate(() => [...document.querySelectorAll('.bar button')]
    .filter((e) => e.checkVisibility()).map((e) => {
      const { width, height } = e.getBoundingClientRect();
      return [e.id, width * height];
    }).sort((a, b) => b[1] - a[1]));
  assert.equal(sizes[0][0], 'open');
  const items = tab.locator('#save-menu button:visible');
  assert.equal(await items.count(), 0);
  await button('Save ▾').click();
  assert.deepEqual(await items.allTextContents(), ['BVH', 'GLB', 'VRMA', 'All files (zip)',
    'Picture (PNG)', 'Video (WebM)', 'Loop (GIF)', 'Copy link']);
  await tab.screenshot({ path: join(pictures, 'save-menu.png') });
  await tab.keyboard.press('Escape');
  assert.equal(await items.count(), 0);
  await button('Save ▾').click();
  await tab.locator('#view').click({ position: { x: 30, y: 300 } });
  assert.equal(await items.count(), 0);
});

const shownCards = (where) => where.locator('.play:visible .name').allTextContents();

test('styles are found by their words', async () => {
  const all = await shownCards(tab);
  await tab.locator('#search').fill('slow stooped');
  assert.deepEqual(await shownCards(tab), ['Aching']);
  // Of a group by its name.
  await tab.locator('#search').fill('injuries');
  assert.deepEqual(await shownCards(tab),
    ['Aching', 'Dragging a leg', 'Hobbling', 'Hurt stomach', 'Limping']);
  // What is active is no hit.
  await button('Old').click();
  assert.equal((await shownCards(tab))[0], 'Aching');
  assert.ok(await slider(tab, 'old').isVisible());
  await button('Neutral').click();
  await tab.locator('#search').fill('xyzzy');
  assert.deepEqual(await shownCards(tab), []);
  assert.ok(await tab.getByText('No matching style').isVisible());
  await tab.locator('#search').fill('');
  assert.deepEqual(await shownCards(tab), all);
});

test('everyday words find styles', async () => {
  const { folder, at, remove } = workFolder();
  cpSync(join(models, 'panache-int8.safetensors'), at('described.safetensors'));
  cpSync(join(models, 'styles.csv'), at('styles.csv'));
  execFileSync(join(models, '../scripts/describe-models'), ['described.safetensors'], { cwd: folder });
  const other = await site.open();
  await other.setInputFiles('#file', at('described.safetensors'));
  await other.waitForFunction(() =>
    window.page.panache.styles.some(({ words }) => words.includes('elderly')));
  const wanted = { happy: 'Happy', sad: 'Depressed', elderly: 'Old', tired: 'Moping',
    monster: 'Zombie', ninja: 'Sneaking', fat: 'Heavyset', injured: 'Limping', afraid: 'Scared',
    soldier: 'Marching', kid: 'Childlike', ape: 'Gorilla' };
  for (const [word, style] of Object.entries(wanted)) {
    await other.locator('#search').fill(word);
    const found = await shownCards(other);
    assert.ok(found.includes(style) && found.length <= 4, `${word}: ${found}`);
  }
  await other.close();
  remove();
});

test('styles stand in groups that fold, and a search looks into all of them', async () => {
  const other = await site.open();
  const cards = other.locator('.play:visible');
  const groups = other.locator('#style-cards details.fold');
  const titles = await groups.locator('h3').allTextContents();
  assert.deepEqual(titles,
    ['Moods', 'Ages', 'Bodies', 'Creatures', 'Ways of walking', 'Injuries']);
  const open = () => groups.evaluateAll((boxes) => boxes.map((box) => box.open && !box.hidden));
  assert.deepEqual(await open(), [true, false, false, false, false, false]);
  const moods = await cards.count();
  assert.equal(await groups.nth(0).locator('.count').textContent(), String(moods));
  await groups.nth(1).locator('summary').press('Enter');
  assert.deepEqual(await open(), [true, true, false, false, false, false]);
  await groups.nth(0).locator('summary').click();
  assert.deepEqual(await open(), [false, true, false, false, false, false]);
  await other.locator('#search').fill('undead');
  assert.deepEqual(await open(), [false, false, false, true, false, false]);
  await other.locator('#search').fill('');
  assert.deepEqual(await open(), [false, true, false, false, false, false]);
  const order = await other.locator('.play .name').allTextContents();
  assert.deepEqual(order.map((text) => text.toLowerCase()), await stylesOf(other));
  await other.close();
});

test('active styles have sliders below, and none vanishes while it is in use', async () => {
  await button('Neutral').click();
  const active = () => tab.locator('#active-styles label').allTextContents();
  assert.deepEqual(await active(), []);
  assert.ok(await tab.getByText('Neutral: click a style to see it.').isVisible());
  await setStyle(tab, 'shy', '1.5');
  await tab.getByRole('button', { name: 'Proud robot' }).click();
  assert.deepEqual(await active(), ['Proud', 'Robot']);
  await slider(tab, 'robot').focus();
  await slider(tab, 'robot').fill('0');
  assert.deepEqual(await active(), ['Proud', 'Robot']);
  await slider(tab, 'robot').fill('0.5');
  await slider(tab, 'robot').fill('0');
  await slider(tab, 'proud').focus();
  await tab.waitForFunction(() => !document.getElementById('style-robot'));
  assert.deepEqual(await active(), ['Proud']);
  await button('Neutral').click();
});

test('gestures stand in one list, in an animator\'s words, and play', async () => {
  const titles = await tab.locator('#gestures button').allTextContents();
  assert.ok(titles.length >= 20);
  for (const title of titles) assert.match(title, /^[A-Z][a-z, ]+( \(\d\))?, \d\.\d s$/);
  assert.ok(titles.some((title) => title.startsWith('Glances ')));
  const row = tab.locator('#gestures p[data-style]').first();
  const style = await row.getAttribute('data-style');
  await row.locator('button').first().click();
  // The style of the gesture is on.
  assert.equal(await slider(tab, style).inputValue(), '1');
  await button('Neutral').click();
});

test('a style shows itself as a figure that walks while it is in sight', async () => {
  const look = (style) => card(tab, style).locator('.figure').evaluate((c) => c.toDataURL());
  const isDrawn = (style) => tab.waitForFunction((name) => {
    const canvas = document.querySelector(`.play[data-style="${name}"] .figure`);
    return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some((v) => v);
  }, style);
  await card(tab, 'angry').scrollIntoViewIfNeeded();
  await isDrawn('angry');
  const still = await look('angry');
  await frames(tab, 8);
  assert.notEqual(await look('angry'), still);
  await card(tab, 'limping').scrollIntoViewIfNeeded();
  await isDrawn('limping');
  assert.notEqual(await look('limping'), await look('angry'));
  const gone = await look('angry');
  await frames(tab, 8);
  assert.equal(await look('angry'), gone);
});

test('a key that is held shows the input, and keys work after a click on a button', async () => {
  await button('Very old').click();
  const comparing = () => tab.evaluate(() => window.page.stage.comparing);
  await tab.keyboard.down('x');
  assert.equal(await comparing(), true);
  await frames(tab, 2);
  await tab.screenshot({ path: join(pictures, 'comparing.png') });
  await tab.keyboard.up('x');
  assert.equal(await comparing(), false);
  await tab.keyboard.press('0');
  assert.equal((await told(tab)).strengths.old, 0);
});

test('the camera faces the body, stands in front, beside and over it, and follows', async () => {
  await button('Walk').click();
  const camera = () => tab.evaluate(() => {
    const { eye, parts } = { eye: window.page.stage.eye, parts: window.page.source.player.parts('styled') };
    const [x, y, z, w] = parts.slice(3, 7);
    // The body's +z, on the ground.
    const ahead = [2 * (x * z + w * y), 1 - 2 * (x * x + y * y)];
    const from = [eye[0] - parts[0], eye[2] - parts[2]];
    const far = Math.hypot(...from);
    return { front: (from[0] * ahead[0] + from[1] * ahead[1]) / far / Math.hypot(...ahead),
      up: Math.atan2(eye[1], far), far };
  });
  const after = async (key) => {
    await tab.keyboard.press(key);
    await frames(tab, 1);
    return camera();
  };
  const front = await after('1');
  assert.ok(front.front > 0.95, JSON.stringify(front));
  const side = await after('2');
  assert.ok(Math.abs(side.front) < 0.3, JSON.stringify(side));
  const top = await after('3');
  assert.ok(top.up > 1.1, JSON.stringify(top));
  const face = await after('f');
  // Three quarters from the front: between the two.
  assert.ok(face.front > 0.5 && face.front < 0.87, JSON.stringify(face));
  await frames(tab, 30);
  const later = await camera();
  // It lags by a seventh of a second of a walk, and keeps its distance else.
  assert.ok(Math.abs(later.far - face.far) < 0.4, `${face.far} ${later.far}`);
});

test('the help opens by its key, at its top, and closes', async () => {
  await tab.setViewportSize({ width: 1100, height: 500 });
  await tab.keyboard.press('?');
  assert.equal(await tab.locator('#help').evaluate((dialog) => dialog.scrollTop), 0);
  assert.ok(await tab.locator('#help-title').isVisible());
  assert.match(await tab.locator('#help').textContent(), /Nothing is uploaded/);
  await tab.keyboard.press('Escape');
  assert.ok(!(await tab.locator('#help').isVisible()));
  await tab.setViewportSize({ width: 1280, height: 800 });
});

test('the onion skin shows where the body was', async () => {
  await frames(tab, 40);
  const seen = () => tab.evaluate(() => window.page.stage.onionsShown);
  assert.equal(await seen(), 0);
  await tab.keyboard.press('n');
  await frames(tab, 2);
  assert.ok((await seen()) >= 2);
  await tab.screenshot({ path: join(pictures, 'onion.png') });
  await tab.keyboard.press('n');
});

test('a style reaches the body', async () => {
  await button('Walk').click();
  await button('Neutral').click();
  await frames(tab, 60);
  const hips = (parts) => parts[1], head = (parts) => parts[7 * 4 + 1] - hips(parts);
  const before = head(await styledParts(tab));
  await button('Very old').click();
  await frames(tab, 60);
  // Whoever is very old walks bowed: the head is some centimetres lower over the hips.
  const after = head(await styledParts(tab));
  assert.ok(after < before - 0.02, `${before} ${after}`);
});
