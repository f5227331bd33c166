// node load-time.mjs [RUNS]: how soon the character moves and the styles are there, after the page of
// build/web is asked for from `panache view` and from a plain static server in turns, and after a
// reload; what comes over the wire; and the processor time of the program for a load and a reload.
// PANACHE_PROGRAM names another program than build/release/panache.

import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { join } from 'node:path';
import { start } from './page/browser.mjs';
import { launchChromium } from './serve.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const runs = Number(process.argv[2] ?? 5);
const program = spawn(process.env.PANACHE_PROGRAM ?? join(root, 'build/release/panache'), ['view', '--no-open']);
const address = await new Promise((done) =>
  program.stdout.once('data', (text) => done(String(text).trim())));
// Seconds of processor time, user's and system's, at the usual 100 ticks.
const cpu = () => {
  const fields = readFileSync(`/proc/${program.pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
  return (Number(fields[11]) + Number(fields[12])) / 100;
};
const site = await start();  // The static server.
const browser = await launchChromium();

async function time(tab, go) {
  const begin = performance.now();
  await go();
  await tab.waitForFunction(() => window.page?.frames > 2, null, { polling: 20 });
  const moves = (performance.now() - begin) / 1000;
  await tab.waitForFunction(() => window.page.ready, null, { polling: 20 });
  return { moves, styles: (performance.now() - begin) / 1000 };
}
const all = { view: [], reload: [], static: [] }, cost = { load: [], reload: [] };
let bytes = 0;
for (let i = 0; i < runs; ++i) {
  for (const [kind, url] of [['view', address], ['static', site.address]]) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
    const tab = await context.newPage();
    const session = await context.newCDPSession(tab);
    await session.send('Network.enable');
    bytes = kind === 'view' ? 0 : bytes;
    session.on('Network.loadingFinished', ({ encodedDataLength }) => {
      if (kind === 'view') bytes += encodedDataLength;
    });
    let before = cpu();
    all[kind].push(await time(tab, () => tab.goto(url, { waitUntil: 'commit' })));
    if (kind === 'view') {
      const first = bytes;
      cost.load.push(cpu() - before);
      before = cpu();
      await tab.evaluate(() => delete window.page);
      all.reload.push(await time(tab, () => tab.reload({ waitUntil: 'commit' })));
      cost.reload.push(cpu() - before);
      if (i === 0) console.log(`first load ${first} bytes, reload ${bytes - first}`);
    }
    await context.close();
  }
}
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
for (const [kind, times] of Object.entries(all)) {
  console.log(`${kind}: moves after ${median(times.map(({ moves }) => moves)).toFixed(2)} s, ` +
    `styles after ${median(times.map(({ styles }) => styles)).toFixed(2)} s (median of ${runs})`);
}
console.log(`processor time of the program: load ${Math.max(...cost.load)} s, reload ${Math.max(...cost.reload)} s (maximum)`);
await browser.close();
await site.close();
program.kill();
process.exit(0);
