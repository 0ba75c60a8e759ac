// What bundle.mjs puts into the script.

declare const WORKER: string; // the worker's script

declare module '*.gz' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}

declare module '*.css';
