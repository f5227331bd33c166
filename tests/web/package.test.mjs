// The npm package under Node: what the module exports, and poses of the caller's own.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cp, mkdir, mkdtemp, readFile, rm, symlink } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const read = (path) => readFile(join(root, path));
const kJoints = 19, kFrames = 180;

let folder, panache, wasm, PanacheError, createFigure, humanBones, StyledBones;
before(async () => {
  // The package and the sample as a user has them.
  folder = await mkdtemp(join(tmpdir(), 'panache-'));
  await cp(join(root, 'apps/web/package'), join(folder, 'package'), { recursive: true });
  await cp(join(root, 'build/wasm/panache.wasm'), join(folder, 'package/panache.wasm'));
  await cp(join(root, 'models/panache-int8.safetensors'), join(folder, 'package/panache-int8.safetensors'));
  await mkdir(join(folder, 'three_js'));
  for (const name of ['main.mjs', 'package.json', 'stick_figure.mjs', 'styled_bones.mjs']) {
    await cp(join(root, 'samples/three_js', name), join(folder, 'three_js', name));
  }
  await symlink(join(root, 'apps/web/node_modules'), join(folder, 'three_js/node_modules'));
  const load = (path) => import(pathToFileURL(join(folder, path)).href);
  ({ createFigure, humanBones } = await load('three_js/stick_figure.mjs'));
  ({ StyledBones } = await load('three_js/styled_bones.mjs'));
  const module = await load('package/index.js');
  PanacheError = module.PanacheError;
  wasm = await WebAssembly.compile(await readFile(join(folder, 'package/panache.wasm')));
  panache = await module.Panache.create({ wasm, model: await read('models/panache-int8.safetensors') });
});
after(async () => {
  panache?.free();
  await rm(folder, { recursive: true });
});

test('the module exports panache.h without files and samples, the page\'s own functions, and nothing else of ours', async () => {
  const promised = (await read('tests/api/symbols.txt')).toString().trim().split('\n')
    .filter((name) => !/^panache_(motion_file|samples)_/.test(name)).sort();
  const names = WebAssembly.Module.exports(wasm).map(({ name }) => name)
    .filter((name) => name.startsWith('panache_'));
  assert.deepEqual(names.filter((name) => !name.startsWith('panache_page_')).sort(), promised);
  const rest = WebAssembly.Module.exports(wasm).map(({ name }) => name)
    .filter((name) => !name.startsWith('panache_'));
  for (const name of rest) {
    assert.match(name, /^(memory|malloc|free|_initialize|stack\w+|__\w+|emscripten_\w+)$/);
  }
});

class Hash {  // FNV-1a of the bits.
  #value = 14695981039346656037n;
  add(floats) {
    for (const byte of new Uint8Array(floats.buffer, floats.byteOffset, floats.byteLength)) {
      this.#value = BigInt.asUintN(64, (this.#value ^ BigInt(byte)) * 1099511628211n);
    }
  }
  toString() { return this.#value.toString(16).padStart(16, '0'); }
}

test('a three.js skeleton, C and the library give the same bits', async () => {
  const file = join(folder, 'poses');
  const model = join(root, 'models/panache-int8.safetensors');
  const [byC, byLibrary] =
    execFileSync(process.env.PANACHE_SAME_BITS, [model, file]).toString().trim().split(' ');
  const bytes = await readFile(file);
  const poses = new Float32Array(new Uint8Array(bytes).buffer);
  assert.equal(poses.length, kFrames * 7 * kJoints);

  const figure = createFigure();
  const styled = new StyledBones(panache, figure, humanBones);
  styled.character.setShape({ posture: 0.75, leftArm: 0.5 });
  styled.character.setStrength('old', 0.5);
  styled.character.setStrength('proud', 0.75);
  const bones = [];
  figure.traverse((bone) => bones.push(bone));
  const hash = new Hash();
  for (let f = 0; f < kFrames; ++f) {
    const at = f * 7 * kJoints;
    bones.forEach((bone, i) => {
      bone.quaternion.fromArray(poses, at + 4 * i);
      bone.position.fromArray(poses, at + 4 * kJoints + 3 * i);
    });
    styled.step(1 / 60);
    hash.add(styled.pose.rotations);
    hash.add(styled.pose.translations);
  }
  assert.equal(hash.toString(), byC);
  assert.equal(byLibrary, byC);
  styled.free();
});

test('the three.js sample runs, and an old figure stoops', () => {
  const lines = execFileSync(process.execPath,
    ['main.mjs', join(folder, 'package'), 'old'], { cwd: join(folder, 'three_js') })
    .toString().trim().split('\n');
  const [, before, after] = lines.at(-1).trim().split(/\s+/).map(Number);
  assert.ok(after > before + 3, lines.at(-1));
});

function skeleton(options) {
  const joints = [];
  const index = new Map();
  createFigure().traverse((bone) => {
    index.set(bone, joints.length);
    joints.push({ name: bone.name, parent: index.get(bone.parent) ?? -1,
      rotation: bone.quaternion.toArray(), translation: bone.position.toArray() });
  });
  const find = (name) => joints.findIndex((joint) => joint.name === name);
  const humanJoints = Object.fromEntries(
    Object.entries(humanBones).map(([human, name]) => [human, find(name)]));
  return { joints, made: panache.createSkeleton(joints, { humanJoints, ...options }) };
}

test('a whole clip gets the tempo of its style', () => {
  const { joints, made } = skeleton();
  assert.equal(made.find('leftHand'), 7);
  assert.equal(made.find('leftShoulder'), -1);
  const frames = 120;
  const clip = {
    rotations: Float32Array.from({ length: 4 * joints.length * frames },
      (_, i) => (i % 4 === 3 ? 1 : 0)),
    translations: Float32Array.from({ length: 3 * joints.length * frames },
      (_, i) => joints[Math.floor(i / 3) % joints.length].translation[i % 3]),
    frameSeconds: 1 / 60,
  };
  const plain = panache.stylizeClip(made, clip, {});
  assert.equal(plain.frameCount, frames);
  assert.deepEqual(plain.rotations, clip.rotations);
  const old = panache.stylizeClip(made, clip, { old: [[0, 0], [0.5, 1]] });
  assert.equal(old.sourceFrames.length, old.frameCount);
  assert.equal(old.contacts.length, 2 * old.frameCount);
  assert.notDeepEqual(old.rotations.slice(-4 * joints.length),
    clip.rotations.slice(-4 * joints.length));
  made.free();
});

test('a character tells what went on, and what is wrong is said in a sentence', () => {
  const { joints, made } = skeleton();
  const character = panache.createCharacter(made, { maxLag: 0.5 });
  const pose = {
    rotations: Float32Array.from(joints.flatMap(({ rotation }) => rotation)),
    translations: Float32Array.from(joints.flatMap(({ translation }) => translation)),
  };
  character.setStrength('old', 1);
  for (let f = 0; f < 60; ++f) character.step(pose, pose, 1 / 60);
  const { gate, rate, ahead, contacts } = character.report();
  assert.ok(gate >= 0 && gate <= 1, gate);
  assert.ok(rate >= 0.5 && rate <= 2, rate);
  assert.ok(ahead <= 0 && ahead >= -0.5, ahead);
  assert.equal(contacts.length, 2);
  character.reset();
  const refusal = (action, message) => assert.throws(action, (error) => {
    assert.ok(error instanceof PanacheError);
    assert.match(error.message, message);
    return true;
  });
  refusal(() => character.setStrength('nobody', 1), /^there is no style 'nobody'$/);
  refusal(() => character.setShape({ spine: 0 }), /^there is no option 'spine'$/);
  refusal(() => character.step({ ...pose, rotations: pose.rotations.slice(1) }, pose, 0.1),
    /^input.rotations: expected a Float32Array of 76 numbers, found one of 75$/);
  refusal(() => panache.createCharacter(made, { maxLag: -1 }), /^max_lag of -1/);
  refusal(() => panache.createSkeleton(joints, { humanJoints: { tail: 1 } }),
    /there is no human joint 'tail'/);
  refusal(() => panache.createSkeleton(joints.slice(0, 3)), /^no humanoid found/);
  character.free();
  made.free();
});
