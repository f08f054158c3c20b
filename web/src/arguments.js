// Meshes and choices of vertices and faces, as callers give them, made into the flat arrays of the library.

const mostId = 0x7fffffff;

const isTyped = (values) => ArrayBuffer.isView(values) && !(values instanceof DataView);

function listOf(values, name) {
  if (isTyped(values) || Array.isArray(values)) return values;
  throw new TypeError(`${name} is ${values === null ? 'null' : `a ${typeof values}`}; give a typed array or an array`);
}

const isOfRows = (values) =>
  Array.isArray(values) && values.length > 0 && values.every((row) => isTyped(row) || Array.isArray(row));

const flatRows = (rows) => rows.flatMap((row) => Array.from(row));

/** x y z of each vertex as a Float64Array. V: flat, or an array of rows of three. */
export function positionsOf(V, name = 'V') {
  const given = listOf(V, name);
  if (isOfRows(given)) {
    const odd = given.findIndex((row) => row.length !== 3);
    if (odd >= 0) throw new TypeError(`${name}[${odd}] has ${given[odd].length} numbers; give x y z of each vertex`);
  }
  const flat = isOfRows(given) ? flatRows(given) : given;
  if (flat.length % 3 !== 0) throw new TypeError(`${name} has ${flat.length} numbers; give x y z of each vertex`);
  if (!isTyped(flat)) {
    const odd = flat.findIndex((value) => typeof value !== 'number');
    if (odd >= 0) throw new TypeError(`${name} holds a ${typeof flat[odd]}; positions are numbers`);
  }
  return Float64Array.from(flat);
}

function ids(values, name) {
  const given = listOf(values, name);
  for (let i = 0; i < given.length; ++i)
    if (!Number.isInteger(given[i]) || Math.abs(given[i]) > mostId)
      throw new TypeError(`${name}[${i}] is ${given[i]}; ids are whole numbers up to ${mostId}`);
  return Int32Array.from(given);
}

function trianglesOrPolygons(rows) {
  const odd = rows.findIndex((row) => row.length < 3);
  if (odd >= 0) throw new TypeError(`F[${odd}] has ${rows[odd].length} corners; a face has at least 3`);
  const corners = ids(flatRows(rows), 'F');
  if (rows.every((row) => row.length === 3)) return { corners, offsets: new Int32Array() };
  const offsets = new Int32Array(rows.length + 1);
  rows.forEach((row, f) => (offsets[f + 1] = offsets[f] + row.length));
  return { corners, offsets };
}

function polygons({ corners, offsets }) {
  const faces = { corners: ids(corners, 'corners'), offsets: ids(offsets, 'offsets') };
  const last = faces.offsets.at(-1);
  if (faces.offsets[0] !== 0 || last !== faces.corners.length)
    throw new TypeError(
      `offsets run from ${faces.offsets[0]} to ${last}; give them from 0 to ${faces.corners.length}, the number of corners`,
    );
  const odd = faces.offsets.findIndex((offset, f) => f > 0 && offset - faces.offsets[f - 1] < 3);
  if (odd > 0)
    throw new TypeError(
      `face ${odd - 1} runs from offset ${faces.offsets[odd - 1]} to ${faces.offsets[odd]}; a face has at least 3 corners`,
    );
  return faces;
}

/** {corners, offsets} of faces; offsets are empty where all are triangles. F: flat triangles, rows, or {corners, offsets}. */
export function facesOf(F) {
  if (F !== null && typeof F === 'object' && 'corners' in F && 'offsets' in F) return polygons(F);
  if (isOfRows(F)) return trianglesOrPolygons(F);
  const corners = ids(F, 'F');
  if (corners.length % 3 !== 0)
    throw new TypeError(`F has ${corners.length} ids; give three for each triangle, rows, or {corners, offsets}`);
  return { corners, offsets: new Int32Array() };
}

export const faceCountOf = ({ corners, offsets }) => (offsets.length > 0 ? offsets.length - 1 : corners.length / 3);

/** One flag each. chosen: a mask (a Uint8Array, or booleans), or ids. */
export function flagsOf(chosen, name, count, things) {
  const given = listOf(chosen, name);
  const isMask =
    given instanceof Uint8Array ||
    given instanceof Uint8ClampedArray ||
    given.some((value) => typeof value === 'boolean');
  if (isMask) {
    if (given.length !== count)
      throw new TypeError(`${name} has ${given.length} flags, but there are ${count} ${things}`);
    return Uint8Array.from(given, (flag) => (flag ? 1 : 0));
  }
  const flags = new Uint8Array(count);
  ids(given, name).forEach((id, i) => {
    if (id < 0 || id >= count)
      throw new TypeError(`${name}[${i}] is ${id}, but there are ${count} ${things} (counted from 0)`);
    flags[id] = 1;
  });
  return flags;
}

/** The rigid part of each vertex, -1: none. */
export function rigidNumbersOf(parts, vertexCount) {
  if (!Array.isArray(parts) || parts.some((part) => !isTyped(part) && !Array.isArray(part)))
    throw new TypeError('rigid is an array of parts, each a mask or ids of vertices: rigid: [ids] for one');
  const numbers = new Int32Array(vertexCount).fill(-1);
  parts.forEach((part, number) => {
    flagsOf(part, `rigid[${number}]`, vertexCount, 'vertices').forEach((flag, v) => {
      if (!flag) return;
      if (numbers[v] >= 0)
        throw new TypeError(`rigid[${numbers[v]}] and rigid[${number}] have vertex ${v} in common; join them to one`);
      numbers[v] = number;
    });
  });
  return numbers;
}

const sidesOf = (rule) =>
  Array.isArray(rule) && rule.length === 2 && rule.every((side) => isTyped(side) || Array.isArray(side))
    ? rule
    : [rule, rule];

/** {face_parts, allowed}: the part of each face, and pairs of parts that may intersect. allow: rules, [A, B] of two parts
 * or one part A, each a mask or ids of faces. */
export function allowedOf(allow, faceCount) {
  if (!Array.isArray(allow))
    throw new TypeError('allow is an array: of [A, B], parts that may pass through each other, or of single parts');
  const rules = allow.map((rule, number) =>
    sidesOf(rule).map((side) => flagsOf(side, `allow[${number}]`, faceCount, 'faces')),
  );
  const parts = new Int32Array(faceCount);
  for (const flags of rules.flat()) {
    const keys = parts.map((part, f) => 2 * part + flags[f]);
    const sorted = [...new Set(keys)].sort((a, b) => a - b);
    const numbers = new Map(sorted.map((key, number) => [key, number]));
    keys.forEach((key, f) => (parts[f] = numbers.get(key)));
  }
  const first = new Map();
  parts.forEach((part, f) => first.has(part) || first.set(part, f));
  const mayPass = (a, b) => rules.some(([A, B]) => A[first.get(a)] && B[first.get(b)]);
  const pairs = [];
  for (let a = 0; a < first.size; ++a)
    for (let b = a; b < first.size; ++b) if (mayPass(a, b) || mayPass(b, a)) pairs.push(a, b);
  return { face_parts: parts, allowed: Int32Array.from(pairs), allowed_count: pairs.length / 2 };
}
