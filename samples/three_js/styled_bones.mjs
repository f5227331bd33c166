// A three.js skeleton as Panache takes it: bones in, bones out.

export class StyledBones {
  #bones; #skeleton; #character; #pose;

  // `root`: of a tree of bones at rest. `humanBones`: the bone's name by the humanoid's joint, where
  // names and shape of the tree do not tell.
  constructor(panache, root, humanBones = {}) {
    this.#bones = [];
    root.traverse((bone) => this.#bones.push(bone));  // Parents before children.
    const index = new Map(this.#bones.map((bone, i) => [bone, i]));
    const joints = this.#bones.map((bone) => ({
      name: bone.name, parent: index.get(bone.parent) ?? -1,
      rotation: bone.quaternion.toArray(), translation: bone.position.toArray(),
    }));
    const humanJoints = Object.fromEntries(Object.entries(humanBones).map(
      ([human, name]) => [human, this.#bones.findIndex((bone) => bone.name === name)]));
    this.#skeleton = panache.createSkeleton(joints, { humanJoints });
    this.#character = panache.createCharacter(this.#skeleton);
    this.#pose = {
      rotations: new Float32Array(4 * joints.length),
      translations: new Float32Array(3 * joints.length),
    };
  }

  get character() { return this.#character; }
  get pose() { return this.#pose; }

  // Styles the bones as they are posed, in place; `seconds` have gone by since the last time.
  step(seconds) {
    this.#bones.forEach((bone, i) => {
      bone.quaternion.toArray(this.#pose.rotations, 4 * i);
      bone.position.toArray(this.#pose.translations, 3 * i);
    });
    this.#character.step(this.#pose, this.#pose, seconds);
    this.#bones.forEach((bone, i) => {
      bone.quaternion.fromArray(this.#pose.rotations, 4 * i);
      bone.position.fromArray(this.#pose.translations, 3 * i);
    });
  }

  free() {
    this.#character.free();
    this.#skeleton.free();
  }
}
