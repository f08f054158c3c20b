import assert from 'node:assert/strict';
import test from 'node:test';
import { heatRanges } from '../src/legend.js';
import { count, duration, short } from '../src/numbers.js';

test('numbers are short and grouped', () => {
  assert.equal(count(1234567), '1\u202f234\u202f567');
  assert.equal(short(0.012345), '0.0123');
  assert.equal(short(-2), '−2');
  assert.equal(short(1.26e-7), '1.3e−7');
  assert.equal(short(2.5e9), '2.5e9');
  assert.equal(short(1e-6), '1e−6');
  assert.equal(short(NaN), '–');
  assert.equal(duration(75), '1 min 15 s');
});

test('the shorter range of displacements leaves the furthest hundredth out', () => {
  const displacement = new Float32Array(1000);
  for (let i = 0; i < 200; ++i) displacement[i] = i + 1;
  assert.deepEqual(heatRanges(displacement), { all: 200, most: 198 });
  assert.deepEqual(heatRanges(new Float32Array(3)), { all: 1, most: 1 });
});
