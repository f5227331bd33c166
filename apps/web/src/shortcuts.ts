// Keyboard shortcuts; help.ts lists them.

import type { Store } from './settings';
import type { Stage } from './stage';

/** `keys`: actions by key code, except for keys that are held or combined with Ctrl. */
export function listenToKeys(store: Store, stage: Stage, help: HTMLDialogElement,
    keys: Record<string, () => void>) {
  addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    const typing = target.matches('input:not([type=range]), textarea');
    if (event.ctrlKey || event.metaKey) {
      const undo = event.code === 'KeyZ' && !event.shiftKey;
      const redo = event.code === 'KeyY' || (event.code === 'KeyZ' && event.shiftKey);
      if (typing || event.altKey || (!undo && !redo)) return;
      event.preventDefault();
      if (undo) store.undo();
      else store.redo();
      return;
    }
    if (typing || event.altKey || help.open) return;
    if (event.key === '?') return help.showModal();
    // A focused button or menu handles the space bar.
    if (event.code === 'Space' && target.matches('button, select')) return;
    const action = event.code === 'KeyX' ? () => (stage.comparing = true) : keys[event.code];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || event.code === 'Comma' || event.code === 'Period') action();
  });
  addEventListener('keyup', (event) => {
    if (event.code === 'KeyX') stage.comparing = false;
  });
  addEventListener('blur', () => (stage.comparing = false));
}
