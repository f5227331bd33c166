// Messages over the view about errors in files, or oddities.

import { PanacheError } from '../package/index.js';
import { find } from './dom';

const kSeconds = 12;

let timer = 0;

/** Shows a text for a while; an empty text hides the current one. */
export function say(text: string) {
  const alert = find('#alert');
  alert.textContent = text;
  alert.hidden = text === '';
  clearTimeout(timer);
  timer = window.setTimeout(() => (alert.hidden = true), kSeconds * 1000);
}

/** Shows errors in files; all other errors are bugs. */
export async function attempt(action: () => Promise<void> | void, tell = say) {
  try {
    tell('');
    await action();
  } catch (error) {
    if (!(error instanceof PanacheError)) throw error;
    tell(error.message);
  }
}
