// The npm package under Node: what the module exports, and poses of the caller's own.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { cp, mkdir, mkdtemp, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const read = (path) => readFile(join(root, path));
const tsc = join(root, 'apps/web/node_modules/typescript/bin/tsc');
const kJoints = 19, kFrames = 180;

let folder, panache, createWithWalker, wasm, PanacheError, createFigure, createWalk,
  humanBones, StyledBones, StyledMixer, three;
before(async () => {
  // The package and the sample as a user has them.
  folder = await mkdtemp(join(tmpdir(), 'panache-'));
  execFileSync(process.execPath, [join(root, 'apps/web/header.mjs')]);
  execFileSync(process.execPath,
    [tsc, '-p', join(root, 'apps/web/package'), '--outDir', join(folder, 'package')]);
  for (const path of ['apps/web/package/README.md', 'apps/web/package/package.json',
    'apps/web/package/example.mjs', 'LICENSE', 'build/wasm/panache.wasm', 'models/panache-int8.safetensors',
    'models/neutral.safetensors', 'models/remover-int8.safetensors', 'models/walker.safetensors']) {
    await cp(join(root, path), join(folder, 'package', basename(path)));
  }
  await mkdir(join(folder, 'three_js'));
  for (const name of ['main.mjs', 'package.json', 'stick_figure.mjs']) {
    await cp(join(root, 'samples/three_js', name), join(folder, 'three_js', name));
  }
  await mkdir(join(folder, 'three_js/node_modules'));
  await symlink(join(root, 'apps/web/node_modules/three'),
    join(folder, 'three_js/node_modules/three'));
  await symlink(join(folder, 'package'), join(folder, 'three_js/node_modules/panache'));
  const load = (path) => import(pathToFileURL(join(folder, path)).href);
  ({ createFigure, createWalk, humanBones } = await load('three_js/stick_figure.mjs'));
  ({ StyledBones, StyledMixer } = await load('package/three.js'));
  three = await import(pathToFileURL(
    join(root, 'apps/web/node_modules/three/build/three.module.js')).href);
  const module = await load('package/index.js');
  PanacheError = module.PanacheError;
  wasm = await WebAssembly.compile(await readFile(join(folder, 'package/panache.wasm')));
  const model = await read('models/panache-int8.safetensors');
  panache = await module.Panache.create({ wasm, model });
  createWithWalker = (walker) => module.Panache.create({ wasm, model, walker });
});
after(async () => {
  panache?.free();
  await rm(folder, { recursive: true });
});

// A project with the package in it, as npm installs it.
async function install() {
  const project = join(folder, 'project'), installed = join(project, 'node_modules/panache');
  await mkdir(installed, { recursive: true });
  execFileSync('npm', ['pack', '--silent', '--pack-destination', project],
    { cwd: join(folder, 'package') });
  execFileSync('tar', ['-xzf', `panache-${version}.tgz`, '-C', installed, '--strip-components=1'],
    { cwd: project });
  return { project, installed };
}
const { version } = JSON.parse(await read('apps/web/package/package.json'));

test('the package is whole: licence, example and types', async () => {
  const { project, installed } = await install();
  assert.match((await readFile(join(installed, 'LICENSE'))).toString(), /Apache License/);
  const { license } = JSON.parse(await readFile(join(installed, 'package.json')));
  assert.equal(license, 'Apache-2.0');
  assert.ok((await readFile(join(installed, 'README.md'))).toString().includes(`\`${license}\``));

  // The example where it lies, and copied into the project.
  await cp(join(installed, 'example.mjs'), join(project, 'example.mjs'));
  const walker = await readFile(join(installed, 'walker.safetensors'));
  const made = await createWithWalker(walker);
  const walk = made.createWalker();
  for (let f = 0; f < 60; ++f) walk.step(1 / 60);
  await writeFile(join(project, 'walk.bvh'), walk.exportAs('.bvh'));
  const styled = ['example.mjs', 'node_modules/panache/example.mjs'].map((example) =>
    execFileSync(process.execPath, [example, 'walk.bvh', 'old=1'], { cwd: project }).toString());
  assert.match(styled[0], /^MOTION$/m);
  assert.equal(styled[1], styled[0]);
  walk.free();
  made.free();

  await writeFile(join(project, 'use.mts'), `
    import { Character, Panache, PanacheError, type Pose, type Shape } from 'panache';
    export async function use(bytes: Uint8Array, pose: Pose): Promise<string> {
      const panache = await Panache.create({ wasm: bytes, model: bytes });
      const shape: Partial<Shape> = { legs: 0 };
      const skeleton = panache.createSkeleton([]);
      const remover = panache.createRemover(bytes);
      const character = panache.createCharacter(skeleton, { maxLag: 1, remover });
      character.setRemoved(remover.recognise(skeleton, { ...pose, frameSeconds: 1 })[0].name);
      character.setShape(shape);
      character.step(pose, pose, 1 / 60);
      // @ts-expect-error A name of a style is a string.
      character.setStrength(1, 1);
      // @ts-expect-error Characters are made by createCharacter().
      new Character(panache, skeleton, {});
      // @ts-expect-error What the package uses itself is not declared.
      panache._model();
      return panache.openFile(bytes, 'walk.bvh').joints[0].name + new PanacheError('').message;
    }`);
  await symlink(join(root, 'apps/web/node_modules/three'), join(project, 'node_modules/three'));
  await mkdir(join(project, 'node_modules/@types'));
  for (const name of ['three', 'webxr', 'stats.js']) {
    await symlink(join(root, 'apps/web/node_modules/@types', name),
      join(project, 'node_modules/@types', name));
  }
  await writeFile(join(project, 'use_three.mts'), `
    import { Panache } from 'panache';
    import { StyledBones, StyledMixer } from 'panache/three';
    import { AnimationMixer, Object3D } from 'three';
    export function use(panache: Panache, root: Object3D): number {
      const styled = new StyledMixer(panache, new AnimationMixer(root), { humanBones: { leftHand: null } });
      styled.setStrength('old', 1);
      styled.update(1 / 60);
      // @ts-expect-error A mixer is no tree of bones.
      new StyledBones(panache, new AnimationMixer(root));
      return styled.character.report().gate;
    }`);
  for (const [module, resolution] of [['node16', 'node16'], ['esnext', 'bundler']]) {
    const ran = spawnSync(process.execPath, [tsc, '--noEmit', '--strict', '--target', 'es2022',
      '--module', module, '--moduleResolution', resolution, '--skipLibCheck', 'use.mts', 'use_three.mts'],
    { cwd: project });
    assert.equal(ran.stdout.toString(), '', resolution);
    assert.equal(ran.status, 0, resolution);
  }
});

// What a package of npm has to be, as other people's programs check it.
const checkers = join(root, 'tests/web/node_modules');
const without = !existsSync(join(checkers, 'publint')) && 'tests/web has no packages; npm ci fetches them';
test('publint and attw find no faults', { skip: without }, async () => {
  const { project, installed } = await install();
  const { publint } = await import('publint');
  const { messages } = await publint({ pkgDir: installed, strict: true });
  assert.deepEqual(messages, []);
  // Modules only; the other entries are no modules.
  const ran = spawnSync(process.execPath, [join(checkers, '@arethetypeswrong/cli/dist/index.js'),
    join(project, `panache-${version}.tgz`), '--profile', 'esm-only', '--entrypoints', '.', './three',
    '--no-color', '--no-emoji']);
  assert.equal(ran.status, 0, ran.stdout + ran.stderr);
});

test('the module exports panache.h without samples, the page\'s own functions, and nothing else of ours', async () => {
  const promised = (await read('tests/api/symbols.txt')).toString().trim().split('\n')
    .filter((name) => !name.startsWith('panache_samples_')).sort();
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

// The model with a list of its own in its metadata.
async function withList(key, lines) {
  const bytes = await readFile(join(root, 'models/panache-int8.safetensors'));
  const size = Number(bytes.readBigUInt64LE());
  const header = JSON.parse(bytes.subarray(8, 8 + size).toString());
  header.__metadata__[key] = lines.map((line) => `${line}\n`).join('');
  const text = Buffer.from(JSON.stringify(header));
  const padded = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, ' ')]);
  const length = Buffer.alloc(8);
  length.writeBigUInt64LE(BigInt(padded.length));
  return Buffer.concat([length, padded, bytes.subarray(8 + size)]);
}

test('styles have the groups of the model', async () => {
  const groups = panache.styles.map((_, i) => `gröup ${i >> 1}`);
  const own = panache.modelBytes;
  panache.setModel(await withList('style_groups', groups));
  assert.deepEqual(panache.styles.map(({ group }) => group), groups);
  panache.setModel(own);
});

/** A second of the figure at rest, as the arrays of a clip. */
function restClip(joints, frames = 60) {
  return {
    rotations: Float32Array.from({ length: 4 * joints.length * frames },
      (_, i) => joints[(i >> 2) % joints.length].rotation[i % 4]),
    translations: Float32Array.from({ length: 3 * joints.length * frames },
      (_, i) => joints[Math.floor(i / 3) % joints.length].translation[i % 3]),
    frameSeconds: 1 / 60,
  };
}

/** What a character of these options shows of the figure at rest after a change of it. */
function stand({ joints, made }, change, options = {}, frames = 120) {
  const character = panache.createCharacter(made, options);
  change(character);
  const shown = [];
  for (let f = 0; f < frames; ++f) {
    const pose = restClip(joints, 1);
    character.step(pose, pose, 1 / 60);
    shown.push(...pose.rotations);
  }
  character.free();
  return shown.join();
}

// What sides do is tested over the C interface: that they get there, here.
test('styles have sides, which characters, clips and players take', async () => {
  const own = panache.modelBytes;
  panache.setModel(await withList('style_sides',
    panache.styles.map(({ name }) => (name === 'old' ? 'right leg' : ''))));
  const { joints, made } = skeleton();
  assert.equal(panache.styles.find(({ name }) => name === 'old').side, 'right leg');
  const withWalker = await createWithWalker(await read('models/walker.safetensors'));
  withWalker.setModel(panache.modelBytes);
  const takers = {
    clip: (side) => panache.stylizeClip(made, restClip(joints), { old: 1 },
      { sides: side === undefined ? {} : { old: side } }).rotations.join(),
    character: (side) => stand({ joints, made }, (character) => {
      character.setStrength('old', 1);
      if (side !== undefined) character.setSide('Old', side);
    }, {}, 30),
    player: (side) => {
      const walk = withWalker.createWalker();
      walk.setStrength('old', 1);
      if (side !== undefined) walk.setSide('old', side);
      for (let f = 0; f < 60; ++f) walk.step(1 / 60);
      const parts = walk.parts('styled').join();
      walk.free();
      return parts;
    },
  };
  for (const [name, moved] of Object.entries(takers)) {
    const captured = moved(), mirrored = moved('mirrored');
    assert.notEqual(mirrored, captured, name);
    for (const side of ['captured', 'right', 1]) {
      assert.equal(moved(side), captured, `${name} ${side}`);
    }
    for (const side of ['left', -1]) assert.equal(moved(side), mirrored, `${name} ${side}`);
  }
  const character = panache.createCharacter(made);
  refusal(() => character.setSide('old', 'up'),
    /^side of 'old': expected 'captured', 'mirrored', 'left', 'right' or a number from -1 to 1, found 'up'$/);
  refusal(() => character.setSide('proud', 'left'),
    /^side of 'proud': expected 'captured', 'mirrored' or a number from -1 to 1, found 'left'$/);
  refusal(() => character.setSide('old', 2), /found 2$/);
  for (const thing of [character, made, withWalker]) thing.free();
  panache.setModel(own);
});

// The poses of a walking figure, and the hashes of what C and the library make of them.
async function sameBits() {
  const file = join(folder, 'poses');
  const hashes = execFileSync(process.env.PANACHE_SAME_BITS,
    [...['panache-int8', 'remover-int8'].map((name) => join(root, `models/${name}.safetensors`)), file])
    .toString().trim().split('\n');
  const poses = new Float32Array(new Uint8Array(await readFile(file)).buffer);
  assert.equal(poses.length, kFrames * 7 * kJoints);
  return { poses, hashes };
}

test('a three.js skeleton, C and the library give the same bits', async () => {
  const { poses, hashes: [byC, byLibrary] } = await sameBits();
  const figure = createFigure();
  const styled = new StyledBones(panache, figure, { humanBones });
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

test('styles are taken off and told with the bits of C', async () => {
  const { poses, hashes: [, , ofPoses, ofClip, ofShares] } = await sameBits();
  const { made } = skeleton();
  const remover = panache.createRemover(await read('models/remover-int8.safetensors'));
  const character = panache.createCharacter(made, { remover });
  character.setRemoved('old');
  character.setStrength('proud', 0.75);
  const whole = { rotations: new Float32Array(4 * kJoints * kFrames),
    translations: new Float32Array(3 * kJoints * kFrames), frameSeconds: 1 / 60 };
  const hashOf = (one) => {
    const hash = new Hash();
    for (let f = 0; f < one.rotations.length / (4 * kJoints); ++f) {
      hash.add(one.rotations.subarray(4 * kJoints * f, 4 * kJoints * (f + 1)));
      hash.add(one.translations.subarray(3 * kJoints * f, 3 * kJoints * (f + 1)));
    }
    return hash.toString();
  };
  const stepped = { rotations: whole.rotations.slice(), translations: whole.translations.slice() };
  for (let f = 0; f < kFrames; ++f) {
    const at = 7 * kJoints * f;
    whole.rotations.set(poses.subarray(at, at + 4 * kJoints), 4 * kJoints * f);
    whole.translations.set(poses.subarray(at + 4 * kJoints, at + 7 * kJoints), 3 * kJoints * f);
    const poseOf = (clip) => ({
      rotations: clip.rotations.subarray(4 * kJoints * f, 4 * kJoints * (f + 1)),
      translations: clip.translations.subarray(3 * kJoints * f, 3 * kJoints * (f + 1)) });
    character.step(poseOf(whole), poseOf(stepped), 1 / 60);
  }
  assert.equal(hashOf(stepped), ofPoses);
  assert.equal(hashOf(panache.stylizeClip(made, whole, { proud: 0.75 }, { remover, remove: 'Old' })),
    ofClip);

  const told = remover.recognise(made, whole);
  assert.ok(told.every(({ share }, i) => i === 0 || share <= told[i - 1].share));
  const hash = new Hash();
  hash.add(Float32Array.from([...remover.styles, { name: 'neutral' }],
    ({ name }) => told.find((one) => one.name === name)?.share ?? 0));
  assert.equal(hash.toString(), ofShares);

  // What goes on without a remover, after it, is the input.
  character.setRemoved(null);
  character.setStrength('proud', 0);
  const pose = { rotations: whole.rotations.slice(0, 4 * kJoints),
    translations: whole.translations.slice(0, 3 * kJoints) };
  const out = { rotations: pose.rotations.slice(), translations: pose.translations.slice() };
  for (let f = 0; f < 120; ++f) character.step(pose, out, 1 / 60);
  assert.deepEqual(out, pose);
  for (const thing of [character, remover, made]) thing.free();
});

test('a player takes off what its file shows, and says what is wrong in a sentence', async () => {
  const bytes = await read('models/remover-int8.safetensors');
  const remover = panache.createRemover(bytes);
  assert.equal(remover.styles.at(-1).name, 'any');
  assert.equal(remover.styles.find(({ name }) => name === 'zombie').group, 'creatures');
  const owner = await createWithWalker(await read('models/walker.safetensors'));
  const walk = owner.createWalker();
  walk.steer(1.3, 0);
  walk.setStrength('old', 1);
  for (let f = 0; f < 60 * 8; ++f) walk.step(1 / 60);
  const [file, neutral] = ['styled', 'input'].map((which) => panache.openFile(
    walk.exportAs('.bvh', { which, seconds: 4 }), `${which}.bvh`));
  const share = (one, style) =>
    remover.recogniseFile(one).find(({ name }) => name === style).share;
  assert.equal(remover.recogniseFile(file)[0].name, 'old');
  assert.ok(share(neutral, 'old') < 0.2, `${share(neutral, 'old')}`);
  const player = file.createPlayer();
  refusal(() => player.setRemoved('old'),
    /^setRemoved: expected a player that was given a remover$/);
  const plain = player.exportAs('.bvh');
  player.useRemover(remover);
  assert.deepEqual(player.exportAs('.bvh'), plain);
  player.setRemoved('old');
  const off = panache.openFile(player.exportAs('.bvh'), 'off.bvh');
  assert.ok(share(off, 'old') < share(file, 'old') - 0.5, `${share(off, 'old')}`);
  // What is seen while it plays is what is saved, here without the tempo.
  player.setTiming('off');
  const still = panache.openFile(player.exportAs('.bvh'), 'still.bvh').createPlayer();
  player.seek(0);
  let farthest = 0, changed = 0;
  for (let f = 0; f < 120; ++f) {
    player.step(f && 1 / 60);
    still.step(f && 1 / 60);
    const [seen, saved, input] = [player.parts('styled').slice(), still.parts('styled').slice(),
      player.parts('input').slice()];
    for (let k = 0; k < seen.length; k += 7) {
      const far = (a, b) => Math.hypot(...[0, 1, 2].map((i) => a[k + i] - b[k + i]));
      if (f > 30) farthest = Math.max(farthest, far(seen, saved));
      changed = Math.max(changed, far(seen, input));
    }
  }
  assert.ok(changed > 0.05 && farthest < changed / 4, `${changed} m changed, ${farthest} m apart`);
  // With the tempo it plays as long as what is saved, to a step and what the end of a clip changes.
  player.setTiming('all');
  player.loop = false;
  player.seek(0);
  const [{ seconds, frames }] = file.clips, [saved] =
    panache.openFile(player.exportAs('.bvh'), 'tempo.bvh').clips;
  let steps = 0;
  for (player.step(0); player.seconds < seconds - 1e-6 && steps < 2 * frames; ++steps) player.step(1 / 60);
  assert.ok(Math.abs(saved.frames - frames) > 0.1 * frames, `${frames} to ${saved.frames} frames`);
  assert.ok(Math.abs(steps - saved.frames) < 0.05 * frames, `${steps} steps, ${saved.frames} frames`);
  player.setRemoved(null);
  assert.deepEqual(player.exportAs('.bvh'), plain);

  const { made } = skeleton();
  const character = panache.createCharacter(made);
  const clip = { rotations: new Float32Array(4 * kJoints).fill(0.5),
    translations: new Float32Array(3 * kJoints), frameSeconds: 1 / 60 };
  refusal(() => panache.createRemover(panache.modelBytes),
    /^the remover: the model puts styles on; expected one that takes them off$/);
  refusal(() => panache.createRemover('old'),
    /^the remover: expected an ArrayBuffer or a Uint8Array, found 'old'$/);
  refusal(() => panache.createRemover(bytes.subarray(0, 1000)), /^the remover: /);
  refusal(() => player.setRemoved('nobody'), /^unknown style 'nobody'; the model has \d+ styles: moods, /);
  refusal(() => player.useRemover(panache),
    /^remover: expected a Remover, found an object of the class Panache$/);
  refusal(() => character.setRemoved('old'),
    /^setRemoved: expected a character that was given a remover$/);
  refusal(() => panache.stylizeClip(made, clip, {}, { remove: 'old' }),
    /^remove: expected remover too, the model that takes the style off$/);
  refusal(() => panache.stylizeClip(made, clip, {}, { remover }),
    /^remover: expected remove too, the style to take off$/);
  refusal(() => owner.createWalker().useRemover(remover), /^this remover is of another Panache; /);
  const empty = { ...clip, rotations: new Float32Array(), translations: new Float32Array() };
  refusal(() => remover.recognise(made, empty), /^clip: has no frames$/);
  for (const thing of [remover, remover]) thing.free();
  refusal(() => remover.recogniseFile(file), /^this remover was freed and cannot be used any more/);
  player.step(1 / 60);  // Keeps what it needs.
  for (const thing of [player, character, made, off, file, neutral, walk, owner]) thing.free();
});

test('the three.js sample runs, and an old figure stoops', () => {
  const lines = execFileSync(process.execPath,
    ['main.mjs', 'old'], { cwd: join(folder, 'three_js') })
    .toString().trim().split('\n');
  const [, before, after] = lines.at(-1).trim().split(/\s+/).map(Number);
  assert.ok(after > before + 3, lines.at(-1));
});

// Everything that three.js objects can be put into: position, rotation, scale of all bones.
function poseOf(root) {
  const out = [];
  root.traverse(({ position, quaternion }) => out.push(...position, ...quaternion));
  return out;
}
function play(root, seconds = 3) {
  const mixer = new three.AnimationMixer(root);
  mixer.clipAction(createWalk(seconds)).play();
  return mixer;
}

test('an AnimationMixer is styled as its poses are by hand', () => {
  const [figure, byHand] = [createFigure(), createFigure()];
  const styled = new StyledMixer(panache, play(figure), { humanBones });
  const mixer = play(byHand);
  const bones = [];
  byHand.traverse((bone) => bones.push(bone));
  const { joints, made } = skeleton();
  const character = panache.createCharacter(made);
  styled.setStrength('old', 1);
  character.setStrength('old', 1);
  const pose = { rotations: new Float32Array(4 * kJoints), translations: new Float32Array(3 * kJoints) };
  for (let f = 0; f < 100; ++f) {
    styled.update(1 / 60);
    mixer.update(1 / 60);
    bones.forEach((bone, i) => {
      bone.quaternion.toArray(pose.rotations, 4 * i);
      bone.position.toArray(pose.translations, 3 * i);
    });
    character.step(pose, pose, 1 / 60);
    const expected = bones.flatMap((_, i) => [...pose.translations.subarray(3 * i, 3 * i + 3),
      ...pose.rotations.subarray(4 * i, 4 * i + 4)]);
    assert.deepEqual(poseOf(figure).map(Math.fround), expected, `frame ${f}`);
  }
  assert.equal(joints.length, kJoints);
  // The mixer's own pose comes back, and so it does in the end.
  styled.restore();
  assert.deepEqual(poseOf(figure), poseOf(byHand));
  styled.update(1 / 60);
  mixer.update(1 / 60);
  styled.free();
  assert.deepEqual(poseOf(figure), poseOf(byHand));
});

test('a paused mixer, which writes nothing, does not pile the style up', () => {
  const figure = createFigure();
  const mixer = play(figure);
  const styled = new StyledMixer(panache, mixer, { humanBones, styleRoot: false });
  styled.setStrength('old', 1);
  for (let f = 0; f < 60; ++f) styled.update(1 / 60);
  mixer.timeScale = 0;
  for (let f = 0; f < 900; ++f) styled.update(1 / 60);  // Held feet creep to the style.
  const before = poseOf(figure);
  for (let f = 0; f < 60; ++f) styled.update(1 / 60);
  const moved = Math.max(...poseOf(figure).map((x, i) => Math.abs(x - before[i])));
  assert.ok(moved < 0.01, `${moved}`);
  styled.free();
});

test('without a style three.js keeps its numbers to the last digit', () => {
  const [figure, plain] = [createFigure(), createFigure()];
  figure.position.x = plain.position.x = 1 / 3;
  const holder = new three.Group();
  holder.add(figure);
  const mixer = play(plain), styled = new StyledMixer(panache, play(figure), { humanBones });
  for (let f = 0; f < 30; ++f) {
    styled.update(1 / 60);
    mixer.update(1 / 60);
    assert.deepEqual(poseOf(figure), poseOf(plain));
  }
  styled.free();
});

test('a scaled and turned scene gets the same style in its own units', () => {
  const plain = createFigure(), small = createFigure();
  // As exporters do it: centimetres and Z up below an object that undoes both; a mesh beside it.
  const scene = new three.Group(), armature = new three.Object3D();
  armature.scale.setScalar(0.01);
  armature.quaternion.setFromAxisAngle(new three.Vector3(1, 0, 0), -Math.PI / 2);
  scene.add(armature, new three.Mesh());
  armature.add(small);
  const toZUp = armature.quaternion.clone().invert();
  const clip = createWalk(3);
  small.traverse((bone) => bone.position.multiplyScalar(100));
  small.position.applyQuaternion(toZUp);
  small.quaternion.premultiply(toZUp);
  const [track] = clip.tracks;
  for (let i = 0; i < track.values.length; i += 3) {
    new three.Vector3().fromArray(track.values, i).multiplyScalar(100).applyQuaternion(toZUp)
      .toArray(track.values, i);
  }
  const mixer = new three.AnimationMixer(scene);
  mixer.clipAction(clip).play();
  const a = new StyledMixer(panache, play(plain), { humanBones });
  const b = new StyledMixer(panache, mixer, { humanBones });
  a.setStrength('proud', 1);
  b.setStrength('proud', 1);
  const positionsIn = (root) => ['Skull', 'Wing_L_2', 'Stilt_R_3'].flatMap((name) => {
    root.updateMatrixWorld(true);
    return [...root.getObjectByName(name).getWorldPosition(new three.Vector3())];
  });
  let largest = 0, changed = 0;
  for (let f = 0; f < 120; ++f) {
    a.update(1 / 60);
    b.update(1 / 60);
    const [p, q] = [positionsIn(plain), positionsIn(scene)];
    p.forEach((x, i) => { largest = Math.max(largest, Math.abs(x - q[i])); });
    b.restore();
    positionsIn(scene).forEach((x, i) => { changed = Math.max(changed, Math.abs(x - q[i])); });
  }
  assert.ok(largest < 0.002, `${largest} m apart`);  // Rounding of 32 bits, through networks.
  assert.ok(changed > 0.03, `${changed} m changed`);
  assert.deepEqual([armature.scale.x, armature.position.length()], [0.01, 0]);
  a.free();
  b.free();
});

test('what three.js objects cannot be styled is said in a sentence', () => {
  refusal(() => new StyledBones(panache, new three.Group()), /^root: expected an object with bones/);
  refusal(() => new StyledBones(panache, null), /^root: expected an Object3D, found nothing/);
  refusal(() => new StyledMixer(panache, createFigure()), /^mixer: expected an AnimationMixer/);
  refusal(() => new StyledBones(panache, createFigure(), { humanBones: { hips: 'Pelvis' } }),
    /^humanBones.hips: there is no bone 'Pelvis'/);
  refusal(() => new StyledBones(panache, createFigure(), { humanBones, maxlag: 1 }),
    /there is no option 'maxlag'/);
  const flat = createFigure();
  flat.children[0].scale.set(1, 2, 1);
  refusal(() => new StyledBones(panache, flat, { humanBones }), /^'Back_A': expected a scale .* 1, 2, 1$/);
  const bone = new three.Bone();
  assert.throws(() => new StyledBones(panache, bone), PanacheError);
  const styled = new StyledMixer(panache, play(createFigure()), { humanBones });
  refusal(() => styled.update(NaN), /^seconds: expected a finite number/);
  styled.free();
  refusal(() => styled.update(1 / 60), /freed/);
});

function refusal(action, message) {
  assert.throws(action, (error) => {
    assert.ok(error instanceof PanacheError, error.stack);
    assert.match(error.message, message);
    return true;
  });
}

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
  const frames = 120, clip = restClip(joints, frames);
  const plain = panache.stylizeClip(made, clip, {});
  assert.equal(plain.frameCount, frames);
  assert.deepEqual(plain.rotations, clip.rotations);
  const old = panache.stylizeClip(made, clip, { old: [[0, 0], [0.5, 1]] });
  assert.equal(old.sourceFrames.length, old.frameCount);
  assert.equal(old.contacts.length, 2 * old.frameCount);
  assert.notDeepEqual(old.rotations.slice(-4 * joints.length),
    clip.rotations.slice(-4 * joints.length));
  // Nobody steps in this clip, so only 'all' changes its time.
  for (const [styleTiming, changes] of [['steps', false], ['all', true], ['off', false],
    [true, false], [false, false]]) {
    const { sourceFrames } = panache.stylizeClip(made, clip, { old: 1 },
      { styleTiming, loop: 'off' });
    assert.equal(sourceFrames.some((frame, i) => frame !== i), changes, String(styleTiming));
  }
  made.free();
});

test('a character tells what went on, and what is wrong is said in a sentence', () => {
  const { joints, made } = skeleton();
  const character = panache.createCharacter(made, { maxLag: 0.5 });
  const pose = restClip(joints, 1);
  character.setStrength('old', 1);
  for (let f = 0; f < 60; ++f) character.step(pose, pose, 1 / 60);
  const { gate, rate, ahead, contacts } = character.report();
  assert.ok(gate >= 0 && gate <= 1, gate);
  assert.ok(rate >= 0.5 && rate <= 2, rate);
  assert.ok(ahead <= 0 && ahead >= -0.5, ahead);
  assert.equal(contacts.length, 2);
  character.reset();
  character.setStrength('Old', 1);
  refusal(() => character.setStrength('nobody', 1),
    /^unknown style 'nobody'; the model has \d+ styles: moods, /);
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

test('gestures are listed, triggered and played as often as in the takes', async () => {
  const own = panache.modelBytes;
  panache.setModel(await withList('style_gesture_rates',
    panache.styles.map(({ name }) => (name === 'scared' ? '1' : ''))));
  const gesturesOf = (style) => panache.styles.find(({ name }) => name === style).gestures;
  assert.ok(gesturesOf('scared').length > 0 && gesturesOf('scared').every((name) => / s$/.test(name)));
  assert.deepEqual(gesturesOf('robot'), []);
  const { joints, made } = skeleton();
  const scared = (options, gesture) => stand({ joints, made }, (character) => {
    character.setStrength('scared', 1);
    if (gesture !== undefined) character.trigger('scared', gesture);
  }, options);
  const silent = { gestureRate: 0 };
  assert.notEqual(scared(silent), scared(silent, 1));
  assert.equal(scared(), scared({ gestureRate: 1 }));
  assert.notEqual(scared(), scared(silent));
  const character = panache.createCharacter(made);
  refusal(() => character.trigger('robot'), /^style 'robot' has no gesture 0; it has 0$/);
  refusal(() => panache.createCharacter(made, { gestureRate: -1 }), /^gesture rate of -1/);
  character.free();
  made.free();
  panache.setModel(own);
});

test('an FBX gets the commands that show and convert it', () => {
  assert.throws(() => panache.openFile(new Uint8Array(10), 'a/walk.FBX'), { message:
    'a/walk.FBX: is FBX, which is not read here; `panache view a/walk.FBX` shows it, and ' +
    '`panache convert a/walk.FBX -o a/walk.glb` makes a file that is read' });
});

test('what is no skeleton, strength, key or file is rejected with what was found', async () => {
  const { joints, made } = skeleton();
  const without = (key, i = 3, value = undefined) =>
    joints.map((joint, at) => (at === i ? { ...joint, [key]: value } : joint));
  const create = (list, options) => () => panache.createSkeleton(list, options);
  const name = joints[3].name;
  const rejected = [
    [create(joints.map(({ name, parent, translation }) => ({ name, parent, translation }))),
      `joint 0 '${joints[0].name}': rotation: expected 4 finite numbers (x y z w), found nothing`],
    [create(without('rotation', 3, [0, 0, 0])),
      `joint 3 '${name}': rotation: expected 4 finite numbers (x y z w), found [0, 0, 0]`],
    [create(without('rotation', 3, { x: 0, y: 0, z: 0, w: 1 })),
      `joint 3 '${name}': rotation: expected 4 finite numbers (x y z w), found an object of the class Object`],
    [create(without('rotation', 3, [0, 0, NaN, 1])),
      `joint 3 '${name}': rotation: expected 4 finite numbers (x y z w), found [0, 0, NaN, 1]`],
    [create(without('translation')),
      `joint 3 '${name}': translation: expected 3 finite numbers (x y z), found nothing`],
    [create(without('parent')), `joint 3 '${name}': parent: expected a whole number, found nothing`],
    [create(without('name')), 'joint 3: name: expected a string, found nothing'],
    [create(undefined), 'joints: expected an array of joints, found nothing'],
    [create({ joints }), 'joints: expected an array of joints, found an object of the class Object'],
    [create(joints, null), 'options: expected an object, found nothing'],
    [create(joints, { humanJoints: { head: 'Head' } }),
      "humanJoints.head: expected a whole number, found 'Head'"],
    [create(joints, { poses: [undefined] }),
      'poses[0].rotations: expected a Float32Array of 76 numbers, found nothing'],
    [() => panache.stylizeClip(made, {}, { old: 1 }),
      'clip.rotations: expected a Float32Array with 4 numbers for each joint of each frame, found nothing'],
    [() => panache.openFile(Promise.resolve(new Uint8Array()), 'walk.bvh'),
      'walk.bvh: expected an ArrayBuffer or a Uint8Array, found an object of the class Promise'],
    [() => panache.setModel('model.safetensors'),
      "the model: expected an ArrayBuffer or a Uint8Array, found 'model.safetensors'"],
  ];
  const clip = { rotations: new Float32Array(4 * joints.length).fill(0.5),
    translations: new Float32Array(3 * joints.length), frameSeconds: 1 / 60 };
  for (const [strength, message] of [
    [undefined, "strength of 'old': expected a number or keys [seconds, strength], found nothing"],
    [[[0]], "strength of 'old': key 0: expected 2 finite numbers (seconds, strength), found [0]"]]) {
    rejected.push([() => panache.stylizeClip(made, clip, { old: strength }), message]);
  }
  for (const [styleTiming, found] of [['fast', "'fast'"], [2, '2'], [null, 'nothing']]) {
    rejected.push([() => panache.stylizeClip(made, clip, { old: 1 }, { styleTiming }),
      `styleTiming: expected 'steps', 'all', 'off', true or false, found ${found}`]);
  }
  const character = panache.createCharacter(made);
  for (const [strength, found] of [[undefined, 'nothing'], ['1', "'1'"], [NaN, 'NaN']]) {
    rejected.push([() => character.setStrength('old', strength),
      `strength of 'old': expected a finite number, found ${found}`]);
  }
  rejected.push([() => character.step(clip, clip), 'seconds: expected a number, found nothing'],
    [() => character.step(clip.rotations, clip, 0.1),
      'input.rotations: expected a Float32Array of 76 numbers, found nothing']);
  for (const [action, message] of rejected) {
    assert.throws(action, (error) => error instanceof PanacheError && error.message === message ||
      assert.fail(`expected '${message}', found '${error.stack}'`));
  }
  await assert.rejects(createWithWalker('walker'), PanacheError);
  character.free();
  made.free();
});

test('what was freed throws, and so does what another Panache has made', async () => {
  const other = await createWithWalker(await read('models/walker.safetensors'));
  const walk = other.createWalker();
  walk.step(0.1);
  const file = other.openFile(walk.exportAs('.bvh'), 'walk.bvh');
  const player = file.createPlayer();
  const { joints, made } = skeleton();
  const character = panache.createCharacter(made);
  const pose = { rotations: new Float32Array(4 * joints.length),
    translations: new Float32Array(3 * joints.length) };
  refusal(() => other.createCharacter(made), /^this skeleton is of another Panache; /);
  refusal(() => other.stylizeClip(made, { ...pose, frameSeconds: 0.1 }, {}), /of another Panache/);
  refusal(() => panache.learnStyle('mine', { file }, { file }),
    /^walk.bvh: this file is open in another Panache; /);

  for (const thing of [character, made, player, walk, file]) {
    thing.free();
    thing.free();
  }
  const freed = {
    character: [() => character.step(pose, pose, 0.1), () => character.report(),
      () => character.reset(), () => character.setShape({}), () => character.setStrength('old', 1)],
    skeleton: [() => made.find('head'), () => panache.createCharacter(made)],
    player: [() => player.step(0.1), () => player.parts('styled'), () => player.pose('input', 2),
      () => player.gate, () => player.exportAs('.bvh'), () => player.setStrength('old', 1),
      () => player.setTrack('old', [[0, 1]]), () => player.seek(0), () => player.body,
      () => walk.steer(1, 0), () => walk.step(0.1)],
    file: [() => file.createPlayer(), () => file.putOn(file),
      () => other.learnStyle('mine', { file }, { file })],
  };
  for (const action of freed.file) refusal(action, /^this file was freed and cannot be used/);
  delete freed.file;
  other.free();
  other.free();
  freed.Panache = [() => other.createWalker(), () => other.goldenHash(),
    () => other.setModel(panache.modelBytes), () => other.removeStyle('old'),
    () => other.createCharacter(other.createSkeleton(joints))];
  for (const [what, actions] of Object.entries(freed)) {
    for (const action of actions) {
      refusal(action, new RegExp(
        `^this ${what} was freed and cannot be used any more; create another one$`));
    }
  }
});
