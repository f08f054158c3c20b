// Modules of Node.js, which bundlers for browsers neither have nor look for under a name that is no literal.

/** What `import('node:NAME')` gives. To be called in Node.js alone. */
export function nodeModule(name) {
  const address = `node:${name}`;
  return import(/* webpackIgnore: true */ /* @vite-ignore */ address);
}
