// A worker, of browsers and of Node.js, that calls for another thread. It takes {id, call, arguments, cancelled} and posts
// {id, progress} any number of times, then {id, result} or {id, error}.
//
// call: "load" (arguments: those of load(), once, before all others; left out: the defaults) or a function of what load()
// gives. progress: of "run" a line of standard error, of "repair" what onProgress gets. cancelled: an Int32Array on shared
// memory; the call is asked to end when its first number is not 0.
import { load, UnsnarlError } from './load.js';
import { nodeModule } from './node.js';

const { port, listen } = await (async () => {
  if (typeof self !== 'undefined' && typeof self.postMessage === 'function')
    return { port: self, listen: (take) => self.addEventListener('message', ({ data }) => take(data)) };
  const { parentPort } = await nodeModule('worker_threads');
  return { port: parentPort, listen: (take) => parentPort.on('message', take) };
})();

let unsnarl;

async function callOf(id, call, given, signal) {
  const tell = (progress) => port.postMessage({ id, progress });
  if (call === 'load') {
    unsnarl = load(...given);
    return { version: (await unsnarl).version };
  }
  const calls = await (unsnarl ??= load());
  if (typeof calls[call] !== 'function') throw new TypeError(`there is no call "${call}"`);
  if (call === 'run') return calls.run(given[0], { ...given[1], onOutput: tell, signal });
  if (call === 'repair') return calls.repair(given[0], given[1], given[2], { onProgress: tell, signal });
  return calls[call](...given);
}

const described = (error) => ({
  name: error?.name ?? 'Error',
  message: error?.message ?? String(error),
  ...(error instanceof UnsnarlError ? { code: error.code } : {}),
});

listen(async ({ id, call, arguments: given = [], cancelled }) => {
  const signal = {
    get aborted() {
      return cancelled !== undefined && Atomics.load(cancelled, 0) !== 0;
    },
  };
  try {
    port.postMessage({ id, result: await callOf(id, call, given, signal) });
  } catch (error) {
    port.postMessage({ id, error: described(error) });
  }
});
