// What the page says over the view when something is wrong with a file, or odd about it.

import { PanacheError } from '../package/index.js';
import { find } from './dom';

const kSeconds = 12;

let timer = 0;

/** Shows a text for a while; an empty one hides the last. */
export function say(text: string) {
  const alert = find('#alert');
  alert.textContent = text;
  alert.hidden = text === '';
  clearTimeout(timer);
  timer = window.setTimeout(() => (alert.hidden = true), kSeconds * 1000);
}

/** Tells of what is wrong with a file; everything else is a fault of ours. */
export async function attempt(action: () => Promise<void> | void, tell = say) {
  try {
    tell('');
    await action();
  } catch (error) {
    if (!(error instanceof PanacheError)) throw error;
    tell(error.message);
  }
}
