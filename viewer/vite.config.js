import { defineConfig } from 'vite';
import { inlinePage } from './inline_page.js';
import { shellPage } from './shell_page.js';

export default defineConfig({
  plugins: [shellPage(), inlinePage()],
  build: {
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    modulePreload: false,
    emptyOutDir: false,  // the folder may hold anything
    target: 'es2022',
    chunkSizeWarningLimit: 2000,
  },
});
