// The box around a body as it stands.

import * as THREE from 'three';

const kMostVertices = 20000;  // Of a mesh that are looked at; of more than that every second or so.

/** Around these meshes in their present pose, in the world. */
export function boxAround(meshes: readonly THREE.Mesh[]): THREE.Box3 {
  const box = new THREE.Box3(), point = new THREE.Vector3();
  for (const mesh of meshes) {
    const { count } = mesh.geometry.getAttribute('position');
    const step = Math.ceil(count / kMostVertices);
    for (let i = 0; i < count; i += step) {
      box.expandByPoint(mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld));
    }
  }
  return box;
}
