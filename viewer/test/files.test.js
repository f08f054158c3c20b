import assert from 'node:assert/strict';
import test from 'node:test';
import { trianglesOfFiles } from '../src/files.js';

const triangles = Int32Array.of(0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9);
const cornersOf = (page) => trianglesOfFiles(page).map((part) => [...part]);

test('triangles go to the file of their face', () => {
  const scene = { files: [{ first_face: 0, faces: 1 }, { first_face: 1, faces: 1 }, { first_face: 2, faces: 1 }] };
  assert.deepEqual(cornersOf({ scene, triangles, triangleFaces: Int32Array.of(0, 0, 1, 2) }),
    [[0, 1, 2, 0, 2, 3], [4, 5, 6], [7, 8, 9]]);
});

test('where triangles are faces, they are counted', () => {
  const scene = { files: [{ first_face: 0, faces: 3 }, { first_face: 3, faces: 1 }, { first_face: 4, faces: 0 }] };
  assert.deepEqual(cornersOf({ scene, triangles, triangleFaces: null }).map((c) => c.length / 3), [3, 1, 0]);
});

test('without files there is one', () => {
  assert.deepEqual(cornersOf({ scene: {}, triangles, triangleFaces: null }), [[...triangles]]);
});
