// Draws what is translucent of a body as a whole: its depth first, so that only its outside is seen
// and a pixel is blended once, whatever the order of its triangles and meshes. A ghost is translucent
// all over; of a solid body, so are materials with a blended texture, which many files have all over.

import * as THREE from 'three';

// After all that is translucent on the ground; what is seen through a ghost comes before it.
const kSolidOrder = 1, kGhostOrder = 3;
const kSurface = 0.5;    // Least alpha of a texture that hides what is behind it.
const kSeen = 1 / 255;   // Least alpha that is drawn.

interface Part {
  mesh: THREE.Mesh;
  solid: THREE.Material;
  castShadow: boolean;
  colour: THREE.Material;
  depth: THREE.Mesh;
}

/** A copy of a material that is drawn after everything solid. Both passes are the same program, so
 * that they give a point the same depth, bit for bit. */
function pass(from: THREE.Material, opacity: number, isColour: boolean): THREE.Material {
  const out = from.clone();
  Object.assign(out, { transparent: true, forceSinglePass: true, depthWrite: !isColour,
    colorWrite: isColour });
  if (out instanceof THREE.MeshPhysicalMaterial) out.transmission = 0;
  const least = from.alphaTest || (from.transparent ? (isColour ? kSeen : kSurface) : 0);
  out.alphaTest = least * opacity;
  out.opacity = from.opacity * opacity;
  if (out instanceof THREE.ShaderMaterial) out.uniforms.opacity.value = out.opacity;
  return out;
}

/** The mesh again, moved by the same bones. */
function twin(mesh: THREE.Mesh, material: THREE.Material): THREE.Mesh {
  const skinned = mesh instanceof THREE.SkinnedMesh;
  const out = skinned ? new THREE.SkinnedMesh(mesh.geometry, material)
    : new THREE.Mesh(mesh.geometry, material);
  if (skinned && out instanceof THREE.SkinnedMesh) {
    out.bindMode = mesh.bindMode;
    out.bind(mesh.skeleton, mesh.bindMatrix);
  }
  out.morphTargetInfluences = mesh.morphTargetInfluences;
  out.morphTargetDictionary = mesh.morphTargetDictionary;
  out.layers.mask = mesh.layers.mask;
  out.frustumCulled = mesh.frustumCulled;
  return out;
}

export class Translucency {
  #parts: Part[] = [];
  #opacity = 0;

  /** For `opacity` to be set. */
  constructor(private meshes: readonly THREE.Mesh[]) {}

  /** 1 is the body as it was made. */
  set opacity(opacity: number) {
    if (opacity === this.#opacity) return;
    this.free();
    this.#opacity = opacity;
    for (const mesh of this.meshes) {
      if (opacity < 1 || (mesh.material as THREE.Material).transparent) this.#add(mesh);
    }
  }

  free() {
    for (const { mesh, solid, castShadow, colour, depth } of this.#parts) {
      Object.assign(mesh, { material: solid, castShadow, renderOrder: 0 });
      depth.removeFromParent();
      colour.dispose();
      (depth.material as THREE.Material).dispose();
    }
    this.#parts = [];
    this.#opacity = 0;
  }

  #add(mesh: THREE.Mesh) {
    const solid = mesh.material as THREE.Material, { castShadow } = mesh;
    const ghost = this.#opacity < 1, order = ghost ? kGhostOrder : kSolidOrder;
    const colour = pass(solid, this.#opacity, true);
    const depth = twin(mesh, pass(solid, this.#opacity, false));
    depth.renderOrder = order;
    mesh.add(depth);
    Object.assign(mesh,
      { material: colour, castShadow: castShadow && !ghost, renderOrder: order + 1 });
    this.#parts.push({ mesh, solid, castShadow, colour, depth });
  }
}
