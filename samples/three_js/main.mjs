// node main.mjs PACKAGE STYLE: styles a three.js figure for three seconds, PACKAGE being build/npm.
import { readFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Vector3 } from 'three';

import { createFigure, humanBones, walk } from './stick_figure.mjs';
import { StyledBones } from './styled_bones.mjs';

const [folder, style = 'old'] = process.argv.slice(2);
if (!folder) {
  console.error('usage: node main.mjs PACKAGE [STYLE]');
  process.exit(2);
}
const { Panache } = await import(pathToFileURL(resolve(folder, 'index.js')).href);
const panache = await Panache.create({
  wasm: await readFile(resolve(folder, 'panache.wasm')),
  model: await readFile(resolve(folder, 'panache-int8.safetensors')),
});
const figure = createFigure();
const styled = new StyledBones(panache, figure, humanBones);
styled.character.setStrength(style, 1);

// How far the head is ahead of the hips, cm.
function stoop() {
  figure.updateMatrixWorld(true);
  const head = figure.getObjectByName('Skull').getWorldPosition(new Vector3());
  return 100 * (head.z - figure.position.z);
}

console.log(`seconds  head ahead of the hips, cm: as it walks  as '${style}'`);
for (let frame = 0; frame <= 180; ++frame) {
  walk(figure, frame / 60);
  const before = stoop();
  styled.step(1 / 60);
  if (frame % 30 !== 0) continue;
  console.log(`${(frame / 60).toFixed(1).padStart(7)}  ${before.toFixed(1).padStart(41)}  ` +
    stoop().toFixed(1).padStart(8));
}
styled.free();
panache.free();
