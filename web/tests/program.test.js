// The tests run the program by the package: files, lines, cancelling, memory, and refusals of what a browser cannot do.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { runNative, sampleFile, unsnarl } from './support.js';

const tubes = { 'in.obj': sampleFile('crossing_tubes', 'in.obj') };
const fix = ['fix', 'in.obj', '-o', 'out.obj'];

test('each run starts from a clean state', async () => {
  await unsnarl.run(fix, { files: tubes });
  const { exitCode, stderr } = await unsnarl.run(['check', 'out.obj']);
  assert.equal(exitCode, 3);
  assert.match(stderr, /out\.obj/);
});

test('what is passed in is not changed, and what has not changed does not come back', async () => {
  const bytes = Uint8Array.from(tubes['in.obj']);
  const { files } = await unsnarl.run(['fix', 'in.obj', '--in-place', '--quiet'], { files: { 'in.obj': bytes } });
  assert.deepEqual(bytes, Uint8Array.from(tubes['in.obj']));
  assert.deepEqual(Object.keys(files), ['in.obj']);
  assert.deepEqual((await unsnarl.run(['fix', 'in.obj', '--in-place'], { files })).files, {});
});

test('runs at the same time do not see each other', async () => {
  const all = await Promise.all([0, 1, 2].map((n) => unsnarl.run(['sample', 'klein_map', '-o', `${n}.obj`])));
  assert.deepEqual(
    all.map(({ files }) => Object.keys(files)),
    [['0.obj'], ['1.obj'], ['2.obj']],
  );
});

test('lines of standard error come while the program is at work', async () => {
  const lines = [];
  const { stderr } = await unsnarl.run([...fix, '--progress', 'json'], {
    files: tubes,
    onOutput: (line) => lines.push(line),
  });
  assert.equal(lines.join('\n') + '\n', stderr);
  const told = lines.filter((line) => line.startsWith('{')).map((line) => JSON.parse(line));
  assert.ok(told.length > 3 && told.at(-1).fraction === 1);
});

test('a run that is asked to end keeps what it has reached', async () => {
  const signal = { aborted: false };
  const { exitCode, files } = await unsnarl.run([...fix, '--progress', 'json', '--keep-partial'], {
    files: tubes,
    signal,
    onOutput: () => (signal.aborted = true),
  });
  assert.equal(exitCode, 6);
  assert.ok(Object.keys(files).every((name) => name === 'out.obj'));
});

test('an error in onOutput ends the run and is thrown', async () => {
  const error = new Error('enough');
  await assert.rejects(
    unsnarl.run([...fix, '--progress', 'json'], {
      files: tubes,
      onOutput: () => {
        throw error;
      },
    }),
    error,
  );
});

test('names of files stay in the working folder', async () => {
  for (const name of ['../in.obj', '/in.obj', 'a//in.obj', './in.obj', ''])
    await assert.rejects(
      unsnarl.run(['check', 'in.obj'], { files: { [name]: tubes['in.obj'] } }),
      /is no name of a file/,
    );
  await assert.rejects(unsnarl.run(['check', 'in.obj'], { files: { 'in.obj': 7 } }), /is no Uint8Array/);
});

test('texts are written as UTF-8', async () => {
  const { exitCode } = await unsnarl.run(['check', 'in.obj'], { files: { 'in.obj': `# ä\n${tubes['in.obj']}` } });
  assert.equal(exitCode, 1);
});

test('a limit of memory is kept', async () => {
  const files = { 'in.obj': sampleFile('posed_limb', 'in.obj', '--resolution', '200') };
  const limited = await unsnarl.run([...fix, '--memory-limit', '25'], { files });
  assert.equal(limited.exitCode, 5);
  const { stderr } = runNative([...fix, '--memory-limit', '40'], { files });
  assert.match(limited.stderr, /memory/);
  assert.match(stderr, /memory/);
  assert.ok(!('out.obj' in limited.files));
  assert.equal((await unsnarl.run([...fix, '--memory-limit', '2000', '--quiet'], { files })).exitCode, 0);
});

test('a limit of time is kept', async () => {
  const { exitCode, stderr } = await unsnarl.run([...fix, '--time-limit', '0.001'], { files: tubes });
  assert.equal(exitCode, 5);
  assert.match(stderr, /time limit/);
});

test('deep nesting in files is refused as by the native program', async () => {
  const deep = {
    'a.gltf': `${'['.repeat(100000)}`,
    'a.vtp': `<?xml version="1.0"?><VTKFile>${'<a>'.repeat(100000)}`,
    'a.svg': `<svg>${'<g>'.repeat(100000)}`,
  };
  for (const name of ['a.gltf', 'a.vtp']) {
    const there = runNative(['check', name], { files: deep });
    const here = await unsnarl.run(['check', name], { files: deep });
    assert.equal(here.exitCode, 3);
    assert.equal(here.stderr, there.stderr);
  }
  assert.equal((await unsnarl.run(['curves', 'a.svg', '-o', 'b.svg'], { files: deep })).exitCode, 3);
});

test('a batch, which needs processes, says that there are none', async () => {
  const { exitCode, stderr, files } = await unsnarl.run(['batch', 'meshes', '-o', 'repaired'], {
    files: { 'meshes/in.obj': tubes['in.obj'] },
  });
  assert.notEqual(exitCode, 0);
  assert.match(stderr, /process/);
  assert.ok(!Object.keys(files).some((name) => name.endsWith('.obj')), stderr);
});

test('--version --json tells what is compiled in', async () => {
  const { stdout } = await unsnarl.run(['--version', '--json']);
  assert.equal(JSON.parse(stdout).version ?? JSON.parse(stdout).unsnarl, unsnarl.version);
});
