// The same calls in a worker of Node.js.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { loadInWorker, packageFolder, runNative, sampleFile, unsnarl, UnsnarlError } from './support.js';

let worker;
before(async () => (worker = await loadInWorker()));
after(() => worker.close());

test('gives what the calls in this thread give', async () => {
  assert.equal(worker.version, unsnarl.version);
  assert.deepEqual(await worker.samples(), await unsnarl.samples());
  const { V, F } = await worker.sample('crossing_tubes');
  assert.deepEqual(await worker.findIntersections(V, F), await unsnarl.findIntersections(V, F));
  const repaired = await worker.repair(V, F);
  assert.deepEqual(repaired.V, (await unsnarl.repair(V, F)).V);
  assert.deepEqual(await worker.certify(V, F, repaired.V), await unsnarl.certify(V, F, repaired.V));
  const files = { 'in.obj': sampleFile('stool', 'in.obj') };
  const args = ['fix', 'in.obj', '-o', 'out.obj', '--quiet'];
  const { files: written, exitCode } = await worker.run(args, { files });
  assert.equal(exitCode, 0);
  assert.ok(runNative(args, { files }).files['out.obj'].equals(written['out.obj']));
});

test('tells progress, and is cancelled while this thread is free', async () => {
  const { V, F } = await worker.sample('trefoil_tube', { resolution: 200 });
  const abort = new AbortController();
  const told = [];
  const result = await worker.repair(
    V,
    F,
    {},
    {
      onProgress: (progress) => {
        told.push(progress);
        abort.abort();
      },
      signal: abort.signal,
    },
  );
  assert.equal(result.status, 'cancelled');
  assert.ok(told.length > 0 && told[0].phase);
  const lines = [];
  const { exitCode } = await worker.run(['sample', '--list'], { onOutput: (line) => lines.push(line) });
  assert.equal(exitCode, 0);
  await assert.rejects(worker.repair(V, F, {}, { signal: AbortSignal.abort() }), { name: 'AbortError' });
});

test('passes errors on', async () => {
  await assert.rejects(
    worker.sample('none'),
    (error) => error instanceof UnsnarlError && error.code === 'invalid_argument',
  );
  await assert.rejects(worker.repair([1], [0]), TypeError);
});

test('takes the module as bytes and as an address, and says where there is none', async () => {
  const file = join(packageFolder, 'unsnarl_module.wasm');
  for (const wasm of [readFileSync(file), `file://${file}`, new URL(`file://${file}`)]) {
    const other = await loadInWorker({ wasm });
    assert.equal(other.version, unsnarl.version);
    await other.close();
  }
  await assert.rejects(loadInWorker({ wasm: 'file:///none.wasm' }), /none\.wasm/);
});
