// A labelled number: a slider, a field for the exact value, and a reset button.

import { button, element, hinted } from './dom';
import { bounded } from './keys';

export interface SliderOptions {
  id: string;
  title: string;
  hint?: string;
  min: number;
  max: number;
  /** The value after a reset. */
  rest: number;
  onChange(value: number): void;
  /** Replaces the default reset, which changes the value to `rest`. */
  onReset?(): void;
}

export class Slider {
  readonly row: HTMLElement;
  readonly range: HTMLInputElement;
  #field: HTMLInputElement;
  #reset: HTMLButtonElement;

  constructor(private options: SliderOptions) {
    const { id, title, hint, min, max } = options;
    const bounds = { min, max, step: 0.01 };
    this.range = element('input', { type: 'range', id, ...bounds, title: hint });
    this.#field = element('input', {
      type: 'number', ...bounds, 'aria-label': `${title}, exact`, inputmode: 'decimal',
    });
    const reset = () => (options.onReset ? options.onReset() : this.#change(options.rest));
    this.#reset = button('↺', () => {
      reset();
      this.range.focus();
    }, { class: 'reset', ...hinted(`Reset ${title}`) });
    const label = element('label', { for: id, title: hint }, title);
    // Marks at the reset value and at 1.
    const share = (value: number) => (value - min) / (max - min);
    const marks = `--rest: ${share(options.rest)}; --one: ${share(1)}`;
    this.row = element('div', { class: 'slider', style: marks },
      label, this.range, this.#field, this.#reset);
    this.range.addEventListener('input', () => this.#change(Number(this.range.value)));
    this.#field.addEventListener('change', () => {
      this.#change(bounded(this.#field.valueAsNumber, min, max, options.rest));
      this.#field.value = this.range.value;
    });
    this.range.addEventListener('dblclick', reset);
    this.show(options.rest);
  }

  /** Shows a value without calling onChange. */
  show(value: number) {
    const { min, max, rest } = this.options;
    const text = String(value);
    if (this.range.value !== text) this.range.value = text;
    if (document.activeElement !== this.#field) this.#field.value = value.toFixed(2);
    const share = (v: number) => String((v - min) / (max - min));
    this.row.style.setProperty('--from', share(Math.min(value, rest)));
    this.row.style.setProperty('--to', share(Math.max(value, rest)));
    this.row.classList.toggle('changed', value !== rest);
    this.#reset.disabled = value === rest;
  }

  #change(value: number) {
    const { min, max, rest, onChange } = this.options;
    const good = bounded(value, min, max, rest);
    this.show(good);
    onChange(good);
  }
}
