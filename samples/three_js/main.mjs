// node main.mjs STYLE: styles a figure that an AnimationMixer moves, for three seconds.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { Panache } from 'panache';
import { StyledMixer } from 'panache/three';
import { AnimationMixer, Vector3 } from 'three';

import { createFigure, createWalk, humanBones } from './stick_figure.mjs';

const style = process.argv[2] ?? 'old';
const { resolve } = createRequire(import.meta.url);
const panache = await Panache.create({
  wasm: await readFile(resolve('panache/panache.wasm')),
  model: await readFile(resolve('panache/panache-int8.safetensors')),
});
const figure = createFigure();
const mixer = new AnimationMixer(figure);
mixer.clipAction(createWalk(3)).play();
const styled = new StyledMixer(panache, mixer, { humanBones });
styled.setStrength(style, 1);

// How far the head is ahead of the hips, cm.
function stoop() {
  figure.updateMatrixWorld(true);
  const head = figure.getObjectByName('Skull').getWorldPosition(new Vector3());
  return 100 * (head.z - figure.position.z);
}

console.log(`seconds  head ahead of the hips, cm: as it walks  as '${style}'`);
for (let frame = 0; frame < 180; ++frame) {
  styled.update(1 / 60);
  if (frame % 30 !== 29) continue;
  const after = stoop();
  styled.restore();
  console.log(`${((frame + 1) / 60).toFixed(1).padStart(7)}  ${stoop().toFixed(1).padStart(41)}  ` +
    after.toFixed(1).padStart(8));
}
styled.free();
panache.free();
