// Loads what the page needs later than its script: files and libraries. A page opened from disk may
// neither fetch files nor import modules, so libraries are plain scripts, and files are there both as
// they are and packed as scripts. vite.config.ts makes them.

import files from 'virtual:panache-files';

import { PanacheError } from '../package/index.js';
import { element } from './dom';

interface Late {
  zip: { zipSync(files: Record<string, Uint8Array>): Uint8Array };
  gif: typeof import('gifenc');
}
export type Packed = keyof typeof files;

const pathOf = (name: string) => `./assets/${name}.js`;
const failed = (path: string) =>
  new PanacheError(`${path} did not load; try again, or reload the page`);

function load(name: string): Promise<void> {
  return new Promise((done, fail) => {
    const script = element('script', { src: pathOf(name) });
    script.addEventListener('load', () => done());
    script.addEventListener('error', () => fail(failed(pathOf(name))));
    document.head.append(script);
  });
}

/** The exports of a library: assets/NAME.js stores them in window.late_NAME. */
export async function late<Name extends keyof Late>(name: Name): Promise<Late[Name]> {
  const loaded = () => (window as unknown as Record<string, Late[Name]>)[`late_${name}`];
  if (!loaded()) await load(name);
  return loaded();
}

/** The bytes of a file. `onShare` gets the share that has arrived, 0 to 1. */
export async function packed(name: Packed, onShare: (share: number) => void = () => {}):
    Promise<ArrayBuffer> {
  const bytes = location.protocol === 'file:' ? await unpacked(name)
    : await fetched(files[name], onShare);
  onShare(1);
  return bytes;
}

async function fetched({ file, size }: { file: string; size: number },
  onShare: (share: number) => void): Promise<ArrayBuffer> {
  const path = `./assets/${file}`;
  const answer = await fetch(path).catch(() => null);
  if (!answer?.ok || !answer.body) throw failed(path);
  const reader = answer.body.getReader();
  const bytes = new Uint8Array(size);
  for (let count = 0; ;) {
    const { done, value } = await reader.read().catch(() => { throw failed(path); });
    if (done && count === size) return bytes.buffer;
    if (done || count + value.length > size) throw failed(path);
    bytes.set(value, count);
    onShare((count += value.length) / size);
  }
}

/** assets/NAME.js is packed_NAME='...', gzip in base64. */
async function unpacked(name: Packed): Promise<ArrayBuffer> {
  await load(name);
  const text = atob((window as unknown as Record<string, string>)[`packed_${name}`]);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}
