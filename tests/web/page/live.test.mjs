// panache live --view: the page shows what the relay receives and sends.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { frames, models, pictures, start, workFolder } from './browser.mjs';

const work = workFolder(), children = [];
let site;
before(async () => { site = await start(); });
after(async () => {
  for (const child of children) child.kill();
  await site.close();
  work.remove();
});

/** A port that nobody listens at. */
async function freePort() {
  const socket = createSocket('udp4');
  await new Promise((bound) => socket.bind(0, '127.0.0.1', bound));
  const { port } = socket.address();
  await new Promise((closed) => socket.close(closed));
  return port;
}

function run(...given) {
  const child = spawn(process.env.PANACHE_PROGRAM, given, { cwd: work.folder,
    env: { ...process.env, PANACHE_MODEL: join(models, 'panache.safetensors') },
    stdio: ['ignore', 'pipe', 'ignore'] });
  children.push(child);
  return child;
}

test('the page of panache live draws the input and what goes out', async () => {
  work.panache('walker', '--seconds', '20', '-o', 'walk.bvh');
  const [from, to] = [await freePort(), await freePort()];
  const relay = run('live', '--view', '--style', 'old=1', '--vmc-in', `127.0.0.1:${from}`,
    '--vmc-out', `127.0.0.1:${to}`);
  const [line] = await once(relay.stdout, 'data');
  const url = String(line).trim();
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/\?live$/);
  run('live', 'send', 'walk.bvh', '--to', `127.0.0.1:${from}`, '--loop');
  const tab = await site.open('', { url });
  await tab.waitForFunction(() => window.page.poses !== null);
  // The style has come, and the head of an old walk is lower than that of its input.
  await tab.waitForFunction(() => {
    const { poses } = window.page, head = 7 * 5 + 1;
    return poses[147 + head] < poses[head] - 0.05;
  });
  const first = await tab.evaluate(() => [...window.page.poses]);
  await frames(tab, 20);
  assert.notDeepEqual(await tab.evaluate(() => [...window.page.poses]), first);
  assert.ok(first.every(Number.isFinite) && first.length === 294);
  await tab.screenshot({ path: join(pictures, 'live.png') });
  // Ctrl-C ends the relay, although the page is still there; and the page says so.
  relay.kill('SIGINT');
  const [code] = await once(relay, 'exit');
  assert.equal(code, 0);
  await tab.getByText('panache live has ended').waitFor();
  await tab.close();
});
