// The package: see index.d.ts.
export { load, UnsnarlError } from './load.js';
export { loadInWorker } from './in_worker.js';
