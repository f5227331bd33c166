// Helpers for DOM elements.

type Attributes = Record<string, string | number | boolean | undefined>;

/** Creates an element with attributes and children. */
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

export function button(text: string, press: () => void, attributes: Attributes = {}) {
  const out = element('button', { type: 'button', ...attributes }, text);
  out.addEventListener('click', press);
  return out;
}
/** Describes a button with a short text: its tooltip and accessible name. */
export const hinted = (hint: string) => ({ title: hint, 'aria-label': hint });

export function find<T extends HTMLElement>(selector: string): T {
  const out = document.querySelector<T>(selector);
  if (!out) throw new Error(`the page has no ${selector}`);
  return out;
}

const colours = new Map<string, string>();
/** Call it when the colour scheme changes. */
export const forgetColours = () => colours.clear();

/** A colour of the style sheet, cached: reading it there can take longer than drawing. */
export function colour(name: string): string {
  let value = colours.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    colours.set(name, value);
  }
  return value;
}

/** Downloads a file. */
export function saveBytes(bytes: BlobPart, name: string, type = 'application/octet-stream') {
  const address = URL.createObjectURL(new Blob([bytes], { type }));
  const link = element('a', { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** The position of a pointer in an element, 0 to 1 across and down. */
export function positionIn(field: HTMLElement,
    { clientX, clientY }: PointerEvent): [number, number] {
  const box = field.getBoundingClientRect();
  return [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
}
/** Reports the position of a pointer while it is pressed on an element, and its release. */
export function listenToDrags(field: HTMLElement, move: (x: number, y: number) => void,
    end = () => {}) {
  field.addEventListener('pointerdown', (event) => {
    field.setPointerCapture(event.pointerId);
    move(...positionIn(field, event));
  });
  field.addEventListener('pointermove', (event) => {
    if (field.hasPointerCapture(event.pointerId)) move(...positionIn(field, event));
  });
  for (const name of ['pointerup', 'pointercancel']) field.addEventListener(name, end);
}
