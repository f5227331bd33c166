declare module 'virtual:panache-file/*' {
  /** Gzip in base64. */
  const packed: string;
  export default packed;
}

declare module 'virtual:panache-removable' {
  const styles: readonly { name: string; group: string }[];
  export default styles;
}

declare module 'gifenc' {
  type Colour = [red: number, green: number, blue: number];
  /** At most so many colours for these pixels, RGBA. */
  export function quantize(pixels: Uint8ClampedArray, count: number): Colour[];
  /** The index of the colour of each pixel. */
  export function applyPalette(pixels: Uint8ClampedArray, palette: Colour[]): Uint8Array;
  export function GIFEncoder(): {
    /** The first frame has the colours of all. `delay`: milliseconds; `repeat` 0: for ever. */
    writeFrame(indices: Uint8Array, width: number, height: number,
      options: { palette?: Colour[]; delay: number; repeat?: number }): void;
    finish(): void;
    bytes(): Uint8Array;
  };
}
