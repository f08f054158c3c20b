import { readFileSync } from 'node:fs';

/** Puts shell.html, the elements that src/viewer.js fills, where a page has <!--shell-->. */
export function shellPage() {
  const shell = new URL('shell.html', import.meta.url);
  return {
    name: 'shell-page',
    transformIndexHtml: {
      order: 'pre',
      handler: (html) => html.replace('<!--shell-->\n', () => readFileSync(shell, 'utf8')),
    },
  };
}
