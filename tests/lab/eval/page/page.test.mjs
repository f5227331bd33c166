// The page of a report in a browser. PANACHE_REPORTS: a folder with the reports `full` and `empty`
// of write_reports.cpp.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import playwright from 'playwright-core';

const rude = 'a<b> & "c"\'s';  // A system's name.
const all = ['judged', 'overall', 'content', 'style', 'performers', 'strength', 'mixes', 'unseen', 'foreign',
  'disturbances', 'foresight', 'persons', 'strips', 'contacts', 'literature', 'cost', 'definitions'];
let browser;
before(async () => {
  browser = await playwright.chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
});
after(() => browser?.close());

// The page, from its file, and its numbers. It may complain of nothing and load nothing else.
async function open(name) {
  const folder = join(process.env.PANACHE_REPORTS, name);
  const page = await browser.newPage();
  const problems = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('console', (message) => problems.push(message.text()));
  page.on('request', (request) => {
    if (!request.url().endsWith('/index.html')) problems.push(request.url());
  });
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
  assert.deepEqual(problems, []);
  return { page, report: JSON.parse(await readFile(join(folder, 'report.json'), 'utf8')) };
}

// The rows of a table, as texts: those of the first table in `section` that has this caption.
const rows = (page, section, caption = '') => page.evaluate(([id, wanted]) => {
  const table = [...document.querySelectorAll(`#${id} table`)]
    .find((one) => (one.caption?.textContent ?? '') === wanted);
  return [...table.tBodies[0].rows].map((row) => [...row.cells].map((cell) => cell.textContent));
}, [section, caption]);

// Every number anywhere in the JSON.
function numbersOf(value, into = []) {
  if (typeof value === 'number') into.push(value);
  else if (value && typeof value === 'object') Object.values(value).forEach((part) => numbersOf(part, into));
  return into;
}

test('every section of a full report is there, in order, and none of an empty one', async () => {
  const ids = (page) => page.locator('section').evaluateAll((found) => found.map((one) => one.id));
  const links = (page) => page.locator('nav a').evaluateAll((found) => found.map((one) => one.hash.slice(1)));
  const { page: full } = await open('full');
  assert.deepEqual(await ids(full), all);
  assert.deepEqual(await links(full), all);
  const named = await full.locator('[id]').evaluateAll((found) => found.map((one) => one.id));
  assert.equal(new Set(named).size, named.length, 'an id stands twice');
  const { page: empty } = await open('empty');
  assert.deepEqual(await ids(empty), ['judged', 'definitions']);
});

test('every number of a table is one of the JSON, rounded', async () => {
  const { page, report } = await open('full');
  const known = new Set(numbersOf(report).flatMap((value) =>
    [0, 1, 2, 3, 4].map((digits) => value.toFixed(digits)).concat(value.toLocaleString('en-US'))));
  known.add(`${Math.floor((868352 + 512) / 1024)} KB`);
  const shown = await page.locator('td').evaluateAll((cells) => cells.map((cell) => cell.textContent));
  const numbers = shown.map((text) => text.replace(/^\u2022 /, '')).filter((text) => /\d/.test(text));
  assert.ok(numbers.length > 500, `${numbers.length} numbers`);
  assert.deepEqual(numbers.filter((text) => !known.has(text)), []);
});

test('numbers stand in their own row and column', async () => {
  const { page, report } = await open('full');
  const fixed = (value, digits) => value.toFixed(digits);
  const overall = await rows(page, 'overall');
  assert.deepEqual(overall.map(([name]) => name), ['real takes', 'input', 'panache', rude]);
  for (const [m, { key, digits }] of report.measures.entries()) {
    assert.equal(overall[0][3 + m], fixed(report.real[key], digits), key);
    assert.equal(overall[2][3 + m].replace('\u2022 ', ''), fixed(report.systems.panache.seen[key], digits), key);
  }
  assert.deepEqual((await rows(page, 'cost'))[0], ['panache', 'panache', '6.50', '848 KB', '216,412', '0.0020']);
  assert.deepEqual((await rows(page, 'mixes'))[0].slice(0, 4), ['old + proud', '0.810', '0.720', '0.930']);
  assert.deepEqual((await rows(page, 'foresight', 'panache'))[0].slice(0, 4),
    ['walk', '\u2022 0.50', '1.50', '6.50']);
  assert.deepEqual(await rows(page, 'persons', 'panache'),
    [['29 real people', '4.13', '6.25', '0.875'], ['20 seeds', '4.50', '6.50', '0.950']]);
  const worst = await rows(page, 'foreign', 'Most jerk against the input');
  assert.equal(worst.length, 8);
  assert.deepEqual(worst[0].slice(0, 2), ['box, style 10', '2.00']);
  const clips = await rows(page, 'performers', 'Share of clips recognised, and distance from the nearest real take');
  assert.deepEqual(clips.map(([name]) => name), ['neutral', 'old', 'proud', 'all styles']);
});

test('it says what was evaluated, on what, and how long that took', async () => {
  const { page } = await open('full');
  const facts = await page.locator('.facts > *').allInnerTexts();
  assert.deepEqual(facts, ['Evaluated on', 'two.csv', 'Trained on', 'one.csv', 'Real takes',
    '97 held out, 485 windows', 'Styles', 'old, proud', 'Contents', 'walk, run', 'Style classifier on real takes',
    '0.971 (usual: at least 0.950)', 'Content classifier on real takes', '0.972 (usual: at least 0.900)', 'Time taken',
    '7 min 7 s']);
});

test('the best system is marked with more than colour', async () => {
  const { page } = await open('full');
  const style = (await rows(page, 'overall')).map((row) => row[3]);
  assert.deepEqual(style.map((text) => text.startsWith('\u2022')), [false, false, true, false]);
  assert.equal(await page.locator('#overall tbody tr:nth-child(3) td:nth-child(4) b').count(), 1);
});

test('what was not measured is a dash, and classifiers that are not good enough are told of', async () => {
  const { page } = await open('poor');
  assert.ok((await rows(page, 'overall'))[0].includes('\u2013'));
  assert.doesNotMatch(await page.locator('body').innerText(), /NaN|undefined|null/);
  assert.match(await page.locator('p.warning').innerText(), /^The style classifier recognises 0\.940/);
  const { page: full } = await open('full');
  assert.equal(await full.locator('p.warning').count(), 0);
});

test('names are text wherever they stand', async () => {
  const { page } = await open('full');
  assert.equal(await page.locator('b').filter({ hasNotText: '\u2022' }).count(), 0);
  assert.ok((await page.locator('body').innerText()).split(rude).length > 10);
});

test('confusions, curves, strips and contacts are drawn', async () => {
  const { page } = await open('full');
  const names = await page.locator('svg').evaluateAll((found) => found.map((one) => one.getAttribute('aria-label')));
  for (const name of ['Confusion of styles, real takes', 'Confusion of styles, panache', `Confusion of styles, ${rude}`,
    'Style recognised over strength', 'Film strip: walk, old', 'When the feet are planted: walk, old']) {
    assert.equal(names.filter((one) => one === name).length, 1, name);
  }
  // Ten frames a second: the left foot stands in the first two of three frames, the right one in the
  // last two.
  const bars = await page.locator('#contacts rect').evaluateAll((found) =>
    found.map((one) => ['x', 'width'].map((name) => Number(one.getAttribute(name)))));
  const [[start, track], [left, leftWidth], , [right, rightWidth]] = bars;
  const near = (a, b) => assert.ok(Math.abs(a - b) < 0.01, `${a} is not ${b}`);
  near(left, start);
  near(leftWidth, track * 2 / 3);
  near(right, start + track / 3);
  near(rightWidth, track * 2 / 3);
  // Each square of a confusion holds its number of clips.
  const squares = await page.locator('svg[aria-label="Confusion of styles, real takes"] text[font-size="9"]')
    .evaluateAll((found) => found.map((one) => one.textContent));
  assert.deepEqual(squares, ['1', '1', '1', '2']);
});

test('every measure is defined', async () => {
  const { page, report } = await open('full');
  const terms = await page.locator('.definitions dt').allInnerTexts();
  for (const { label } of report.measures) assert.ok(terms.includes(label), label);
});
