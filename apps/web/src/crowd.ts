// A crowd with one motion: sixty characters, each another person, steered together.

import * as THREE from 'three';

import type { Panache, Remover } from '../package/index.js';
import { element, find } from './dom';
import { bodyGeometry, Mannequin, type Look } from './mannequin';
import type { Settings } from './settings';
import type { Source } from './source';
import type { Wish } from './steering';
import { applySettings } from './styling';

const kCount = 60, kInARow = 10;
const kApart = 1.5;         // Metres between neighbours.
const kCreatedAtOnce = 3;   // In a frame, so that the view stays smooth.
const kOutOfStep = 0.37;    // Seconds from one walker's start to the next one's, within a cycle.
const kCycle = 1.1;         // Seconds.
const kAverage = 0.05;      // Share of the newest frame in the times shown.
const kWidth = kInARow * kApart, kDepth = (kCount / kInARow) * kApart;

interface Member {
  player: Source['player'];
  body: Mannequin;
  slot: THREE.Vector3;
}

/** Moves `value` by whole `period`s to within half of one from 0. */
const wrapped = (value: number, period: number) => value - period * Math.round(value / period);

export class Crowd {
  readonly group = new THREE.Group();
  /** What there is room for, around the middle on the ground. */
  readonly size = new THREE.Vector3(kWidth, 1.8, kDepth);
  #members: Member[] = [];
  #source: Source | null = null;
  #geometry: THREE.BufferGeometry | null = null;
  #settings: Settings | null = null;
  #remover: Remover | null = null;
  #facts = element('p', { id: 'crowd-facts', role: 'status' });
  #stepMs = 0;
  #frameMs = 0;
  #last = 0;  // When the last frame began.

  constructor(private panache: Panache) {
    find('#caption').after(this.#facts);
  }

  /** For tests and the facts. */
  get count() { return this.#members.length; }

  /** For tests: the styled pose of each. */
  get poses() { return this.#members.map(({ player }) => player.parts('styled').slice()); }

  /** Applies the settings: all as they are, but each character is another person, and if `mixed`,
   * each is in another style. */
  apply(settings: Settings, remover: Remover | null) {
    this.#settings = settings;
    this.#remover = remover;
    this.#members.forEach((member, i) => this.#applyTo(member, i));
  }
  #applyTo({ player }: Member, i: number) {
    if (!this.#settings) return;
    const { styles } = this.panache;
    const own = this.#settings.mixed && styles.length > 0
      ? { styles: { [styles[i % styles.length].name]: 1 }, keys: {} } : {};
    const from = this.#settings.person || 'crowd';
    applySettings(this.panache, player, { ...this.#settings, ...own, person: `${from} ${i + 1}` },
      this.#remover);
  }

  /** Advances all by `seconds`; creates those that lack. */
  step(source: Source, look: Look, seconds: number, wish: Wish) {
    if (source !== this.#source) this.clear();
    this.#source = source;
    for (let i = 0; i < kCreatedAtOnce && this.#members.length < kCount; ++i) {
      this.#add(source, look, wish);
    }
    const begin = performance.now();
    for (const { player } of this.#members) {
      if ('steer' in player) player.steer(wish.speed, wish.turn);
      player.step(seconds);
    }
    this.#measure(begin, performance.now() - begin);
    const middle = new THREE.Vector3().fromArray(source.player.parts('styled')).setY(0);
    for (const { player, body, slot } of this.#members) {
      const parts = player.parts('styled').slice();
      // A character that leaves on one side comes in on the other.
      const shift = slot.clone();
      const x = parts[0] + slot.x - middle.x, z = parts[2] + slot.z - middle.z;
      shift.x += wrapped(x, kWidth) - x;
      shift.z += wrapped(z, kDepth) - z;
      body.pose(parts, shift);
    }
  }

  #add(source: Source, look: Look, wish: Wish) {
    const player = source.kind === 'walk'
      ? this.panache.createWalker() : source.file.createPlayer(source.clip);
    const i = this.#members.length;
    const mesh = source.player.coarseBody;
    this.#geometry ??= bodyGeometry(mesh);
    const body = new Mannequin(this.#geometry, mesh, look);
    const slot = new THREE.Vector3((i % kInARow) * kApart, 0, Math.floor(i / kInARow) * kApart)
      .sub(new THREE.Vector3((kWidth - kApart) / 2, 0, (kDepth - kApart) / 2));
    const member = { player, body, slot };
    this.#members.push(member);
    body.object.layers.mask = this.group.layers.mask;
    this.group.add(body.object);
    this.#applyTo(member, i);
    if (!('steer' in player)) return player.step(0);
    player.steer(wish.speed, wish.turn);
    for (let t = 0; t < (i * kOutOfStep) % kCycle; t += 0.05) player.step(0.05);
  }

  #measure(begin: number, ms: number) {
    const share = this.#last === 0 ? 1 : kAverage;
    this.#stepMs += share * (ms / this.#members.length - this.#stepMs);
    if (this.#last > 0) {
      this.#frameMs += (this.#frameMs === 0 ? 1 : share) * (begin - this.#last - this.#frameMs);
    }
    this.#last = begin;
    if (this.#frameMs === 0) return;
    this.#facts.textContent = `${this.#members.length} characters, ` +
      `${(1000 / this.#frameMs).toFixed(0)} frames a second, ` +
      `${(1000 * this.#stepMs).toFixed(0)} µs a character with its input`;
  }

  /** Frees all characters. */
  clear() {
    for (const { player, body } of this.#members) {
      player.free();
      body.free();
    }
    this.#members = [];
    this.#source = null;
    this.#geometry?.dispose();
    this.#geometry = null;
    this.#frameMs = this.#last = 0;
    this.#facts.textContent = '';
  }
}
