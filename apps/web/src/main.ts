// The page: makes everything and runs it, one frame after the other.

import * as files from 'virtual:panache-files';

import { Panache, PanacheError } from '../package/index.js';
import { kAngles, type Angle } from './camera';
import { element, find } from './dom';
import { Figures } from './figures';
import { Cross } from './gamepad';
import { buildHelp } from './help';
import { buildPanel } from './panel';
import { Plots } from './plots';
import { Film, saveBytes, savePicture } from './saving';
import { fromAddress, shapeOf, Store, toAddress, type Settings } from './settings';
import { clipSource, openFile, putTogether, walkSource, type Source } from './source';
import { Stage } from './stage';
import { kPaces, Steering, type Pace } from './steering';
import { TransportBar } from './transport';

const kMeasuredSteps = 16;   // At once: a browser's clock is too coarse for one.
const kMeasureEvery = 6;     // Frames.
const kPlotEvery = 3;        // Frames.
const kAlertSeconds = 12;

/** What the build packed into the script. */
async function unpack(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const packed = new Blob([bytes]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

class Page {
  #panache: Panache;
  #store: Store;
  #stage = new Stage(find<HTMLCanvasElement>('#view'));
  #plots: Plots;
  #steering = new Steering(find('#stick'));
  #cross = new Cross();
  #transport: TransportBar;
  #figures: Figures;
  #help = buildHelp();
  #film = new Film(this.#stage.canvas);
  #source: Source;
  #files: File[] = [];  // That were opened together.
  #bytes = new ArrayBuffer(0);  // Of the file that is open.
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
      onLoop: (loop) => this.#source.kind === 'clip' && (this.#source.player.loop = loop),
      onStep: (frames) => this.#stepFrames(frames),
    });
    this.#source = walkSource(panache);
    this.#figures = new Figures(panache, buildPanel(this.#store, panache.styles));
    this.#buildViewControls();
    this.#buildWalkerControls();
    this.#buildFileControls();
    this.#listenToDrops();
    this.#use(this.#source);
    this.#store.listen((settings) => this.#apply(settings));
    this.#rememberInAddress();
    matchMedia('(prefers-color-scheme: dark)')
      .addEventListener('change', () => {
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
  }

  #report() {
    const player = this.#source.player;
    const { styles, strength } = this.#store.settings;
    this.#plots.add({
      time: this.#seconds,
      strengths: Object.entries(styles).map(([name, value]) => [name, value * strength]),
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
    this.#plots.draw();
    find('#gate-now').textContent = player.gate.toFixed(2);
    find('#rate-now').textContent = `${player.rate.toFixed(2)}×`;
    find('#step-now').textContent = `median ${Math.round(this.#plots.stepMedian)}`;
  }

  // ---- Settings ----

  #apply(settings: Settings) {
    const player = this.#source.player;
    for (const { name } of this.#panache.styles) {
      player.setStrength(name, (settings.styles[name] ?? 0) * settings.strength);
    }
    player.setShape(shapeOf(settings));
    this.#stage.view = settings.view;
    this.#stage.trail = settings.trail;
    this.#stage.onion = settings.onion;
  }

  #rememberInAddress() {
    let timer = 0;
    this.#store.listen((settings) => {
      clearTimeout(timer);
      timer = window.setTimeout(() => {
        const text = toAddress(settings);
        if (text === location.hash.replace(/^#/, '')) return;
        history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
      }, 200);
    });
    addEventListener('hashchange', () => {
      this.#store.set(fromAddress(location.hash, this.#panache.styles.map((s) => s.name)));
    });
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
    Digit0: () => this.#store.set({ styles: {} }),
    Digit1: () => this.#look('front'),
    Digit2: () => this.#look('side'),
    Digit3: () => this.#look('top'),
    Digit4: () => this.#look('orbit'),
    KeyF: () => this.#look('face'),
    KeyX: () => (this.#stage.comparing = true),
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
    find('#file-name').textContent = source.kind === 'clip' ? source.file.name : '';
    if (source.kind === 'clip') {
      this.#transport.show(source.file, source.clip);
      this.#transport.setPlaying(true);
      source.player.loop = this.#transport.state.loop;
    }
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

  /** Opens the first of some files, and lists them where there are several. */
  async #openAll(files: File[]) {
    if (files.length === 0) return;
    const list = await putTogether(this.#panache, files);
    await this.#open(list[0]);
    this.#files = list;
    const menu = find<HTMLSelectElement>('#files');
    menu.replaceChildren(...list.map(({ name }, i) => element('option', { value: i }, name)));
    menu.hidden = list.length < 2;
  }

  async #open(file: File) {
    const opened = await openFile(this.#panache, file);
    let source: Source;
    try {
      source = await clipSource(opened.file, opened.bytes, 0);
    } catch (error) {
      opened.file.free();
      throw error;
    }
    this.#bytes = opened.bytes;
    this.#use(source);
  }

  async #playClip(clip: number) {
    if (this.#source.kind !== 'clip') return;
    this.#use(await clipSource(this.#source.file, this.#bytes, clip));
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
  #nameOf(extension: string): string {
    const { styles, strength } = this.#store.settings;
    const source = this.#source.kind === 'clip'
      ? this.#source.file.name.replace(/\.[^.]*$/, '') : this.#steering.pace;
    const named = Object.keys(styles).filter((name) => styles[name] * strength !== 0);
    return `${[source, ...(named.length ? named : ['neutral'])].join('-')}${extension}`;
  }

  // ---- Controls under the view ----

  #setPace(pace: Pace) {
    this.#steering.setPace(pace);
    for (const button of document.querySelectorAll<HTMLElement>('[data-pace]')) {
      button.setAttribute('aria-pressed', String(button.dataset.pace === pace));
    }
  }

  #buildViewControls() {
    const button = (id: string, text: string, hint: string, press: () => void) => {
      const out = element('button', { type: 'button', id, title: hint, 'aria-label': hint }, text);
      out.addEventListener('click', press);
      return out;
    };
    const names = { face: 'Camera', front: 'Front', side: 'Side', top: 'Top', orbit: 'Orbit' };
    const menu = element('select', { id: 'angle', 'aria-label': 'Camera', title: 'Camera (1 to 4)' },
      ...kAngles.map((angle) => element('option', { value: angle }, names[angle])));
    menu.addEventListener('change', () => {
      this.#look(menu.value as Angle);
      menu.blur();
    });
    const compare = button('compare', 'Hold: input', 'Hold to see the input alone (X)', () => {});
    compare.addEventListener('pointerdown', () => (this.#stage.comparing = true));
    for (const end of ['pointerup', 'pointerleave', 'pointercancel']) {
      compare.addEventListener(end, () => (this.#stage.comparing = false));
    }
    const whole = button('fullscreen', 'Full screen', 'The view alone, on the whole screen', () => {
      if (document.fullscreenElement) void document.exitFullscreen();
      else void find('.stage').requestFullscreen();
    });
    whole.hidden = !document.fullscreenEnabled;
    const more = find('#more');
    more.addEventListener('click', () => {
      const open = find('#plots').classList.toggle('open');
      more.setAttribute('aria-pressed', String(open));
    });
    find('#camera').append(menu,
      button('fit', 'Fit', 'Face the character and fit it in (F)', () => {
        menu.value = 'face';
        this.#look('face');
      }),
      compare, whole, button('show-help', '?', 'Help: keys and more', () => this.#help.showModal()));
  }

  #buildWalkerControls() {
    const buttons = (Object.keys(kPaces) as Pace[]).map((pace) => {
      const button = element('button', { type: 'button', 'data-pace': pace },
        pace[0].toUpperCase() + pace.slice(1));
      button.addEventListener('click', () => this.#setPace(pace));
      return button;
    });
    const keys = element('span', { class: 'keys' });
    for (const key of ['W', 'A', 'S', 'D']) keys.append(element('kbd', {}, key), ' ');
    keys.append('steer');
    find('#walker-controls').append(...buttons, keys);
    this.#setPace('walk');
  }

  #buildFileControls() {
    const input = find<HTMLInputElement>('#file');
    const button = (id: string, text: string, hint: string, press: () => void | Promise<void>) => {
      const out = element('button', { type: 'button', id, title: hint }, text);
      out.addEventListener('click', () => void this.#attempt(press));
      return out;
    };
    const film = button('save-webm', 'WebM', 'Record a video of the view; press again to stop', () => {
      if (this.#film.running) this.#film.stop();
      else this.#film.start(this.#nameOf('.webm'));
      film.setAttribute('aria-pressed', String(this.#film.running));
      film.textContent = this.#film.running ? 'Stop recording' : 'WebM';
    });
    film.hidden = !Film.possible;
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
    const link = button('copy-link', 'Copy link', 'A link to this page with these settings',
      async () => {
        await navigator.clipboard.writeText(this.#link());
        link.textContent = 'Copied';
        setTimeout(() => (link.textContent = 'Copy link'), 1500);
      });
    link.hidden = !navigator.clipboard;
    find('#file-controls').append(menu,
      button('back', 'Walker', 'Close the file and steer the walker again',
        () => this.#use(walkSource(this.#panache))),
      button('open', 'Open …', 'BVH, GLB, glTF, VRM or VRMA files; or drop them on the view',
        () => input.click()),
      element('span', { class: 'word' }, 'Save'),
      button('save-bvh', 'BVH', 'The motion, as a BVH file', save('.bvh')),
      button('save-glb', 'GLB', 'The motion, as a GLB file', save('.glb')),
      button('save-png', 'PNG', 'Save the view as a picture',
        () => {
        this.#stage.draw(0);  // What was drawn before is gone once it was shown.
        savePicture(this.#stage.canvas, this.#nameOf('.png'));
      }),
      film, link);
  }

  #link(): string {
    return location.href.replace(/#.*$/, '') + `#${toAddress(this.#store.settings)}`;
  }

  #listenToDrops() {
    const drop = find('#drop');
    let depth = 0;
    addEventListener('dragenter', (event) => {
      event.preventDefault();
      drop.hidden = ++depth === 0;
    });
    addEventListener('dragleave', () => (drop.hidden = --depth <= 0));
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      depth = 0;
      drop.hidden = true;
      const files = [...(event.dataTransfer?.files ?? [])];
      void this.#attempt(() => this.#openAll(files));
    });
    // `panache view FILE` names a file that it serves beside the page.
    const served = new URLSearchParams(location.search).get('open');
    if (served) {
      void this.#attempt(async () => {
        const answer = await fetch(`open/${encodeURIComponent(served)}`);
        if (!answer.ok) throw new PanacheError(`${served}: the server has no such file`);
        await this.#openAll([new File([await answer.blob()], served)]);
      });
    }
  }

  /** For tests: what is going on. */
  get panache() {
    return this.#panache;
  }
  get stage() {
    return this.#stage;
  }
  get source() {
    return this.#source;
  }
  get frames() {
    return this.#frames;
  }
  get stepMicroseconds() {
    return this.#plots.stepMedian;
  }
}

async function start() {
  try {
    const [wasm, model, walker] = await Promise.all(
      [files.wasm, files.model, files.walker].map(unpack));
    const panache = await Panache.create({ wasm, model, walker });
    Object.assign(window, { page: new Page(panache) });
  } catch (error) {
    find('#wait').textContent = `This browser cannot show the page: ${(error as Error).message}`;
    throw error;
  }
}

void start();
