// A small page, built with each bundler, repairs a sample in headless Chromium, in the page and in a worker.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import * as esbuild from 'esbuild';
import { promisify } from 'node:util';
import { chromium } from 'playwright-core';
import webpack from 'webpack';
import { here, packageFolder, runNative, sampleFile, temporaryFolder } from './support.js';

const tools = join(here, 'node_modules');
const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/google-chrome'].find(existsSync);

const input = sampleFile('crossing_tubes', 'in.obj');
const args = ['fix', 'in.obj', '-o', 'out.obj', '--quiet'];
const wanted = runNative(args, { files: { 'in.obj': input } }).files['out.obj'].toString();

let browser;
before(async () => (browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] })));
after(() => browser?.close());

/** A folder with the sources of the page, and the package in node_modules. settings: those of load(), as text. */
function pageSources(t, settings = '') {
  const folder = temporaryFolder(t);
  mkdirSync(join(folder, 'node_modules'));
  cpSync(packageFolder, join(folder, 'node_modules/unsnarl'), { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{"private": true, "type": "module"}');
  writeFileSync(
    join(folder, 'index.html'),
    '<!doctype html><title>unsnarl</title><script type="module" src="./main.js"></script>',
  );
  writeFileSync(
    join(folder, 'main.js'),
    `import { load, loadInWorker } from 'unsnarl';
     window.repairHere = async (text) => {
       const { files } = await (await load(${settings})).run(${JSON.stringify(args)}, { files: { 'in.obj': text } });
       return new TextDecoder().decode(files['out.obj']);
     };
     window.repairInWorker = async (text) => {
       const worker = await loadInWorker(${settings});
       const lines = [];
       const { files } = await worker.run([...${JSON.stringify(args.slice(0, -1))}, '--progress', 'json'],
         { files: { 'in.obj': text }, onOutput: (line) => lines.push(line) });
       await worker.close();
       return { out: new TextDecoder().decode(files['out.obj']), lines: lines.length };
     };
     window.cancelInWorker = async (text) => {
       const worker = await loadInWorker(${settings});
       const abort = new AbortController();
       const run = worker.run([...${JSON.stringify(args.slice(0, -1))}, '--progress', 'json'],
         { files: { 'in.obj': text }, onOutput: () => abort.abort(), signal: abort.signal });
       const ended = await run.then(({ exitCode }) => exitCode, ({ name }) => name);
       const { exitCode } = await worker.run(['sample', '--list']);
       await worker.close();
       return [ended, exitCode];
     };
     document.title = 'ready';`,
  );
  return folder;
}

/** Serves a folder. isolated: its pages may share memory. */
async function serve(t, folder, { isolated = false } = {}) {
  const headers = isolated
    ? { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' }
    : {};
  const server = createServer(({ url }, response) => {
    const file = join(folder, decodeURI(url === '/' ? '/index.html' : url.split('?')[0]));
    if (!existsSync(file)) return response.writeHead(404).end();
    response
      .writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream', ...headers })
      .end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  t.after(() => server.close());
  return `http://127.0.0.1:${server.address().port}/`;
}

/** Opens the page and repairs, in it and in a worker. */
async function check(t, folder, { isolated = false } = {}) {
  const page = await browser.newPage();
  t.after(() => page.close());
  const troubles = [];
  page.on('pageerror', (error) => troubles.push(String(error)));
  page.on('requestfailed', (request) => troubles.push(`${request.url()} failed`));
  page.on(
    'response',
    (response) =>
      response.status() >= 400 &&
      !response.url().endsWith('favicon.ico') &&
      troubles.push(`${response.url()}: ${response.status()}`),
  );
  await page.goto(await serve(t, folder, { isolated }));
  await page.waitForFunction(() => document.title === 'ready').catch(() => assert.fail(troubles.join('\n')));
  assert.equal(await page.evaluate((text) => window.repairHere(text), input.toString()), wanted);
  const { out, lines } = await page.evaluate((text) => window.repairInWorker(text), input.toString());
  assert.equal(out, wanted);
  assert.ok(lines > 3);
  const ended = isolated ? 6 : 'AbortError';
  assert.deepEqual(await page.evaluate((text) => window.cancelInWorker(text), input.toString()), [ended, 0]);
  assert.deepEqual(troubles, []);
}

const runTool = (cwd, tool, ...given) =>
  execFileSync(process.execPath, [join(tools, tool), ...given], {
    cwd,
    stdio: ['ignore', 'pipe', 'pipe'],
    encoding: 'utf8',
  });

test('without a bundler, from a web server', async (t) => {
  const folder = pageSources(t);
  const map = '<script type="importmap">{"imports": {"unsnarl": "./node_modules/unsnarl/index.js"}}</script>';
  writeFileSync(
    join(folder, 'index.html'),
    readFileSync(join(folder, 'index.html'), 'utf8').replace('<script', `${map}<script`),
  );
  await check(t, folder);
  await check(t, folder, { isolated: true });
});

test('Vite', async (t) => {
  const folder = pageSources(t);
  writeFileSync(
    join(folder, 'vite.config.js'),
    "export default { base: './', worker: { format: 'es' }, build: { target: 'es2022' } };",
  );
  runTool(folder, 'vite/bin/vite.js', 'build', '--logLevel', 'warn');
  await check(t, join(folder, 'dist'));
});

test('Vite while it serves', async (t) => {
  const folder = pageSources(t);
  writeFileSync(join(folder, 'vite.config.js'), "export default { optimizeDeps: { exclude: ['unsnarl'] } };");
  const { createServer: createVite } = await import('vite');
  const server = await createVite({ root: folder, logLevel: 'silent', server: { port: 0, host: '127.0.0.1' } });
  await server.listen();
  t.after(() => server.close());
  const page = await browser.newPage();
  t.after(() => page.close());
  await page.goto(server.resolvedUrls.local[0] ?? server.resolvedUrls.network[0]);
  await page.waitForFunction(() => document.title === 'ready');
  assert.equal(await page.evaluate((text) => window.repairHere(text), input.toString()), wanted);
  assert.equal((await page.evaluate((text) => window.repairInWorker(text), input.toString())).out, wanted);
});

test('webpack', async (t) => {
  const folder = pageSources(t);
  const settings = { context: folder, mode: 'production', entry: './main.js', output: { path: join(folder, 'dist') } };
  const stats = await promisify(webpack)(settings);
  assert.deepEqual(
    [
      stats.compilation.errors,
      stats.compilation.warnings.filter(({ name }) => !/Size|Asset|Entrypoint|NoAsync/.test(name)),
    ],
    [[], []],
  );
  writeFileSync(join(folder, 'dist/index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
  await check(t, join(folder, 'dist'));
});

/** Those that leave new URL(..., import.meta.url) as it is: module and worker are files that are named to them. */
function copyBeside(folder) {
  copyFileSync(join(packageFolder, 'unsnarl_module.wasm'), join(folder, 'dist/unsnarl_module.wasm'));
  writeFileSync(join(folder, 'dist/index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
}

test('esbuild', async (t) => {
  const folder = pageSources(t);
  const entryPoints = { main: 'main.js', worker: 'node_modules/unsnarl/worker.js' };
  await esbuild.build({
    absWorkingDir: folder,
    entryPoints,
    bundle: true,
    format: 'esm',
    minify: true,
    outdir: 'dist',
  });
  copyBeside(folder);
  await check(t, join(folder, 'dist'));
});

test('Rollup', async (t) => {
  const folder = pageSources(t);
  const resolver =
    "{ name: 'packages', resolveId: (name) => (name === 'unsnarl' ? process.cwd() + '/node_modules/unsnarl/index.js' : null) }";
  writeFileSync(
    join(folder, 'rollup.config.js'),
    `export default { input: { main: 'main.js', worker: 'node_modules/unsnarl/worker.js' }, plugins: [${resolver}],
       output: { dir: 'dist', format: 'es', entryFileNames: '[name].js', chunkFileNames: '[name].js' } };`,
  );
  runTool(folder, 'rollup/dist/bin/rollup', '-c', '--silent');
  copyBeside(folder);
  await check(t, join(folder, 'dist'));
});
