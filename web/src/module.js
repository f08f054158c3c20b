// One compiled WebAssembly module, of which every call gets an instance of its own: memory, files and globals are new
// each time, and are gone afterwards.
import { nodeModule } from './node.js';
import unsnarlModule from './unsnarl_module.js';

/** Where the module lies: beside this file. */
export const defaultWasm = () => new URL('./unsnarl_module.wasm', import.meta.url);

async function compiledFrom(wasm) {
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  const url = wasm instanceof URL ? wasm : new URL(wasm, globalThis.location?.href ?? import.meta.url);
  if (url.protocol === 'file:') {
    const { readFile } = await nodeModule('fs/promises');
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok)
    throw new Error(
      `${url}: the server says ${response.status} ${response.statusText}; serve the file, or pass its bytes as load({wasm})`,
    );
  // Browsers keep what they have compiled from a stream, but take one of this type alone.
  const canStream = response.headers.get('content-type')?.startsWith('application/wasm') ?? false;
  return canStream ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** @param wasm its URL, its bytes, or a WebAssembly.Module of it; undefined: where it lies beside this file. */
export const compile = async (wasm = defaultWasm()) => (wasm instanceof WebAssembly.Module ? wasm : compiledFrom(wasm));

/** An instance. settings: what the module calls and reads, see emscripten's Module and the sources that name it. */
export const instantiate = (compiled, settings = {}) =>
  new Promise((resolve, reject) => {
    const instantiateWasm = (imports, receive) => {
      WebAssembly.instantiate(compiled, imports).then((instance) => receive(instance, compiled), reject);
      return {};
    };
    unsnarlModule({ instantiateWasm, ...settings }).then(resolve, reject);
  });
