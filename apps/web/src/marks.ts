// The marks of the feet on the ground: a disc under each planted foot, and a ribbon that traces the
// toes.

import * as THREE from 'three';

const kSamples = 110;  // Per ribbon.
const kGap = 0.02;     // Minimum distance between samples, metres.
const kWidth = 0.016;

class Ribbon {
  readonly mesh: THREE.Mesh;
  #points: THREE.Vector3[] = [];

  constructor() {
    const geometry = new THREE.BufferGeometry();
    const numbers = (size: number) =>
      new THREE.BufferAttribute(new Float32Array(2 * kSamples * size), size)
        .setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute('position', numbers(3));
    geometry.setAttribute('color', numbers(4));
    const index: number[] = [];
    for (let i = 0; i + 1 < kSamples; ++i) {
      const a = 2 * i;
      index.push(a, a + 1, a + 2, a + 1, a + 3, a + 2);
    }
    geometry.setIndex(index);
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({
      vertexColors: true, transparent: true, depthWrite: false, side: THREE.DoubleSide,
    }));
    this.mesh.frustumCulled = false;
  }

  clear() {
    this.#points = [];
  }

  add(position: THREE.Vector3) {
    const last = this.#points[0];
    if (last && last.distanceTo(position) > 1) this.clear();
    if (last && last.distanceTo(position) < kGap) return;
    this.#points.unshift(position.clone());
    this.#points.length = Math.min(this.#points.length, kSamples);
  }

  draw(colour: THREE.Color) {
    const position = this.mesh.geometry.getAttribute('position') as THREE.BufferAttribute;
    const paint = this.mesh.geometry.getAttribute('color') as THREE.BufferAttribute;
    const count = this.#points.length;
    const side = new THREE.Vector3();
    for (let i = 0; i < count; ++i) {
      const a = this.#points[Math.max(0, i - 1)], b = this.#points[Math.min(count - 1, i + 1)];
      side.set(b.z - a.z, 0, a.x - b.x).setLength(kWidth / 2);
      const p = this.#points[i];
      for (const [k, sign] of [[0, 1], [1, -1]]) {
        position.setXYZ(2 * i + k, p.x + sign * side.x, p.y, p.z + sign * side.z);
        paint.setXYZW(2 * i + k, colour.r, colour.g, colour.b, 0.75 * (1 - i / kSamples) ** 1.5);
      }
    }
    position.needsUpdate = paint.needsUpdate = true;
    this.mesh.geometry.setDrawRange(0, Math.max(0, count - 1) * 6);
  }
}

export class Marks {
  readonly group = new THREE.Group();
  #ribbons = [new Ribbon(), new Ribbon()];
  #discs: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>[];
  #colour = new THREE.Color();

  constructor() {
    const disc = new THREE.CircleGeometry(0.105, 40).rotateX(-Math.PI / 2).scale(0.72, 1, 1.3);
    const ring = new THREE.RingGeometry(0.095, 0.105, 40).rotateX(-Math.PI / 2).scale(0.72, 1, 1.3);
    this.#discs = [disc, ring, disc, ring].map((geometry) => new THREE.Mesh(geometry,
      new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false })));
    this.group.add(...this.#ribbons.map((ribbon) => ribbon.mesh), ...this.#discs);
  }

  paint(colour: string) {
    this.#colour.set(colour);
    for (const disc of this.#discs) disc.material.color.set(colour);
  }

  clear() {
    for (const ribbon of this.#ribbons) ribbon.clear();
  }

  /** `ankles` and `toes` in the world; `planted`: probability that each foot is planted. */
  show(ankles: THREE.Vector3[], toes: THREE.Vector3[], planted: number[], trail: boolean) {
    for (const foot of [0, 1]) {
      this.#ribbons[foot].mesh.visible = trail;
      this.#ribbons[foot].add(toes[foot]);
      if (trail) this.#ribbons[foot].draw(this.#colour);
      const sure = Math.max(0, Math.min(1, (planted[foot] - 0.3) / 0.5));
      const ahead = Math.atan2(toes[foot].x - ankles[foot].x, toes[foot].z - ankles[foot].z);
      for (const [k, opacity] of [[0, 0.28], [1, 0.9]]) {
        const disc = this.#discs[2 * foot + k];
        disc.position.lerpVectors(ankles[foot], toes[foot], 0.62).setY(0.003 + 0.001 * k);
        disc.rotation.y = ahead;
        disc.material.opacity = opacity * sure;
        disc.visible = sure > 0.01;
      }
    }
  }
}
