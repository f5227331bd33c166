// Files in one zip. What writes it comes when it is first needed, as a plain script: a page opened
// from a disk may import no modules.

import { element } from './dom';

type Zip = (files: Record<string, Uint8Array>) => Uint8Array;

function load(path: string): Promise<void> {
  return new Promise((done, fail) => {
    const script = element('script', { src: path });
    script.addEventListener('load', () => done());
    script.addEventListener('error', () => fail(new Error(`${path} did not load`)));
    document.head.append(script);
  });
}

export async function zip(files: Record<string, Uint8Array>): Promise<Uint8Array> {
  const late = window as { zipFiles?: Zip };
  if (!late.zipFiles) await load('./assets/zip.js');
  return late.zipFiles!(files);
}
