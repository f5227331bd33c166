// The page: creates everything and runs it frame by frame.

import { Panache } from '../package/index.js';
import { attempt, say } from './alerts';
import type { Angle } from './camera';
import { find, forgetColours } from './dom';
import { listenToDrops } from './drops';
import { Crowd } from './crowd';
import { Exporter } from './exporter';
import { Figures } from './figures';
import { Cross } from './gamepad';
import { buildHelp } from './help';
import { withKey } from './keys';
import { Learn } from './learn';
import { buildPanel, captionOf } from './panel';
import { Plots } from './plots';
import { kRemovable, Removal } from './removal';
import { served } from './served';
import { fromAddress, rememberInAddress, Store, type Settings, type View } from './settings';
import { listenToKeys } from './shortcuts';
import {
  clipSource, firstMotion, isModel, openMoving, putTogether, walkSource, type Source,
} from './source';
import { Stage } from './stage';
import { Steering, type Pace, type Wish } from './steering';
import { applySettings, keyedNow, triggerAny } from './styling';
import { buildFileControls, buildWalkerControls, listFiles, showPace } from './toolbar';
import { Track } from './track';
import { TransportBar } from './transport';
import { buildViewControls } from './view_controls';

const kBelowChips = 14;  // Pixels between the buttons in the view and a head.

export class Page {
  readonly store: Store;
  readonly stage = new Stage(find<HTMLCanvasElement>('#view'));
  #plots: Plots;
  readonly exporter: Exporter;
  readonly steering = new Steering(find('#stick'));
  #cross = new Cross();
  readonly transport: TransportBar;
  #figures: Figures;
  #panel: ReturnType<typeof buildPanel>;
  readonly removal: Removal;
  readonly learn: Learn;
  #track: Track;
  readonly crowd: Crowd;
  readonly help = buildHelp();
  source: Source;
  frames = 0;
  files: File[] = [];  // Opened together.
  #file: File | null = null;    // The open one.
  bytes = new ArrayBuffer(0);  // Content of the open file.
  #cut = true;
  #last = 0;
  #seconds = 0;
  #passed = 0;  // Seconds in the last frame.
  #wish: Wish = { speed: 0, turn: 0 };

  /** Whether the model has arrived: until then the walker walks without styles. */
  ready = false;
  #loaded: Promise<void>;

  constructor(readonly panache: Panache, model: Promise<ArrayBuffer>) {
    this.store = new Store(this.#readAddress());
    this.removal = new Removal(panache, this.store);
    this.#plots = new Plots(find('#plots'), panache.styles.map(({ name }) => name));
    this.exporter = new Exporter(this);
    this.transport = new TransportBar(this);
    this.source = walkSource(panache);
    this.learn = new Learn(this);
    this.#track = new Track(this);
    this.#track.setStyles(panache.styles);
    find('.clip-row').append(this.#track.toggle);
    this.#panel = buildPanel(this);
    this.#figures = new Figures(panache);
    this.crowd = new Crowd(panache);
    this.stage.gather(this.crowd);
    buildViewControls(this);
    this.stage.keepClear = () => {
      const chips = find('#camera').getBoundingClientRect();
      const view = this.stage.canvas.getBoundingClientRect();
      const above = chips.bottom - view.top + kBelowChips;
      return above < view.height / 2 ? above : 0;
    };
    buildWalkerControls((pace) => this.#setPace(pace));
    this.#setPace('walk');
    buildFileControls(this);
    listenToDrops((given, target) => {
      const motions = given.filter((file) => !isModel(file));
      // While the learning form is open, it takes the motions.
      if (this.learn.open && motions.length) this.learn.take(motions, target);
      else void attempt(() => this.openAll(given));
    });
    this.use(this.source);
    this.store.listen((settings) => this.#apply(settings));
    this.#loaded = model.then((bytes) => this.#begin(bytes));
    this.#loaded.catch((error: Error) => (find('#styles-wait').textContent = error.message));
    void attempt(async () => {
      if (!await this.#loaded.then(() => true, () => false)) return;
      const file = await served('open');
      if (file) await this.openAll([file]);
    });
    matchMedia('(prefers-color-scheme: dark)')
      .addEventListener('change', () => {
        forgetColours();
        this.stage.paint();
        this.#figures.paint();
      });
    this.#listenToKeys();
    // A clicked button gives the keyboard focus back to the view; one reached by Tab keeps it.
    addEventListener('click', (event) => {
      const button = (event.target as HTMLElement).closest('button');
      const keeps = button?.closest('dialog, .play');  // Arrow keys go on from a style.
      if (button && event.detail > 0 && !keeps) button.blur();
    });
    find('#wait').hidden = true;
    requestAnimationFrame((now) => {
      this.#last = now;
      this.#frame(now);
    });
  }

  /** Shows the styles of the page's first model, with the strengths of the address. */
  #begin(bytes: ArrayBuffer) {
    this.panache.setModel(bytes);
    this.stylesChanged();
    const { styles, keys, sides } = this.#readAddress();
    this.store.begin({ styles, keys, sides });
    rememberInAddress(this.store, () => this.#readAddress());
    this.#panel.showStyles();
    this.ready = true;
  }

  // ---- One frame ----

  #frame(now: number) {
    requestAnimationFrame((next) => this.#frame(next));
    const seconds = Math.min(0.1, (now - this.#last) / 1000);
    this.#last = now;
    this.#cross.step(seconds);
    this.#advance(seconds);
    this.#figures.step(seconds);
    if (this.store.settings.view === 'crowd') {
      this.crowd.step(this.source, this.stage.styledLook, this.#passed, this.#wish);
    }
    this.stage.update(this.source, this.#cut, seconds);
    this.#cut = false;
    this.stage.draw(seconds);
    this.#report();
    ++this.frames;
  }

  #advance(seconds: number) {
    const source = this.source;
    if (source.kind === 'walk') {
      this.#wish = this.steering.wish(seconds);
      source.player.steer(this.#wish.speed, this.#wish.turn);
      source.player.step(seconds);
      this.#passed = seconds;
      this.#seconds += seconds;
      return;
    }
    const { passed, cut } = this.transport.play(source, seconds);
    this.#passed = passed;
    this.#seconds += passed;
    this.#cut ||= cut;
    this.#track.at(source.player.seconds);
  }

  #report() {
    const { settings } = this.store;
    const now = Object.entries({ ...settings.styles, ...keyedNow(this.source, settings) });
    const drawn = this.#plots.follow(this.source.player, this.#seconds,
      now.map(([name, value]) => [name, value * settings.strength]));
    if (drawn) this.#panel.active.showNow();
  }

  // ---- Settings ----

  #readAddress(): Settings {
    return fromAddress(location.hash, this.panache.styles.map(({ name }) => name), kRemovable);
  }
  #apply(settings: Settings) {
    const { remover } = this.removal;
    applySettings(this.panache, this.source.player, settings, remover);
    if (settings.removed && !remover) {
      void attempt(async () => {
        await this.removal.load();
        this.#apply(this.store.settings);
      });
    }
    find('#caption').textContent = captionOf(settings, this.source.kind === 'clip');
    this.#setView(settings.view);
    if (settings.view === 'crowd') this.crowd.apply(settings, remover);
    this.stage.trail = settings.trail;
    this.stage.onion = settings.onion;
  }

  #setView(view: View) {
    const [before] = [this.stage.view, (this.stage.view = view)];
    if ((before === 'crowd') === (view === 'crowd')) return;
    if (before === 'crowd') this.crowd.clear();
    this.look('face');
  }

  isActive(name: string): boolean {
    const { styles, keys } = this.store.settings;
    return (styles[name] ?? 0) !== 0 || name in keys;
  }
  /** Plays a style alone, as captured. If it does so already, takes it off unless `keep`. */
  playStyle(name: string, keep = false) {
    const { styles, keys } = this.store.settings;
    const alone = styles[name] === 1 && Object.keys({ ...styles, ...keys }).length === 1;
    if (!alone) this.store.set({ styles: { [name]: 1 }, keys: {}, sides: {} });
    else if (!keep) this.store.set({ styles: {}, sides: {} });
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
    this.transport.setPlaying(false);
    this.store.setKeys(name, withKey(keys, this.source.player.seconds, value).keys);
  }

  // ---- Models ----

  /** Call it when the model's styles change; `changed` is a style replaced under the same name. */
  stylesChanged(changed = '') {
    const { styles } = this.panache;
    this.#panel.setStyles(styles, changed);
    this.#figures.show(this.#panel.cards.buttons);
    this.#plots.styles = styles.map(({ name }) => name);
    this.#track.setStyles(styles);
    this.store.keepStyles(this.#plots.styles);
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
    if (isStyle && added) this.store.set({ styles: { [added.name]: 1 }, keys: {}, sides: {} });
  }

  #listenToKeys() {
    const ofClip = (action: () => void) => () => this.source.kind === 'clip' && action();
    listenToKeys(this, {
      Space: () => {
        const isClip = this.source.kind === 'clip';
        if (isClip) this.transport.setPlaying(!this.transport.state.playing);
        else this.#setPace(this.steering.pace === 'idle' ? 'walk' : 'idle');
      },
      Digit0: () => this.store.set({ styles: {}, keys: {}, sides: {} }),
      Digit1: () => this.look('front'),
      Digit2: () => this.look('side'),
      Digit3: () => this.look('top'),
      Digit4: () => this.look('orbit'),
      KeyF: () => this.look('face'),
      KeyG: () => triggerAny(this.panache, this.source, this.store.settings),
      KeyK: ofClip(() => this.#track.add()),
      KeyN: () => this.store.set({ onion: !this.store.settings.onion }),
      KeyI: ofClip(() => this.transport.setIn()),
      KeyO: ofClip(() => this.transport.setOut()),
      Comma: () => this.stepFrames(-1),
      Period: () => this.stepFrames(1),
    });
  }

  look(angle: Angle) {
    this.stage.look(angle, this.source.player);
  }

  // ---- Sources ----

  /** Shows a source, and frees the one before. */
  use(source: Source) {
    if (this.source !== source) {
      const old = this.source;
      if (old.kind === 'clip' && (source.kind !== 'clip' || source.file !== old.file)) {
        old.file.free();
      }
      this.crowd.clear();
      old.player.free();
    }
    this.source = source;
    document.body.dataset.source = source.kind;
    find('#walker-controls').hidden = source.kind !== 'walk';
    find('#clip-controls').hidden = source.kind !== 'clip';
    find('#back').hidden = source.kind === 'walk';
    this.learn.showSource();
    find('#file-name').textContent = source.kind === 'clip' ? source.file.name : '';
    if (source.kind === 'clip') {
      this.transport.show(source);
      this.transport.setPlaying(true);
      source.player.loop = this.transport.state.loop;
      const { seconds, frameTime } = source.file.clips[source.clip] ?? { seconds: 0, frameTime: 0 };
      this.#track.setTime(seconds, frameTime);
      if (Object.keys(this.store.settings.keys).length) this.#track.open(true);
    } else {
      find('#files').hidden = true;
      this.#track.open(false);
    }
    this.#apply(this.store.settings);
    void attempt(() => this.removal.look(source, () => this.source === source));
    source.player.step(0);
    this.stage.show(source);
    this.#plots.clear();
    this.#cut = true;
  }

  /** Only for clips, like stepFrames(). */
  seek(seconds: number) {
    if (this.source.kind !== 'clip') return;
    this.source.player.seek(seconds);
    this.#cut = true;
  }

  stepFrames(frames: number) {
    if (this.source.kind !== 'clip') return;
    const { file, clip, player } = this.source;
    const { frameTime, seconds } = file.clips[clip] ?? { frameTime: 0, seconds: 0 };
    this.transport.setPlaying(false);
    if (frameTime <= 0) return;
    const at = Math.round(player.seconds / frameTime) + frames;
    this.seek(Math.min(seconds, Math.max(0, at * frameTime)));
  }

  /** Loads models and styles, opens the first of the other files, and lists them if there are
   * several. */
  async openAll(given: File[]) {
    await this.#loaded;
    for (const file of given.filter(isModel)) await this.#openModel(file);
    const files = given.filter((file) => !isModel(file));
    if (files.length === 0) return;
    const list = await putTogether(this.panache, files);
    await this.open(list[0]);
    this.files = list;
    listFiles(list);
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
    const source = this.source;
    if (source.kind !== 'clip' || !this.#file) return;
    this.transport.showRate(source.file, source.clip);  // Kept if opening fails.
    await this.open(this.#file, source.clip, fps);
  }

  // ---- Controls under the view ----

  #setPace(pace: Pace) {
    this.steering.setPace(pace);
    showPace(pace);
  }
}
