// node moving-picture.mjs FOLDER LABEL=FILE.glb...: draws walking characters side by side, each on a
// treadmill with its name below, as FOLDER/000.png and so on, 20 frames a second. Each shows whole
// cycles of its own walk, so the frames are a loop; tempos change by less than a twentieth for that,
// by a tenth for twelve characters. Prints the number of frames. Called by scripts/moving-picture.

import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launchChromium, serve } from './serve.mjs';

const [folder, ...walkers] = process.argv.slice(2);
const labels = walkers.map((walker) => walker.split('=')[0]);
const files = walkers.map((walker) => walker.slice(walker.indexOf('=') + 1));
const three = fileURLToPath(new URL('node_modules/three', import.meta.url));
const size = { width: 1200, height: Math.round(1980 / Math.max(6, files.length)) };

const page = `<!doctype html>
<link rel="icon" href="data:,">
<style>
  body { margin: 0; background: #fff }
  p { position: absolute; bottom: 8px; margin: 0; text-align: center; color: #444;
      font: 19px 'DejaVu Sans', sans-serif; width: ${size.width / files.length}px }
</style>
${labels.map((label, i) => `<p style="left: ${(i * size.width) / files.length}px">${label}</p>`).join('')}
<script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/": "/three/examples/jsm/"}}
</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/loaders/GLTFLoader.js';

const colours = [0x8d949c, 0xd55e00, 0x009e73, 0xaa3377, 0x3f8fd0, 0xc99700];
const spacing = 1.28; // Between characters, metres.
const from = 2; // Seconds of a clip that are not shown, until the walk is steady.
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setPixelRatio(2);
renderer.setSize(${size.width}, ${size.height});
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.PCFSoftShadowMap;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xffffff);
scene.add(new THREE.HemisphereLight(0xffffff, 0xb8b0a8, 2.2));
const sun = new THREE.DirectionalLight(0xffffff, 2.4);
sun.position.set(-1.5, 8, 2.5);
sun.castShadow = true;
sun.shadow.mapSize.set(4096, 2048);
const far = Math.max(5, (${files.length} * spacing) / 2 + 1);
Object.assign(sun.shadow.camera, { left: -far, right: far, top: 3, bottom: -3 });
sun.shadow.radius = 5;
scene.add(sun);

const floor = new THREE.Mesh(new THREE.PlaneGeometry(40, 8), new THREE.ShadowMaterial({ opacity: 0.2 }));
floor.rotation.x = -Math.PI / 2;
floor.position.y = 0.004;
floor.receiveShadow = true;
scene.add(floor);

// A walk: its pose at a time, the length of its cycle, the travel of a cycle.
async function walk(index) {
  const gltf = await new GLTFLoader().loadAsync('/' + index + '.glb');
  const material = new THREE.MeshStandardMaterial({ color: colours[index % colours.length],
    roughness: 0.75 });
  const bones = [];
  gltf.scene.traverse((node) => {
    if (node.isMesh) Object.assign(node, { material, castShadow: true, frustumCulled: false });
    if (node.isBone) bones.push(node);
  });
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(gltf.animations[0]);
  action.play();
  const seconds = gltf.animations[0].duration;
  const hips = bones.find((bone) => bone.name === 'hips');
  const at = (time) => {
    mixer.setTime(time);
    gltf.scene.updateMatrixWorld(true);
    return hips.getWorldPosition(new THREE.Vector3());
  };
  const positions = (time) => {
    const origin = at(time);
    return bones.map((bone) => bone.getWorldPosition(new THREE.Vector3()).sub(origin));
  };
  const first = positions(from);
  let cycle = 0, least = Infinity;
  for (let length = 0.7; length < Math.min(2.2, seconds - from); length += 1 / 240) {
    const other = positions(from + length);
    const distance = first.reduce((sum, p, i) => sum + p.distanceTo(other[i]), 0) / first.length;
    // A second cycle is as good as the first.
    if (distance < least - 0.004) [cycle, least] = [length, distance];
  }
  const start = at(from), travel = at(from + cycle).sub(start);
  return { scene: gltf.scene, at, cycle, start, travel, least };
}

const walks = [];
for (let i = 0; i < ${files.length}; ++i) walks.push(await walk(i));

// The duration, of 3 to 5 s, in which all walks have nearly whole numbers of cycles.
let duration = 0, worst = Infinity;
for (let t = 3; t <= 5; t += 0.02) {
  const off = Math.max(...walks.map(({ cycle }) => Math.abs(Math.round(t / cycle) * cycle / t - 1)));
  if (off < worst - 1e-6) [duration, worst] = [t, off];
}
const count = Math.round(20 * duration);

const tilt = 0.62; // The characters' heading from the line of sight, radians.
walks.forEach((walk, i) => {
  const stage = new THREE.Group();
  stage.position.x = (i - (walks.length - 1) / 2) * spacing;
  stage.rotation.y = tilt - Math.atan2(walk.travel.x, walk.travel.z);
  stage.add(walk.scene);
  scene.add(stage);
  walk.stage = stage;
  const belt = new THREE.Group();
  belt.position.copy(stage.position);
  belt.rotation.y = tilt;
  walk.marks = [];
  walk.gap = walk.travel.length() / Math.max(1, Math.round(walk.travel.length() / 0.45));
  for (let k = 0; k * walk.gap < 1.9; ++k) {
    const mark = new THREE.Mesh(new THREE.PlaneGeometry(0.8, 0.03),
      new THREE.MeshBasicMaterial({ color: 0xe2deda }));
    mark.rotation.x = -Math.PI / 2;
    mark.position.y = 0.002;
    belt.add(mark);
    walk.marks.push(mark);
  }
  scene.add(belt);
});

const width = walks.length * spacing, height = width * ${size.height / size.width};
const camera = new THREE.OrthographicCamera(-width / 2, width / 2, height * 0.78, -height * 0.22, 0.1, 30);
camera.position.set(0, 2.2, 10);
camera.lookAt(0, 0.45, 0);
camera.position.y -= 0.35;

window.show = (frame) => {
  const share = frame / count;
  for (const walk of walks) {
    const cycles = Math.round(duration / walk.cycle) * share;
    const part = cycles - Math.floor(cycles);
    walk.at(from + part * walk.cycle);
    // On the spot: the steady part of the travel is taken off.
    const off = walk.start.clone().addScaledVector(walk.travel, part).setY(0);
    walk.scene.position.set(-off.x, 0, -off.z);
    const gone = part * walk.travel.length();
    walk.marks.forEach((mark, k) => {
      mark.position.z = ((((k * walk.gap - gone) % (walk.marks.length * walk.gap)) +
        walk.marks.length * walk.gap) % (walk.marks.length * walk.gap)) - 0.95;
      mark.visible = Math.abs(mark.position.z) < 0.94;
    });
  }
  renderer.render(scene, camera);
};
window.ready = { count, duration, worst, cycles: walks.map(({ cycle, least }) => [cycle, least]) };
</script>`;

const { server, address } = await serve((path) => (path === '/' ? Buffer.from(page)
  : path.startsWith('/three/') ? join(three, path.slice('/three/'.length))
  : files[parseInt(path.slice(1), 10)]));
const browser = await launchChromium();
try {
  const tab = await browser.newPage({ viewport: size });
  tab.on('pageerror', (error) => console.error(`moving-picture: ${error.message}`));
  await tab.goto(address);
  await tab.waitForFunction(() => window.ready, null, { timeout: 120000 });
  const { count, ...facts } = await tab.evaluate(() => window.ready);
  console.error(`moving-picture: ${JSON.stringify(facts)}`);
  for (let frame = 0; frame < count; ++frame) {
    await tab.evaluate((number) => window.show(number), frame);
    await tab.screenshot({ path: join(folder, `${String(frame).padStart(3, '0')}.png`) });
  }
  console.log(count);
} finally {
  await browser.close();
  server.close();
}
