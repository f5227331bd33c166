// Shows the avatar, and a line to write to it.
import * as THREE from 'three';
import { Panache } from 'panache';

import { Avatar } from './avatar.mjs';
import { moodOf, moods } from './moods.mjs';

const bytes = async (path) => {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
};
const from = (name) => bytes(`./node_modules/panache/${name}`);

const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector('canvas'), antialias: true });
const scene = new THREE.Scene();
scene.background = new THREE.Color('#e9e4db');
scene.add(new THREE.HemisphereLight('#ffffff', '#b8a898', 2));
const sun = new THREE.DirectionalLight('#ffffff', 2.2);
sun.position.set(1.5, 3, 2.5);
scene.add(sun);
const floor = new THREE.Mesh(new THREE.CircleGeometry(0.55, 48), new THREE.MeshBasicMaterial({ color: '#d9d1c5' }));
floor.rotation.x = -Math.PI / 2;
scene.add(floor);
const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 20);
camera.position.set(0.9, 1, 2.6);
camera.lookAt(0, 0.62, 0);

const [wasm, model, walker, file] = await Promise.all([from('panache.wasm'),
  from('panache-int8.safetensors'), from('walker.safetensors'), bytes('./avatar.vrm')]);
const avatar = await Avatar.create(await Panache.create({ wasm, model, walker }), file);
scene.add(avatar.vrm.scene);

// For programs that chat: mood('sad', 0.6), say('I am sorry to hear that').
const strength = document.querySelector('#intensity');
window.mood = (word, intensity) => {
  const name = avatar.mood(word, intensity);
  document.querySelector('output').textContent = `${name} ${avatar.current.intensity.toFixed(2)}`;
  return name;
};
window.say = (text) => {
  const name = moodOf(text);
  if (name) window.mood(name, Number(strength.value));
  avatar.talk(text);
};

document.querySelector('form').addEventListener('submit', (event) => {
  event.preventDefault();
  const line = document.querySelector('#line');
  window.say(line.value);
  line.select();
});
for (const name of Object.keys(moods)) {
  const button = document.createElement('button');
  button.textContent = name;
  button.addEventListener('click', () => window.mood(name, Number(strength.value)));
  document.querySelector('#moods').append(button);
}
strength.addEventListener('input', () => window.mood(avatar.current.name, Number(strength.value)));

const clock = new THREE.Clock();
renderer.setAnimationLoop(() => {
  const { clientWidth: width, clientHeight: height } = renderer.domElement;
  const size = renderer.getSize(new THREE.Vector2());
  if (size.x !== width || size.y !== height) {
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  }
  avatar.update(Math.min(0.1, clock.getDelta()));
  renderer.render(scene, camera);
});
window.avatar = avatar;
