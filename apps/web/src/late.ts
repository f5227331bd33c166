// Scripts that come when they are first needed, as plain scripts: a page opened from a disk may
// import no modules. vite.config.ts makes assets/NAME.js of each, which puts what it has into the
// window as late_NAME.

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

/** What the build packs into a script: gzip in base64. */
export async function unpack(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const packed = new Blob([bytes]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
