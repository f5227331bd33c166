// The page: makes everything and runs it, one frame after the other.

import * as files from 'virtual:panache-files';

import { Panache, PanacheError, Playback, type Walk } from '../package/index.js';
import type { Angle } from './camera';
import { button, element, find, forgetColours } from './dom';
import { listenToDrops } from './drops';
import { Figures } from './figures';
import { Cross } from './gamepad';
import { buildHelp } from './help';
import { strengthAt, withKey, type Key } from './keys';
import { late } from './late';
import { Learn } from './learn';
import type { LoopMotion } from './loop';
import { clipLoop, walkLoop } from './loop_motion';
import { buildPanel, captionOf, type Panel } from './panel';
import { Plots } from './plots';
import { addFiles, addMotion, type Exports } from './save_all';
import { buildViewSaving } from './save_view';
import { saveBytes } from './saving';
import { served } from './served';
import {
  fromAddress, rememberInAddress, shapeOf, Store, toAddress, type Settings,
} from './settings';
import {
  clipSource, firstMotion, isModel, openFile, putTogether, titleOf, walkSource, type Source,
} from './source';
import { Stage } from './stage';
import { kPaces, Steering, type Pace } from './steering';
import { Track } from './track';
import { TransportBar } from './transport';
import { unpack } from './unpack';
import { buildViewControls } from './view_controls';

const kMeasuredSteps = 16;   // At once: a browser's clock is too coarse for one.
const kMeasureEvery = 6;     // Frames.
const kPlotEvery = 3;        // Frames.
const kAlertSeconds = 12;

class Page {
  #panache: Panache;
  #store: Store;
  #stage = new Stage(find<HTMLCanvasElement>('#view'));
  #plots: Plots;
  #steering = new Steering(find('#stick'));
  #cross = new Cross();
  #transport: TransportBar;
  #figures: Figures;
  #panel: Panel;
  #learn: Learn;
  #track: Track;
  #help = buildHelp();
  #source: Source;
  #files: File[] = [];  // That were opened together.
  #file: File | null = null;    // That is open.
  #bytes = new ArrayBuffer(0);  // Of that file.
  #cut = true;
  #last = 0;
  #seconds = 0;
  #frames = 0;
  #alertTimer = 0;

  constructor(panache: Panache) {
    this.#panache = panache;
    const names = panache.styles.map((style) => style.name);
    this.#store = new Store(fromAddress(location.hash, names));
    this.#plots = new Plots(find('#plots'), names);
    this.#transport = new TransportBar({
      onSeek: (seconds) => this.#seek(seconds),
      onClip: (clip) => void this.#attempt(() => this.#playClip(clip)),
      onRate: (fps) => void this.#attempt(() => this.#setRate(fps)),
      onLoop: (loop) => this.#source.kind === 'clip' && (this.#source.player.loop = loop),
      onStep: (frames) => this.#stepFrames(frames),
    });
    this.#source = walkSource(panache);
    this.#learn = new Learn({
      panache,
      capture: (which, seconds) => this.#capture(which, seconds),
      isLive: () => this.#source.kind === 'walk',
      onLearnt: (name) => {
        this.#stylesChanged(name);
        this.#store.set({ styles: { [name]: 1 }, keys: {} });
      },
      onSave: (name) => this.#saveStyle(name),
    });
    this.#track = new Track(this.#store, {
      now: () => (this.#source.kind === 'clip' ? this.#source.player.seconds : 0),
      strength: (style) => this.#strengthOf(style),
      onSeek: (seconds) => {
        this.#transport.setPlaying(false);
        this.#seek(seconds);
      },
    });
    this.#track.setStyles(panache.styles);
    find('#clip-controls').append(this.#track.toggle);
    this.#panel = buildPanel(this.#store, panache.styles, {
      onStrength: (name, value) => this.#setStrength(name, value),
      onReset: (name) => {
        const { [name]: _style, ...styles } = this.#store.settings.styles;
        const { [name]: _keys, ...keys } = this.#store.settings.keys;
        this.#store.set({ styles, keys });
      },
      onSave: (name) => this.#saveStyle(name),
      onRemove: (name) => void this.#attempt(() => {
        panache.removeStyle(name);
        this.#stylesChanged();
      }),
    }, this.#learn);
    this.#figures = new Figures(panache, this.#panel.rows);
    buildViewControls({
      onLook: (angle) => this.#look(angle),
      onCompare: (held) => (this.#stage.comparing = held),
      onHelp: () => this.#help.showModal(),
    });
    this.#stage.keepClear = () => {
      const chips = find('#camera').getBoundingClientRect();
      const view = this.#stage.canvas.getBoundingClientRect();
      const above = chips.bottom - view.top;
      return above < view.height / 2 ? above : 0;
    };
    this.#buildWalkerControls();
    this.#buildFileControls();
    listenToDrops((given, target) => {
      const motions = given.filter((file) => !isModel(file));
      // While a style is being learnt, motions are for that.
      if (this.#learn.open && motions.length) this.#learn.take(motions, target);
      else void this.#attempt(() => this.#openAll(given));
    });
    void this.#attempt(async () => {
      const file = await served('open');
      if (file) await this.#openAll([file]);
    });
    this.#use(this.#source);
    this.#store.listen((settings) => this.#apply(settings));
    rememberInAddress(this.#store, () => this.#panache.styles.map(({ name }) => name));
    matchMedia('(prefers-color-scheme: dark)')
      .addEventListener('change', () => {
        forgetColours();
        this.#stage.paint();
        this.#figures.paint();
      });
    addEventListener('keydown', (event) => this.#key(event));
    addEventListener('keyup', (event) => {
      if (event.code === 'KeyX') this.#stage.comparing = false;
    });
    addEventListener('blur', () => (this.#stage.comparing = false));
    // A button that was clicked gives the keys back to the view; one reached by Tab keeps them.
    addEventListener('click', (event) => {
      const button = (event.target as HTMLElement).closest('button');
      if (button && event.detail > 0 && !button.closest('dialog')) button.blur();
    });
    find('#wait').hidden = true;
    requestAnimationFrame((now) => {
      this.#last = now;
      this.#frame(now);
    });
  }

  // ---- One frame ----

  #frame(now: number) {
    requestAnimationFrame((next) => this.#frame(next));
    const seconds = Math.min(0.1, (now - this.#last) / 1000);
    this.#last = now;
    this.#cross.step(seconds);
    this.#advance(seconds);
    this.#figures.step(seconds);
    this.#stage.update(this.#source.player, this.#source.joints, this.#cut, seconds);
    this.#cut = false;
    this.#stage.draw(seconds);
    this.#report();
    ++this.#frames;
  }

  #advance(seconds: number) {
    const source = this.#source;
    if (source.kind === 'walk') {
      const { speed, turn } = this.#steering.wish(seconds);
      source.player.steer(speed, turn);
      source.player.step(seconds);
      this.#seconds += seconds;
      return;
    }
    const { playing, speed } = this.#transport.state;
    if (playing) {
      const before = source.player.seconds;
      // The library takes a tenth of a second at once.
      source.player.step(seconds * speed);
      const [begin, end] = this.#transport.range;
      const { loop } = this.#transport.state;
      const whole = end >= source.file.clips[source.clip]?.seconds;
      if (source.player.seconds < begin || (loop && !whole && source.player.seconds >= end)) {
        this.#seek(begin);
      } else if (!loop && source.player.seconds >= end) {
        this.#transport.setPlaying(false);
      }
      this.#cut ||= source.player.seconds < before;
      this.#seconds += seconds * speed;
    } else {
      source.player.step(0);  // What is pushed is seen when the clip goes on, or is scrubbed.
    }
    this.#transport.at(source.player.seconds);
    this.#track.at(source.player.seconds);
  }

  #report() {
    const player = this.#source.player;
    const { styles, strength } = this.#store.settings;
    const now = { ...styles, ...this.#keyedNow() };
    this.#plots.add({
      time: this.#seconds,
      strengths: Object.entries(now).map(([name, value]) => [name, value * strength]),
      gate: player.gate,
      rate: player.rate,
      contacts: player.contacts,
    });
    if (this.#frames % kMeasureEvery === 0) {
      const begin = performance.now();
      player.measure(kMeasuredSteps);
      this.#plots.addStep(((performance.now() - begin) * 1000) / kMeasuredSteps);
    }
    if (this.#frames % kPlotEvery !== 0) return;
    this.#panel.showNow(Object.fromEntries(
      Object.keys(this.#store.settings.keys).map((name) => [name, this.#strengthOf(name)])));
    this.#plots.draw();
    find('#gate-now').textContent = player.gate.toFixed(2);
    find('#rate-now').textContent = `${player.rate.toFixed(2)}×`;
    find('#step-now').textContent = `median ${Math.round(this.#plots.stepMedian)}`;
  }

  // ---- Settings ----

  #apply(settings: Settings) {
    this.#give(this.#source.player, settings);
    find('#caption').textContent = captionOf(settings, this.#source.kind === 'clip');
    this.#stage.view = settings.view;
    this.#stage.trail = settings.trail;
    this.#stage.onion = settings.onion;
  }

  #give(player: Walk | Playback, settings: Settings) {
    for (const { name } of this.#panache.styles) {
      player.setStrength(name, (settings.styles[name] ?? 0) * settings.strength);
      if (!(player instanceof Playback)) continue;
      player.setTrack(name, (settings.keys[name] ?? [])
        .map(([seconds, value]): Key => [seconds, value * settings.strength]));
    }
    player.setShape(shapeOf(settings));
  }

  /** The strengths that keys give at the play head. */
  #keyedNow(): Record<string, number> {
    if (this.#source.kind !== 'clip') return {};
    const { seconds } = this.#source.player;
    return Object.fromEntries(Object.entries(this.#store.settings.keys)
      .map(([name, keys]) => [name, strengthAt(keys, seconds)]));
  }
  #strengthOf(name: string): number {
    return this.#keyedNow()[name] ?? this.#store.settings.styles[name] ?? 0;
  }
  /** A style that has keys gets one at the play head, which stops for that. */
  #setStrength(name: string, value: number) {
    const keys = this.#store.settings.keys[name];
    if (this.#source.kind !== 'clip' || !keys) return this.#store.setStyle(name, value);
    this.#transport.setPlaying(false);
    this.#store.setKeys(name, withKey(keys, this.#source.player.seconds, value).keys);
  }

  // ---- Models ----

  /** The model has other styles; `changed` is one of the same name that is another now. */
  #stylesChanged(changed = '') {
    const { styles } = this.#panache;
    this.#panel.setStyles(styles, changed);
    this.#figures.show(this.#panel.rows);
    this.#plots.styles = styles.map(({ name }) => name);
    this.#track.setStyles(styles);
    this.#store.keepStyles(this.#plots.styles);
  }

  /** Opens a model, or adds a style to the one that is open. */
  async #openModel(file: File) {
    const bytes = await file.arrayBuffer();
    const known = this.#panache.styles.map(({ name }) => name);
    const isStyle = this.#panache.isStyle(bytes);
    if (isStyle) this.#panache.addStyle(bytes, { name: file.name });
    else this.#panache.setModel(bytes, file.name);
    this.#stylesChanged();
    const added = this.#panache.styles.find(({ name }) => !known.includes(name));
    if (isStyle && added) this.#store.set({ styles: { [added.name]: 1 }, keys: {} });
  }

  #saveStyle(name: string) {
    saveBytes(this.#panache.extractStyle(name) as BlobPart, `${name}.safetensors`);
  }

  /** What is seen, as a motion file. */
  #capture(which: 'input' | 'styled', seconds: number): File {
    const source = this.#source;
    const [extension, title] = source.kind === 'clip'
      ? [source.file.extension, titleOf(source.file.name)]
      : ['.bvh', this.#steering.pace];
    const bytes = source.player.exportAs(extension, { which, seconds });
    return new File([bytes as BlobPart],
      `${which === 'input' ? title : this.#nameOf('')}${extension}`);
  }

  #key(event: KeyboardEvent) {
    const target = event.target as HTMLElement;
    const typing = target.matches('input:not([type=range]), textarea');
    if (event.ctrlKey || event.metaKey) {
      const undo = event.code === 'KeyZ' && !event.shiftKey;
      const redo = event.code === 'KeyY' || (event.code === 'KeyZ' && event.shiftKey);
      if (typing || event.altKey || (!undo && !redo)) return;
      event.preventDefault();
      if (undo) this.#store.undo();
      else this.#store.redo();
      return;
    }
    if (typing || event.altKey || this.#help.open) return;
    if (event.key === '?') return this.#help.showModal();
    // A button or a menu that has the focus takes the space bar.
    if (event.code === 'Space' && target.matches('button, select')) return;
    const action = this.#keys[event.code];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || event.code === 'Comma' || event.code === 'Period') action();
  }

  #keys: Record<string, () => void> = {
    Space: () => {
      if (this.#source.kind === 'clip') this.#transport.setPlaying(!this.#transport.state.playing);
      else this.#setPace(this.#steering.pace === 'idle' ? 'walk' : 'idle');
    },
    Digit0: () => this.#store.set({ styles: {}, keys: {} }),
    Digit1: () => this.#look('front'),
    Digit2: () => this.#look('side'),
    Digit3: () => this.#look('top'),
    Digit4: () => this.#look('orbit'),
    KeyF: () => this.#look('face'),
    KeyX: () => (this.#stage.comparing = true),
    KeyK: () => this.#source.kind === 'clip' && this.#track.add(),
    KeyN: () => this.#store.set({ onion: !this.#store.settings.onion }),
    KeyI: () => this.#source.kind === 'clip' && this.#transport.setIn(),
    KeyO: () => this.#source.kind === 'clip' && this.#transport.setOut(),
    Comma: () => this.#stepFrames(-1),
    Period: () => this.#stepFrames(1),
  };

  #look(angle: Angle) {
    this.#stage.look(angle, this.#source.player);
  }

  // ---- Sources ----

  #use(source: Source) {
    if (this.#source !== source) {
      const old = this.#source;
      if (old.kind === 'clip' && (source.kind !== 'clip' || source.file !== old.file)) {
        old.file.free();
      }
      old.player.free();
    }
    this.#source = source;
    document.body.dataset.source = source.kind;
    find('#walker-controls').hidden = source.kind !== 'walk';
    find('#clip-controls').hidden = source.kind !== 'clip';
    find('#back').hidden = source.kind === 'walk';
    if (source.kind === 'walk') find('#files').hidden = true;
    this.#learn.showSource();
    find('#file-name').textContent = source.kind === 'clip' ? source.file.name : '';
    if (source.kind === 'clip') {
      this.#transport.show(source.file, source.clip);
      this.#transport.setPlaying(true);
      source.player.loop = this.#transport.state.loop;
      const { seconds, frameTime } = source.file.clips[source.clip] ?? { seconds: 0, frameTime: 0 };
      this.#track.setTime(seconds, frameTime);
      if (Object.keys(this.#store.settings.keys).length) this.#track.open(true);
    }
    if (source.kind === 'walk') this.#track.open(false);
    this.#apply(this.#store.settings);
    source.player.step(0);
    this.#stage.show(source.player, source.own);
    this.#plots.clear();
    this.#cut = true;
  }

  #seek(seconds: number) {
    if (this.#source.kind !== 'clip') return;
    this.#source.player.seek(seconds);
    this.#cut = true;
  }

  #stepFrames(frames: number) {
    if (this.#source.kind !== 'clip') return;
    const { file, clip, player } = this.#source;
    const { frameTime, seconds } = file.clips[clip] ?? { frameTime: 0, seconds: 0 };
    this.#transport.setPlaying(false);
    if (frameTime <= 0) return;
    const at = Math.round(player.seconds / frameTime) + frames;
    this.#seek(Math.min(seconds, Math.max(0, at * frameTime)));
  }

  /** Takes models and styles, opens the first of the other files, and lists them where there are
   * several. */
  async #openAll(given: File[]) {
    for (const file of given.filter(isModel)) await this.#openModel(file);
    const files = given.filter((file) => !isModel(file));
    if (files.length === 0) return;
    const list = await putTogether(this.#panache, files);
    await this.#open(list[0]);
    this.#files = list;
    const menu = find<HTMLSelectElement>('#files');
    menu.replaceChildren(...list.map(({ name }, i) => element('option', { value: i }, name)));
    menu.hidden = list.length < 2;
  }

  /** Plays a motion of a file, the first of a body where none is asked for. */
  async #open(file: File, clip?: number, fps?: number) {
    const opened = await openFile(this.#panache, file, fps);
    let source: Source;
    try {
      source = await clipSource(opened.file, opened.bytes, clip ?? firstMotion(opened.file));
    } catch (error) {
      opened.file.free();
      throw error;
    }
    this.#file = file;
    this.#bytes = opened.bytes;
    this.#use(source);
    if (opened.file.notes.length > 0) this.#alert(opened.file.notes.join('\n'));
  }

  async #playClip(clip: number) {
    if (this.#source.kind !== 'clip') return;
    this.#use(await clipSource(this.#source.file, this.#bytes, clip));
  }

  /** Reads the file that is open as if it had so many frames a second; 0: at its own rate. */
  async #setRate(fps: number) {
    const source = this.#source;
    if (source.kind !== 'clip' || !this.#file) return;
    this.#transport.showRate(source.file, source.clip);  // What stays, if that fails.
    await this.#open(this.#file, source.clip, fps);
  }

  /** Tells of what is wrong with a file; everything else is a fault of ours. */
  async #attempt(action: () => Promise<void> | void) {
    try {
      this.#alert('');
      await action();
    } catch (error) {
      if (!(error instanceof PanacheError)) throw error;
      this.#alert(error.message);
    }
  }

  #alert(text: string) {
    const alert = find('#alert');
    alert.textContent = text;
    alert.hidden = text === '';
    clearTimeout(this.#alertTimer);
    this.#alertTimer = window.setTimeout(() => (alert.hidden = true), kAlertSeconds * 1000);
  }

  /** "walk-old.bvh": the source, the styles, the extension. */
  #nameOf(extension: string, of?: string): string {
    const { styles, keys, strength } = this.#store.settings;
    const source = of ?? (this.#source.kind === 'clip'
      ? titleOf(this.#source.file.name) : this.#steering.pace);
    const named = Object.keys(styles).filter((name) => styles[name] * strength !== 0);
    if (this.#source.kind === 'clip') {
      named.push(...Object.keys(keys).filter((name) => !named.includes(name)));
    }
    return `${[source, ...(named.length ? named : ['neutral'])].join('-')}${extension}`;
  }

  // ---- Controls under the view ----

  #setPace(pace: Pace) {
    this.#steering.setPace(pace);
    for (const button of document.querySelectorAll<HTMLElement>('[data-pace]')) {
      button.setAttribute('aria-pressed', String(button.dataset.pace === pace));
    }
  }

  #buildWalkerControls() {
    const buttons = (Object.keys(kPaces) as Pace[]).map((pace) => {
      const title = pace[0].toUpperCase() + pace.slice(1);
      return button(title, () => this.#setPace(pace), { 'data-pace': pace });
    });
    const keys = element('span', { class: 'keys' });
    for (const key of ['W', 'A', 'S', 'D']) keys.append(element('kbd', {}, key), ' ');
    keys.append('steer');
    find('#walker-controls').append(...buttons, keys);
    this.#setPace('walk');
  }

  #buildFileControls() {
    const input = find<HTMLInputElement>('#file');
    const act = (id: string, text: string, title: string, press: () => void | Promise<void>) =>
      button(text, () => void this.#attempt(press), { id, title });
    input.addEventListener('change', () => {
      const files = [...(input.files ?? [])];
      input.value = '';
      void this.#attempt(() => this.#openAll(files));
    });
    const save = (extension: string) => () => {
      saveBytes(this.#source.player.exportAs(extension) as BlobPart, this.#nameOf(extension));
    };
    const menu = element('select', { id: 'files', 'aria-label': 'Opened files', hidden: true });
    menu.addEventListener('change', () =>
      void this.#attempt(() => this.#open(this.#files[Number(menu.value)])));
    const link = act('copy-link', 'Copy link', 'A link to this page with these settings',
      async () => {
        await navigator.clipboard.writeText(this.#link());
        link.textContent = 'Copied';
        setTimeout(() => (link.textContent = 'Copy link'), 1500);
      });
    link.hidden = !navigator.clipboard;
    find('#file-controls').append(menu,
      act('back', 'Walker', 'Close the file and steer the walker again',
        () => this.#use(walkSource(this.#panache))),
      act('open', 'Open …',
        'BVH, GLB, glTF, VRM or VRMA files, a model or a style; or drop them on the view',
        () => input.click()),
      element('span', { class: 'word' }, 'Save'),
      act('save-bvh', 'BVH', 'The motion, as a BVH file', save('.bvh')),
      act('save-glb', 'GLB', 'The motion, as a GLB file', save('.glb')),
      act('save-vrma', 'VRMA', 'The motion, as a VRM animation', save('.vrma')),
      act('save-zip', 'Zip', 'All opened files, each as BVH, GLB and VRMA, in one zip',
        () => this.#saveAll()),
      ...buildViewSaving({
        stage: this.#stage,
        nameOf: (extension) => this.#nameOf(extension),
        motion: () => this.#loopMotion(),
        attempt: (action) => this.#attempt(action),
      }), link);
  }

  /** What is seen now, as a motion that can be gone through again, beside what is seen. */
  #loopMotion(): LoopMotion {
    const { settings } = this.#store;
    const source = this.#source;
    if (source.kind === 'walk') {
      return walkLoop(this.#panache, this.#steering.pace, (player) => this.#give(player, settings));
    }
    const { isPart, range } = this.#transport;
    const keyed = Object.keys(settings.keys).length > 0;
    return clipLoop(source, this.#bytes, range,
      (player) => this.#give(player, settings), !isPart && !keyed);
  }

  /** Everything that is listed, styled as is set now, in all formats. */
  async #saveAll() {
    const out: Exports = {};
    const nameOf = (source: string) => this.#nameOf('', source);
    const source = this.#source;
    if (source.kind === 'walk') addMotion(out, source.player, nameOf(this.#steering.pace));
    const files = source.kind === 'clip' ? this.#files : [];
    const failed = await addFiles(out, this.#panache, files,
      (player) => this.#give(player, this.#store.settings), nameOf);
    if (Object.keys(out).length) {
      const all = files.length > 1 ? `${files.length} motions` : titleOf(Object.keys(out)[0]);
      saveBytes((await late('zip')).zipFiles(out) as BlobPart, `${all}.zip`, 'application/zip');
    }
    if (failed.length) throw new PanacheError(failed.join('\n'));
  }

  #link(): string {
    return location.href.replace(/#.*$/, '') + `#${toAddress(this.#store.settings)}`;
  }

  /** For tests: what is going on. */
  get panache() {
    return this.#panache;
  }
  get stage() {
    return this.#stage;
  }
  get settings() {
    return this.#store.settings;
  }
  set(patch: Partial<Settings>) {
    this.#store.set(patch);
  }
  get source() {
    return this.#source;
  }
  get frames() {
    return this.#frames;
  }
}

/** The model that `panache view --model` serves beside the page, else the page's own. */
async function findModel(): Promise<ArrayBuffer> {
  return await (await served('model'))?.arrayBuffer() ?? unpack(files.model);
}

async function start() {
  try {
    const [wasm, model, walker] = await Promise.all(
      [unpack(files.wasm), findModel(), unpack(files.walker)]);
    const panache = await Panache.create({ wasm, model, walker });
    Object.assign(window, { page: new Page(panache) });
  } catch (error) {
    find('#wait').textContent = `This browser cannot show the page: ${(error as Error).message}`;
    throw error;
  }
}

void start();
