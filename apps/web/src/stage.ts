// The view: two lit bodies on a ground, side by side, overlaid or the output alone.

import * as THREE from 'three';

import type { Walk } from '../package/index.js';
import { humanJoints } from '../package/index.js';
import { Camera, type Angle } from './camera';
import { colour } from './dom';
import { Ground } from './ground';
import type { Crowd } from './crowd';
import { bodyGeometry, Mannequin, type Look } from './mannequin';
import { Marks } from './marks';
import type { View } from './settings';
import type { SkinnedCharacter } from './skinned';

const kInputLayer = 1, kStyledLayer = 2, kCrowdLayer = 3;
const kAboveBody = 0.16;      // Share of the view that is free above a fitted body.
const kMaxDown = 0.08;        // Share of the view.
const kGhost = 0.4;           // Opacity of the input over the output.
const kOnions = 3;            // Number of past poses.
const kOnionSeconds = 0.3;    // Time between them.

/** The motion and looks to show: the part of a source that the stage needs. */
export interface Showable {
  readonly player: Pick<Walk, 'body' | 'coarseBody' | 'contacts' | 'parts' | 'pose'>;
  readonly joints: number;
  readonly own: readonly [SkinnedCharacter, SkinnedCharacter] | null;
}

const kStyledLook: Look = { body: '#efe6d8', accent: '#d9622b' };

interface Stand {
  position: THREE.Vector3;
  toes: THREE.Vector3[];
}

interface Body {
  readonly object: THREE.Object3D;
  /** The world-space bounding box of its meshes. */
  readonly box: THREE.Box3;
  /** 1 is solid. */
  opacity: number;
  pose(numbers: Float32Array, shift: THREE.Vector3): void;
  free(): void;
}

const jointAt = (parts: Float32Array, name: string) =>
  new THREE.Vector3().fromArray(parts, 7 * humanJoints.indexOf(name));
const groundUnder = (parts: Float32Array) => jointAt(parts, 'hips').setY(0);

function onLayer(object: THREE.Object3D, layer: number) {
  object.traverse((node) => node.layers.set(layer));
  return object;
}

/** Whether a graphics card renders; software rendering takes ten times as long. */
function hasGraphicsCard(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const told = context?.getExtension('WEBGL_debug_renderer_info');
  const name = told ? context?.getParameter(told.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|software/i.test(String(name));
}

export class Stage {
  view: View = 'styled';
  trail = true;
  onion = false;
  /** The figures of the view `crowd`. */
  #crowd: Crowd | null = null;
  /** Shows only the input, in all views, for comparison. */
  comparing = false;
  /** Height at the top, in pixels, to keep free of bodies if there is room. */
  keepClear = () => 0;
  #fast: boolean;  // Whether a graphics card renders.
  #renderer: THREE.WebGLRenderer;
  #scene = new THREE.Scene();
  #camera: Camera;
  #otherCamera = new THREE.PerspectiveCamera(30, 1, 0.1, 80);
  #sun = new THREE.DirectionalLight(0xffffff, 2.4);
  #sky = new THREE.HemisphereLight(0xffffff, 0x9a8f85, 1.5);
  #ground: Ground;
  #marks = new Marks();
  #bodies: { input: Body; styled: Body; skinned: boolean } | null = null;
  /** The position of each body on the ground, and of its toes. */
  #input: Stand = { position: new THREE.Vector3(), toes: [] };
  #styled: Stand = { position: new THREE.Vector3(), toes: [] };
  #geometry: THREE.BufferGeometry | null = null;
  #onions: Mannequin[] = [];
  #past: { time: number; parts: Float32Array }[] = [];
  #time = 0;
  #size = { width: 0, height: 0, ratio: 0 };
  #slowness = 0;
  #down = 0;  // Pixels by which the picture is moved down, see keepClear.
  #sharpest = 2;  // Maximum rendered pixels per CSS pixel.

  #loops: { input: THREE.Vector2; styled: THREE.Vector2; share: number } | null = null;

  /** `forLoop`: with a grid that can loop seamlessly. */
  constructor(readonly canvas: HTMLCanvasElement, forLoop = false) {
    const fast = (this.#fast = hasGraphicsCard());
    this.#sharpest = fast ? 2 : 0.75;
    // Opaque: saves a fifth of the frame time if the page is composed in software.
    const context = canvas.getContext('webgl2', { alpha: false, antialias: fast });
    this.#renderer = new THREE.WebGLRenderer({ canvas, context: context ?? undefined });
    // Without a card a shadow map takes longer than all the rest: use soft spots instead.
    this.#renderer.shadowMap.enabled = fast;
    this.#renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.#ground = new Ground(!fast, forLoop);
    this.#renderer.autoClear = false;
    this.#sun.castShadow = fast;
    this.#sun.shadow.mapSize.setScalar(1024);
    this.#sun.shadow.radius = 5;
    this.#sun.shadow.bias = -0.0004;
    this.#sun.shadow.normalBias = 0.01;
    const box = this.#sun.shadow.camera;
    [box.left, box.right, box.top, box.bottom, box.near, box.far] = [-1.5, 1.5, 1.7, -1.5, 0.5, 9];
    const rim = new THREE.DirectionalLight(0xbfd4ff, 0.9);
    rim.position.set(-3, 2.5, -4);
    this.#scene.add(this.#sun, this.#sun.target, this.#sky, rim, this.#ground.group,
      onLayer(this.#marks.group, kStyledLayer));
    for (const light of [this.#sun, this.#sky, rim]) light.layers.enableAll();
    this.#camera = new Camera(canvas);
    this.paint();
  }

  /** Takes the colours of the style sheet. */
  paint() {
    this.#renderer.setClearColor(colour('stage'), 1);
    this.#ground.paint(colour('stage'), colour('grid'));
    this.#marks.paint(colour('accent'));
  }

  /** Shows the bodies of another source: its own meshes if it has any, else mannequins. */
  show(source: Showable) {
    const { player, own } = source;
    this.#freeBodies();
    const body = this.#fast ? player.body : player.coarseBody;
    const geometry = (this.#geometry = bodyGeometry(body));
    const add = (object: THREE.Object3D, layer: number) =>
      this.#scene.add(onLayer(object, layer));
    const inputLook = { body: '#a9b9cc', accent: '#4d6480' };
    const styledLook = kStyledLook;
    this.#onions = Array.from({ length: kOnions }, () => new Mannequin(geometry, body, styledLook));
    this.#onions.forEach((onion, i) => {
      add(onion.object, kStyledLayer);
      onion.opacity = 0.4 - 0.1 * i;
    });
    const [input, styled] = own ?? [new Mannequin(geometry, body, inputLook),
      new Mannequin(geometry, body, styledLook)];
    this.#bodies = { input, styled, skinned: own !== null };
    add(input.object, kInputLayer);
    add(styled.object, kStyledLayer);
    this.#marks.clear();
    this.#past = [];
    this.update(source, true, 0);
    this.look('face', player);
  }

  /** Shows a crowd in its view. */
  gather(crowd: Crowd) {
    this.#crowd = crowd;
    this.#scene.add(onLayer(crowd.group, kCrowdLayer));
  }
  /** How the styled body looks. */
  get styledLook(): Look { return kStyledLook; }

  /** Moves the camera to the front, the side, the top, ... of the bodies, and fits them in. */
  look(angle: Angle, player: Showable['player']) {
    if (!this.#bodies) return;
    const { input, styled } = this.#bodies;
    const box = styled.box;
    if (this.view === 'crowd' && this.#crowd) {
      const { size } = this.#crowd;
      box.setFromCenterAndSize(this.#styled.position.clone().setY(size.y / 2), size);
    } else if (this.view !== 'styled') {
      box.union(input.box.translate(this.#styled.position.clone().sub(this.#input.position)));
    }
    this.#camera.look(angle, player.parts('styled'), box);
  }

  /** Updates the bodies from the player's last step. */
  update({ player, joints }: Showable, cut: boolean, seconds: number) {
    if (!this.#bodies) return;
    if (cut) this.#marks.clear();
    const input = player.parts('input').slice(), styled = player.parts('styled').slice();
    const here = groundUnder(styled);
    const still = new THREE.Vector3();
    // In the overlaid view the input is moved to the position of the output.
    const beside = here.clone().sub(groundUnder(input));
    const inputShift = this.view === 'over' ? beside : still;
    if (this.#bodies.skinned) {
      this.#bodies.input.pose(player.pose('input', joints).slice(), inputShift);
      this.#bodies.styled.pose(player.pose('styled', joints).slice(), still);
    } else {
      this.#bodies.input.pose(input, inputShift);
      this.#bodies.styled.pose(styled, still);
    }
    const feet = (parts: Float32Array, name: string) =>
      ['left', 'right'].map((side) => jointAt(parts, side + name));
    this.#input = { position: groundUnder(input).add(inputShift),
      toes: feet(input, 'Toes').map((foot) => foot.add(inputShift)) };
    this.#styled = { position: here, toes: feet(styled, 'Toes') };
    this.#marks.show(feet(styled, 'Foot'), this.#styled.toes, player.contacts, this.trail);
    this.#showOnions(styled, cut, seconds);
    this.#camera.follow(here, cut ? 0 : seconds);
  }

  #showOnions(parts: Float32Array, cut: boolean, seconds: number) {
    if (cut) this.#past = [];
    this.#time += seconds;
    if (seconds > 0) this.#past.push({ time: this.#time, parts });
    while (this.#past[0]?.time < this.#time - kOnionSeconds * (kOnions + 0.5)) this.#past.shift();
    this.#onions.forEach((onion, i) => {
      const then = this.#time - kOnionSeconds * (i + 1);
      const moment = this.#past.filter(({ time }) => time <= then).pop();
      onion.object.visible = this.onion && !this.#bodies?.skinned && moment !== undefined;
      if (onion.object.visible && moment) onion.pose(moment.parts, new THREE.Vector3());
    });
  }

  /** For tests: the camera's position, and the number of past poses shown. */
  get eye() {
    return this.#camera.camera.position.toArray();
  }
  get onionsShown() {
    return this.#onions.filter((onion) => onion.object.visible).length;
  }

  /** Maximum size of a picture in either direction, pixels. */
  get largestPicture() {
    return Math.min(8192, this.#renderer.capabilities.maxTextureSize);
  }
  /** The size of the view on the screen, pixels. */
  get seen(): [number, number] {
    const ratio = window.devicePixelRatio;
    return [Math.round(this.canvas.clientWidth * ratio),
      Math.round(this.canvas.clientHeight * ratio)];
  }
  /** The view as a PNG; null if the browser is out of memory. */
  picture(width: number, height: number): Promise<Blob | null> {
    const { ratio } = this.#size;
    this.#drawAt(width, height);
    const picture = new Promise<Blob | null>((done) => this.canvas.toBlob(done, 'image/png'));
    this.#size = { width: 0, height: 0, ratio };  // The next frame takes the page's size again.
    return picture;
  }

  #drawAt(width: number, height: number) {
    this.#size = { width, height, ratio: 1 };
    this.#down = 0;
    this.#renderer.setPixelRatio(1);
    this.#renderer.setSize(width, height, false);
    this.#drawAll();
  }

  /** The visible bodies. */
  get seenBodies(): readonly ('input' | 'styled')[] {
    return this.view === 'styled' || this.view === 'crowd' ? ['styled'] : ['input', 'styled'];
  }
  /** A view of another player with the same angle, on a separate canvas; free() it. */
  studio(source: Showable): Stage {
    const out = new Stage(document.createElement('canvas'), true);
    out.view = this.view;
    out.trail = false;
    out.show(source);
    out.#camera.takeAngle(this.#camera);
    return out;
  }
  /** Draws one frame of a loop in which the bodies move by `travel`: x and z of each visible one,
   * metres; empty if the loop does not close. `share` of it has passed. */
  drawStill(source: Showable, width: number, height: number, travel: readonly number[],
      share: number) {
    const [input, styled] = [travel.slice(0, 2), travel.slice(-2)].map(([x = 0, z = 0]) =>
      new THREE.Vector2(x, z));
    this.#loops = { input, styled, share };
    this.update(source, true, 0);
    this.#drawAt(width, height);
  }
  #freeBodies() {
    this.#bodies?.input.free();
    this.#bodies?.styled.free();
    for (const onion of this.#onions) onion.free();
    this.#geometry?.dispose();
  }
  free() {
    this.#freeBodies();
    this.#camera.free();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  draw(seconds: number) {
    this.#fit(seconds);
    this.#drawAll();
  }

  #drawAll() {
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    const { width } = this.#size;
    const camera = this.#camera.camera;
    if (this.comparing) {
      this.#seeInput(camera);
      this.#drawPart(this.#otherCamera, 0, width, [kInputLayer]);
    } else if (this.view === 'side') {
      // Each half shows one body in the middle, from the same angle.
      const half = Math.floor(width / 2);
      this.#seeInput(camera);
      this.#drawPart(this.#otherCamera, 0, half, [kInputLayer]);
      this.#drawPart(camera, half, width - half, [kStyledLayer]);
    } else {
      const layers = { over: [kInputLayer, kStyledLayer], styled: [kStyledLayer],
        crowd: [kCrowdLayer] }[this.view];
      this.#drawPart(camera, 0, width, layers);
    }
  }

  #seeInput(camera: THREE.PerspectiveCamera) {
    this.#otherCamera.copy(camera);
    this.#otherCamera.position.sub(this.#styled.position).add(this.#input.position);
  }

  /** Centres on the styled body if its layer is among `layers`, else on the input. */
  #drawPart(camera: THREE.PerspectiveCamera, left: number, width: number, layers: number[]) {
    const { height } = this.#size;
    const which = layers.join() === `${kInputLayer}` ? 'input' : 'styled';
    const { position, toes } = which === 'input' ? this.#input : this.#styled;
    camera.setViewOffset(width, height, 0, -this.#down, width, height);
    camera.zoom = this.#camera.zoomFor(camera.aspect);
    camera.updateProjectionMatrix();
    camera.layers.set(0);
    for (const layer of layers) camera.layers.enable(layer);
    this.#ground.follow(position, layers.includes(kCrowdLayer) ? null : toes);
    if (this.#loops) this.#ground.close(this.#loops[which], this.#loops.share);
    this.#sun.position.set(position.x + 1.6, 4.2, position.z + 2);
    this.#sun.target.position.set(position.x, 0.6, position.z);
    if (this.#bodies) this.#bodies.input.opacity = layers.length > 1 ? kGhost : 1;
    this.#renderer.setViewport(left, 0, width, height);
    this.#renderer.setScissor(left, 0, width, height);
    this.#renderer.setScissorTest(true);
    this.#renderer.render(this.#scene, camera);
  }

  // Fits the renderer to the canvas. If drawing is slow, lowers the resolution to one pixel per CSS
  // pixel, then drops the cast shadow, then lowers the resolution further.
  #fit(seconds: number) {
    this.#slowness += 0.05 * ((seconds > 0.024 ? 1 : 0) - this.#slowness);
    let ratio = this.#size.ratio || Math.min(this.#sharpest, window.devicePixelRatio);
    const min = Math.min(ratio, this.#fast ? 0.6 : 0.5);
    if (this.#slowness > 0.7 && this.#sun.castShadow && ratio <= 1) {
      this.#sun.castShadow = this.#renderer.shadowMap.enabled = false;
      this.#ground.spots = true;
      this.#slowness = 0;
    } else if (this.#slowness > 0.7 && ratio > min) {
      ratio = Math.max(min, ratio * 0.8);
      this.#slowness = 0;
    }
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === this.#size.width && height === this.#size.height && ratio === this.#size.ratio) {
      return;
    }
    this.#size = { width, height, ratio };
    this.#down = Math.max(0, Math.min(kMaxDown * height, this.keepClear() - kAboveBody * height));
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(width, height, false);
  }
}
