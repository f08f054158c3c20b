import assert from 'node:assert/strict';
import test from 'node:test';
import { Conflicts, trianglesOfFaces } from '../src/conflicts.js';
import { Faces, vertexNormals } from '../src/faces.js';
import { FramePlayer } from '../src/frames.js';
import { firstTriangleHit } from '../src/picking.js';

test('edges of polygons are listed once, and diagonals are none', () => {
  const faces = new Faces(Int32Array.of(0, 1, 2, 3, 1, 4, 2), Int32Array.of(4, 3));
  const edges = faces.edges();
  const listed = Array.from({ length: edges.length / 2 }, (_, i) => `${edges[2 * i]}-${edges[2 * i + 1]}`);
  assert.deepEqual(listed.sort(), ['0-1', '0-3', '1-2', '1-4', '2-3', '2-4']);
  assert.deepEqual([...faces.of(1)], [1, 4, 2]);
  assert.deepEqual([...new Faces(Int32Array.of(5, 6, 7, 7, 6, 8), null).of(1)], [7, 6, 8]);
});

test('many edges are found as by a set', () => {
  const corners = Int32Array.from({ length: 3000 }, (_, i) => Math.floor(i * 7919 % 613 + (i % 3)));
  const expected = new Set();
  for (let i = 0; i < corners.length; i += 3)
    for (const [u, v] of [[0, 1], [1, 2], [2, 0]].map((e) => e.map((k) => corners[i + k])))
      expected.add(`${Math.min(u, v)}-${Math.max(u, v)}`);
  assert.equal(new Faces(corners, null).edges().length, 2 * expected.size);
});

test('normals point along the turn of the corners', () => {
  const normals = vertexNormals(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), Int32Array.of(0, 1, 2));
  assert.deepEqual([...normals.subarray(0, 4)], [0, 0, 32767, 0]);
});

test('partners of a face are found on both sides of the pairs', () => {
  const conflicts = new Conflicts(Int32Array.of(0, 2, 0, 1, 2, 1), 4, ['disjoint', 'one_vertex']);
  assert.deepEqual(conflicts.partners(2), [{ face: 0, kind: 0 }, { face: 1, kind: 1 }]);
  assert.deepEqual(conflicts.partners(3), []);
  assert.deepEqual(conflicts.countByClass, [1, 1]);
  assert.deepEqual([...conflicts.isRed], [1, 1, 1, 0]);
});

test('triangles of chosen faces', () => {
  const triangles = Int32Array.of(0, 1, 2, 0, 2, 3, 4, 5, 6);
  assert.deepEqual([...trianglesOfFaces(triangles, Int32Array.of(0, 0, 1), (f) => f === 0)], [0, 1, 2, 0, 2, 3]);
  assert.deepEqual([...trianglesOfFaces(triangles, null, (f) => f === 2)], [4, 5, 6]);
});

test('a ray finds the nearest triangle in front of it, where it is at that moment', () => {
  const a = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1);
  const b = a.map((x, i) => (i < 9 && i % 3 === 2 ? 2 : x));  // the first triangle rises above the second
  const triangles = Int32Array.of(0, 1, 2, 3, 4, 5);
  const down = (t) => firstTriangleHit([0.2, 0.2, 5], [0, 0, -1], triangles, a, b, t);
  assert.equal(down(0), 1);
  assert.equal(down(1), 0);
  assert.equal(firstTriangleHit([0.2, 0.2, 5], [0, 0, 1], triangles, a, b, 0), -1);
  assert.equal(firstTriangleHit([0.9, 0.9, 5], [0, 0, -1], triangles, a, b, 0), -1);
});

test('frames are reached forwards and backwards', () => {
  const frame = (vertices, displacements) => ({ vertices: Int32Array.from(vertices), displacements: Float32Array.from(displacements) });
  const player = new FramePlayer([frame([], []), frame([0], [1, 0, 0]), frame([0, 1], [2, 0, 0, 0, 3, 4])], new Float32Array(6));
  player.seek(2);
  assert.deepEqual([...player.positions], [2, 0, 0, 0, 3, 4]);
  assert.deepEqual([...player.displacement], [2, 5]);
  player.seek(1);
  assert.deepEqual([...player.positions], [1, 0, 0, 0, 0, 0]);
  assert.deepEqual([...player.displacement], [1, 0]);
});
