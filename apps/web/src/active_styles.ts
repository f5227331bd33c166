// The active styles below the panel: a slider for each, and a switch for those with a side.

import type { Style } from '../package/index.js';
import { element } from './dom';
import { capitalized } from './groups';
import { kMin, kMax } from './keys';
import type { Session } from './session';
import { SideSwitch } from './side';
import { Slider } from './slider';

export class ActiveStyles {
  readonly element = element('section', { id: 'active-styles', 'aria-label': 'Active styles' });
  #none = element('p', { class: 'hint' }, 'Neutral: click a style to see it.');
  #sliders = new Map<string, Slider>();
  #sides = new Map<string, SideSwitch>();

  constructor(private session: Session) {
    this.element.append(this.#none);
    session.store.listen(() => this.#show());
    this.element.addEventListener('focusout', () => setTimeout(() => this.#show()));
  }

  /** Shows the current strengths of styles with keys. */
  showNow() {
    for (const [name, slider] of this.#sliders) {
      if (!(name in this.session.store.settings.keys)) continue;
      slider.show(Math.round(this.session.strengthOf(name) * 100) / 100);
    }
  }

  /** Builds the rows again, as descriptions may have changed. */
  set() {
    for (const { row } of this.#sliders.values()) row.remove();
    this.#sliders.clear();
    this.#sides.clear();
    this.#show();
  }

  #make(style: Style): Slider {
    const { name, description } = style;
    const slider = new Slider({
      id: `style-${encodeURIComponent(name)}`, title: capitalized(name),
      hint: description || undefined, min: kMin, max: kMax, rest: 0,
      onChange: (value) => this.session.setStrength(name, value),
      onReset: () => this.session.store.dropStyle(name),
    });
    slider.row.append(element('p', { class: 'words' }, description));
    if (style.side) {
      const side = new SideSwitch(style, (chosen) => this.session.store.setSide(name, chosen));
      this.#sides.set(name, side);
      slider.row.append(side.element);
    }
    return slider;
  }

  #show() {
    const { styles, keys, sides } = this.session.store.settings;
    for (const [name, { row }] of this.#sliders) {
      // A slider in use stays, also at 0.
      if (this.session.isActive(name) || row.contains(document.activeElement)) continue;
      row.remove();
      this.#sliders.delete(name);
      this.#sides.delete(name);
    }
    for (const style of this.session.panache.styles) {
      const { name } = style;
      if (!this.session.isActive(name) || this.#sliders.has(name)) continue;
      const slider = this.#make(style);
      this.#sliders.set(name, slider);
      this.element.append(slider.row);
    }
    for (const [name, slider] of this.#sliders) {
      slider.row.classList.toggle('keyed', name in keys);
      if (!(name in keys)) slider.show(styles[name] ?? 0);
    }
    for (const [name, side] of this.#sides) side.show(sides[name] ?? 1);
    this.#none.hidden = this.#sliders.size > 0;
  }
}
