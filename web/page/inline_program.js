import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

/** What must be said of all that is in the module: NOTICE, and the licences that its package brings. */
function licences(folder) {
  const texts = [readFileSync(new URL('../../NOTICE', import.meta.url), 'utf8')];
  const brought = `${folder}/licenses`;
  if (existsSync(brought))
    for (const name of readdirSync(brought).sort()) texts.push(`${name}\n\n${readFileSync(`${brought}/${name}`, 'utf8')}`);
  return texts.map((text) => text.trim()).join(`\n\n${'-'.repeat(72)}\n\n`);
}

/**
 * Puts the WebAssembly module of a package (its folder), and the licences, into the page, compressed, where it has
 * <!--unsnarl-program-->; src/embedded.js reads them.
 */
export function inlineProgram(folder) {
  return {
    name: 'inline-program',
    enforce: 'post',
    generateBundle(options, bundle) {
      const page = bundle['index.html'];
      const element = (id, bytes) =>
        `<script type="text/plain" id="${id}">${gzipSync(bytes, { level: 9 }).toString('base64')}</script>`;
      const elements = [element('program', readFileSync(`${folder}/unsnarl_module.wasm`)), element('licences', licences(folder))];
      page.source = page.source.replace('<!--unsnarl-program-->', () => elements.join('\n'));
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
