// The package does what the native program does, byte for byte.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { project, runBoth, sampleFile, unsnarl } from './support.js';

const seeds = join(project, 'tests/fuzz/seeds');
const formats = ['obj', 'off', 'ply', 'stl', 'gltf', 'surf', 'gii', 'vtk', 'vtp', 'msh', 'inp', 'threemf'];

for (const format of formats)
  test(`every ${format} file`, async () => {
    for (const seed of readdirSync(join(seeds, format)).sort()) {
      const name = seed.includes('.') ? seed : `${seed}.${format}`;
      const files = { [name]: readFileSync(join(seeds, format, seed)) };
      await runBoth(['check', name], { files });
      await runBoth(['fix', name, '-o', `fixed-${name}`, '--keep-partial', '--quiet'], { files });
    }
  });

test('samples, in the formats that they can be written in', async () => {
  for (const sample of ['mobius_extended', 'linked_rings', 'klein_map', 'overlapping_quads', 'stool'])
    for (const ending of ['obj', 'off', 'ply', 'glb']) await runBoth(['sample', sample, '-o', `${sample}.${ending}`]);
  for (const [sample, ending] of [
    ['curve_star', 'svg'],
    ['curve_star', 'json'],
    ['knot_3_1', 'xyz'],
    ['routes_star_6', 'json'],
  ])
    await runBoth(['sample', sample, '-o', `${sample}.${ending}`]);
});

test('repairs of samples', async () => {
  for (const sample of ['crossing_tubes', 'trefoil_tube', 'dressed_figure', 'posed_limb']) {
    const files = { 'in.obj': sampleFile(sample, 'in.obj') };
    const { exitCode } = await runBoth(['fix', 'in.obj', '-o', 'out.obj'], { files });
    assert.equal(exitCode, 0);
  }
});

test('pictures, animations, recordings, pages, reports', async () => {
  const files = { 'in.obj': sampleFile('stool', 'in.obj') };
  const made = ['out.obj', 'a.png', 'a.gif', 'marked.ply', 'a.rec', 'report.json'];
  const { files: written } = await runBoth(
    [
      'fix',
      'in.obj',
      '-o',
      'out.obj',
      '--picture',
      'a.png',
      '--highlight',
      'marked.ply',
      '--record',
      'a.rec',
      '--report',
      'report.json',
    ],
    { files },
    { but: ['report.json'] },
  );
  assert.deepEqual(Object.keys(written).sort(), made.filter((name) => name !== 'a.gif').sort());
  await runBoth(['fix', 'in.obj', '-o', 'out.obj', '--picture', 'a.gif', '--quiet'], { files });
  await runBoth(['view', 'in.obj', 'out.obj', '-o', 'view.html'], {
    files: { ...files, 'out.obj': written['out.obj'] },
  });
});

test('a scene of several files', async () => {
  const files = {
    'tubes.obj': sampleFile('crossing_tubes', 'tubes.obj'),
    'sub/rings.ply': sampleFile('linked_rings', 'rings.ply'),
  };
  const { files: written } = await runBoth(['fix', 'tubes.obj', 'sub/rings.ply', '-o', 'repaired'], { files });
  assert.deepEqual(Object.keys(written).sort(), ['repaired/rings.ply', 'repaired/tubes.obj']);
});

test('a sequence of frames, and going on with it', async () => {
  const first = sampleFile('crossing_tubes', 'frame.obj').toString();
  const moved = (by) => first.replace(/^v (\S+)/gm, (line, x) => `v ${Number(x) * (1 + by)}`);
  const files = Object.fromEntries([0, 1, 2].map((t) => [`frames/${t}.obj`, moved(0.01 * t)]));
  const args = ['fix', '--sequence', 'frames/*.obj', '-o', 'repaired'];
  const list = 'repaired/unsnarl-sequence.jsonl'; // names the program
  const { files: written, exitCode } = await runBoth(args, { files }, { other: [list] });
  assert.equal(exitCode, 0);
  assert.deepEqual(
    Object.keys(written)
      .filter((name) => name.endsWith('.obj'))
      .sort(),
    ['repaired/0.obj', 'repaired/1.obj', 'repaired/2.obj'],
  );
  const again = await unsnarl.run(args, { files: { ...files, ...written } });
  assert.equal(again.exitCode, 0);
  assert.match(again.stderr, /3 were done before/);
});

test('curves, surfaces of knots, isotopies, routes', async () => {
  const untimed = (name) => ({ but: [name] });
  await runBoth(['curves', 'in.svg', '-o', 'out.svg', '--quiet'], {
    files: { 'in.svg': sampleFile('curve_star', 'in.svg') },
  });
  await runBoth(['seifert', 'in.xyz', '-o', 'out.obj', '--quiet'], {
    files: { 'in.xyz': sampleFile('knot_3_1', 'in.xyz') },
  });
  const knots = { 'a.xyz': sampleFile('knot_kinks_1', 'a.xyz'), 'b.xyz': sampleFile('knot_circle', 'b.xyz') };
  await runBoth(
    ['knot-isotopy', 'a.xyz', 'b.xyz', '-o', 'isotopy', '--quiet'],
    { files: knots },
    untimed('isotopy/isotopy.json'),
  );
  const plan = { 'plan.json': sampleFile('routes_star_6', 'plan.json') };
  await runBoth(['routes', 'plan.json', '-o', 'routes', '--quiet'], { files: plan }, untimed('routes/routes.json'));
});

test('standard input and output', async () => {
  const input = sampleFile('klein_map', 'in.glb');
  const { stdoutBytes } = await runBoth(['fix', '-', '--format', 'glb', '-o', '-', '--quiet'], { input });
  assert.equal(Buffer.from(stdoutBytes.subarray(0, 4)).toString(), 'glTF');
});

test('names in other alphabets', async () => {
  const bytes = sampleFile('klein_map', 'in.obj');
  await runBoth(['fix', 'Größe 网格/σχήμα.obj', '-o', 'Größe 网格/☆.obj', '--quiet'], {
    files: { 'Größe 网格/σχήμα.obj': bytes },
  });
});

test('help, and what it refuses', async () => {
  for (const args of [
    ['--version'],
    ['--help'],
    ['fix', '--help'],
    ['fxi'],
    ['fix'],
    ['fix', 'none.obj', '-o', 'out.obj'],
  ])
    await runBoth(args);
  const files = { 'bad.obj': 'v 0 0 0\nf 1 2 3\n', 'bad.ply': 'ply\nformat ascii 1.0\n', 'bad.gltf': '{' };
  for (const name of Object.keys(files)) {
    const { exitCode } = await runBoth(['fix', name, '-o', `out${name.slice(3)}`], { files });
    assert.equal(exitCode, 3);
  }
});

test('exit codes', async () => {
  const obstructed = { 'in.obj': sampleFile('klein_bottle', 'in.obj') };
  assert.equal((await runBoth(['fix', 'in.obj', '-o', 'out.obj'], { files: obstructed })).exitCode, 7);
  const tubes = { 'in.obj': sampleFile('crossing_tubes', 'in.obj') };
  assert.equal((await runBoth(['check', 'in.obj'], { files: tubes })).exitCode, 1);
  assert.equal((await runBoth(['fix', 'in.obj', '-o', 'none/out.obj'], { files: tubes })).exitCode, 4);
  assert.equal(
    (await runBoth(['fix', 'in.obj', '-o', 'out.obj', '--max-displacement', '1e-6'], { files: tubes })).exitCode,
    5,
  );
  assert.equal((await runBoth(['fix', 'in.obj', '-o', 'in.obj'], { files: tubes })).exitCode, 2);
  assert.equal((await runBoth(['fix', 'in.obj', '--in-place'], { files: tubes })).exitCode, 0);
});
