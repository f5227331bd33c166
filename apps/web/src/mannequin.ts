// The body that the library builds with a rig's proportions: one skinned mesh, lit per vertex, so
// it is cheap even without a graphics card.

import * as THREE from 'three';

import { humanJoints, type Body } from '../package/index.js';
import { Translucency } from './translucency';

export interface Look {
  body: THREE.ColorRepresentation;
  accent: THREE.ColorRepresentation;
}

const kNumbers = 7;
const kMaxVertices = 20000;  // Per mesh; larger meshes are subsampled.

/** The world-space bounding box of the meshes in their current pose. */
export function boxAround(meshes: readonly THREE.Mesh[]): THREE.Box3 {
  const box = new THREE.Box3(), point = new THREE.Vector3();
  for (const mesh of meshes) {
    const { count } = mesh.geometry.getAttribute('position');
    const step = Math.ceil(count / kMaxVertices);
    for (let i = 0; i < count; i += step) {
      box.expandByPoint(mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld));
    }
  }
  return box;
}

/** The geometry that both bodies and all ghosts of a player share. */
export function bodyGeometry(body: Body): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  const add = (name: string, array: THREE.TypedArray, size: number, normalized = false) =>
    geometry.setAttribute(name, new THREE.BufferAttribute(array, size, normalized));
  add('position', body.positions, 3);
  add('normal', body.normals, 3);
  add('skinIndex', body.joints, 4);
  add('skinWeight', body.weights, 4, true);
  add('accent', body.accents, 1, true);
  geometry.setIndex(new THREE.BufferAttribute(body.triangles, 1));
  return geometry;
}

const kVertex = `
  #include <skinning_pars_vertex>
  attribute float accent;
  varying float vAccent;
  varying vec3 vLight;
  void main() {
    #include <beginnormal_vertex>
    #include <skinbase_vertex>
    #include <skinnormal_vertex>
    #include <begin_vertex>
    #include <skinning_vertex>
    #include <project_vertex>
    vec3 n = normalize(objectNormal);
    vec3 toEye = normalize(cameraPosition - transformed);
    float sun = max(0.0, dot(n, normalize(vec3(0.36, 0.82, 0.45))));
    float rim = pow(1.0 - max(0.0, dot(n, toEye)), 3.0);
    vec3 sky = mix(vec3(0.40, 0.36, 0.34), vec3(0.56, 0.57, 0.60), 0.5 + 0.5 * n.y);
    vLight = sky + vec3(0.54, 0.52, 0.48) * sun + vec3(0.20, 0.22, 0.26) * rim;
    vAccent = accent;
  }`;
const kFragment = `
  uniform vec3 body, accentColour;
  uniform float opacity;
  varying float vAccent;
  varying vec3 vLight;
  void main() {
    vec3 colour = mix(body, accentColour, smoothstep(0.35, 0.65, vAccent));
    gl_FragColor = vec4(colour * vLight, opacity);
    #include <colorspace_fragment>
  }`;

export class Mannequin {
  readonly object: THREE.SkinnedMesh;
  #bones: THREE.Bone[];
  #translucency: Translucency;

  constructor(geometry: THREE.BufferGeometry, body: Body, look: Look) {
    const material = new THREE.ShaderMaterial({
      vertexShader: kVertex, fragmentShader: kFragment,
      uniforms: {
        body: { value: new THREE.Color(look.body) },
        accentColour: { value: new THREE.Color(look.accent) },
        opacity: { value: 1 },
      },
    });
    this.object = new THREE.SkinnedMesh(geometry, material);
    this.#bones = humanJoints.map(() => new THREE.Bone());
    for (const bone of this.#bones) bone.matrixWorldAutoUpdate = bone.matrixAutoUpdate = false;
    const one = new THREE.Vector3(1, 1, 1);
    const inverses = this.#bones.map((_, joint) => new THREE.Matrix4().compose(
      new THREE.Vector3().fromArray(body.bindPositions, 3 * joint),
      new THREE.Quaternion().fromArray(body.bindRotations, 4 * joint), one).invert());
    this.object.bind(new THREE.Skeleton(this.#bones, inverses), new THREE.Matrix4());
    this.object.bindMode = THREE.DetachedBindMode;
    this.object.frustumCulled = false;
    this.object.castShadow = true;
    this.#translucency = new Translucency([this.object]);
  }

  /** Takes a pose from Player.parts(), moved by `shift`. */
  pose(parts: Float32Array, shift: THREE.Vector3) {
    const position = new THREE.Vector3(), turn = new THREE.Quaternion();
    const one = new THREE.Vector3(1, 1, 1);
    this.#bones.forEach((bone, joint) => {
      position.fromArray(parts, kNumbers * joint).add(shift);
      turn.fromArray(parts, kNumbers * joint + 3);
      bone.matrixWorld.compose(position, turn, one);
    });
  }

  get box() {
    return boxAround([this.object]);
  }
  set opacity(opacity: number) {
    this.#translucency.opacity = opacity;
  }

  /** Keeps the geometry, which other bodies may use. */
  free() {
    this.#translucency.free();
    this.object.removeFromParent();
    (this.object.material as THREE.Material).dispose();
    this.object.skeleton.dispose();
  }
}
