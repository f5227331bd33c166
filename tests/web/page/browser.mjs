// What the tests of the page share: a server of the built page, and a browser that complains.

import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { mkdir, readFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import playwright from 'playwright-core';
import { launchChromium, serve } from '../serve.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
export const pageFolder = join(root, 'build', 'web');
export const models = join(root, 'models');

/** The hash of 300 styled frames natively, on each instruction set of the machine. */
export const nativeHashes = () =>
  execFileSync(process.env.PANACHE_GOLDEN, [join(models, 'panache-int8.safetensors')])
    .toString().trim().split('\n').map((line) => line.split(' ')[1]);

/** A folder of a test's own: the path of a file in it, the program run there, and its end. */
export function workFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'panache-page-'));
  return {
    folder,
    at: (name) => join(folder, name),
    panache: (...given) => execFileSync(process.env.PANACHE_PROGRAM, given,
      { cwd: folder, encoding: 'utf8' }),
    // Runs `panache view`: where it serves the page, or '' where this build does not.
    view: async (t, ...given) => {
      const server = spawn(process.env.PANACHE_PROGRAM, ['view', '--no-open', ...given],
        { cwd: folder });
      t.after(() => server.kill());
      return new Promise((done) => {
        server.stdout.once('data', (data) => done(String(data).trim()));
        server.once('exit', () => done(''));
      });
    },
    remove: () => rmSync(folder, { recursive: true }),
  };
}

// Milliseconds after which something is taken to hang, on a busy machine too.
const kPatience = 180000;

/** The page at an address with a path of its own, as it may lie on any server. */
async function servePage() {
  const { server, address } = await serve((path) =>
    join(pageFolder, path.replace(/^\/some\/path\//, '/').replace(/\/$/, '/index.html')));
  return { server, address: `${address}some/path/` };
}

// Sixty frames for each second of the motion, however long they take, as with a graphics card.
function steadyFrames() {
  const request = window.requestAnimationFrame.bind(window);
  let now = 0, last = -1;
  // Who else asks, as playwright does while it waits, is called in the same frame.
  window.requestAnimationFrame = (draw) => request((time) => {
    if (time !== last) now += 1000 / 60;
    last = time;
    draw(now);
  });
}

// The page spares whoever draws in software, which a browser without a window always does.
function graphicsCard() {
  WebGL2RenderingContext.prototype.getExtension = ((own) => function (name) {
    return name === 'WEBGL_debug_renderer_info' ? null : own.call(this, name);
  })(WebGL2RenderingContext.prototype.getExtension);
}

// To draw without a graphics card takes most of the time of a frame, and nobody looks: of so many
// frames one is drawn. What draws at once does so still.
function drawOneOf(count) {
  const { stage } = window.page;
  if (!stage) return;
  const { draw } = stage;
  let frame = 0;
  stage.draw = (seconds) => {
    if (seconds === 0 || ++frame % count === 0) draw.call(stage, seconds);
  };
}

/** Debian's Firefox instead of its Chromium, over WebDriver BiDi. */
export const isFirefox = process.env.PANACHE_BROWSER === 'firefox';

/** Screenshots for a person to look at. */
export const pictures = join(root, 'build', 'web-pictures', isFirefox ? 'firefox' : 'chromium');

/** A small screen for fingers, which Firefox over WebDriver BiDi does not have. */
export const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2,
  isMobile: true, hasTouch: true };

// Firefox has WebGL only in a window.
const launch = () => (isFirefox ? playwright._bidiFirefox.launch({
  executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr', headless: false,
  env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: '1' },
  firefoxUserPrefs: { 'webgl.force-enabled': true },
}) : launchChromium());

/** Starts both; close() ends them. open() gives a tab in which the page runs. */
export async function start() {
  const { server, address } = await servePage();
  const browser = await launch();
  await mkdir(pictures, { recursive: true });
  const complaints = [], requests = [];

  // Without a hash as a visitor sees it first; most tests want a neutral start.
  async function open(hash = 'neutral', options = {}) {
    // `route`: what becomes of some requests; the page may then not get ready, or fail. `every`: of
    // that many frames one is drawn.
    const { url = address, steady, card, route, fails, every = 5, ...look } = options;
    const tab = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...look });
    tab.setDefaultTimeout(kPatience);
    if (steady) await tab.addInitScript(steadyFrames);
    if (card) await tab.addInitScript(graphicsCard);
    if (isFirefox) await tab.addInitScript(keepDownloads);
    if (route) await tab.route(...route);
    tab.on('console', (message) => {
      // Chromium warns of its own slowness when WebGL runs in software, and when tests read pixels.
      const ours = !/GL Driver Message|software WebGL|willReadFrequently/.test(message.text());
      if (ours && !fails && ['error', 'warning'].includes(message.type())) complaints.push(message.text());
    });
    tab.on('pageerror', (error) => fails || complaints.push(error.message));
    tab.on('request', (request) => requests.push(request.url()));
    await tab.goto(url + (hash ? `#${hash}` : ''));
    if (route) return tab;
    await tab.waitForFunction(() => window.page?.ready && window.page.frames > 2);
    await tab.evaluate(drawOneOf, every);
    return tab;
  }
  /** A page of somebody else. */
  async function plain(url) {
    const tab = await browser.newPage();
    tab.setDefaultTimeout(kPatience);
    await tab.goto(url);
    return tab;
  }
  async function close() {
    await browser.close();
    server.close();
    assert.deepEqual(complaints, []);
  }
  return { open, plain, close, address, requests };
}

/** The slider of an active style, which may have any name. */
export const slider = (tab, style) => tab.locator(`[id="style-${encodeURIComponent(style)}"]`);
/** The button on the card of a style. */
export const card = (tab, style) => tab.locator(`.play[data-style="${style}"]`);
/** Gives a style a strength, besides the others. */
export async function setStyle(tab, style, value) {
  if (!(await slider(tab, style).count())) {
    await card(tab, style).evaluate((play) => play.nextElementSibling.click());
  }
  await slider(tab, style).fill(value);
}
/** Opens all groups of styles. */
export const unfold = (tab) => tab.evaluate(() =>
  document.querySelectorAll('details.fold:not([open]) summary').forEach((fold) => fold.click()));

/** Drops files, by their names and bytes, on the element that `selector` finds. */
export async function drop(tab, selector, files) {
  await tab.evaluate(async ([where, list]) => {
    const data = new DataTransfer();
    for (const [name, text] of list) {
      const answer = await fetch(`data:application/octet-stream;base64,${text}`);
      data.items.add(new File([await answer.blob()], name));
    }
    const event = (type) =>
      new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true });
    const target = document.querySelector(where);
    for (const type of ['dragenter', 'dragover', 'drop']) target.dispatchEvent(event(type));
  }, [selector, files.map(([name, bytes]) => [name, bytes.toString('base64')])]);
}

// WebDriver BiDi tells of no downloads: the page's links hand over what they would save.
function keepDownloads() {
  const { click } = HTMLAnchorElement.prototype;
  HTMLAnchorElement.prototype.click = function () {
    if (!this.download) return click.call(this);
    const { download: name, href } = this;
    window.downloads.push(fetch(href).then((answer) => answer.blob()).then((blob) =>
      new Promise((done) => {
        const reader = new FileReader();
        reader.onload = () => done({ name, text: reader.result.split(',')[1] });
        reader.readAsDataURL(blob);
      })));
  };
  window.downloads = [];
}

/** Presses what saves a file: its name and bytes. */
export async function download(tab, press) {
  if (isFirefox) {
    await press();
    await tab.waitForFunction(() => window.downloads.length > 0);
    const { name, text } = await tab.evaluate(() => window.downloads.shift());
    return { name, bytes: Buffer.from(text, 'base64') };
  }
  const coming = tab.waitForEvent('download');
  await press();
  const file = await coming;
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}

/** Chooses from the menu Save: 'bvh', 'png', .... */
export async function chooseSave(tab, what) {
  await tab.locator('#save').click();
  await tab.locator(`#save-${what.toLowerCase()}`).click();
}

/** A double click at a place of the page. */
export async function doubleClick(tab, x, y) {
  if (!isFirefox) return tab.mouse.dblclick(x, y);
  // Over WebDriver BiDi two clicks are no double click.
  await tab.mouse.click(x, y);
  await tab.mouse.click(x, y);
  await tab.evaluate(([left, top]) => document.elementFromPoint(left, top)
    .dispatchEvent(new MouseEvent('dblclick', { bubbles: true })), [x, y]);
}

/** Waits until the page has made some more frames, and draws the last one. */
export async function frames(tab, count = 3) {
  const begin = await tab.evaluate(() => window.page.frames);
  await tab.waitForFunction((until) => window.page.frames >= until, begin + count);
  await tab.evaluate(() => window.page.stage?.draw(0));
}

/** Where the styled body is, and how each of its parts is turned. */
export function styledParts(tab) {
  return tab.evaluate(() => [...window.page.source.player.parts('styled')]);
}

/** Listens to what the page asks of the library from now on; told() has the last of it. */
export async function listen(tab) {
  await tab.evaluate(() => {
    const player = window.page.source.player, told = { strengths: {} };
    const { setStrength, setShape, setTiming } = player;
    player.setStrength = (name, value) => {
      told.strengths[name] = value;
      setStrength.call(player, name, value);
    };
    player.setShape = (shape) => {
      told.shape = shape;
      setShape.call(player, shape);
    };
    player.setTiming = (timing) => {
      told.timing = timing;
      setTiming.call(player, timing);
    };
    player.steer &&= ((steer) => (speed, turn) => {
      told.steer = { speed, turn };
      steer.call(player, speed, turn);
    })(player.steer);
    window.told = told;
  });
}
export const told = (tab) => tab.evaluate(() => window.told);
