// A gamepad's D-pad on the sliders: up and down choose a slider, left and right move it.

const kUp = 12, kDown = 13, kLeft = 14, kRight = 15;
const kPush = 0.05;
const kRepeat = 0.14;  // Seconds.

export class Cross {
  #wait = 0;

  /** Call it once per frame. */
  step(seconds: number) {
    this.#wait -= seconds;
    const pad = navigator.getGamepads?.().find((p) => p?.connected);
    const on = (button: number) => pad?.buttons[button]?.pressed ?? false;
    if (![kUp, kDown, kLeft, kRight].some(on)) this.#wait = 0;
    if (!pad || this.#wait > 0 || ![kUp, kDown, kLeft, kRight].some(on)) return;
    this.#wait = kRepeat;
    const sliders = [...document.querySelectorAll<HTMLInputElement>('.panel input[type=range]')]
      .filter((slider) => slider.checkVisibility());
    const focused = sliders.indexOf(document.activeElement as HTMLInputElement);
    if (on(kUp) || on(kDown)) {
      const next = focused < 0 ? 0 : focused + (on(kDown) ? 1 : -1);
      sliders[Math.max(0, Math.min(sliders.length - 1, next))].focus();
    } else if (focused >= 0) {
      const slider = sliders[focused];
      slider.value = String(Number(slider.value) + (on(kRight) ? kPush : -kPush));
      slider.dispatchEvent(new Event('input'));
    }
  }
}
