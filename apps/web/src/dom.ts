// A little help with elements.

type Attributes = Record<string, string | number | boolean | undefined>;

/** An element with attributes and children; `class`, `text` and everything else by its own name. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    out.setAttribute(name, value === true ? '' : String(value));
  }
  out.append(...children);
  return out;
}

/** A button that does something when it is pressed. */
export function button(text: string, press: () => void, attributes: Attributes = {}) {
  const out = element('button', { type: 'button', ...attributes }, text);
  out.addEventListener('click', press);
  return out;
}
/** What says in words what a button with a short text does: its tooltip, and its name. */
export const hinted = (hint: string) => ({ title: hint, 'aria-label': hint });

export function find<T extends HTMLElement>(selector: string): T {
  const out = document.querySelector<T>(selector);
  if (!out) throw new Error(`the page has no ${selector}`);
  return out;
}

const colours = new Map<string, string>();
/** When others apply. */
export const forgetColours = () => colours.clear();

/** The value of a colour of the style sheet; asking that itself may take longer than a drawing. */
export function colour(name: string): string {
  let value = colours.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    colours.set(name, value);
  }
  return value;
}
