import { bytesOfBase64 } from '../../../viewer/src/packed_words.js';

/** The program of this page, compiled: a WebAssembly.Module. */
export async function compiledProgram() {
  const element = document.getElementById('program');
  const packed = new Blob([bytesOfBase64(element.textContent)]);
  element.remove();
  const bytes = packed.stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compileStreaming(new Response(bytes, { headers: { 'Content-Type': 'application/wasm' } }));
}
