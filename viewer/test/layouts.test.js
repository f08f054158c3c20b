import assert from 'node:assert/strict';
import test from 'node:test';
import { viewsOf } from '../src/layouts.js';

test('two views lie side by side, or below each other where the canvas is tall', () => {
  const rects = (tall) => viewsOf({ layout: 'pair' }, tall).map(({ rect, clip, t }) => {
    assert.deepEqual(rect, clip);
    return [rect.x, rect.y, rect.width, rect.height, t];
  });
  assert.deepEqual(rects(false), [[0, 0, 0.5, 1, 0], [0.5, 0, 0.5, 1, 1]]);
  assert.deepEqual(rects(true), [[0, 0, 1, 0.5, 0], [0, 0.5, 1, 0.5, 1]]);
});

test('other layouts fill the canvas', () => {
  for (const layout of ['wipe', 'blend', 'replay', 'single'])
    for (const view of viewsOf({ layout, blend: 0.3, divider: 0.4 }, true)) assert.equal(view.rect.width * view.rect.height, 1);
});
