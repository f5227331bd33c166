// Loads what the page needs later than its script: files that the build packed, and libraries. A page
// opened from disk may neither fetch files nor import modules, so all of them are plain scripts.
// vite.config.ts makes them.

import sizes from 'virtual:panache-sizes';

import { PanacheError } from '../package/index.js';
import { element } from './dom';

interface Late {
  zip: { zipSync(files: Record<string, Uint8Array>): Uint8Array };
  gif: typeof import('gifenc');
}
export type Packed = keyof typeof sizes;

const pathOf = (name: string) => `./assets/${name}.js`;
const failed = (name: string) =>
  new PanacheError(`${pathOf(name)} did not load; try again, or reload the page`);

function load(name: string): Promise<void> {
  return new Promise((done, fail) => {
    const script = element('script', { src: pathOf(name) });
    script.addEventListener('load', () => done());
    script.addEventListener('error', () => fail(failed(name)));
    document.head.append(script);
  });
}

/** The exports of a library: assets/NAME.js stores them in window.late_NAME. */
export async function late<Name extends keyof Late>(name: Name): Promise<Late[Name]> {
  const loaded = () => (window as unknown as Record<string, Late[Name]>)[`late_${name}`];
  if (!loaded()) await load(name);
  return loaded();
}

/** The bytes of a packed file. `onShare` gets the share that has arrived, 0 to 1. */
export async function packed(name: Packed, onShare: (share: number) => void = () => {}):
    Promise<ArrayBuffer> {
  const text = location.protocol === 'file:' ? await runPacked(name)
    : await fetchPacked(name, onShare);
  onShare(1);
  return unpack(text);
}

/** assets/NAME.js is packed_NAME='...'. */
async function runPacked(name: Packed): Promise<string> {
  await load(name);
  return (window as unknown as Record<string, string>)[`packed_${name}`];
}
/** The same text, but its arrival can be followed. */
async function fetchPacked(name: Packed, onShare: (share: number) => void): Promise<string> {
  const answer = await fetch(pathOf(name)).catch(() => null);
  if (!answer?.ok || !answer.body) throw failed(name);
  const reader = answer.body.getReader(), decoder = new TextDecoder();
  const parts: string[] = [];
  for (let count = 0; ;) {
    const { done, value } = await reader.read().catch(() => { throw failed(name); });
    if (done) break;
    parts.push(decoder.decode(value, { stream: true }));
    onShare(Math.min(1, (count += value.length) / sizes[name]));
  }
  const text = parts.join('');
  return text.slice(text.indexOf("'") + 1, text.lastIndexOf("'"));
}

/** gzip in base64. */
async function unpack(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}
