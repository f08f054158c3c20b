// The tests install what npm packs in a folder of its own, and check the types that TypeScript sees.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { here, packageFolder, project, sampleFile, runNative, temporaryFolder, unsnarl } from './support.js';

const runIn = (cwd, program, ...args) =>
  execFileSync(program, args, { cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

/** A new folder with the package installed from its tarball. */
function installed(t) {
  const folder = temporaryFolder(t);
  const tarballs = readdirSync(dirname(packageFolder)).filter((name) => name.endsWith('.tgz'));
  assert.equal(tarballs.length, 1, tarballs.join());
  writeFileSync(join(folder, 'package.json'), '{"private": true, "type": "module"}');
  runIn(folder, 'npm', 'install', '--offline', '--no-audit', '--no-fund', join(dirname(packageFolder), tarballs[0]));
  return folder;
}

test('the package holds what it needs, and nothing else', () => {
  const [{ files }] = JSON.parse(runIn(packageFolder, 'npm', 'pack', '--dry-run', '--json'));
  const names = files.map(({ path }) => path);
  const sources = readdirSync(join(project, 'web/src'));
  const licenses = readdirSync(join(packageFolder, 'licenses')).map((name) => `licenses/${name}`);
  assert.deepEqual(
    names.sort(),
    [...sources, ...licenses, 'LICENSE', 'NOTICE', 'README.md', 'unsnarl_module.js', 'unsnarl_module.wasm'].sort(),
  );
  for (const library of [
    'emscripten',
    'fmtlib',
    'giflib',
    'libpng1.6',
    'libzip',
    'pugixml',
    'zlib',
    'libeigen3-dev',
    'nlohmann-json3-dev',
    'libcli11-dev',
  ])
    assert.ok(
      licenses.some((name) => name.startsWith(`licenses/${library}`)),
      library,
    );
  const { version, license } = JSON.parse(readFileSync(join(packageFolder, 'package.json')));
  assert.equal(version.replace('-dev', '.dev'), unsnarl.version);
  assert.equal(license, 'Apache-2.0');
});

test('installed, it repairs as the program does', (t) => {
  const folder = installed(t);
  const before = sampleFile('crossing_tubes', 'in.obj');
  writeFileSync(join(folder, 'in.obj'), before);
  writeFileSync(
    join(folder, 'repair.js'),
    `import { readFileSync, writeFileSync } from 'node:fs';
     import { load, loadInWorker } from 'unsnarl';
     const options = { files: { 'in.obj': readFileSync('in.obj') } };
     const args = ['fix', 'in.obj', '-o', 'out.obj', '--quiet'];
     writeFileSync('here.obj', (await (await load()).run(args, options)).files['out.obj']);
     const worker = await loadInWorker();
     writeFileSync('there.obj', (await worker.run(args, options)).files['out.obj']);
     await worker.close();`,
  );
  runIn(folder, process.execPath, 'repair.js');
  const wanted = runNative(['fix', 'in.obj', '-o', 'out.obj', '--quiet'], { files: { 'in.obj': before } }).files[
    'out.obj'
  ];
  for (const name of ['here.obj', 'there.obj']) assert.ok(readFileSync(join(folder, name)).equals(wanted), name);
});

test('the example of the README does what it says', (t) => {
  const folder = installed(t);
  const [, example] = readFileSync(join(packageFolder, 'README.md'), 'utf8').match(
    /```js\n(import \{ load \}[^`]*)```/,
  );
  writeFileSync(join(folder, 'example.js'), example);
  assert.match(runIn(folder, process.execPath, 'example.js'), /^\d+ embedded\n$/);
});

test('its types are those of what it does', (t) => {
  const folder = installed(t);
  const good = `
    import { load, loadInWorker, UnsnarlError, type Intersections, type RepairResult } from 'unsnarl';
    const unsnarl = await load({ wasm: new URL('file:///a.wasm') });
    const { V, F } = await unsnarl.sample('crossing_tubes', { resolution: 20, radius: 0.3 });
    const found: Intersections = await unsnarl.findIntersections(V, F, { weld: 'all' });
    const result: RepairResult = await unsnarl.repair([[0, 0, 0]], [[0, 1, 2]], { fixed: [true], minGap: 1e-3, allow: [[[0], [1]]] },
      { onProgress: ({ pairsLeft }) => { pairsLeft.toFixed() } });
    const worker = await loadInWorker();
    const { files, exitCode } = await worker.run(['fix'], { files: { 'a.obj': new Uint8Array() }, signal: new AbortController().signal });
    await worker.close();
    export const all = [found.kinds, result.status === 'embedded', files['a.obj'].length, exitCode + 1, UnsnarlError];`;
  const wrong = {
    'a.ts': 'await unsnarl.repair(V, F, { mingap: 1 });',
    'b.ts': "await unsnarl.run('fix');",
    'c.ts': "result.status === 'embeded';",
  };
  const lead = `
    import { load } from 'unsnarl';
    const unsnarl = await load();
    const { V, F } = await unsnarl.sample('klein_map');
    const result = await unsnarl.repair(V, F);
    `;
  writeFileSync(join(folder, 'good.ts'), good);
  for (const [name, text] of Object.entries(wrong)) writeFileSync(join(folder, name), `${lead}${text}\nexport {};`);
  const check = (name) => {
    try {
      runIn(
        folder,
        process.execPath,
        join(here, 'node_modules/typescript/bin/tsc'),
        '--noEmit',
        '--strict',
        '--target',
        'es2022',
        '--module',
        'nodenext',
        '--lib',
        'es2022,dom',
        name,
      );
      return '';
    } catch ({ stdout }) {
      return stdout;
    }
  };
  assert.equal(check('good.ts'), '');
  for (const name of Object.keys(wrong)) assert.match(check(name), new RegExp(`^${name}\\(\\d+,\\d+\\): error`), name);
});
