import ProgramWorker from './worker.js?worker&inline';

/** A run that was stopped before its end. */
export class Stopped extends Error {}

/** The program `unsnarl` in a worker: one run at a time, in the order of the calls. */
export class Program {
  #module;
  #worker = null;
  #runs = new Map();
  #next = 0;
  #flag = undefined;  // of shared memory, where the page may have that

  /** module: promise of a WebAssembly.Module */
  constructor(module) {
    this.#module = module;
    this.#start();
  }

  /**
   * Runs it with these arguments in a folder with these files, { name: Uint8Array }. onLine(line): a line of standard
   * error, while it runs. Resolves to { exitCode, stdout, stderr, files }, files: what it wrote. Rejects with Stopped,
   * or where the program broke down.
   */
  run(args, files = {}, onLine = () => {}) {
    const id = ++this.#next;
    const worker = this.#worker;
    const flag = this.#flag;
    return new Promise((resolve, reject) => {
      this.#runs.set(id, { resolve, reject, onLine });
      worker.then((there) => there.postMessage({ id, args, files, flag }), reject);
    });
  }

  /** Asks what runs to end with what it has reached. False: in this page it can only be stopped. */
  askToEnd() {
    if (!this.#flag || Atomics.load(this.#flag, 0) !== 0) return false;
    Atomics.store(this.#flag, 0, 1);
    return true;
  }

  /** Takes that back: for what runs from now on. */
  goOn() {
    if (this.#flag) Atomics.store(this.#flag, 0, 0);
  }

  /** Ends what runs and what waits; each rejects with Stopped. */
  stop() {
    if (this.#runs.size === 0) return;
    this.#worker.then((there) => there.terminate(), () => {});
    for (const { reject } of this.#runs.values()) reject(new Stopped('stopped'));
    this.#runs.clear();
    this.#start();
  }

  #start() {
    if (globalThis.crossOriginIsolated) this.#flag = new Int32Array(new SharedArrayBuffer(4));
    this.#worker = this.#module.then((module) => {
      const worker = new ProgramWorker();
      worker.addEventListener('message', ({ data }) => this.#take(data));
      worker.addEventListener('error', (event) => this.#breakDown(event.message));
      worker.postMessage({ module });
      return worker;
    });
    this.#worker.catch(() => {});  // each run says so
  }

  #take({ id, line, result, error }) {
    const run = this.#runs.get(id);
    if (!run) return;
    if (line !== undefined) return void run.onLine(line);
    this.#runs.delete(id);
    if (result) run.resolve(result);
    else run.reject(new Error(error));
  }

  #breakDown(words) {
    for (const { reject } of this.#runs.values()) reject(new Error(words));
    this.#runs.clear();
    this.#start();
  }
}
