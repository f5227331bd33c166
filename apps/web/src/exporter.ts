// What is taken away: the motion that is seen, in files of all kinds.

import { PanacheError, type Panache, type Playback, type Remover, type Walk } from '../package/index.js';
import { late } from './late';
import type { LoopMotion } from './loop';
import { clipLoop, walkLoop } from './loop_motion';
import { addFiles, addMotion, type Exports } from './save_all';
import { saveBytes } from './saving';
import type { Settings } from './settings';
import { titleOf, type Source } from './source';
import type { Pace } from './steering';
import { activeStyles, applySettings } from './styling';

/** What is seen now. */
export interface Seen {
  source: Source;
  settings: Settings;
  /** Once it is there. */
  remover: Remover | null;
  pace: Pace;
  /** Those that are listed. */
  files: File[];
  /** Of the file that is open. */
  bytes: ArrayBuffer;
  /** From where to where a clip plays, seconds; `isPart`: that is less than all of it. */
  range: [number, number];
  isPart: boolean;
}

export class Exporter {
  constructor(private panache: Panache, private seen: () => Seen) {}

  /** "walk-old.bvh": the source, the styles, the extension. */
  nameOf(extension: string, of?: string): string {
    const { source, settings, pace } = this.seen();
    const title = of ?? (source.kind === 'clip' ? titleOf(source.file.name) : pace);
    const styles = activeStyles(source, settings);
    return `${[title, ...(styles.length ? styles : ['neutral'])].join('-')}${extension}`;
  }

  save(extension: string) {
    const { player } = this.seen().source;
    saveBytes(player.exportAs(extension) as BlobPart, this.nameOf(extension));
  }
  saveStyle(name: string) {
    saveBytes(this.panache.extractStyle(name) as BlobPart, `${name}.safetensors`);
  }

  /** Everything that is listed, styled as is set now, in all formats. */
  async saveAll() {
    const { source, pace, files } = this.seen();
    const out: Exports = {};
    const nameOf = (title: string) => this.nameOf('', title);
    if (source.kind === 'walk') addMotion(out, source.player, nameOf(pace));
    const listed = source.kind === 'clip' ? files : [];
    const failed = await addFiles(out, this.panache, listed,
      (player) => this.#prepare(player), nameOf);
    if (Object.keys(out).length) {
      const all = listed.length > 1 ? `${listed.length} motions` : titleOf(Object.keys(out)[0]);
      saveBytes((await late('zip')).zipFiles(out) as BlobPart, `${all}.zip`, 'application/zip');
    }
    if (failed.length) throw new PanacheError(failed.join('\n'));
  }

  /** What is seen, as a motion file. */
  capture(which: 'input' | 'styled', seconds: number): File {
    const { source, pace } = this.seen();
    const [extension, title] = source.kind === 'clip'
      ? [source.file.extension, titleOf(source.file.name)] : ['.bvh', pace];
    const bytes = source.player.exportAs(extension, { which, seconds });
    return new File([bytes as BlobPart],
      `${which === 'input' ? title : this.nameOf('')}${extension}`);
  }

  /** What is seen now, as a motion that can be gone through again, beside what is seen. */
  loopMotion(): LoopMotion {
    const { source, settings, pace, bytes, range, isPart } = this.seen();
    const prepare = (player: Walk | Playback) => this.#prepare(player);
    if (source.kind === 'walk') return walkLoop(this.panache, pace, prepare);
    const keyed = Object.keys(settings.keys).length > 0;
    return clipLoop(source, bytes, range, prepare, !isPart && !keyed);
  }

  #prepare(player: Walk | Playback) {
    const { settings, remover } = this.seen();
    applySettings(this.panache, player, settings, remover);
  }
}
