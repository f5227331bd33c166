// What keys do while the page has the focus; help.ts lists them.

import type { Angle } from './camera';

export interface ShortcutActions {
  undo(): void;
  redo(): void;
  help: HTMLDialogElement;
  /** Whether the key is held that shows the input alone. */
  onCompare(held: boolean): void;
  onLook(angle: Angle): void;
  onSpace(): void;
  onNeutral(): void;
  onGesture(): void;
  onKeyframe(): void;
  onPastPoses(): void;
  onLoopStart(): void;
  onLoopEnd(): void;
  onStep(frames: number): void;
}

export function listenToKeys(on: ShortcutActions) {
  const keys: Record<string, () => void> = {
    Space: () => on.onSpace(),
    Digit0: () => on.onNeutral(),
    Digit1: () => on.onLook('front'),
    Digit2: () => on.onLook('side'),
    Digit3: () => on.onLook('top'),
    Digit4: () => on.onLook('orbit'),
    KeyF: () => on.onLook('face'),
    KeyX: () => on.onCompare(true),
    KeyG: () => on.onGesture(),
    KeyK: () => on.onKeyframe(),
    KeyN: () => on.onPastPoses(),
    KeyI: () => on.onLoopStart(),
    KeyO: () => on.onLoopEnd(),
    Comma: () => on.onStep(-1),
    Period: () => on.onStep(1),
  };
  addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    const typing = target.matches('input:not([type=range]), textarea');
    if (event.ctrlKey || event.metaKey) {
      const undo = event.code === 'KeyZ' && !event.shiftKey;
      const redo = event.code === 'KeyY' || (event.code === 'KeyZ' && event.shiftKey);
      if (typing || event.altKey || (!undo && !redo)) return;
      event.preventDefault();
      if (undo) on.undo();
      else on.redo();
      return;
    }
    if (typing || event.altKey || on.help.open) return;
    if (event.key === '?') return on.help.showModal();
    // A button or a menu that has the focus takes the space bar.
    if (event.code === 'Space' && target.matches('button, select')) return;
    const action = keys[event.code];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || event.code === 'Comma' || event.code === 'Period') action();
  });
  addEventListener('keyup', (event) => {
    if (event.code === 'KeyX') on.onCompare(false);
  });
  addEventListener('blur', () => on.onCompare(false));
}
