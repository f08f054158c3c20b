// Calls on arrays: they say what the program says of a file of the same numbers, and refuse what makes no sense.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { runNative, unsnarl, UnsnarlError } from './support.js';

/** The text of an OBJ file that holds these numbers exactly. */
function objOf(V, F) {
  const vertices = Array.from({ length: V.length / 3 }, (_, v) => `v ${V[3 * v]} ${V[3 * v + 1]} ${V[3 * v + 2]}\n`);
  const faces = Array.from(
    { length: F.length / 3 },
    (_, f) => `f ${F[3 * f] + 1} ${F[3 * f + 1] + 1} ${F[3 * f + 2] + 1}\n`,
  );
  return vertices.join('') + faces.join('');
}

const verticesOf = (obj) =>
  obj
    .toString()
    .match(/^v .*$/gm)
    .flatMap((line) => line.split(' ').slice(1).map(Number));

const rowsOf = (flat, size) =>
  Array.from({ length: flat.length / size }, (_, i) => Array.from(flat.slice(size * i, size * i + size)));

/** A tetrahedron, and another that pierces it. */
const tetrahedra = {
  V: [0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0.5, 0.5, -1, 1.5, 0.5, -1, 0.5, 1.5, -1, 0.7, 0.7, 1],
  F: [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6],
};

test('samples are those of the program', async () => {
  const names = (await unsnarl.samples()).map(({ name }) => name);
  assert.ok(names.includes('trefoil_tube') && names.includes('overlapping_quads'));
  const { V, F } = await unsnarl.sample('trefoil_tube', { resolution: 40 });
  assert.ok(V instanceof Float64Array && F instanceof Int32Array);
  const { files } = runNative(['sample', 'trefoil_tube', '--resolution', '40', '-o', 'a.obj']);
  assert.equal(V.length, verticesOf(files['a.obj']).length);
  const quads = await unsnarl.sample('overlapping_quads');
  assert.ok(quads.F.offsets.length > 1 && quads.F.offsets.at(-1) === quads.F.corners.length);
  const parameter = (await unsnarl.samples()).find(({ name }) => name === 'crossing_tubes').parameters[0];
  const [one, other] = [
    await unsnarl.sample('crossing_tubes'),
    await unsnarl.sample('crossing_tubes', { [parameter.name]: parameter.maximum }),
  ];
  assert.notDeepEqual(one.V, other.V);
});

test('intersections are those that the program lists', async () => {
  const { V, F } = tetrahedra;
  const found = await unsnarl.findIntersections(V, F);
  const { stdout } = runNative(['check', 'a.obj', '--json'], { files: { 'a.obj': objOf(V, F) } });
  assert.equal(found.pairs.length / 2, JSON.parse(stdout).pairs.total);
  assert.equal(found.pairs.length / 2, found.kinds.length);
  assert.equal(found.counts.disjoint, found.kinds.length);
  assert.deepEqual((await unsnarl.findIntersections(V.slice(0, 12), F.slice(0, 12))).pairs, new Int32Array());
});

test('a mesh may be given flat, in rows, or as polygons', async () => {
  const { V, F } = tetrahedra;
  const { pairs } = await unsnarl.findIntersections(V, F);
  const offsets = Array.from({ length: F.length / 3 + 1 }, (_, f) => 3 * f);
  const others = [
    [Float64Array.from(V), Int32Array.from(F)],
    [rowsOf(V, 3), rowsOf(F, 3)],
    [V, rowsOf(F, 3).map((row) => Uint32Array.from(row))],
    [V, { corners: F, offsets }],
  ];
  for (const [positions, faces] of others)
    assert.deepEqual((await unsnarl.findIntersections(positions, faces)).pairs, pairs);
});

test('a repair gives the positions of the program, and changes nothing that it was given', async () => {
  for (const name of ['crossing_tubes', 'posed_limb', 'stool']) {
    const sample = await unsnarl.sample(name);
    const F = sample.F.corners ?? sample.F;
    const faces = sample.F.corners ? sample.F : F;
    const obj = runNative(['sample', name, '-o', 'in.obj']).files['in.obj'];
    const V = Float64Array.from(verticesOf(obj));
    const before = V.slice();
    const result = await unsnarl.repair(V, faces);
    assert.deepEqual(V, before);
    const { files } = runNative(['fix', 'in.obj', '-o', 'out.obj', '--quiet'], { files: { 'in.obj': obj } });
    assert.equal(result.status, 'embedded');
    // The file has the fewest digits of moved coordinates as 32-bit floats.
    const wanted = verticesOf(files['out.obj']).map((x, i) => (Math.fround(x) === result.V[i] ? result.V[i] : x));
    assert.deepEqual(Array.from(result.V), wanted);
    assert.equal(result.report.status, 'embedded');
    const certificate = await unsnarl.certify(V, faces, result.V);
    assert.ok(certificate.embedded && certificate.seamsClosed);
    assert.ok(!(await unsnarl.certify(V, faces, V)).embedded);
  }
});

test('32-bit positions come back as such', async () => {
  const V = Float32Array.from(tetrahedra.V);
  const single = await unsnarl.repair(V, tetrahedra.F);
  assert.ok(single.V instanceof Float32Array);
  assert.equal(single.status, 'embedded');
  assert.ok((await unsnarl.certify(V, tetrahedra.F, single.V)).embedded);
  assert.ok((await unsnarl.repair(V, tetrahedra.F, { precision: 'float64' })).V instanceof Float64Array);
});

test('what must not move stays, what is rigid moves as a body, what may intersect does', async () => {
  const { V, F } = tetrahedra;
  for (const fixed of [
    [0, 1, 2, 3],
    Uint8Array.from([1, 1, 1, 1, 0, 0, 0, 0]),
    [true, true, true, true, false, false, false, false],
  ]) {
    const result = await unsnarl.repair(V, F, { fixed });
    assert.equal(result.status, 'embedded');
    assert.deepEqual(Array.from(result.V.slice(0, 12)), V.slice(0, 12));
    assert.notDeepEqual(Array.from(result.V.slice(12)), V.slice(12));
  }
  const { V: moved, status } = await unsnarl.repair(V, F, { fixed: [0, 1, 2, 3], rigid: [[4, 5, 6, 7]] });
  assert.equal(status, 'embedded');
  const distance = (X, a, b) => Math.hypot(...[0, 1, 2].map((k) => X[3 * a + k] - X[3 * b + k]));
  for (const [a, b] of [
    [4, 5],
    [5, 6],
    [6, 7],
  ])
    assert.ok(Math.abs(distance(moved, a, b) - distance(V, a, b)) < 1e-6);
  const allowed = await unsnarl.repair(V, F, {
    allow: [
      [
        [0, 1, 2, 3],
        [4, 5, 6, 7],
      ],
    ],
  });
  assert.equal(allowed.status, 'allowed');
  assert.deepEqual(Array.from(allowed.V), V);
  assert.equal(
    (
      await unsnarl.findIntersections(V, F, {
        allow: [
          [
            [0, 1, 2, 3],
            [4, 5, 6, 7],
          ],
        ],
      })
    ).kinds.length,
    0,
  );
});

test('limits end a repair with a status', async () => {
  const { V, F } = await unsnarl.sample('crossing_tubes');
  assert.equal((await unsnarl.repair(V, F, { maxDisplacement: 1e-6 })).status, 'displacement_exceeded');
  assert.equal((await unsnarl.repair(V, F, { timeLimit: 1e-6 })).status, 'time_limit');
});

test('progress is told, and may cancel', async () => {
  const { V, F } = await unsnarl.sample('crossing_tubes');
  const told = [];
  await unsnarl.repair(V, F, {}, { onProgress: (progress) => told.push(progress) });
  assert.ok(told.length > 2 && told.every(({ fraction }, i) => i === 0 || fraction >= told[i - 1].fraction));
  assert.equal(told.at(-1).pairsLeft, 0);
  const signal = { aborted: false };
  const cancelled = await unsnarl.repair(V, F, {}, { onProgress: () => (signal.aborted = true), signal });
  assert.equal(cancelled.status, 'cancelled');
  const thrown = new Error('enough');
  await assert.rejects(
    unsnarl.repair(
      V,
      F,
      {},
      {
        onProgress: () => {
          throw thrown;
        },
      },
    ),
    thrown,
  );
});

test('what makes no sense is refused, and the message says where', async () => {
  const { V, F } = tetrahedra;
  const refused = [
    [() => unsnarl.repair(V.slice(1), F), TypeError, /V has 23 numbers/],
    [() => unsnarl.repair(V, F.slice(1)), TypeError, /F has 23 ids/],
    [() => unsnarl.repair(V, [0.5, 1, 2]), TypeError, /F\[0\] is 0.5/],
    [() => unsnarl.repair(V, [[0, 1]]), TypeError, /F\[0\] has 2 corners/],
    [() => unsnarl.repair('mesh', F), TypeError, /V is a string/],
    [() => unsnarl.repair([...V.slice(0, 23), NaN], F), UnsnarlError, /vertex 7/],
    [() => unsnarl.repair(V, [0, 1, 8]), UnsnarlError, /vertex 8/],
    [() => unsnarl.repair(V, { corners: F, offsets: [0, 3] }), TypeError, /offsets run from 0 to 3/],
    [() => unsnarl.repair(V, F, { minGap: -1 }), TypeError, /minGap is -1/],
    [() => unsnarl.repair(V, F, { minGap: NaN }), TypeError, /minGap is NaN/],
    [() => unsnarl.repair(V, F, { min_gap: 0.1 }), TypeError, /there is no option "min_gap"/],
    [() => unsnarl.repair(V, F, { goal: 'al' }), UnsnarlError, /goal/],
    [() => unsnarl.repair(V, F, { fixed: [8] }), TypeError, /fixed\[0\] is 8/],
    [() => unsnarl.repair(V, F, { fixed: new Uint8Array(3) }), TypeError, /fixed has 3 flags/],
    [() => unsnarl.repair(V, F, { rigid: [0, 1] }), TypeError, /rigid is an array of parts/],
    [() => unsnarl.certify(V, F, V.slice(3)), UnsnarlError, /vertices/],
    [() => unsnarl.sample('none'), UnsnarlError, /no sample is called "none"/],
  ];
  for (const [call, kind, message] of refused)
    await assert.rejects(
      call,
      (error) => error instanceof kind && (message.test(error.message) || assert.fail(error.message)),
    );
});
