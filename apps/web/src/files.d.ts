declare module 'virtual:panache-files' {
  /** The name in assets, and the bytes. */
  const files: Record<'wasm' | 'model' | 'walker' | 'remover' | 'neutral',
    { file: string; size: number }>;
  export default files;
}

declare module 'virtual:panache-removable' {
  const styles: readonly { name: string; group: string }[];
  export default styles;
}

declare module 'gifenc' {
  type Colour = [red: number, green: number, blue: number];
  /** Returns at most `count` colours for RGBA pixels. */
  export function quantize(pixels: Uint8ClampedArray, count: number): Colour[];
  /** The index of the colour of each pixel. */
  export function applyPalette(pixels: Uint8ClampedArray, palette: Colour[]): Uint8Array;
  export function GIFEncoder(): {
    /** The palette of the first frame is global. `delay`: milliseconds; `repeat` 0: forever. */
    writeFrame(indices: Uint8Array, width: number, height: number,
      options: { palette?: Colour[]; delay: number; repeat?: number }): void;
    finish(): void;
    bytes(): Uint8Array;
  };
}
