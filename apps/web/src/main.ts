// Loads what the page consists of, and starts it.

import * as files from 'virtual:panache-files';

import { Panache } from '../package/index.js';
import { find } from './dom';
import { LiveView } from './live';
import { Page } from './page';
import { served } from './served';
import { unpack } from './unpack';

/** The model that `panache view --model` serves beside the page, else the page's own. */
async function findModel(): Promise<ArrayBuffer> {
  return await (await served('model'))?.arrayBuffer() ?? unpack(files.model);
}

async function start() {
  try {
    const [wasm, model, walker] = await Promise.all(
      [unpack(files.wasm), findModel(), unpack(files.walker)]);
    const panache = await Panache.create({ wasm, model, walker });
    const live = new URLSearchParams(location.search).has('live');
    Object.assign(window, { page: live ? new LiveView(panache) : new Page(panache) });
  } catch (error) {
    find('#wait').textContent = `This browser cannot show the page: ${(error as Error).message}`;
    throw error;
  }
}

void start();
