// The same calls as load() gives, made in a worker.
import { UnsnarlError } from './library.js';
import { nodeModule } from './node.js';

async function startWorker() {
  if (typeof Worker !== 'undefined') return new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  const { Worker: NodeWorker } = await nodeModule('worker_threads');
  const worker = new NodeWorker(new URL('./worker.js', import.meta.url));
  worker.addEventListener = (name, take) =>
    worker.on(name, (value) => take(name === 'message' ? { data: value } : value));
  return worker;
}

function errorOf({ name, message, code }) {
  if (code !== undefined) return new UnsnarlError(code, message);
  return new ({ TypeError, RangeError }[name] ?? Error)(message);
}

const aborted = () => new DOMException('the call was cancelled', 'AbortError');

/** A flag that another thread sees, where pages may have one. */
const sharedFlag = () =>
  typeof SharedArrayBuffer === 'undefined' ? undefined : new Int32Array(new SharedArrayBuffer(4));

/** An address as the worker, which lies elsewhere, understands it. */
const absolute = (address) => new URL(address, globalThis.location?.href ?? import.meta.url).href;

class Caller {
  #settings;
  #worker;
  #calls = new Map();
  #last = 0;

  constructor({ wasm, ...settings }) {
    const isAddress = typeof wasm === 'string' || wasm instanceof URL;
    this.#settings = { wasm: isAddress ? absolute(wasm) : wasm, ...settings };
  }

  async start() {
    this.#worker = startWorker();
    const worker = await this.#worker;
    worker.addEventListener('message', ({ data }) => this.#take(data));
    worker.addEventListener('error', (event) =>
      this.#fail(event.error ?? new Error(event.message ?? 'the worker cannot be started')),
    );
    return this.#call('load', [this.#settings]);
  }

  async #call(call, given, { onTold, signal } = {}) {
    if (signal?.aborted) throw aborted();
    const worker = await this.#worker;
    const id = ++this.#last;
    const cancelled = sharedFlag();
    const cancel = () => (cancelled ? Atomics.store(cancelled, 0, 1) : this.#startAnew());
    signal?.addEventListener('abort', cancel, { once: true });
    try {
      return await new Promise((resolve, reject) => {
        this.#calls.set(id, { resolve, reject, onTold });
        worker.postMessage({ id, call, arguments: given, cancelled });
      });
    } finally {
      this.#calls.delete(id);
      signal?.removeEventListener('abort', cancel);
    }
  }

  #take({ id, progress, result, error }) {
    const call = this.#calls.get(id);
    if (call === undefined) return;
    if (progress !== undefined) call.onTold?.(progress);
    else if (error !== undefined) call.reject(errorOf(error));
    else call.resolve(result);
  }

  #fail(error) {
    for (const { reject } of this.#calls.values()) reject(error);
  }

  /** Nothing else stops a worker that sees no shared flag: what it was doing is lost. */
  #startAnew() {
    this.#fail(aborted());
    this.#worker.then((worker) => worker.terminate());
    this.start().catch((error) => this.#fail(error));
  }

  call(name, ...given) {
    return this.#call(name, given);
  }

  run(args, { onOutput, signal, ...options } = {}) {
    return this.#call('run', [args, options], { onTold: onOutput, signal });
  }

  repair(V, F, options, { onProgress, signal } = {}) {
    return this.#call('repair', [V, F, options], { onTold: onProgress, signal });
  }

  async close() {
    (await this.#worker).terminate();
    this.#fail(aborted());
  }
}

export async function loadInWorker(settings = {}) {
  const caller = new Caller(settings);
  const { version } = await caller.start().catch(async (error) => {
    await caller.close();
    throw error;
  });
  const others = ['findIntersections', 'certify', 'sample', 'samples'].map((name) => [
    name,
    (...given) => caller.call(name, ...given),
  ]);
  return {
    version,
    run: (args, options) => caller.run(args, options),
    repair: (V, F, options, control) => caller.repair(V, F, options, control),
    ...Object.fromEntries(others),
    close: () => caller.close(),
  };
}
