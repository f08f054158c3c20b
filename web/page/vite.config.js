// Run by `build`, with the Vite of viewer/. Environment: UNSNARL_WEB, the folder with load.js and unsnarl_module.wasm.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { inlinePage } from '../../viewer/inline_page.js';
import { shellPage } from '../../viewer/shell_page.js';
import { inlineProgram, withoutFiles } from './inline_program.js';

const web = process.env.UNSNARL_WEB;
if (!web) throw new Error('UNSNARL_WEB is not set: run web/page/build');

const { version } = JSON.parse(readFileSync(new URL('../../cmake/project.json', import.meta.url)));

export default {
  root: fileURLToPath(new URL('.', import.meta.url)),
  plugins: [shellPage(), inlinePage(), inlineProgram(web)],
  define: { unsnarlVersion: JSON.stringify(version) },
  resolve: { alias: { 'unsnarl-load': `${web}/load.js` } },
  // A page that was opened from the disk may have no worker that is a module.
  worker: { format: 'iife', plugins: () => [withoutFiles()] },
  build: {
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    modulePreload: false,
    emptyOutDir: false,
    target: 'es2022',
    chunkSizeWarningLimit: 4000,
  },
};
