// What is played and how: the source, the settings and the styles, and what people do with them.
// Controls act on it and listen to it.

import type { Panache } from '../package/index.js';
import { say } from './alerts';
import { find } from './dom';
import { withKey } from './keys';
import { kRemovable, Removal } from './removal';
import { fromAddress, Store, type Settings } from './settings';
import {
  clipSource, firstMotion, isModel, openMoving, putTogether, walkSource, type Source,
} from './source';
import { Steering } from './steering';
import { keyedNow } from './styling';

type News = 'source' | 'styles' | 'files';

export class Session {
  readonly store: Store;
  readonly removal: Removal;
  readonly steering = new Steering(find('#stick'));
  source: Source;
  files: File[] = [];  // Opened together.
  #file: File | null = null;    // The open one.
  bytes = new ArrayBuffer(0);  // Content of the open file.
  cut = true;  // Whether the motion has jumped since the last frame.
  changed = '';  // A style that was just replaced under the same name.
  /** Settled when the page's first model is there. */
  loaded: Promise<void> = Promise.resolve();
  /** Stops playing. */
  pause = () => {};
  #listeners: Record<News, (() => void)[]> = { source: [], styles: [], files: [] };

  constructor(readonly panache: Panache) {
    this.store = new Store(this.readAddress());
    this.removal = new Removal(panache, this.store);
    this.source = walkSource(panache);
  }

  /** Calls `action` now and after each change. */
  listen(to: News, action: () => void) {
    this.#listeners[to].push(action);
    action();
  }
  #tell(news: News) {
    for (const action of this.#listeners[news]) action();
  }

  // ---- Settings ----

  readAddress(): Settings {
    return fromAddress(location.hash, this.panache.styles.map(({ name }) => name), kRemovable);
  }
  isActive(name: string): boolean {
    const { styles, keys } = this.store.settings;
    return (styles[name] ?? 0) !== 0 || name in keys;
  }
  /** Plays a style alone, as captured. If it does so already, takes it off unless `keep`. */
  playStyle(name: string, keep = false) {
    const { styles, keys } = this.store.settings;
    const alone = styles[name] === 1 && Object.keys({ ...styles, ...keys }).length === 1;
    if (!alone) this.playAlone(name);
    else if (!keep) this.store.set({ styles: {}, sides: {} });
  }
  playAlone(name: string) {
    this.store.set({ styles: { [name]: 1 }, keys: {}, sides: {} });
  }
  /** Adds a style to the active ones, as captured. */
  addStyle(name: string) {
    if (!this.isActive(name)) this.store.setStyle(name, 1);
  }
  /** The current strength of a style. */
  strengthOf(name: string): number {
    const { settings } = this.store;
    return keyedNow(this.source, settings)[name] ?? settings.styles[name] ?? 0;
  }
  /** Plays a gesture; turns its style on if it is off. */
  trigger(name: string, gesture: number) {
    if (this.strengthOf(name) === 0) this.setStrength(name, 1);
    this.source.player.trigger(name, gesture);
  }
  /** Sets the strength; a style with keys gets a key at the play head, and playing stops. */
  setStrength(name: string, value: number) {
    const keys = this.store.settings.keys[name];
    if (this.source.kind !== 'clip' || !keys) return this.store.setStyle(name, value);
    this.pause();
    this.store.setKeys(name, withKey(keys, this.source.player.seconds, value).keys);
  }

  // ---- Models ----

  /** Call it when the model's styles change; `changed` is a style replaced under the same name. */
  stylesChanged(changed = '') {
    this.changed = changed;
    this.#tell('styles');
    this.store.keepStyles(this.panache.styles.map(({ name }) => name));
  }
  removeStyle(name: string) {
    this.panache.removeStyle(name);
    this.stylesChanged();
  }
  /** Opens a model, or adds a style to the open model. */
  async #openModel(file: File) {
    const bytes = await file.arrayBuffer();
    const known = this.panache.styles.map(({ name }) => name);
    const isStyle = this.panache.isStyle(bytes);
    if (isStyle) this.panache.addStyle(bytes, { name: file.name });
    else this.panache.setModel(bytes, file.name);
    this.stylesChanged();
    const added = this.panache.styles.find(({ name }) => !known.includes(name));
    if (isStyle && added) this.playAlone(added.name);
  }

  // ---- Sources ----

  /** Shows a source, and frees the one before. */
  use(source: Source) {
    const old = this.source;
    this.source = source;
    this.#tell('source');
    if (old.kind === 'clip' && (source.kind !== 'clip' || source.file !== old.file)) old.file.free();
    old.player.free();
    this.cut = true;
  }

  /** Only for clips, like stepFrames(). */
  seek(seconds: number) {
    if (this.source.kind !== 'clip') return;
    this.source.player.seek(seconds);
    this.cut = true;
  }
  stepFrames(frames: number) {
    if (this.source.kind !== 'clip') return;
    const { file, clip, player } = this.source;
    const { frameTime, seconds } = file.clips[clip] ?? { frameTime: 0, seconds: 0 };
    this.pause();
    if (frameTime <= 0) return;
    const at = Math.round(player.seconds / frameTime) + frames;
    this.seek(Math.min(seconds, Math.max(0, at * frameTime)));
  }

  /** Loads models and styles, opens the first of the other files, and lists them if there are
   * several. */
  async openAll(given: File[]) {
    await this.loaded;
    for (const file of given.filter(isModel)) await this.#openModel(file);
    const files = given.filter((file) => !isModel(file));
    if (files.length === 0) return;
    const list = await putTogether(this.panache, files);
    await this.open(list[0]);
    this.files = list;
    this.#tell('files');
  }
  /** Plays a motion of a file, by default the first that moves a body. */
  async open(given: File, clip?: number, fps?: number) {
    const opened = await openMoving(this.panache, given, fps);
    let source: Source;
    try {
      source = await clipSource(opened.file, opened.bytes, clip ?? firstMotion(opened.file));
    } catch (error) {
      opened.file.free();
      throw error;
    }
    this.#file = opened.from;
    this.bytes = opened.bytes;
    this.use(source);
    if (opened.notes.length > 0) say(opened.notes.join('\n'));
  }
  async playClip(clip: number) {
    if (this.source.kind !== 'clip') return;
    this.use(await clipSource(this.source.file, this.bytes, clip));
  }
  /** Reads the open file at `fps` frames per second; 0: at its own rate. */
  async setRate(fps: number) {
    if (this.source.kind === 'clip' && this.#file) await this.open(this.#file, this.source.clip, fps);
  }
}
