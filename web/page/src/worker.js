/**
 * Runs the program. Messages in: first { module }, a WebAssembly.Module; then { id, args, files: { name: bytes }, flag },
 * one run each. flag: an Int32Array on shared memory; the program is asked to end when its first number is not 0. Out: { id, line } for each line of standard error, then { id, result: { exitCode, stdout, stderr, files } }
 * or { id, error: words }.
 */
import { load } from 'unsnarl-load';

let program;

async function run({ id, args, files, flag }) {
  const signal = { get aborted() { return flag !== undefined && Atomics.load(flag, 0) !== 0; } };
  try {
    const result = await (await program).run(args, { files, signal, onOutput: (line) => postMessage({ id, line }) });
    postMessage({ id, result }, Object.values(result.files).map(({ buffer }) => buffer));
  } catch (error) {
    postMessage({ id, error: String(error?.message ?? error) });
  }
}

let last = Promise.resolve();
addEventListener('message', ({ data }) => {
  if (data.module) program = load({ wasm: data.module });
  else last = last.then(() => run(data));
});
