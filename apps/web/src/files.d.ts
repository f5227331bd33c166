declare module 'virtual:panache-files' {
  /** Gzip in base64. */
  export const wasm: string;
  export const model: string;
  export const walker: string;
}
