// node example.mjs walk.bvh old=1 proud=0.5 > styled.bvh: restyles a file.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { Panache } from 'panache';

const { resolve } = createRequire(import.meta.url);
const fileOf = (name) => readFile(resolve(`panache/${name}`));
const [path, ...styles] = process.argv.slice(2);
const panache = await Panache.create({
  wasm: await fileOf('panache.wasm'),
  model: await fileOf('panache-int8.safetensors'),
});
try {
  const file = panache.openFile(await readFile(path), path);
  const player = file.createPlayer();
  for (const style of styles) {
    const [name, strength] = style.split('=');
    player.setStrength(name, Number(strength));
  }
  process.stdout.write(player.exportAs(file.extension));
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
