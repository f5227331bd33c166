// Content security policies: the npm package in a page of somebody else, and our own page as
// `panache view` serves it. Neither needs unsafe-eval.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { serve } from '../serve.mjs';
import { frames, models, nativeHashes, start, workFolder } from './browser.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const { panache, view, remove } = workFolder();
let site;
before(async () => { site = await start(); });
after(async () => {
  await site.close();
  remove();
});

// What a strict page allows: its own scripts, and to compile WebAssembly, which is not eval.
const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'";
const script = `
import { Panache } from '/npm/index.js';
const bytes = async (name) => (await fetch(name)).arrayBuffer();
window.violations = [];
document.addEventListener('securitypolicyviolation', (event) => violations.push(event.blockedURI));
try {
  const panache = await Panache.create({
    wasm: await bytes('/panache.wasm'),
    model: await bytes('/panache-int8.safetensors'),
    walker: await bytes('/walker.safetensors'),
  });
  const walk = panache.createWalker();
  walk.setStrength('old', 1);
  walk.steer(1.4, 0);
  for (let i = 0; i < 120; ++i) walk.step(1 / 60);
  const saved = walk.exportAs('.bvh').length;
  window.done = { hash: panache.goldenHash(), parts: [...walk.parts('styled')], saved };
} catch (error) {
  window.done = { error: String(error) };
}`;

/** The page of somebody else. */
const embed = () => serve((path) => (
  path === '/' ? Buffer.from('<!doctype html><script type="module" src="/main.js"></script>')
    : path === '/main.js' ? Buffer.from(script)
    : path.startsWith('/npm/') ? join(root, 'build', path)
    : path === '/panache.wasm' ? join(root, 'build/wasm/panache.wasm') : join(models, path)),
{ 'Content-Security-Policy': policy });

test('a page that embeds the npm package needs no unsafe-eval', async () => {
  const { server, address } = await embed();
  const tab = await site.plain(address);
  await tab.waitForFunction(() => window.done);
  const done = await tab.evaluate(() => window.done);
  assert.equal(done.error, undefined);
  for (const hash of nativeHashes()) assert.equal(done.hash, hash);
  assert.equal(done.parts.length, 21 * 7);
  assert.ok(done.parts.every(Number.isFinite) && done.saved > 1000);
  assert.deepEqual(await tab.evaluate(() => window.violations), []);
  // The policy is in force.
  assert.equal(await tab.evaluate(() => {
    const probe = document.createElement('script');
    probe.textContent = 'window.inline = true';
    document.head.append(probe);
    return window.inline;
  }), undefined);
  await tab.close();
  server.close();
});

test('the page runs under the policy of panache view, with a file open in it', async (t) => {
  panache('walker', '-o', 'walk.bvh', '--seconds', '2');
  const address = await view(t, 'walk.bvh');
  if (!address) return t.skip('this build has no server for the page');
  assert.match(address, /^http:\/\/127\.0\.0\.1:\d+\/\?open=walk\.bvh$/);
  const answer = await fetch(address);
  assert.match(answer.headers.get('content-security-policy'), /default-src 'none'/);
  assert.doesNotMatch(answer.headers.get('content-security-policy'), /'unsafe-eval'/);
  // Complaints of the browser fail the test at its end.
  const tab = await site.open('old=1', { url: address });
  await tab.waitForFunction(() => window.page.source.file?.name === 'walk.bvh');
  assert.match(await tab.locator('#file-name').textContent(), /walk\.bvh/);
  assert.ok(await tab.evaluate(() => window.crossOriginIsolated));
  await frames(tab, 5);
  await tab.close();
});
