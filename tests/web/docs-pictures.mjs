// node docs-pictures.mjs [CLIP.bvh]: draws docs/pictures/web*.png from build/web, as a machine with
// a graphics card shows the page.

import { fileURLToPath } from 'node:url';
import { join } from 'node:path';
import { frames, start } from './page/browser.mjs';

const [clip] = process.argv.slice(2);
const out = fileURLToPath(new URL('../../docs/pictures', import.meta.url));
const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 1.5, isMobile: true,
  hasTouch: true };
const looks = [['web', ''], ['web-phone', 'old=2&view=styled', phone],
  ['web-dark', 'robot=0.8&proud=0.6&view=over', { colorScheme: 'dark' }]];
if (clip) looks.push(['web-clip', 'limping=1&view=side', {}, clip]);

const site = await start();
for (const [name, hash, options, file] of looks) {
  const tab = await site.open(hash, { ...options, steady: true, card: true });
  if (file) {
    await tab.setInputFiles('#file', file);
    await tab.waitForFunction(() => window.page.source.kind === 'clip');
  }
  for (let i = 0; i < 4; ++i) await frames(tab, 20);
  await tab.screenshot({ path: join(out, `${name}.png`) });
  await tab.close();
}
await site.close();
