import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

/** Puts the WebAssembly module into the page, compressed, where it has <!--unsnarl-program-->; see src/compiled.js. */
export function inlineProgram(wasm) {
  return {
    name: 'inline-program',
    enforce: 'post',
    generateBundle(options, bundle) {
      const page = bundle['index.html'];
      const text = gzipSync(readFileSync(wasm), { level: 9 }).toString('base64');
      page.source = page.source.replace('<!--unsnarl-program-->',
        () => `<script type="text/plain" id="program">${text}</script>`);
    },
  };
}

/** The worker gets the module from the page: nothing in it shall ask for, or hold, the file. */
export function withoutFiles() {
  return {
    name: 'without-files',
    enforce: 'pre',
    transform: (code) => code.replace(/new URL\((['"])[^'"]*\.wasm\1, *import\.meta\.url\)/g, "'unsnarl_module.wasm'"),
  };
}
