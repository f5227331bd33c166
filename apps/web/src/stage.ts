// The view: two bodies on a ground, in good light, side by side, overlaid or the output alone.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import type { Playback, Walk } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { colour } from './dom';
import { Ground } from './ground';
import { Mannequin } from './mannequin';
import { Marks } from './marks';
import type { View } from './settings';
import type { SkinnedCharacter } from './skinned';

const kInputLayer = 1, kStyledLayer = 2;
const kGazeHeight = 0.8;  // Metres.
const kNearest = 1.5, kFarthest = 12;

interface Body {
  pose(numbers: Float32Array, shift: THREE.Vector3): void;
  free(): void;
}

const jointAt = (parts: Float32Array, name: string) =>
  new THREE.Vector3().fromArray(parts, 7 * humanJoints.indexOf(name));
const groundUnder = (parts: Float32Array) => jointAt(parts, 'hips').setY(0);

/** Whether a chip draws, and not the browser by itself, which takes ten times as long. */
function hasGraphicsCard(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const told = context?.getExtension('WEBGL_debug_renderer_info');
  const name = told ? context?.getParameter(told.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|software/i.test(String(name));
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  view: View = 'styled';
  trail = true;
  #renderer: THREE.WebGLRenderer;
  #scene = new THREE.Scene();
  #camera = new THREE.PerspectiveCamera(30, 1, 0.1, 80);
  #otherCamera = new THREE.PerspectiveCamera(30, 1, 0.1, 80);
  #controls: OrbitControls;
  #sun = new THREE.DirectionalLight(0xffffff, 2.4);
  #sky = new THREE.HemisphereLight(0xffffff, 0x9a8f85, 1.5);
  #ground = new Ground();
  #marks = new Marks();
  #bodies: { input: Body; styled: Body; skinned: boolean } | null = null;
  #ghost: Mannequin | null = null;
  #followed = new THREE.Vector3();
  #size = { width: 0, height: 0, ratio: 0 };
  #slowness = 0;
  #sharpest = 2;  // Pixels drawn for one of the page's.

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    const fast = hasGraphicsCard();
    this.#sharpest = fast ? 2 : 0.75;
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: fast });
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.shadowMap.type = fast ? THREE.PCFSoftShadowMap : THREE.PCFShadowMap;
    this.#renderer.autoClear = false;
    this.#sun.castShadow = true;
    this.#sun.shadow.mapSize.setScalar(fast ? 1024 : 512);
    this.#sun.shadow.radius = 5;
    this.#sun.shadow.bias = -0.0004;
    this.#sun.shadow.normalBias = 0.01;
    const box = this.#sun.shadow.camera;
    [box.left, box.right, box.top, box.bottom, box.near, box.far] = [-1.5, 1.5, 1.7, -1.5, 0.5, 9];
    const rim = new THREE.DirectionalLight(0xbfd4ff, 0.9);
    rim.position.set(-3, 2.5, -4);
    this.#scene.add(this.#sun, this.#sun.target, this.#sky, rim, this.#ground.group,
      this.#marks.group);
    for (const light of [this.#sun, this.#sky, rim]) light.layers.enableAll();
    this.#onLayer(this.#marks.group, kStyledLayer);
    this.#camera.position.set(1.75, 1.35, 3.75);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.target.set(0, kGazeHeight, 0);
    Object.assign(this.#controls, {
      enablePan: false, enableDamping: true, dampingFactor: 0.12, minDistance: kNearest,
      maxDistance: kFarthest, minPolarAngle: 0.15, maxPolarAngle: 1.56,
    });
    this.paint();
  }

  /** Takes the colours of the style sheet. */
  paint() {
    this.#renderer.setClearColor(colour('stage'), 1);
    this.#ground.paint(colour('stage'), colour('grid'));
    this.#marks.paint(colour('accent'));
  }

  /** Shows the bodies of another player: its own meshes where it has some, else mannequins. */
  show(player: Walk | Playback, own: [SkinnedCharacter, SkinnedCharacter] | null) {
    this.#bodies?.input.free();
    this.#bodies?.styled.free();
    this.#ghost?.free();
    const input = { body: '#b9c6d6', accent: '#5d7087' };
    const offsets = player.offsets;
    const place = (object: THREE.Object3D, layer: number) => {
      this.#onLayer(object, layer);
      this.#scene.add(object);
    };
    this.#ghost = new Mannequin(offsets, { ...input, opacity: 0.36 });
    place(this.#ghost.mesh, kInputLayer);
    if (own) {
      this.#bodies = { input: own[0], styled: own[1], skinned: true };
      place(own[0].group, kInputLayer);
      place(own[1].group, kStyledLayer);
    } else {
      const solid = new Mannequin(offsets, { ...input, opacity: 1 });
      const styled = new Mannequin(offsets, { body: '#efe6d8', accent: '#d9622b', opacity: 1 });
      this.#bodies = { input: solid, styled, skinned: false };
      place(solid.mesh, kInputLayer);
      place(styled.mesh, kStyledLayer);
    }
    this.#marks.clear();
    this.#follow(groundUnder(player.parts('styled')), true);
  }

  /** Brings the player's last step into view. */
  update(player: Walk | Playback, joints: number, cut: boolean) {
    if (!this.#bodies || !this.#ghost) return;
    if (cut) this.#marks.clear();
    const input = player.parts('input').slice(), styled = player.parts('styled').slice();
    const here = groundUnder(styled);
    const still = new THREE.Vector3();
    // Where both are seen at once, the input walks where the output does.
    const beside = here.clone().sub(groundUnder(input));
    const inputShift = this.view === 'over' ? beside : still;
    this.#ghost.pose(input, inputShift);
    if (this.#bodies.skinned) {
      this.#bodies.input.pose(player.pose('input', joints).slice(), inputShift);
      this.#bodies.styled.pose(player.pose('styled', joints).slice(), still);
    } else {
      this.#bodies.input.pose(input, inputShift);
      this.#bodies.styled.pose(styled, still);
    }
    const feet = (name: string) => ['left', 'right'].map((side) => jointAt(styled, side + name));
    this.#marks.show(feet('Foot'), feet('Toes'), player.contacts, this.trail);
    this.#follow(here, cut);
    this.#inputPlace.copy(groundUnder(input)).add(inputShift);
  }
  #inputPlace = new THREE.Vector3();

  draw(seconds: number) {
    this.#fit(seconds);
    this.#controls.update();
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    const { width } = this.#size;
    if (this.view === 'side') {
      // Each half has its own body in the middle, seen from the same side.
      const half = Math.floor(width / 2);
      this.#otherCamera.copy(this.#camera);
      this.#otherCamera.position.sub(this.#followed).add(this.#inputPlace);
      this.#drawPart(this.#otherCamera, 0, half, [kInputLayer], this.#inputPlace);
      this.#drawPart(this.#camera, half, width - half, [kStyledLayer], this.#followed);
    } else {
      const layers = this.view === 'over' ? [kInputLayer, kStyledLayer] : [kStyledLayer];
      this.#drawPart(this.#camera, 0, width, layers, this.#followed);
    }
  }

  #drawPart(camera: THREE.PerspectiveCamera, left: number, width: number, layers: number[],
      middle: THREE.Vector3) {
    const { height } = this.#size;
    camera.aspect = width / height;
    // A narrow view steps back, so that a person still fits in.
    camera.zoom = Math.min(1, camera.aspect / 0.52);
    camera.updateProjectionMatrix();
    camera.layers.set(0);
    for (const layer of layers) camera.layers.enable(layer);
    this.#ground.follow(middle);
    this.#sun.position.set(middle.x + 1.6, 4.2, middle.z + 2);
    this.#sun.target.position.set(middle.x, 0.6, middle.z);
    if (this.#ghost && this.#bodies) {
      const over = layers.length > 1;
      this.#ghost.mesh.visible = over;
      const input = this.#bodies.input;
      const solid = input instanceof Mannequin ? input.mesh : (input as SkinnedCharacter).group;
      solid.visible = !over;
    }
    this.#renderer.setViewport(left, 0, width, height);
    this.#renderer.setScissor(left, 0, width, height);
    this.#renderer.setScissorTest(true);
    this.#renderer.render(this.#scene, camera);
  }

  /** Camera and light go where the body goes. */
  #follow(place: THREE.Vector3, at_once: boolean) {
    const step = place.clone().sub(this.#followed);
    if (!at_once && step.length() > 5) at_once = true;
    this.#followed.add(step);
    this.#camera.position.add(step);
    this.#controls.target.set(place.x, kGazeHeight, place.z);
  }

  // Takes the size of the place that the page gives it, and gives up sharpness where drawing is too
  // slow for it.
  #fit(seconds: number) {
    this.#slowness += 0.05 * ((seconds > 0.024 ? 1 : 0) - this.#slowness);
    let ratio = this.#size.ratio || Math.min(this.#sharpest, window.devicePixelRatio);
    if (this.#slowness > 0.7 && ratio > 0.6) {
      ratio = Math.max(0.6, ratio * 0.8);
      this.#slowness = 0;
    }
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === this.#size.width && height === this.#size.height && ratio === this.#size.ratio) {
      return;
    }
    this.#size = { width, height, ratio };
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(width, height, false);
  }

  #onLayer(object: THREE.Object3D, layer: number) {
    object.traverse((node) => node.layers.set(layer));
  }
}
