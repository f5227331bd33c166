// A body of solid parts, made to the measure of a rig, that shows twist and contact. All of it is
// one skinned mesh in which each vertex hangs on one joint.

import * as THREE from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

import { humanJoints } from '../package/index.js';
import { limb, palm, sphere, wedge } from './solids';

export interface Look {
  body: THREE.ColorRepresentation;
  accent: THREE.ColorRepresentation;
  /** 1 is solid. */
  opacity: number;
}

const kNumbers = 7;
const at = (name: string) => humanJoints.indexOf(name);

/** The parts of one joint, in its own frame: the body's colour first, then the accent's. */
type Parts = [THREE.BufferGeometry[], THREE.BufferGeometry[]];

function partsOf(offsets: Float32Array): Parts[] {
  const offset = (name: string) => new THREE.Vector3().fromArray(offsets, 3 * at(name));
  const parts: Parts[] = humanJoints.map(() => [[], []]);
  const body = (name: string, ...solids: THREE.BufferGeometry[]) =>
    parts[at(name)][0].push(...solids);
  const accent = (name: string, ...solids: THREE.BufferGeometry[]) =>
    parts[at(name)][1].push(...solids);

  const left = offset('leftUpperLeg'), right = offset('rightUpperLeg');
  const hips = left.clone().add(right).multiplyScalar(0.5);
  const chest = offset('chest'), neck = offset('neck');
  const belly = chest.lengthSq() > 0 ? chest : new THREE.Vector3(0, 0.12, 0);
  const torso = neck.lengthSq() > 0 ? neck : new THREE.Vector3(0, 0.2, 0);
  body('hips', sphere(hips.clone().add(new THREE.Vector3(0, 0.04, -0.004)), 0.148, 0.1, 0.112));
  body('spine', sphere(belly.clone().multiplyScalar(0.35), 0.132, 0.5 * belly.y + 0.1, 0.098));
  body('chest', sphere(torso.clone().multiplyScalar(0.48), 0.149, 0.5 * torso.y + 0.06, 0.106),
    sphere(new THREE.Vector3(0, 0.7 * torso.y, -0.008), 0.158, 0.062, 0.08));
  accent('spine', sphere(new THREE.Vector3(0, -0.012, 0), 0.137, 0.016, 0.103));
  const head = offset('head');
  const top = head.lengthSq() > 0 ? head : new THREE.Vector3(0, 0.09, 0);
  accent('neck', limb(top, 0.05, 0.046, 0));
  body('head', sphere(new THREE.Vector3(0, 0.1, 0.012), 0.078, 0.112, 0.094),
    sphere(new THREE.Vector3(0, 0.055, 0.035), 0.06, 0.062, 0.07));
  // A visor says where the face is.
  accent('head', sphere(new THREE.Vector3(0, 0.108, 0.022), 0.0745, 0.034, 0.095));

  for (const side of ['left', 'right']) {
    const out = side === 'left' ? 1 : -1;
    const upper = offset(`${side}LowerArm`), lower = offset(`${side}Hand`);
    body(`${side}Shoulder`, limb(offset(`${side}UpperArm`), 0.05, 0.055, 0));
    accent(`${side}UpperArm`, sphere(new THREE.Vector3(), 0.058, 0.058, 0.058));
    body(`${side}UpperArm`, limb(upper, 0.05, 0.04, 0.006));
    accent(`${side}LowerArm`, sphere(new THREE.Vector3(), 0.042, 0.042, 0.042));
    body(`${side}LowerArm`, limb(lower, 0.041, 0.026, 0.005));
    accent(`${side}Hand`, sphere(new THREE.Vector3(), 0.029, 0.027, 0.029));
    body(`${side}Hand`, ...palm(out));

    const thigh = offset(`${side}LowerLeg`), shin = offset(`${side}Foot`);
    const toes = offset(`${side}Toes`);
    accent(`${side}UpperLeg`, sphere(new THREE.Vector3(), 0.083, 0.083, 0.083));
    body(`${side}UpperLeg`, limb(thigh, 0.082, 0.054, 0.008));
    accent(`${side}LowerLeg`, sphere(new THREE.Vector3(0, 0, 0.004), 0.055, 0.057, 0.058));
    body(`${side}LowerLeg`, limb(shin, 0.051, 0.033, 0.012));
    accent(`${side}Foot`, sphere(new THREE.Vector3(), 0.039, 0.042, 0.041));
    const ball = toes.lengthSq() > 0 ? toes : new THREE.Vector3(0, -0.07, 0.12);
    body(`${side}Foot`, wedge([
      [-0.062, ball.y], [-0.066, 0.4 * ball.y], [-0.03, 0.015], [0.032, 0.012],
      [ball.z, ball.y + 0.042], [ball.z, ball.y],
    ], 0.078));
    accent(`${side}Toes`, wedge(
      [[0.002, 0], [0.002, 0.04], [0.045, 0.03], [0.075, 0.004], [0.07, 0]], 0.08));
  }
  return parts;
}

function geometryOf(offsets: Float32Array, look: Look): THREE.BufferGeometry {
  const pieces: THREE.BufferGeometry[] = [];
  partsOf(offsets).forEach((groups, joint) => groups.forEach((solids, group) => {
    const colour = new THREE.Color(group === 0 ? look.body : look.accent);
    for (const solid of solids) {
      const count = solid.getAttribute('position').count;
      solid.deleteAttribute('uv');
      const colours = new Float32Array(3 * count), index = new Uint16Array(4 * count);
      const weight = new Float32Array(4 * count);
      for (let i = 0; i < count; ++i) {
        colour.toArray(colours, 3 * i);
        index[4 * i] = joint;
        weight[4 * i] = 1;
      }
      solid.setAttribute('color', new THREE.BufferAttribute(colours, 3));
      solid.setAttribute('skinIndex', new THREE.BufferAttribute(index, 4));
      solid.setAttribute('skinWeight', new THREE.BufferAttribute(weight, 4));
      // Vertices that are shared are moved once, which counts where there is no graphics card.
      if (!solid.index) solid.setIndex([...Array(count).keys()]);
      pieces.push(solid);
    }
  }));
  return mergeGeometries(pieces);
}

export class Mannequin {
  readonly mesh: THREE.SkinnedMesh;
  #bones: THREE.Bone[];

  constructor(offsets: Float32Array, look: Look) {
    const solid = look.opacity === 1;
    const material = new THREE.MeshLambertMaterial({
      vertexColors: true,
      transparent: !solid, opacity: look.opacity, depthWrite: solid,
    });
    this.mesh = new THREE.SkinnedMesh(geometryOf(offsets, look), material);
    this.#bones = humanJoints.map(() => new THREE.Bone());
    for (const bone of this.#bones) bone.matrixWorldAutoUpdate = bone.matrixAutoUpdate = false;
    // The geometry is in the frames of the joints, so nothing has to be undone.
    this.mesh.bind(new THREE.Skeleton(this.#bones, this.#bones.map(() => new THREE.Matrix4())),
      new THREE.Matrix4());
    this.mesh.bindMode = THREE.DetachedBindMode;
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = solid;
  }

  /** Takes the pose that Player.parts() gives, moved by `shift`. */
  pose(parts: Float32Array, shift: THREE.Vector3) {
    const place = new THREE.Vector3(), turn = new THREE.Quaternion();
    const one = new THREE.Vector3(1, 1, 1);
    this.#bones.forEach((bone, joint) => {
      place.fromArray(parts, kNumbers * joint).add(shift);
      turn.fromArray(parts, kNumbers * joint + 3);
      bone.matrixWorld.compose(place, turn, one);
    });
  }

  free() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    (this.mesh.material as THREE.Material).dispose();
    this.mesh.skeleton.dispose();
  }
}
