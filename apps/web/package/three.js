// Styles the bones of a three.js scene. Reads and writes three's objects without importing three.
// See three.d.ts.
import { PanacheError, checkFinite, unexpected } from './checks.js';

// Returns `root`, the bones below it and all nodes in between, parents first.
function findBones(root) {
  if (typeof root?.traverse !== 'function') throw unexpected('root', 'an Object3D', root);
  const wanted = new Set();
  root.traverse((object) => {
    if (!object.isBone) return;
    for (let at = object; at && !wanted.has(at); at = at === root ? null : at.parent) wanted.add(at);
  });
  if (!wanted.size) throw new PanacheError('root: expected an object with bones, found none');
  const bones = [];
  root.traverse((object) => { if (wanted.has(object)) bones.push(object); });
  return bones;
}

// The scale of each bone's parent, relative to the parent of `root`: joints have no scale.
function scalesOf(bones, index) {
  const own = [];
  return bones.map((bone, i) => {
    const above = own[index.get(bone.parent)] ?? 1;
    const { x, y, z } = bone.scale;
    if (!(Math.min(x, y, z) > 0 && Math.max(x, y, z) < 1.001 * Math.min(x, y, z))) {
      throw new PanacheError(`'${bone.name}': expected a scale that is above 0 and the same along ` +
        `all axes, found ${x}, ${y}, ${z}`);
    }
    own[i] = above * x;
    return above;
  });
}

export class StyledBones {
  #bones; #scales; #skeleton; #character; #pose; #input; #styled = false;

  constructor(panache, root, { humanBones = {}, metresPerUnit, upAxis, ...options } = {}) {
    this.#bones = findBones(root);
    const index = new Map(this.#bones.map((bone, i) => [bone, i]));
    this.#scales = scalesOf(this.#bones, index);
    const count = this.#bones.length;
    this.#pose = { rotations: new Float32Array(4 * count), translations: new Float32Array(3 * count) };
    this.#input = { rotations: new Float64Array(4 * count), translations: new Float64Array(3 * count) };
    this.#read();
    const joints = this.#bones.map((bone, i) => ({
      name: bone.name, parent: index.get(bone.parent) ?? -1,
      rotation: [...this.#pose.rotations.subarray(4 * i, 4 * i + 4)],
      translation: [...this.#pose.translations.subarray(3 * i, 3 * i + 3)],
    }));
    const humanJoints = Object.fromEntries(Object.entries(humanBones).map(([human, name]) => {
      const place = name === null ? -1 : this.#bones.findIndex((bone) => bone.name === name);
      if (place < 0 && name !== null) {
        throw new PanacheError(`humanBones.${human}: there is no bone '${name}'`);
      }
      return [human, place];
    }));
    this.#skeleton = panache.createSkeleton(joints, {
      humanJoints, ...(metresPerUnit !== undefined && { metresPerUnit }),
      ...(upAxis !== undefined && { upAxis }),
    });
    try {
      this.#character = panache.createCharacter(this.#skeleton, options);
    } catch (error) {
      this.#skeleton.free();
      throw error;
    }
  }

  get character() { return this.#character; }
  get pose() { return this.#pose; }

  step(seconds) {
    this.#read();
    this.#character.step(this.#pose, this.#pose, seconds);
    const { rotations, translations } = this.#pose;
    this.#bones.forEach((bone, i) => {
      // Do not write unchanged values: they would lose the digits beyond 32 bits.
      if (differs(rotations, this.#input.rotations, 4 * i, 4)) {
        bone.quaternion.fromArray(rotations, 4 * i);
      }
      if (differs(translations, this.#input.translations, 3 * i, 3, this.#scales[i])) {
        bone.position.fromArray(translations, 3 * i).divideScalar(this.#scales[i]);
      }
    });
    this.#styled = true;
  }

  restore() {
    if (!this.#styled) return;
    this.#bones.forEach((bone, i) => {
      bone.quaternion.fromArray(this.#input.rotations, 4 * i);
      bone.position.fromArray(this.#input.translations, 3 * i);
    });
    this.#styled = false;
  }

  free() {
    this.#character.free();
    this.#skeleton.free();
  }

  #read() {
    this.#bones.forEach((bone, i) => {
      bone.quaternion.toArray(this.#input.rotations, 4 * i);
      bone.position.toArray(this.#input.translations, 3 * i);
      for (let k = 0; k < 4; ++k) this.#pose.rotations[4 * i + k] = this.#input.rotations[4 * i + k];
      for (let k = 0; k < 3; ++k) {
        this.#pose.translations[3 * i + k] = this.#input.translations[3 * i + k] * this.#scales[i];
      }
    });
  }
}

function differs(styled, input, begin, count, scale = 1) {
  for (let i = begin; i < begin + count; ++i) {
    if (styled[i] !== Math.fround(input[i] * scale)) return true;
  }
  return false;
}

export class StyledMixer {
  #mixer; #bones;

  constructor(panache, mixer, options) {
    if (typeof mixer?.getRoot !== 'function') throw unexpected('mixer', 'an AnimationMixer', mixer);
    this.#mixer = mixer;
    this.#bones = new StyledBones(panache, mixer.getRoot(), options);
  }

  get character() { return this.#bones.character; }
  setStrength(style, strength) { this.character.setStrength(style, strength); }
  setSide(style, side) { this.character.setSide(style, side); }

  // The mixer only writes what its actions change, so it needs its own pose back first.
  update(seconds) {
    checkFinite(seconds, 'seconds');
    this.#bones.restore();
    this.#mixer.update(seconds);
    this.#bones.step(seconds);
  }

  restore() { this.#bones.restore(); }
  free() {
    this.#bones.restore();
    this.#bones.free();
  }
}
