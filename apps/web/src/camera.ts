// The camera of a view: it follows the body, faces it, and fits it in.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

export const kAngles = ['face', 'front', 'side', 'top', 'orbit'] as const;
export type Angle = (typeof kAngles)[number];

// This angle shows both the lean of a style and the swing of arms and legs.
const kThreeQuarters = Math.PI / 4;
/** Azimuth from the front of the body to its left, and elevation, radians. */
const kDirections: Record<Angle, [number, number]> = {
  face: [kThreeQuarters, 0.14], front: [0, 0.05], side: [Math.PI / 2, 0.05], top: [0, 1.42],
  orbit: [kThreeQuarters, 0.14],
};
const kNearest = 1.5, kFarthest = 12;  // Metres, for a person.
const kLag = 0.14;          // Seconds behind the body.
const kRoom = 1.42;         // View height to body height: text covers the edges of the view.
const kEdge = 1.1;          // The minimum ratio of view to body, in every direction.
const kSlimmest = 0.52;     // Aspect ratio of a view that always fits a person.
const kTan = Math.tan(THREE.MathUtils.degToRad(15));  // Half the field of view.
const kOrbitSpeed = 4;      // Turns in four minutes.

const reduced = matchMedia('(prefers-reduced-motion: reduce)');

export class Camera {
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.1, 80);
  readonly followed = new THREE.Vector3();
  #controls: OrbitControls;
  #middle = new THREE.Vector3(0, 0.8, 0);  // The centre of the view, relative to `followed`.
  #width = kSlimmest;  // Aspect ratio of the view that it needs.

  constructor(canvas: HTMLCanvasElement) {
    this.#controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.#controls, {
      enablePan: false, enableDamping: !reduced.matches, dampingFactor: 0.12,
      minDistance: kNearest, maxDistance: kFarthest, minPolarAngle: 0.1, maxPolarAngle: 1.56,
      autoRotateSpeed: kOrbitSpeed,
    });
  }

  /** Looks at a world-space box from an angle, which it keeps, at a distance that fits the box.
   * `parts` give the position and heading of the body. */
  look(angle: Angle, parts: Float32Array, box: THREE.Box3) {
    const facing = new THREE.Vector3(0, 0, 1)
      .applyQuaternion(new THREE.Quaternion().fromArray(parts, 3));
    const [left, up] = kDirections[angle];
    const ahead = Math.atan2(facing.x, facing.z) + left;
    const from = new THREE.Vector3(
      Math.sin(ahead) * Math.cos(up), Math.sin(up), Math.cos(ahead) * Math.cos(up));
    const distance = this.#fit(box, from);
    this.followed.set(parts[0], 0, parts[2]);
    box.getCenter(this.#middle).sub(this.followed);
    this.#aim();
    this.camera.position.copy(this.#controls.target).addScaledVector(from, distance);
    this.#controls.autoRotate = angle === 'orbit' && !reduced.matches;
    this.#controls.update();
  }

  /** The distance that fits a box, if the view is wide enough. */
  #fit(box: THREE.Box3, from: THREE.Vector3): number {
    const half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
    const around = Math.hypot(half.x, half.z);
    const right = new THREE.Vector3(0, 1, 0).cross(from).normalize();
    const over = from.clone().cross(right);
    let distance = Math.max((kRoom * half.y) / kTan, 1.5 * around);
    for (let corner = 0; corner < 8; ++corner) {
      const [x, y, z] = [1, 2, 4].map((bit) => (corner & bit ? 1 : -1));
      const position = new THREE.Vector3(x, y, z).multiply(half);
      distance = Math.max(distance,
        position.dot(from) + (kEdge * Math.abs(position.dot(over))) / kTan);
    }
    // For any side, as the user can orbit the camera.
    this.#width = Math.max(kSlimmest,
      (kEdge * around) / Math.sqrt(distance ** 2 - around ** 2) / kTan);
    this.#controls.minDistance = Math.min(kNearest, distance / 3);
    this.#controls.maxDistance = Math.max(kFarthest, 2 * distance);
    this.camera.near = Math.min(0.1, distance / 30);
    this.camera.far = Math.max(80, 6 * distance);
    return distance;
  }

  /** The zoom for a view of this aspect ratio: a narrow view zooms out so that everything fits. */
  zoomFor(aspect: number) {
    return Math.min(1, aspect / this.#width);
  }

  /** Takes the angle of `other`, relative to the body. */
  takeAngle(other: Camera) {
    const from = other.camera.position.clone().sub(other.#controls.target);
    this.#middle.copy(other.#middle);
    this.#width = other.#width;
    this.#aim();
    this.camera.position.copy(this.#controls.target).add(from);
    this.#controls.autoRotate = false;
    this.#controls.update();
  }

  /** Follows the body with a small lag. */
  follow(position: THREE.Vector3, seconds: number) {
    const step = position.clone().sub(this.followed);
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
    this.#controls.target.copy(this.followed).add(this.#middle);
  }
}
