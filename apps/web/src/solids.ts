// The shapes that the mannequin is made of. Metres.

import * as THREE from 'three';

const kAround = 18;

/** A ball, as wide, high and deep as these radii say. */
export function sphere(middle: THREE.Vector3, x: number, y: number, z: number) {
  return new THREE.SphereGeometry(1, kAround, 12).scale(x, y, z)
    .translate(middle.x, middle.y, middle.z);
}

/** From the origin to `end`, round at both ends; `bulge` is how much thicker it is on the way. */
export function limb(end: THREE.Vector3, from: number, to: number, bulge: number) {
  const length = end.length();
  if (length < 1e-4) return sphere(end, from, from, from);
  const points: THREE.Vector2[] = [];
  const steps = 6;
  for (let i = 0; i <= steps; ++i) {
    const angle = (Math.PI / 2) * (i / steps - 1);
    points.push(new THREE.Vector2(from * Math.cos(angle), from * Math.sin(angle)));
  }
  for (let i = 1; i < steps; ++i) {
    const t = i / steps;
    const radius = from + (to - from) * t + bulge * Math.sin(Math.PI * Math.min(1, 1.5 * t));
    points.push(new THREE.Vector2(radius, t * length));
  }
  for (let i = 0; i <= steps; ++i) {
    const angle = (Math.PI / 2) * (i / steps);
    points.push(new THREE.Vector2(to * Math.cos(angle), length + to * Math.sin(angle)));
  }
  points[0].x = points[points.length - 1].x = 0;
  const solid = new THREE.LatheGeometry(points, kAround);
  const up = new THREE.Vector3(0, 1, 0);
  return solid.applyQuaternion(
    new THREE.Quaternion().setFromUnitVectors(up, end.clone().normalize()));
}

/** The side view of a foot, as points ahead and up, of this width. */
export function wedge(outline: [number, number][], width: number) {
  const bevel = 0.012;
  const shape = new THREE.Shape(outline.map(([z, y]) => new THREE.Vector2(z, y)));
  const solid = new THREE.ExtrudeGeometry(shape, {
    depth: width - 2 * bevel, bevelEnabled: true, bevelThickness: bevel, bevelSize: 0.006,
    bevelOffset: -0.006, bevelSegments: 3, steps: 1,
  });
  // From ahead = x, up = y, across = z to ahead = z.
  return solid.translate(0, 0, -width / 2 + bevel).rotateY(-Math.PI / 2);
}

/** A hand along +x or -x (`out` = 1 or -1), palm down, thumb ahead: one sees how it is turned. */
export function palm(out: number) {
  const thumb = limb(new THREE.Vector3(0.042 * out, -0.006, 0.034), 0.013, 0.01, 0);
  return [
    sphere(new THREE.Vector3(0.05 * out, 0, 0), 0.05, 0.0165, 0.04),
    sphere(new THREE.Vector3(0.108 * out, -0.003, 0), 0.052, 0.0125, 0.034),
    thumb.translate(0.028 * out, -0.002, 0.024),
  ];
}
