// What is seen, as a file.

import { element } from './dom';

export function saveBytes(bytes: BlobPart, name: string, type = 'application/octet-stream') {
  const address = URL.createObjectURL(new Blob([bytes], { type }));
  const link = element('a', { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** A film of a canvas, from one press of a button to the next. */
export class Film {
  #recorder: MediaRecorder | null = null;

  constructor(private canvas: HTMLCanvasElement) {}

  static get possible() {
    return typeof MediaRecorder !== 'undefined' && MediaRecorder.isTypeSupported('video/webm');
  }
  get running() {
    return this.#recorder !== null;
  }

  start(name: string) {
    const pieces: Blob[] = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(60),
      { mimeType: 'video/webm', videoBitsPerSecond: 8e6 });
    recorder.ondataavailable = (event) => pieces.push(event.data);
    recorder.onstop = () => saveBytes(new Blob(pieces), name, 'video/webm');
    recorder.start();
    this.#recorder = recorder;
  }
  stop() {
    this.#recorder?.stop();
    this.#recorder = null;
  }
}
