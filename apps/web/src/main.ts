// Loads the parts of the page and starts it.

import model from 'virtual:panache-file/model';
import walker from 'virtual:panache-file/walker';
import wasm from 'virtual:panache-file/wasm';

import { Panache } from '../package/index.js';
import { find } from './dom';
import { unpack } from './late';
import { LiveView } from './live';
import { Page } from './page';
import { served } from './served';

async function start() {
  try {
    // The model that `panache view --model` serves with the page, or else the page's own.
    const given = await served('model');
    const files = await Promise.all(
      [unpack(wasm), given ? given.arrayBuffer() : unpack(model), unpack(walker)]);
    const panache = await Panache.create(
      { wasm: files[0], model: files[1], walker: files[2] });
    const live = new URLSearchParams(location.search).has('live');
    Object.assign(window, { page: live ? new LiveView(panache) : new Page(panache) });
  } catch (error) {
    find('#wait').textContent = `This browser cannot show the page: ${(error as Error).message}`;
    throw error;
  }
}

void start();
