// Loads the parts of the page and starts it.

import { Panache, PanacheError } from '../package/index.js';
import { find } from './dom';
import { packed } from './late';
import { LiveView } from './live';
import { Page } from './page';
import { served } from './served';

/** The model that `panache view --model` serves with the page, or else the page's own. */
async function loadModel(): Promise<ArrayBuffer> {
  const given = await served('model');
  if (given) return given.arrayBuffer();
  const bar = find<HTMLProgressElement>('#styles-loaded');
  return packed('model', (share) => (bar.value = share));
}

async function start() {
  try {
    const bar = find<HTMLProgressElement>('#loaded');
    const [wasm, walker] = await Promise.all(
      [packed('wasm', (share) => (bar.value = share)), packed('walker')]);
    const panache = await Panache.create({ wasm, walker });
    const live = new URLSearchParams(location.search).has('live');
    // The walker moves before the model, which is larger than all the rest, has arrived.
    Object.assign(window,
      { page: live ? new LiveView(panache, loadModel()) : new Page(panache, loadModel()) });
  } catch (error) {
    find('#wait').textContent = error instanceof PanacheError ? error.message
      : `This browser cannot show the page: ${(error as Error).message}`;
    throw error;
  }
}

void start();
