// compare.mjs ONNXRUNTIME MODEL.onnx FOLDER LIMIT: runs the model in ONNX Runtime on the windows and
// strengths in FOLDER and compares all that it gives with what the library gave: to within LIMIT.

import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const kBatch = 1000;
const [package_, model, folder, limit] = process.argv.slice(2);
const ort = createRequire(import.meta.url)(package_);
const read = (name) => new Float32Array(new Uint8Array(readFileSync(join(folder, name))).buffer);

const session = await ort.InferenceSession.create(model, { intraOpNumThreads: 1 });
const contacts = read('contacts');
const count = contacts.length / 2;
const expected = Object.fromEntries(session.outputNames.map((name) => [name, read(name)]));
const inputs = Object.fromEntries(['windows', 'strengths'].map((name) => [name, read(name)]));
const worst = Object.fromEntries(session.outputNames.map((name) => [name, 0]));
for (let begin = 0; begin < count; begin += kBatch) {
  const rows = Math.min(kBatch, count - begin);
  const feeds = {};
  for (const [name, values] of Object.entries(inputs)) {
    const columns = values.length / count;
    feeds[name] = new ort.Tensor(
      'float32', values.subarray(begin * columns, (begin + rows) * columns), [rows, columns]);
  }
  const found = await session.run(feeds);
  for (const [name, all] of Object.entries(expected)) {
    const columns = all.length / count;
    if (found[name].dims.join() !== [rows, columns].join()) {
      throw Error(`${name}: has shape ${found[name].dims}; expected ${rows},${columns}`);
    }
    for (let i = 0; i < rows * columns; ++i) {
      const difference = Math.abs(found[name].data[i] - all[begin * columns + i]);
      if (!(difference <= worst[name])) worst[name] = difference;
    }
  }
}
console.log(`${count} windows: ` +
  Object.entries(worst).map(([name, x]) => `${name} ${x.toExponential(1)}`).join(', '));
if (!Object.values(worst).every((difference) => difference <= Number(limit))) {
  console.error(`compare.mjs: ${model} differs from the library by more than ${limit}`);
  process.exit(1);
}
