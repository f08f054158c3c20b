// All calls on one compiled module: see index.d.ts.
import * as arrays from './arrays.js';
import { Library } from './library.js';
import { compile } from './module.js';
import { runProgram } from './program.js';

export { UnsnarlError } from './library.js';

export async function load({ wasm } = {}) {
  const compiled = await compile(wasm);
  const version = (await Library.open(compiled)).version();
  const bound = Object.entries(arrays).map(([name, call]) => [name, (...given) => call(compiled, ...given)]);
  return {
    version,
    run: (args, options) => runProgram(compiled, `unsnarl ${version}`, args, options),
    ...Object.fromEntries(bound),
  };
}
