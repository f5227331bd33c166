// node render.mjs FILE OUT.png [SECONDS [CLIP]]: loads a glTF file with three.js in Chromium, plays
// a clip (by name; else the first) to a time, and takes a picture. Ends with 1, and says why, where
// the page has anything to complain of.
import { dirname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launchChromium, serve } from './serve.mjs';

const [file, picture, seconds = '0', clip = ''] = process.argv.slice(2);
if (!file || !picture) {
  console.error('usage: node render.mjs FILE OUT.png [SECONDS [CLIP]]');
  process.exit(2);
}
const three = join(dirname(fileURLToPath(import.meta.url)), 'node_modules', 'three');

const page = `<!doctype html>
<link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/": "/three/examples/jsm/"}}
</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/loaders/GLTFLoader.js';

const size = { width: 640, height: 480 };
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(size.width, size.height);
document.body.append(renderer.domElement);
const gltf = await new GLTFLoader().loadAsync('/model');
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xf4f4f0);
scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x888888, 2));
const sun = new THREE.DirectionalLight(0xffffff, 2);
sun.position.set(2, 4, 3);
scene.add(sun);
const grid = new THREE.GridHelper(6, 12, 0x999999, 0xcccccc);
scene.add(grid);

const wanted = ${JSON.stringify(clip)};
const clips = gltf.animations;
const clip = wanted ? clips.find((c) => c.name === wanted) : clips[0];
if (wanted && !clip) throw new Error('no clip ' + wanted + ' in ' + clips.map((c) => c.name));
if (clip) {
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(clip);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  mixer.setTime(${Number(seconds)});
}
gltf.scene.updateMatrixWorld(true);
const box = new THREE.Box3();
gltf.scene.traverse((o) => {
  if (!o.isMesh) return;
  if (o.isSkinnedMesh) {
    o.computeBoundingBox();
    box.union(o.boundingBox.clone().applyMatrix4(o.matrixWorld));
  } else {
    box.expandByObject(o, true);
  }
});
const middle = box.getCenter(new THREE.Vector3());
const reach = Math.max(box.getSize(new THREE.Vector3()).length(), 1e-3);
const camera = new THREE.PerspectiveCamera(40, size.width / size.height, reach / 100, reach * 100);
camera.position.copy(middle).add(new THREE.Vector3(0.6, 0.35, 1).setLength(1.35 * reach));
camera.lookAt(middle);
renderer.render(scene, camera);
const positions = {};
gltf.scene.traverse((o) => {
  positions[o.name] = o.getWorldPosition(new THREE.Vector3()).toArray();
});
window.done = {
  clips: clips.map((c) => c.name),
  box: [box.min.toArray(), box.max.toArray()],
  places: positions,
};
</script>`;

const { server, address } = await serve((path) => (path === '/' ? Buffer.from(page)
  : path === '/model' ? file : join(three, normalize(path).slice('/three/'.length))));
const complaints = [];
const browser = await launchChromium();
try {
  const tab = await browser.newPage({ viewport: { width: 640, height: 480 } });
  tab.on('console', (message) => {
    // Chromium warns of its own slowness when WebGL runs in software; that is no fault of a file.
    const ours = !/GL Driver Message|software WebGL/.test(message.text());
    if (ours && ['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  tab.on('pageerror', (error) => complaints.push(error.message));
  await tab.goto(address);
  await tab.waitForFunction(() => window.done, null, { timeout: 60000 })
    .catch((error) => complaints.push(error.message));
  console.log(JSON.stringify(await tab.evaluate(() => window.done ?? null)));
  await tab.screenshot({ path: picture });
} finally {
  await browser.close();
  server.close();
}
for (const complaint of complaints) console.error(`${file}: ${complaint}`);
process.exit(complaints.length > 0 ? 1 : 0);
