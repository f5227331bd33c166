// Exports the displayed motion to files of all formats.

import { PanacheError, type MotionFile, type Playback, type Walk } from '../package/index.js';
import { saveBytes } from './dom';
import { late } from './late';
import { clipLoop, walkLoop, type LoopMotion } from './loop';
import type { Session } from './session';
import { freed, openMoving, titleOf } from './source';
import { activeStyles, applySettings } from './styling';
import type { TransportBar } from './transport';

const kFormats = ['.bvh', '.glb', '.vrma'];

type Exports = Record<string, Uint8Array>;  // By file name.

/** Adds the player's motion in all formats, under a unique title. */
function addMotion(out: Exports, player: Walk | Playback, title: string) {
  while (`${title}${kFormats[0]}` in out) title += '-2';
  for (const extension of kFormats) out[title + extension] = player.exportAs(extension);
}

export class Exporter {
  constructor(private session: Session, private transport: TransportBar) {}

  /** "walk-old.bvh": the source, the styles, the extension. */
  nameOf(extension: string, of?: string): string {
    const styles = activeStyles(this.session.source, this.session.store.settings);
    const title = of ?? this.#title;
    return `${[title, ...(styles.length ? styles : ['neutral'])].join('-')}${extension}`;
  }

  /** The title of the displayed motion, for file names. */
  get #title(): string {
    const { source, steering } = this.session;
    return source.kind === 'clip' ? titleOf(source.file.name) : steering.pace;
  }

  save(extension: string) {
    saveBytes(this.session.source.player.exportAs(extension) as BlobPart, this.nameOf(extension));
  }
  saveStyle(name: string) {
    saveBytes(this.session.panache.extractStyle(name) as BlobPart, `${name}.safetensors`);
  }

  /** Saves all listed files with the current settings, in all formats. */
  async saveAll() {
    const { source, panache, files } = this.session;
    const out: Exports = {}, failed: string[] = [];
    if (source.kind === 'walk') addMotion(out, source.player, this.nameOf(''));
    const listed = source.kind === 'clip' ? files : [];
    for (const file of listed) {
      await new Promise((next) => setTimeout(next));  // Keeps the page responsive.
      try {
        freed((await openMoving(panache, file)).file, (opened) => this.#addFile(out, opened));
      } catch (error) {
        if (!(error instanceof PanacheError)) throw error;
        failed.push(error.message);
      }
    }
    if (Object.keys(out).length) {
      const all = listed.length > 1 ? `${listed.length} motions` : titleOf(Object.keys(out)[0]);
      saveBytes((await late('zip')).zipSync(out) as BlobPart, `${all}.zip`, 'application/zip');
    }
    if (failed.length) throw new PanacheError(failed.join('\n'));
  }

  #addFile(out: Exports, file: MotionFile) {
    const title = titleOf(file.name);
    file.clips.forEach(({ name, moves }, i) => {
      if (!moves) return;
      freed(file.createPlayer(i), (player) => {
        this.#prepare(player);
        addMotion(out, player,
          this.nameOf('', file.clips.length > 1 ? `${title}-${name || i + 1}` : title));
      });
    });
  }

  /** The displayed motion as a file. */
  capture(which: 'input' | 'styled', seconds: number): File {
    const { source } = this.session;
    const extension = source.kind === 'clip' ? source.file.extension : '.bvh';
    const bytes = source.player.exportAs(extension, { which, seconds });
    return new File([bytes as BlobPart],
      `${which === 'input' ? this.#title : this.nameOf('')}${extension}`);
  }

  /** A replayable copy of the displayed motion, independent of the view. */
  loopMotion(): LoopMotion {
    const { transport, session: { source, panache, store, steering, bytes } } = this;
    const prepare = (player: Walk | Playback) => this.#prepare(player);
    if (source.kind === 'walk') return walkLoop(panache, steering.pace, prepare);
    const keyed = Object.keys(store.settings.keys).length > 0;
    return clipLoop(source, bytes, transport.range, prepare, !transport.isPart && !keyed);
  }

  #prepare(player: Walk | Playback) {
    const { panache, store, removal } = this.session;
    applySettings(panache, player, store.settings, removal.remover);
  }
}
