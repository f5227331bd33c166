// Loads scripts when they are first needed, as plain scripts: a page opened from disk cannot import
// modules. vite.config.ts builds assets/NAME.js for each, which stores its exports in
// window.late_NAME.

import { PanacheError } from '../package/index.js';
import { element } from './dom';

interface Late {
  zip: { zipSync(files: Record<string, Uint8Array>): Uint8Array };
  gif: typeof import('gifenc');
  remover: { packed: string };
  neutral: { packed: string };
}

function load(path: string): Promise<void> {
  return new Promise((done, fail) => {
    const script = element('script', { src: path });
    script.addEventListener('load', () => done());
    script.addEventListener('error', () => fail(
      new PanacheError(`${path} did not load; try again, or reload the page`)));
    document.head.append(script);
  });
}

export async function late<Name extends keyof Late>(name: Name): Promise<Late[Name]> {
  const loaded = () => (window as unknown as Record<string, Late[Name]>)[`late_${name}`];
  if (!loaded()) await load(`./assets/${name}.js`);
  return loaded();
}

/** Unpacks a file that the build embedded in a script: gzip in base64. */
export async function unpack(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const packed = new Blob([bytes]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
