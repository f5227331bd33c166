import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { card, frames, phone, pictures, slider, start, unfold, workFolder } from './browser.mjs';

const { at, panache, remove } = workFolder();

let site;
before(async () => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '3');
  site = await start();
});
after(async () => {
  await site.close();
  remove();
});

/** Role and name of everything in Chromium's accessibility tree. */
async function told(tab) {
  const session = await tab.context().newCDPSession(tab);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  return nodes.filter((node) => !node.ignored)
    .map((node) => ({ role: node.role?.value, name: node.name?.value }));
}

test('every control has a name', async () => {
  const tab = await site.open();
  await unfold(tab);
  const roles = ['slider', 'spinbutton', 'button', 'combobox', 'application', 'img'];
  const controls = (await told(tab)).filter(({ role }) => roles.includes(role));
  assert.ok(controls.length > 180, `${controls.length}`);
  for (const { role, name } of controls) assert.ok(name, `${role} without a name`);
  await tab.close();
});

test('text stands out from what is behind it, by light and by dark', async () => {
  const tab = await site.open('old=1');
  for (const colorScheme of ['light', 'dark']) {
    await tab.emulateMedia({ colorScheme });
    // WCAG 2: 4.5 to 1.
    const weak = await tab.evaluate(() => {
      const numbers = (text) => text.match(/[\d.]+/g).map(Number);
      const light = ([r, g, b]) => [r, g, b].map((v) => v / 255)
        .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
      const behind = (element) => {
        for (let up = element; up; up = up.parentElement) {
          const colour = numbers(getComputedStyle(up).backgroundColor);
          if (colour.length < 4 || colour[3] === 1) return colour;
        }
        return [255, 255, 255];
      };
      const out = [];
      for (const element of document.querySelectorAll('body *')) {
        const text = [...element.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
        if (!text || element.disabled || !element.checkVisibility()) continue;
        const [a, b] = [light(numbers(getComputedStyle(element).color)), light(behind(element))];
        const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        if (contrast < 4.5) out.push(`${element.textContent}: ${contrast.toFixed(2)}`);
      }
      return out;
    });
    assert.deepEqual(weak, [], colorScheme);
  }
  await tab.close();
});

test('all of it can be done with the keyboard, and one sees where one is', async () => {
  const tab = await site.open();
  const seen = new Set();
  for (let i = 0; i < 140; ++i) {
    await tab.keyboard.press('Tab');
    const at = await tab.evaluate(() => {
      const e = document.activeElement;
      if (e === document.body) return null;
      const { outlineStyle, outlineWidth } = getComputedStyle(e);
      const name = e.id || e.getAttribute('aria-label') || e.textContent;
      return { name, visible: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 2 };
    });
    if (!at) break;
    assert.ok(at.visible, at.name);
    seen.add(at.name);
    if (/^Ages|^save$|^Old$/.test(at.name)) await tab.keyboard.press('Enter');
    if (at.name === 'style-old') {
      await tab.keyboard.press('ArrowRight');
      assert.equal(await tab.locator('#style-old').inputValue(), '1.01');
      await tab.keyboard.press('End');
    }
  }
  for (const name of ['Styled', 'Walk', 'open', 'save', 'save-bvh', 'copy-link', 'style-old', 'pad', 'amount-timing',
    'Legs', 'Foot lock']) {
    assert.ok(seen.has(name), name);
  }
  assert.equal(await tab.locator('#style-old').inputValue(), '2');
  await tab.evaluate(() => document.activeElement.blur());
  await tab.keyboard.press('Space');
  const stand = tab.getByRole('button', { name: 'Idle', exact: true });
  assert.equal(await stand.getAttribute('aria-pressed'), 'true');
  await tab.close();
});

test('a phone shows all of it, large enough for a finger', async () => {
  const tab = await site.open('old=1', phone);
  const scrolled = await tab.evaluate(() => document.documentElement.scrollWidth);
  assert.equal(scrolled, 390);
  const small = await tab.evaluate(() => [...document.querySelectorAll('button, select, input, summary')]
    .filter((e) => e.checkVisibility() && !e.hidden)
    .map((e) => [e.id || e.textContent, e.getBoundingClientRect().height])
    .filter(([, height]) => height < 36));
  assert.deepEqual(small, []);
  await card(tab, 'proud').scrollIntoViewIfNeeded();
  await card(tab, 'proud').tap();
  await slider(tab, 'proud').tap();
  assert.notEqual(await slider(tab, 'proud').inputValue(), '1');
  // The character stays in sight while one is at the sliders.
  assert.ok((await tab.locator('#view').boundingBox()).y >= 0);
  await tab.close();
});

test('small screens: nothing overlaps or is scrolled sideways, and the view keeps half', async () => {
  const sizes = [[844, 390], [320, 640], [390, 844]];
  const tab = await site.open('', { viewport: { width: 844, height: 390 }, steady: true });
  const measure = () => tab.evaluate(() => {
    const boxes = [...document.querySelectorAll('h1, .stage button, .stage select, .bar button, ' +
      '.bar select, .bar output, .key-field, #stick, .split-names span')]
      .filter((e) => e.checkVisibility() && e.getBoundingClientRect().width)
      .map((e) => {
        // A word, and not the half of the view that it stands in.
        const word = document.createRange();
        word.selectNodeContents(e);
        const box = (e.tagName === 'SPAN' ? word : e).getBoundingClientRect();
        return [e.id || e.textContent, box, e];
      });
    const out = [];
    boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
      const apart = p.right <= q.left + 0.5 || q.right <= p.left + 0.5 ||
        p.bottom <= q.top + 0.5 || q.bottom <= p.top + 0.5;
      if (!apart) out.push(`${a} over ${b}`);
    }));
    const sideways = [...document.querySelectorAll('html, body *')]
      .filter((e) => e.checkVisibility() && e.scrollWidth > e.clientWidth + 1 &&
        ['auto', 'scroll'].includes(getComputedStyle(e).overflowX))
      .map((e) => e.id || e.className);
    // The bar ends where the panel begins.
    const end = (e) => (e.closest('.bar') ?? document.body).getBoundingClientRect().right;
    const outside = boxes.filter(([, box, e]) => box.left < -0.5 || box.right > end(e) + 0.5);
    const view = document.querySelector('#view').getBoundingClientRect();
    return { scrolled: document.documentElement.scrollWidth, overlaps: out, sideways,
      outside: outside.map(([name]) => name),
      view: (view.width * view.height) / (innerWidth * innerHeight) };
  });
  const check = async ([width, height], what) => {
    await tab.setViewportSize({ width, height });
    await frames(tab, 2);
    // A click may have scrolled what it is under the view, which stays where it is.
    await tab.evaluate(() => window.scrollTo(0, 0));
    const { scrolled, view, ...faults } = await measure();
    assert.deepEqual(faults, { overlaps: [], sideways: [], outside: [] }, what);
    assert.equal(scrolled, width, what);
    assert.ok(view >= 0.49, `${what}: ${view}`);
    await tab.screenshot({ path: join(pictures, `${what}.png`) });
  };
  for (const size of sizes) await check(size, size.join('x'));
  // A clip has more controls under the view than the walker.
  await tab.setInputFiles('#file', at('walk.bvh'));
  await tab.waitForFunction(() => window.page.source.kind === 'clip');
  await tab.locator('#show-keys').click();
  for (const size of sizes) await check(size, `${size.join('x')}-keys`);
  await tab.close();
});
