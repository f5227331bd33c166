// Content security policies: the npm package in a page of somebody else, and our own page as
// `panache view` serves it. Neither needs unsafe-eval.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { frames, models, nativeHashes, start } from './browser.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
let site;
before(async () => { site = await start(); });
after(() => site.close());

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

async function embed() {
  const types = { '.js': 'text/javascript', '.html': 'text/html' };
  const server = createServer(async (request, response) => {
    const path = request.url;
    try {
      const body = path === '/' ? '<!doctype html><script type="module" src="/main.js"></script>'
        : path === '/main.js' ? script
        : path.startsWith('/npm/') ? await readFile(join(root, 'build', path))
        : path === '/panache.wasm' ? await readFile(join(root, 'build/wasm/panache.wasm'))
        : await readFile(join(models, path));
      response.setHeader('Content-Type', types[extname(path) || '.html'] ?? 'application/octet-stream');
      response.setHeader('Content-Security-Policy', policy);
      response.end(body);
    } catch {
      response.statusCode = 404;
      response.end();
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return server;
}

test('a page that embeds the npm package needs no unsafe-eval', async () => {
  const server = await embed();
  const tab = await site.plain(`http://127.0.0.1:${server.address().port}/`);
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

test('the page runs under the policy that panache view sends, with a file open in it', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'panache-'));
  const walk = join(folder, 'walk.bvh');
  execFileSync(process.env.PANACHE_PROGRAM, ['walker', '-o', walk, '--seconds', '2']);
  const program = spawn(process.env.PANACHE_PROGRAM, ['view', '--no-open', walk]);
  try {
    const address = await new Promise((resolve, reject) => {
      program.stdout.once('data', (text) => resolve(text.toString().trim()));
      program.once('exit', () => reject(new Error('panache view ended')));
    });
    const answer = await fetch(address);
    assert.match(answer.headers.get('content-security-policy'), /default-src 'none'/);
    assert.doesNotMatch(answer.headers.get('content-security-policy'), /'unsafe-eval'/);
    // Complaints of the browser fail the test at its end.
    const tab = await site.open('old=1', { url: address });
    await tab.waitForFunction(() => document.querySelector('#file-name').textContent.includes('walk.bvh'));
    await frames(tab, 5);
    await tab.close();
  } finally {
    program.kill();
    await rm(folder, { recursive: true });
  }
});
