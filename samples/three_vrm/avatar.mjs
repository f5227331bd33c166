// A VRM avatar that idles, talks with its hands, and takes a mood.
import { AnimationMixer, LoopPingPong } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VRMLoaderPlugin } from '@pixiv/three-vrm';
import { VRMAnimationLoaderPlugin, createVRMAnimationClip } from '@pixiv/three-vrm-animation';
import { humanJoints } from 'panache';
import { StyledBones } from 'panache/three';

import { findMood, moods } from './moods.mjs';

const kSettle = 2;          // Seconds until the walker stands still.
const kFade = 0.4;          // Seconds between idling and talking.
const kFaceSpeed = 6;       // Per second: how fast a face changes.
const kLettersASecond = 14;

/** Movements of the arms for talking: styles with gestures, and which of theirs. */
const kTalk = [['childlike', 0], ['teenager', 1], ['childlike', 0]];

/** The walker as it stands for some seconds, with gestures spread over them: the bytes of a VRMA. */
function standing(panache, seconds, gestures = []) {
  const walker = panache.createWalker();
  walker.steer(0, 0);
  walker.setShape({ posture: 0, dynamics: 0 });  // The gestures, without the styles that have them.
  for (const [style] of gestures) walker.setStrength(style, 1);
  const steps = Math.round(60 * (kSettle + seconds));
  const due = gestures.map((_, i) => Math.round(60 * (kSettle + (seconds * (i + 0.2)) / gestures.length)));
  for (let i = 0; i < steps; ++i) {
    const now = due.indexOf(i);
    if (now >= 0) walker.trigger(...gestures[now]);
    walker.step(1 / 60);
  }
  const bytes = walker.exportAs('.vrma', { seconds });
  walker.free();
  return bytes;
}

async function load(bytes, plugin) {
  const loader = new GLTFLoader();
  loader.register(plugin);
  const buffer = bytes.buffer?.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) ?? bytes;
  return (await loader.parseAsync(buffer, '')).userData;
}

export class Avatar {
  #mixer; #styled; #idle; #talk;
  #talking = 0;      // Seconds that it goes on talking.
  #time = 0;
  #faces = new Map();  // Wanted weight of each expression.
  /** The current mood and its intensity. */
  current = { name: 'neutral', intensity: 0 };

  /** `panache`: with its model and walker; `file`: the bytes of a VRM. */
  static async create(panache, file) {
    const { vrm } = await load(file, (parser) => new VRMLoaderPlugin(parser));
    const clips = [];
    for (const bytes of [standing(panache, 8), standing(panache, 7, kTalk)]) {
      const { vrmAnimations } = await load(bytes, (parser) => new VRMAnimationLoaderPlugin(parser));
      clips.push(createVRMAnimationClip(vrmAnimations[0], vrm));
    }
    return new Avatar(panache, vrm, clips);
  }

  constructor(panache, vrm, clips) {
    this.vrm = vrm;
    const bones = Object.entries(vrm.humanoid.humanBones)
      .filter(([name]) => humanJoints.includes(name)).map(([name, { node }]) => [name, node.name]);
    this.#styled = new StyledBones(panache, vrm.scene, { humanBones: Object.fromEntries(bones) });
    this.#mixer = new AnimationMixer(vrm.scene);
    [this.#idle, this.#talk] = clips.map((clip) => {
      const action = this.#mixer.clipAction(clip);
      action.setLoop(LoopPingPong, Infinity).play();
      return action;
    });
    this.#talk.setEffectiveWeight(0);
    this.mood('neutral');
  }

  /** Shows a mood by one of the words in moods.mjs; `intensity`: 0 to 1, and a little more. Returns
   * the mood's name; throws if there is no such word. */
  mood(word, intensity = 0.6) {
    const name = findMood(word);
    if (!name) throw new Error(`there is no mood '${word}'; expected one of ${Object.keys(moods).join(', ')}`);
    const { styles, face, weight = 1 } = moods[name];
    for (const other of Object.values(moods)) {
      for (const style of Object.keys(other.styles)) {
        this.#styled.character.setStrength(style, (styles[style] ?? 0) * intensity);
      }
      this.#faces.set(other.face, 0);
    }
    this.#faces.set(face, Math.min(1, weight * intensity * 1.3));
    this.current = { name, intensity };
    return name;
  }

  /** Talks for as long as the text takes. */
  talk(text) {
    this.#talking = Math.max(1.5, text.length / kLettersASecond);
  }

  /** Moves on by some seconds. Call it in place of vrm.update(). */
  update(seconds) {
    const { humanoid, expressionManager, springBoneManager } = this.vrm;
    this.#time += seconds;
    this.#talking = Math.max(0, this.#talking - seconds);
    const wanted = this.#talking > 0 ? 1 : 0, now = this.#talk.getEffectiveWeight();
    const weight = now + Math.sign(wanted - now) * Math.min(Math.abs(wanted - now), seconds / kFade);
    this.#talk.setEffectiveWeight(weight);
    this.#idle.setEffectiveWeight(1 - weight);
    this.#mixer.update(seconds);
    humanoid.update();
    // The style changes the bones that three-vrm has just posed.
    this.#styled.step(seconds);
    if (expressionManager) this.#updateFace(expressionManager, seconds);
    springBoneManager?.update(seconds);
  }

  #updateFace(face, seconds) {
    for (const [name, wanted] of this.#faces) {
      const now = face.getValue(name) ?? 0;
      face.setValue(name, now + (wanted - now) * Math.min(1, kFaceSpeed * seconds));
    }
    face.setValue('blink', this.#time % 3.7 < 0.12 ? 1 : 0);
    face.setValue('aa', this.#talking > 0 ? 0.5 - 0.5 * Math.cos(19 * this.#time) : 0);
    face.update();
  }
}
