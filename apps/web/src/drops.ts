// Files that are dropped anywhere on the page.

import { find } from './dom';

export function listenToDrops(onFiles: (files: File[], target: EventTarget | null) => void) {
  const drop = find('#drop');
  let depth = 0;
  addEventListener('dragenter', (event) => {
    event.preventDefault();
    drop.hidden = ++depth === 0;
  });
  addEventListener('dragleave', () => (drop.hidden = --depth <= 0));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    drop.hidden = true;
    onFiles([...(event.dataTransfer?.files ?? [])], event.target);
  });
}
