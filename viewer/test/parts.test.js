import assert from 'node:assert/strict';
import { test } from 'node:test';
import { flagPart, partsOfFace } from '../src/parts.js';

const page = {
  scene: { files: [{ name: 'a.obj', first_face: 0, faces: 2 }, { name: 'b.obj', first_face: 2, faces: 1 }] },
  parts: [
    { kind: 'component', names: [], faces: Int32Array.of(0, 1, 0) },
    { kind: 'object', names: ['hat', 'body'], faces: Int32Array.of(-1, 1, 0) },
  ],
};
const flagged = (part) => {
  const flags = new Uint8Array(3);
  flagPart(page, part, flags);
  return [...flags];
};

test('a face is of parts by the names that options take', () => {
  assert.deepEqual(partsOfFace(page, 1), [
    { kind: 'component', name: '1' }, { kind: 'object', name: 'body' }, { kind: 'file', name: 'a.obj' }]);
  assert.deepEqual(partsOfFace(page, 0).map(({ kind }) => kind), ['component', 'file']);
  const alone = { ...page, scene: { files: page.scene.files.slice(0, 1) } };
  assert.deepEqual(partsOfFace(alone, 0).map(({ kind }) => kind), ['component']);
});

test('a part is the faces that are of it', () => {
  assert.deepEqual(flagged({ kind: 'component', name: '0' }), [1, 0, 1]);
  assert.deepEqual(flagged({ kind: 'object', name: 'hat' }), [0, 0, 1]);
  assert.deepEqual(flagged({ kind: 'file', name: 'a.obj' }), [1, 1, 0]);
  assert.deepEqual(flagged({ kind: 'object', name: 'shoe' }), [0, 0, 0]);
});
