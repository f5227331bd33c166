// node play-vrma.mjs MOTION.vrma AVATAR.vrm SECONDS...: plays a VRM animation on a VRM character with
// three-vrm, as a viewer of avatars does. Prints, for each of the times, where the humanoid joints of
// the character are in the world, and the weights of its expressions. Ends with 1, and says why,
// where the libraries have anything to complain of.
import { readFile } from 'node:fs/promises';
import { AnimationMixer, LoopOnce, Vector3 } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { VRMLoaderPlugin } from '@pixiv/three-vrm';
import { VRMAnimationLoaderPlugin, createVRMAnimationClip } from '@pixiv/three-vrm-animation';

globalThis.self = globalThis;
const complaints = [];
for (const kind of ['warn', 'error']) {
  console[kind] = (...words) => complaints.push(words.join(' '));
}

async function load(path, plugin) {
  const loader = new GLTFLoader();
  loader.register(plugin);
  const file = await readFile(path);
  const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
  return loader.parseAsync(bytes, '');
}

const [motion, avatar, ...times] = process.argv.slice(2);
const { vrm } = (await load(avatar, (parser) => new VRMLoaderPlugin(parser))).userData;
const { vrmAnimations } =
  (await load(motion, (parser) => new VRMAnimationLoaderPlugin(parser))).userData;
if (!vrm) complaints.push(`${avatar}: no VRM`);
if (!vrmAnimations?.length) complaints.push(`${motion}: no VRM animation`);
if (!complaints.length) {
  const mixer = new AnimationMixer(vrm.scene);
  const action = mixer.clipAction(createVRMAnimationClip(vrmAnimations[0], vrm));
  action.setLoop(LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  const poses = times.map((seconds) => {
    mixer.setTime(Number(seconds));
    vrm.update(0);
    vrm.scene.updateMatrixWorld(true);
    const joints = {};
    for (const name of Object.keys(vrm.humanoid.humanBones)) {
      const node = vrm.humanoid.getRawBoneNode(name);
      joints[name] = node.getWorldPosition(new Vector3()).toArray();
    }
    const weights = {};
    for (const expression of vrm.expressionManager?.expressions ?? []) {
      weights[expression.expressionName] = expression.weight;
    }
    return { joints, weights };
  });
  console.log(JSON.stringify({ seconds: vrmAnimations[0].duration, poses }));
}
for (const complaint of complaints) process.stderr.write(`${complaint}\n`);
process.exit(complaints.length ? 1 : 0);
