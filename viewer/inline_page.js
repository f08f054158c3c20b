import { readFileSync } from 'node:fs';

/** Puts what Vite has built, script and styles, into the page itself, with the licence of what is in it. */
export function inlinePage() {
  const licence = readFileSync(new URL('node_modules/three/LICENSE', import.meta.url), 'utf8').trim();
  return {
    name: 'inline-page',
    enforce: 'post',
    generateBundle(options, bundle) {
      const page = bundle['index.html'];
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        const text = part.type === 'chunk' ? part.code : String(part.source);
        // A replacement function: the text may hold "$&" and the like.
        page.source = name.endsWith('.css')
          ? page.source.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${text}</style>`)
          : page.source.replace(/<script type="module"[^>]*><\/script>/,
              () => `<script type="module">${text.replaceAll('</script', '<\\/script')}</script>`);
        delete bundle[name];
      }
      page.source = page.source.replace('<!--licences-->', () => `<!--\nThis page contains three.js:\n\n${licence}\n-->`);
    },
  };
}
