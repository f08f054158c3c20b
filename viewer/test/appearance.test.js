import assert from 'node:assert/strict';
import test from 'node:test';
import { fillWithCopies, trianglesOfMaterials, withCopies } from '../src/appearance.js';

test('copies of vertices have the values of the vertices', () => {
  const copies = Int32Array.of(1, 0, 1);
  const values = Float32Array.of(1, 2, 3, 4);
  assert.deepEqual([...withCopies(values, 2, copies)], [1, 2, 3, 4, 3, 4, 1, 2, 3, 4]);
  assert.equal(withCopies(values, 2, new Int32Array(0)), values);
  assert.equal(withCopies(values, 2, undefined), values);
  const result = new Float32Array(10);
  fillWithCopies(result, values, 2, copies);
  assert.deepEqual([...result], [...withCopies(values, 2, copies)]);
});

test('triangles go to their material, those without one to their file', () => {
  const materials = [{ name: 'a' }, { name: 'b' }];
  const scene = { files: [{ first_face: 0, faces: 2 }, { first_face: 2, faces: 3 }] };
  const appearance = {
    materials, faceMaterials: Int32Array.of(1, -1, 0, 1, -1),
    triangles: Int32Array.of(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17),
  };
  const groups = trianglesOfMaterials({ scene, appearance, triangleFaces: Int32Array.of(0, 0, 1, 2, 3, 4) });
  assert.deepEqual(groups.map(({ material, file, triangles }) => [material?.name ?? file, [...triangles]]), [
    [1, [15, 16, 17]], [0, [6, 7, 8]], ['a', [9, 10, 11]], ['b', [0, 1, 2, 3, 4, 5, 12, 13, 14]]]);
});
