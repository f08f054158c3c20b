/** Reads what src/render/packed_words.cpp writes: lists of 32-bit words as differences, byte planes, zlib, base64. */

export function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Byte planes -> words; stride > 0: differences to the word so many places before; like: to the words of a list. */
export function joinPlanes(planes, count, { stride = 0, like = null } = {}) {
  const words = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const code = planes[i] | planes[count + i] << 8 | planes[2 * count + i] << 16 | planes[3 * count + i] << 24;
    const difference = code >>> 1 ^ -(code & 1);
    words[i] = difference + (like ? like[i] : stride > 0 && i >= stride ? words[i - stride] : 0);
  }
  return words;
}

/** kind: 'float' or 'int'; the result is a Float32Array or an Int32Array of `count` words. */
export async function unpackWords(text, { kind, count, stride, like }) {
  if (count === 0) return kind === 'float' ? new Float32Array(0) : new Int32Array(0);
  const planes = await inflated(bytesOfBase64(text));
  if (planes.length !== 4 * count) throw new Error(`a list of this page holds ${planes.length} bytes, not ${4 * count}`);
  const likeWords = like ? new Uint32Array(like.buffer, like.byteOffset, like.length) : null;
  const { buffer } = joinPlanes(planes, count, { stride, like: likeWords });
  return kind === 'float' ? new Float32Array(buffer) : new Int32Array(buffer);
}
