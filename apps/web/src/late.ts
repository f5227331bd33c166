// Scripts that come when they are first needed, as plain scripts: a page opened from a disk may
// import no modules. vite.config.ts makes assets/NAME.js of late/NAME.ts, which puts what it has
// into the window under its name.

import { PanacheError } from '../package/index.js';
import { element } from './dom';

interface Late {
  zip: { zipFiles(files: Record<string, Uint8Array>): Uint8Array };
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
  const known = ((window as { late?: Partial<Late> }).late ??= {});
  if (!known[name]) await load(`./assets/${name}.js`);
  return known[name]!;
}
