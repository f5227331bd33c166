// The ground: a grid that goes on for ever, the shadow on it, where feet are planted and where they
// went.

import * as THREE from 'three';

const kSize = 24;       // Metres; the grid fades before.
const kShadowSize = 5;  // Metres.

/** Lines every metre, finer ones every quarter, fading with the distance from `middle`. */
function gridMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: {
      line: { value: new THREE.Color() },
      ground: { value: new THREE.Color() },
      middle: { value: new THREE.Vector3() },
    },
    vertexShader: `
      varying vec2 place;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        place = world.xz;
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: `
      uniform vec3 line, ground, middle;
      varying vec2 place;
      float lines(float spacing, float width) {
        vec2 at = place / spacing;
        vec2 soft = fwidth(at);
        vec2 away = abs(fract(at - 0.5) - 0.5);
        vec2 on = 1.0 - smoothstep(vec2(0.5 * width), 0.5 * width + 1.5 * soft, away);
        return max(on.x, on.y) * (1.0 - smoothstep(0.15, 0.5, max(soft.x, soft.y)));
      }
      void main() {
        float far = length(place - middle.xz);
        float shown = max(0.75 * lines(1.0, 0.014), 0.3 * lines(0.25, 0.02));
        float fade = 1.0 - smoothstep(2.5, 11.0, far);
        gl_FragColor = vec4(mix(ground, line, shown), fade);
        #include <colorspace_fragment>
      }`,
  });
}

export class Ground {
  readonly group = new THREE.Group();
  #grid: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  #shadow: THREE.Mesh;

  constructor() {
    const plane = new THREE.PlaneGeometry(kSize, kSize).rotateX(-Math.PI / 2);
    this.#grid = new THREE.Mesh(plane, gridMaterial());
    this.#grid.renderOrder = -2;
    const under = new THREE.PlaneGeometry(kShadowSize, kShadowSize).rotateX(-Math.PI / 2);
    this.#shadow = new THREE.Mesh(under, new THREE.ShadowMaterial({ opacity: 0.32 }));
    this.#shadow.receiveShadow = true;
    this.#shadow.position.y = 0.001;
    this.#shadow.renderOrder = -1;
    this.group.add(this.#grid, this.#shadow);
  }

  paint(ground: string, line: string) {
    this.#grid.material.uniforms.ground.value.set(ground);
    this.#grid.material.uniforms.line.value.set(line);
  }

  /** Keeps the ground under the body; the lines stay where they are. */
  follow(place: THREE.Vector3) {
    this.group.position.set(place.x, 0, place.z);
    this.#grid.material.uniforms.middle.value.copy(place);
  }
}
