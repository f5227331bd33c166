// node frame-rate.mjs: how fast the built page draws without a graphics card, side by side at 1440 x
// 900: how soon it moves, what a step costs, frames a second, where the time of a frame goes, and how long a push of a slider takes to be
// seen.

import { frames, start } from './page/browser.mjs';

const kSettle = 6000, kSeconds = 5;

const site = await start();
const opening = performance.now();
const tab = await site.open('', { viewport: { width: 1440, height: 900 }, every: 1 });
console.log(`moves ${Math.round(performance.now() - opening)} ms after opening`);
const steps = await tab.evaluate(() => {
  const { source: { player }, panache } = window.page;
  const median = (count, work) => Array.from({ length: count }, () => {
    const begin = performance.now();
    work();
    return performance.now() - begin;
  }).sort((a, b) => a - b)[count >> 1];
  const players = Array.from({ length: 20 }, () => panache.createWalker());
  for (const each of players) {
    each.setStrength('old', 1);
    each.steer(1.3, 0);
  }
  const one = median(400, () => player.measure(64)) / 64;
  const crowd = median(240, () => players.forEach((each) => each.step(1 / 60)));
  for (const each of players) each.free();
  return { one, crowd };
});
console.log(`a step: ${(1000 * steps.one).toFixed(1)} us; twenty characters, walkers and all: ` +
  `${steps.crowd.toFixed(2)} ms a frame`);
await tab.waitForTimeout(kSettle);  // The figures are drawn, sharpness is given up where it must.
const measured = await tab.evaluate((seconds) => new Promise((done) => {
  const { stage } = window.page;
  const own = { draw: 0 };
  const draw = stage.draw;
  stage.draw = function (...given) {
    const begin = performance.now();
    draw.apply(this, given);
    own.draw += performance.now() - begin;
  };
  const begin = performance.now(), first = window.page.frames;

  const look = () => {
    const now = performance.now();
    if (now - begin < 1000 * seconds) return requestAnimationFrame(look);
    const count = window.page.frames - first;
    stage.draw = draw;
    done({ fps: (1000 * count) / (now - begin), drawMs: own.draw / count,
      ratio: stage.canvas.width / stage.canvas.clientWidth });
  };
  requestAnimationFrame(look);
}), kSeconds);
console.log(`frames a second: ${measured.fps.toFixed(1)}, pixels drawn for one of the page's: ` +
  `${measured.ratio.toFixed(2)} in each direction; issuing the draw calls ` +
  `${measured.drawMs.toFixed(2)} ms a frame`);

await tab.locator('#style-proud').scrollIntoViewIfNeeded();
const box = await tab.locator('#style-proud').boundingBox();
await tab.evaluate(() => {
  window.delays = [];
  document.querySelector('#style-proud').addEventListener('input', (event) => {
    // The task after a frame is after its painting.
    requestAnimationFrame(() => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => window.delays.push(performance.now() - event.timeStamp);
      port2.postMessage(0);
    });
  });
});
await tab.mouse.move(box.x + 20, box.y + box.height / 2);
await tab.mouse.down();
for (let i = 0; i < 80; ++i) {
  await tab.mouse.move(box.x + 20 + (i % 40) * (box.width / 45), box.y + box.height / 2);
  await tab.waitForTimeout(25);
}
await tab.mouse.up();
await frames(tab);
const delays = (await tab.evaluate(() => window.delays)).sort((a, b) => a - b);
const at = (share) => delays[Math.min(delays.length - 1, Math.floor(share * delays.length))];
console.log(`from a push of a slider to the next paint: median ${at(0.5).toFixed(0)} ms, ` +
  `98 % within ${at(0.98).toFixed(0)} ms (${delays.length} pushes)`);
await tab.close();
await site.close();
