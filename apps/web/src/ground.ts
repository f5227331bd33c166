// The ground: an endless grid, and the shadow on it.

import * as THREE from 'three';

const kSize = 24;       // Metres; the grid fades out before its edge.
const kShadowSize = 5;  // Metres.

const kTile = 256;  // Pixels of the texture, which is a square metre.

/** A square metre: lines along its edges, and thinner or `equal` ones every quarter. */
function lineTexture(sharp: boolean, equal: boolean): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = kTile;
  const context = canvas.getContext('2d')!;
  for (let i = 0; i <= 4; ++i) {
    const edge = i % 4 === 0 && !equal;
    const at = (i * kTile) / 4, thickness = edge ? 5 : equal ? 2.5 : 1.5;
    context.fillStyle = edge ? '#bfbfbf' : equal ? '#858585' : '#5a5a5a';
    context.fillRect(at - thickness / 2, 0, thickness, kTile);
    context.fillRect(0, at - thickness / 2, kTile, thickness);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.anisotropy = sharp ? 8 : 1;
  return texture;
}

/** Lines that fade with distance. One texture lookup: shaders that compute lines or colours for
 * each pixel take half of the frame time without a graphics card. */
function gridMaterial(sharp: boolean, equal: boolean): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    depthWrite: false,
    uniforms: {
      line: { value: new THREE.Color() },
      ground: { value: new THREE.Color() },
      lines: { value: lineTexture(sharp, equal) },
      drift: { value: new THREE.Vector2() },
    },
    vertexShader: `
      uniform vec2 drift;
      varying vec2 place;
      varying float shown;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        place = world.xz + drift;
        shown = 1.0 - smoothstep(2.5, 10.5, length(position.xz));
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: `
      uniform vec3 line, ground;
      uniform sampler2D lines;
      varying vec2 place;
      varying float shown;
      void main() {
        gl_FragColor = vec4(mix(ground, line, shown * texture2D(lines, place).r), 1.0);
      }`,
  });
}

/** Dark in the middle, transparent at the edge. */
function spotMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: { strength: { value: 0 } },
    vertexShader: `
      varying vec2 place;
      void main() {
        place = 2.0 * uv - 1.0;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform float strength;
      varying vec2 place;
      void main() {
        float dark = 1.0 - min(1.0, dot(place, place));
        gl_FragColor = vec4(0.06, 0.05, 0.04, strength * dark * dark);
      }`,
  });
}

export class Ground {
  #spots = [1.1, 0.42, 0.42].map((size) => new THREE.Mesh(
    new THREE.PlaneGeometry(size, size).rotateX(-Math.PI / 2), spotMaterial()));
  readonly group = new THREE.Group();
  #grid: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  #shadow: THREE.Mesh;

  /** `spots`: no cast shadow, and cheap lines. `equal`: all lines have the same width. */
  constructor(public spots: boolean, equal: boolean) {
    const plane = new THREE.PlaneGeometry(kSize, kSize, 24, 24).rotateX(-Math.PI / 2);
    this.#grid = new THREE.Mesh(plane, gridMaterial(!spots, equal));
    this.#grid.renderOrder = -2;
    const under = new THREE.PlaneGeometry(kShadowSize, kShadowSize).rotateX(-Math.PI / 2);
    this.#shadow = new THREE.Mesh(under, new THREE.ShadowMaterial({ opacity: 0.32 }));
    this.#shadow.receiveShadow = true;
    this.#shadow.position.y = 0.001;
    this.#shadow.renderOrder = -1;
    this.group.add(this.#grid, this.#shadow, ...this.#spots);
    for (const spot of this.#spots) spot.renderOrder = -1;
  }

  paint(ground: string, line: string) {
    // The shader takes sRGB.
    const { uniforms } = this.#grid.material;
    uniforms.ground.value.set(ground).convertLinearToSRGB();
    uniforms.line.value.set(line).convertLinearToSRGB();
  }

  /** Drifts the grid over a loop in which the body moves by `travel`, so that the grid matches at
   * both ends without a jump. `share` of the loop has passed. */
  close(travel: THREE.Vector2, share: number) {
    const drift = this.#grid.material.uniforms.drift.value as THREE.Vector2;
    drift.copy(travel).multiplyScalar(4).round().divideScalar(4).sub(travel).multiplyScalar(share);
  }

  /** Keeps the ground under the body without moving the lines. `feet` are the toes; null: no body
   * stands there. */
  follow(position: THREE.Vector3, feet: readonly THREE.Vector3[] | null) {
    this.#shadow.visible = !this.spots && feet !== null;
    this.#spots.forEach((spot, i) => {
      const over = i === 0 ? position : feet?.[i - 1];
      spot.visible = this.spots && feet !== null && over !== undefined;
      if (!spot.visible || !over) return;
      spot.position.set(over.x - position.x, 0.002 + 0.001 * i, over.z - position.z);
      const near = i === 0 ? 0.6 : Math.exp(-6 * Math.max(0, over.y - 0.03));
      spot.material.uniforms.strength.value = 0.5 * near;
    });
    this.group.position.set(position.x, 0, position.z);
  }
}
