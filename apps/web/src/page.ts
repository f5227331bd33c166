// The page: creates everything and runs it frame by frame.

import { Panache } from '../package/index.js';
import { attempt } from './alerts';
import type { Angle } from './camera';
import { find, forgetColours } from './dom';
import { listenToDrops } from './drops';
import { Crowd } from './crowd';
import { Exporter } from './exporter';
import { Figures } from './figures';
import { Cross } from './gamepad';
import { buildHelp } from './help';
import { Learn } from './learn';
import { buildPanel, captionOf } from './panel';
import { Plots } from './plots';
import { served } from './served';
import { Session } from './session';
import { rememberInAddress, type Settings, type View } from './settings';
import { listenToKeys } from './shortcuts';
import { isModel } from './source';
import { Stage } from './stage';
import type { Pace, Wish } from './steering';
import { applySettings, keyedNow, triggerAny } from './styling';
import { buildFileControls, buildWalkerControls, showPace } from './toolbar';
import { Track } from './track';
import { TransportBar } from './transport';
import { buildViewControls } from './view_controls';

const kBelowChips = 14;  // Pixels between the buttons in the view and a head.

export class Page {
  readonly session: Session;
  readonly stage = new Stage(find<HTMLCanvasElement>('#view'));
  #plots: Plots;
  #cross = new Cross();
  #transport: TransportBar;
  #figures: Figures;
  #panel: ReturnType<typeof buildPanel>;
  #learn: Learn;
  #track: Track;
  readonly crowd: Crowd;
  #help = buildHelp();
  frames = 0;
  #last = 0;
  #seconds = 0;
  #passed = 0;  // Seconds in the last frame.
  #wish: Wish = { speed: 0, turn: 0 };

  /** Whether the model has arrived: until then the walker walks without styles. */
  ready = false;

  constructor(readonly panache: Panache, model: Promise<ArrayBuffer>) {
    const session = this.session = new Session(panache);
    this.#plots = new Plots(find('#plots'), panache.styles.map(({ name }) => name));
    this.#transport = new TransportBar(session);
    const exporter = new Exporter(session, this.#transport);
    this.#learn = new Learn(session, exporter);
    this.#track = new Track(session);
    find('.clip-row').append(this.#track.toggle);
    this.#panel = buildPanel(session, exporter, this.#learn);
    this.#figures = new Figures(panache);
    this.crowd = new Crowd(panache);
    this.stage.gather(this.crowd);
    buildViewControls(this.stage, (angle) => this.look(angle), this.#help);
    this.stage.keepClear = () => {
      const chips = find('#camera').getBoundingClientRect();
      const view = this.stage.canvas.getBoundingClientRect();
      const above = chips.bottom - view.top + kBelowChips;
      return above < view.height / 2 ? above : 0;
    };
    buildWalkerControls((pace) => this.#setPace(pace));
    this.#setPace('walk');
    buildFileControls(session, this.stage, exporter);
    listenToDrops((given, target) => {
      const motions = given.filter((file) => !isModel(file));
      // While the learning form is open, it takes the motions.
      if (this.#learn.open && motions.length) this.#learn.take(motions, target);
      else void attempt(() => session.openAll(given));
    });
    session.listen('source', () => this.#showSource());
    session.listen('styles', () => this.#showStyles());
    this.store.listen((settings) => this.#apply(settings));
    session.loaded = model.then((bytes) => this.#begin(bytes));
    session.loaded.catch((error: Error) => (find('#styles-wait').textContent = error.message));
    void attempt(async () => {
      if (!await session.loaded.then(() => true, () => false)) return;
      const file = await served('open');
      if (file) await session.openAll([file]);
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
  get store() { return this.session.store; }
  get source() { return this.session.source; }
  get removal() { return this.session.removal; }

  /** Shows the styles of the page's first model, with the strengths of the address. */
  #begin(bytes: ArrayBuffer) {
    const { session } = this;
    this.panache.setModel(bytes);
    session.stylesChanged();
    const { styles, keys, sides } = session.readAddress();
    this.store.begin({ styles, keys, sides });
    rememberInAddress(this.store, () => session.readAddress());
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
    this.stage.update(this.source, this.session.cut, seconds);
    this.session.cut = false;
    this.stage.draw(seconds);
    this.#report();
    ++this.frames;
  }

  #advance(seconds: number) {
    const source = this.source;
    if (source.kind === 'walk') {
      this.#wish = this.session.steering.wish(seconds);
      source.player.steer(this.#wish.speed, this.#wish.turn);
      source.player.step(seconds);
      this.#passed = seconds;
      this.#seconds += seconds;
      return;
    }
    const { passed, cut } = this.#transport.play(source, seconds);
    this.#passed = passed;
    this.#seconds += passed;
    this.session.cut ||= cut;
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

  #showStyles() {
    const { styles } = this.panache;
    this.#panel.setStyles(styles, this.session.changed);
    this.#figures.show(this.#panel.cards.buttons);
    this.#plots.styles = styles.map(({ name }) => name);
    this.#track.setStyles(styles);
  }

  #listenToKeys() {
    const { session, session: { steering } } = this;
    const ofClip = (action: () => void) => () => this.source.kind === 'clip' && action();
    listenToKeys(this.store, this.stage, this.#help, {
      Space: () => {
        const isClip = this.source.kind === 'clip';
        if (isClip) this.#transport.setPlaying(!this.#transport.state.playing);
        else this.#setPace(steering.pace === 'idle' ? 'walk' : 'idle');
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
      KeyI: ofClip(() => this.#transport.setIn()),
      KeyO: ofClip(() => this.#transport.setOut()),
      Comma: () => session.stepFrames(-1),
      Period: () => session.stepFrames(1),
    });
  }

  look(angle: Angle) {
    this.stage.look(angle, this.source.player);
  }

  #showSource() {
    const { source } = this;
    this.crowd.clear();
    document.body.dataset.source = source.kind;
    find('#walker-controls').hidden = source.kind !== 'walk';
    find('#clip-controls').hidden = source.kind !== 'clip';
    find('#back').hidden = source.kind === 'walk';
    this.#learn.showSource();
    find('#file-name').textContent = source.kind === 'clip' ? source.file.name : '';
    if (source.kind === 'clip') {
      this.#transport.show(source);
      this.#transport.setPlaying(true);
      source.player.loop = this.#transport.state.loop;
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
  }

  // ---- Controls under the view ----

  #setPace(pace: Pace) {
    this.session.steering.setPace(pace);
    showPace(pace);
  }
}
