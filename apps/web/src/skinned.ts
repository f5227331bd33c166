// The user's own character: the meshes of a GLB, moved by the library's poses.

import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { clone } from 'three/examples/jsm/utils/SkeletonUtils.js';

import type { MotionFile, Playback } from '../package/index.js';
import { boxAround } from './mannequin';
import { Translucency } from './translucency';

/** Paths of node names from the root down; equal paths get a "+" for each earlier one. */
function pathsOf(parents: number[], names: string[]): Map<string, number> {
  const paths: string[] = [];
  const found = new Map<string, number>();
  names.forEach((name, i) => {
    const above = parents[i] < 0 ? '' : paths[parents[i]];
    let path = `${above}/${name}`;
    while (found.has(path)) path += '+';
    paths.push(path);
    found.set(path, i);
  });
  return found;
}

interface Moved {
  node: THREE.Object3D;
  joint: number;
  /** The rest scale of all ancestors, by which the library multiplies translations. */
  scale: number;
}

export class SkinnedCharacter {
  readonly object = new THREE.Group();
  #scene: THREE.Object3D;
  #moved: Moved[] = [];
  #joints: number;
  #meshes: THREE.Mesh[] = [];
  #translucency = new Translucency(this.#meshes);

  constructor(scene: THREE.Object3D, file: MotionFile, player: Playback) {
    this.#scene = scene;
    this.#joints = file.joints.length;
    const nodes: THREE.Object3D[] = [];
    scene.traverse((node) => node !== scene && nodes.push(node));
    const parents = nodes.map(({ parent }) => nodes.indexOf(parent!));
    // three.js renames nodes, but keeps the names in the file in userData.
    const paths = pathsOf(parents, nodes.map((node) => node.userData.name ?? node.name));
    scene.updateMatrixWorld(true);
    const wanted = pathsOf(file.joints.map((j) => j.parent), file.joints.map((j) => j.name));
    for (const [path, joint] of wanted) {
      const index = paths.get(path);
      if (index === undefined) continue;
      const above = nodes[index].parent?.getWorldScale(new THREE.Vector3()).x ?? 1;
      this.#moved.push({ node: nodes[index], joint, scale: above || 1 });
    }
    const { toYUp, scale, floor } = player.placement;
    this.object.add(scene);
    scene.quaternion.fromArray(toYUp);
    scene.scale.setScalar(scale);
    scene.position.y = -floor;
    this.object.traverse((node) => {
      node.frustumCulled = false;
      if (!(node instanceof THREE.Mesh)) return;
      node.castShadow = true;
      this.#meshes.push(node);
    });
    this.opacity = 1;
  }

  /** Whether all of the library's joints were found among three.js's nodes. */
  get complete() {
    return this.#moved.length === this.#joints;
  }

  pose(numbers: Float32Array, shift: THREE.Vector3) {
    for (const { node, joint, scale } of this.#moved) {
      node.quaternion.fromArray(numbers, 7 * joint);
      node.position.fromArray(numbers, 7 * joint + 4).divideScalar(scale);
    }
    this.object.position.copy(shift);
  }

  /** The bounding box of all that the joints move, without other objects, such as a floor. */
  get box() {
    this.object.updateMatrixWorld(true);
    const joints = new Set(this.#moved.map(({ node }) => node));
    const isMoved = (node: THREE.Object3D | null): boolean =>
      node !== null && (joints.has(node) || isMoved(node.parent));
    return boxAround(this.#meshes.filter((mesh) =>
      mesh.visible && (mesh instanceof THREE.SkinnedMesh || isMoved(mesh))));
  }
  set opacity(opacity: number) {
    this.#translucency.opacity = opacity;
  }

  free() {
    this.#translucency.free();
    this.object.removeFromParent();
    this.#scene.traverse((node) => {
      if (node instanceof THREE.Mesh) node.geometry.dispose();
    });
  }
}

/** The file's character twice, for input and output; null if it has no skin. */
export async function loadSkinned(bytes: ArrayBuffer, file: MotionFile, player: Playback):
    Promise<[SkinnedCharacter, SkinnedCharacter] | null> {
  const { scene, parser } = await new GLTFLoader().parseAsync(bytes, '');
  let skinned = false;
  scene.traverse((node) => {
    if (node instanceof THREE.SkinnedMesh) skinned = true;
    const index = parser.associations.get(node)?.nodes;
    if (index !== undefined) {
      node.userData.name = parser.json.nodes[index].name || `node ${index}`;
    }
  });
  if (!skinned) return null;
  const pair: [SkinnedCharacter, SkinnedCharacter] = [
    new SkinnedCharacter(clone(scene), file, player), new SkinnedCharacter(scene, file, player)];
  return pair.every((character) => character.complete) ? pair : null;
}
