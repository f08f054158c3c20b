/** Which faces intersect which, from (face, face, class) triples. */
export class Conflicts {
  constructor(pairs, faceCount, classNames) {
    this.pairs = pairs;
    this.classNames = classNames;
    this.count = pairs.length / 3;
    this.countByClass = new Array(classNames.length).fill(0);
    this.isRed = new Uint8Array(faceCount);
    for (let i = 0; i < pairs.length; i += 3) {
      this.countByClass[pairs[i + 2]] += 1;
      this.isRed[pairs[i]] = 1;
      this.isRed[pairs[i + 1]] = 1;
    }
  }

  /** The faces that intersect this one: [{ face, kind }], kind an index of classNames. */
  partners(face) {
    const found = [];
    if (!this.isRed[face]) return found;
    for (let i = 0; i < this.pairs.length; i += 3) {
      if (this.pairs[i] === face) found.push({ face: this.pairs[i + 1], kind: this.pairs[i + 2] });
      else if (this.pairs[i + 1] === face) found.push({ face: this.pairs[i], kind: this.pairs[i + 2] });
    }
    return found;
  }
}

/** Positions in a list of triangles, three a triangle, of those whose face is chosen. */
export function trianglesOfFaces(triangles, triangleFaces, isChosen) {
  let count = 0;
  const total = triangles.length / 3;
  const faceOf = triangleFaces ? (t) => triangleFaces[t] : (t) => t;
  for (let t = 0; t < total; ++t) count += isChosen(faceOf(t)) ? 3 : 0;
  const chosen = new Uint32Array(count);
  let at = 0;
  for (let t = 0; t < total; ++t) {
    if (!isChosen(faceOf(t))) continue;
    chosen[at++] = triangles[3 * t];
    chosen[at++] = triangles[3 * t + 1];
    chosen[at++] = triangles[3 * t + 2];
  }
  return chosen;
}
