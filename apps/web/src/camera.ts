// Where the view is seen from: it follows the body, faces it, and fits it in.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import { humanJoints } from '../package/index.js';

export const kAngles = ['face', 'front', 'side', 'top', 'orbit'] as const;
export type Angle = (typeof kAngles)[number];

/** From ahead of the body to its left, and up from the ground, radians. */
const kPlaces: Record<Angle, [number, number]> = {
  face: [0.5, 0.14], front: [0, 0.05], side: [Math.PI / 2, 0.05], top: [0, 1.42],
  orbit: [0.5, 0.14],
};
const kNearest = 1.5, kFarthest = 12;
const kLag = 0.14;          // Seconds behind the body.
const kOverTheTop = 0.22;   // Metres from the highest joint to the end of a head or hand.
const kRoom = 1.42;         // Of the view, for a body.
const kOrbitSpeed = 4;      // Turns in four minutes.

const reduced = matchMedia('(prefers-reduced-motion: reduce)');

export class Camera {
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.1, 80);
  readonly followed = new THREE.Vector3();
  #controls: OrbitControls;
  #height = 1.6;

  constructor(canvas: HTMLCanvasElement) {
    this.#controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.#controls, {
      enablePan: false, enableDamping: !reduced.matches, dampingFactor: 0.12,
      minDistance: kNearest, maxDistance: kFarthest, minPolarAngle: 0.1, maxPolarAngle: 1.56,
      autoRotateSpeed: kOrbitSpeed,
    });
  }

  /** Looks at a body from an angle that it keeps, from as far as all of it needs. */
  look(angle: Angle, parts: Float32Array) {
    let top = 0.3;
    for (let j = 0; j < humanJoints.length; ++j) top = Math.max(top, parts[7 * j + 1]);
    this.#height = top + kOverTheTop;
    const facing = new THREE.Vector3(0, 0, 1)
      .applyQuaternion(new THREE.Quaternion().fromArray(parts, 3));
    const [left, up] = kPlaces[angle];
    const ahead = Math.atan2(facing.x, facing.z) + left;
    const distance = (kRoom * this.#height) / 2 / Math.tan(THREE.MathUtils.degToRad(15));
    this.followed.set(parts[0], 0, parts[2]);
    this.#aim();
    this.camera.position.copy(this.#controls.target).add(new THREE.Vector3(
      Math.sin(ahead) * Math.cos(up), Math.sin(up), Math.cos(ahead) * Math.cos(up))
      .multiplyScalar(distance));
    this.#controls.autoRotate = angle === 'orbit' && !reduced.matches;
    this.#controls.update();
  }

  /** Sees its own body as `other` sees its. */
  takeAngle(other: Camera) {
    const from = other.camera.position.clone().sub(other.#controls.target);
    this.#height = other.#height;
    this.#aim();
    this.camera.position.copy(this.#controls.target).add(from);
    this.#controls.autoRotate = false;
    this.#controls.update();
  }

  /** Goes where the body goes, a little later. */
  follow(place: THREE.Vector3, seconds: number) {
    const step = place.clone().sub(this.followed);
    const cut = reduced.matches || seconds === 0 || step.length() > 2;
    if (!cut) step.multiplyScalar(1 - Math.exp(-seconds / kLag));
    this.followed.add(step);
    this.camera.position.add(step);
    this.#aim();
    this.#controls.update(seconds);
  }

  free() {
    this.#controls.dispose();
  }

  #aim() {
    this.#controls.target.set(this.followed.x, this.#height / 2, this.followed.z);
  }
}
