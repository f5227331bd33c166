// node docs-pictures.mjs [CLIP.bvh]: draws docs/pictures/web*.png, retargeted.png and three-vrm.png from
// build/web, build/npm and build/release/panache, as a machine with a graphics card shows them.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { fileURLToPath } from 'node:url';
import { join } from 'node:path';
import { frames, start } from './page/browser.mjs';
import { serveSample } from './page/sample.mjs';

const [clip] = process.argv.slice(2);
const out = fileURLToPath(new URL('../../docs/pictures', import.meta.url));
const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 1.5, isMobile: true,
  hasTouch: true };

// The doll of samples/three_vrm in the old walk of docs/getting-started.md.
const root = fileURLToPath(new URL('../..', import.meta.url));
const program = process.env.PANACHE_PROGRAM ?? join(root, 'build/release/panache');
const work = mkdtempSync(join(tmpdir(), 'panache-pictures-'));
const panache = (...given) => execFileSync(program, given, { cwd: work });
panache('walker', '-o', 'walk.bvh', '--seconds', '8', '--speed', '1.1');
panache('retarget', 'walk.bvh', '--onto', join(root, 'samples/three_vrm/avatar.vrm'), '-o', 'doll.vrm');

const looks = [['retargeted', 'old=1&view=side', { viewport: { width: 1100, height: 640 } },
  join(work, 'doll.vrm')], ['web', ''], ['web-phone', 'old=2&view=styled', phone],
  ['web-dark', 'robot=0.8&proud=0.6&view=over', { colorScheme: 'dark' }]];
if (clip) looks.push(['web-clip', 'limping=1&view=side', {}, clip]);

const site = await start();
for (const [name, hash, options, file] of looks) {
  const tab = await site.open(hash, { ...options, steady: true, card: true, every: 1 });
  if (file) {
    await tab.setInputFiles('#file', file);
    await tab.waitForFunction(() => window.page.source.kind === 'clip');
  }
  for (let i = 0; i < 4; ++i) await frames(tab, 20);
  await tab.screenshot({ path: join(out, `${name}.png`) });
  await tab.close();
}

// Two moods of the sample in one picture.
const sample = await serveSample();
const avatar = await site.plain(sample.address);
await avatar.waitForFunction(() => window.avatar);
const moods = [];
for (const mood of ['sad', 'happy', 'angry', 'proud']) {
  await avatar.evaluate((name) => {
    window.mood(name, 1.2);
    for (let i = 0; i < 90; ++i) window.avatar.update(1 / 60);
  }, mood);
  await avatar.waitForTimeout(500);
  const { width } = await avatar.locator('canvas').boundingBox();
  const clip = { x: width / 2 - 150, y: 20, width: 300, height: 580 };
  moods.push((await avatar.screenshot({ clip })).toString('base64'));
}
await avatar.setViewportSize({ width: 300 * moods.length, height: 580 });
await avatar.setContent(`<body style="margin:0;display:flex">${moods.map((text) =>
  `<img src="data:image/png;base64,${text}">`).join('')}</body>`);
await avatar.screenshot({ path: join(out, 'three-vrm.png') });
await sample.close();
await site.close();
rmSync(work, { recursive: true });
