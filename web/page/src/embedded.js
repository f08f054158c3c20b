import { bytesOfBase64 } from '../../../viewer/src/packed_words.js';

/** What inline_program.js has put into the page under this id, as a stream of bytes. */
function embedded(id) {
  return new Blob([bytesOfBase64(document.getElementById(id).textContent)]).stream().pipeThrough(new DecompressionStream('gzip'));
}

/** The program of this page, compiled: a WebAssembly.Module. */
export function compiledProgram() {
  return WebAssembly.compileStreaming(new Response(embedded('program'), { headers: { 'Content-Type': 'application/wasm' } }));
}

/** The licences of all that is in the page. */
export const licences = () => new Response(embedded('licences')).text();
