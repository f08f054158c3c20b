import assert from 'node:assert/strict';
import test from 'node:test';
import { deflateSync } from 'node:zlib';
import { bytesOfBase64, joinPlanes, unpackWords } from '../src/packed_words.js';

/** As src/render/packed_words.cpp does it. */
function packed(words, expected) {
  const planes = new Uint8Array(4 * words.length);
  words.forEach((word, i) => {
    const difference = (word - expected(i)) >>> 0;
    const code = (difference << 1 ^ -(difference >>> 31)) >>> 0;
    for (let k = 0; k < 4; ++k) planes[k * words.length + i] = code >>> 8 * k;
  });
  return planes;
}

const base64 = (planes) => deflateSync(planes).toString('base64');
const extremes = [0, 1, 0xffffffff, 0x80000000, 0x7fffffff, 12345, 12346, 3];

test('base64 gives all bytes back', () => {
  const bytes = Uint8Array.from({ length: 257 }, (_, i) => i * 37);
  assert.deepEqual(bytesOfBase64(Buffer.from(bytes).toString('base64')), bytes);
});

test('differences with a stride are summed, modulo 2^32', () => {
  for (const stride of [0, 1, 3]) {
    const planes = packed(extremes, (i) => (stride > 0 && i >= stride ? extremes[i - stride] : 0));
    assert.deepEqual([...joinPlanes(planes, extremes.length, { stride })], extremes);
  }
});

test('a list like another one', async () => {
  const like = new Float32Array([1, -2.5, 1e-30, 3e30]);
  const values = new Float32Array([1, -2.25, 1e-30, NaN]);
  const bits = (list) => [...new Uint32Array(list.buffer)];
  const text = base64(packed(bits(values), (i) => bits(like)[i]));
  const read = await unpackWords(text, { kind: 'float', count: 4, like });
  assert.deepEqual(bits(read), bits(values));
});

test('integers keep their sign, and an empty list needs no text', async () => {
  const read = await unpackWords(base64(packed([0xffffffff, 7], () => 0)), { kind: 'int', count: 2, stride: 0 });
  assert.deepEqual([...read], [-1, 7]);
  assert.equal((await unpackWords('', { kind: 'int', count: 0 })).length, 0);
});

test('a list of the wrong length is refused', async () => {
  await assert.rejects(unpackWords(base64(packed([1, 2], () => 0)), { kind: 'int', count: 3 }), /bytes/);
});
