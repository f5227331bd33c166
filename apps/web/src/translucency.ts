// Draws the translucent parts of a body as a whole, depth first: only the outside is visible, and
// each pixel is blended once, whatever the order of triangles and meshes. All of a ghost is
// translucent; on a solid body, materials with a blended texture (in many files all of them) are.

import * as THREE from 'three';

// Render orders, after everything translucent on the ground. Ghosts come after solid bodies.
const kSolidOrder = 1, kGhostOrder = 3;
const kSurface = 0.5;    // Minimum alpha of a texture that hides what is behind it.
const kSeen = 1 / 255;   // Minimum alpha that is drawn.

interface Part {
  mesh: THREE.Mesh;
  solid: THREE.Material;
  castShadow: boolean;
  colour: THREE.Material;
  depth: THREE.Mesh;
}

/** A copy of a material that is drawn after everything solid. Both passes use the same program, so
 * their depths are equal bit for bit. */
function pass(from: THREE.Material, opacity: number, isColour: boolean): THREE.Material {
  const out = from.clone();
  Object.assign(out, { transparent: true, forceSinglePass: true, depthWrite: !isColour,
    colorWrite: isColour });
  if (out instanceof THREE.MeshPhysicalMaterial) out.transmission = 0;
  const min = from.alphaTest || (from.transparent ? (isColour ? kSeen : kSurface) : 0);
  out.alphaTest = min * opacity;
  out.opacity = from.opacity * opacity;
  if (out instanceof THREE.ShaderMaterial) out.uniforms.opacity.value = out.opacity;
  return out;
}

/** A copy of the mesh with the same bones. */
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

  /** Set `opacity` afterwards. */
  constructor(private meshes: readonly THREE.Mesh[]) {}

  /** 1: the original body. */
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
