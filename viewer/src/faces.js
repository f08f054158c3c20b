/** The polygons of a mesh, over flat lists: corners end to end, and the size of each (null: all are triangles). */
export class Faces {
  constructor(corners, sizes) {
    this.corners = corners;
    this.offsets = null;
    this.count = sizes ? sizes.length : corners.length / 3;
    if (sizes) {
      this.offsets = new Uint32Array(sizes.length + 1);
      for (let f = 0; f < sizes.length; ++f) this.offsets[f + 1] = this.offsets[f] + sizes[f];
    }
  }

  begin(f) {
    return this.offsets ? this.offsets[f] : 3 * f;
  }

  of(f) {
    return this.corners.subarray(this.begin(f), this.begin(f + 1));
  }

  /** Every edge of the polygons once: two vertices an edge. */
  edges() {
    const { corners } = this;
    // Open addressing by the smaller vertex and the larger one.
    const capacity = 2 ** Math.ceil(Math.log2(Math.max(16, 2 * corners.length)));
    const low = new Int32Array(capacity).fill(-1);
    const high = new Int32Array(capacity);
    const found = new Uint32Array(2 * corners.length);
    let size = 0;
    for (let f = 0; f < this.count; ++f) {
      const begin = this.begin(f);
      const end = this.begin(f + 1);
      for (let k = begin; k < end; ++k) {
        const u = corners[k];
        const v = corners[k + 1 < end ? k + 1 : begin];
        const a = Math.min(u, v);
        const b = Math.max(u, v);
        let slot = (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b)) >>> 0 & capacity - 1;
        while (low[slot] >= 0 && (low[slot] !== a || high[slot] !== b)) slot = slot + 1 & capacity - 1;
        if (low[slot] >= 0) continue;
        low[slot] = a;
        high[slot] = b;
        found[size++] = a;
        found[size++] = b;
      }
    }
    return found.slice(0, size);
  }
}

/** Vertex normals, four signed 16-bit numbers a vertex (the last is 0), weighted by area. */
export function vertexNormals(positions, triangles) {
  const sums = new Float32Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    sums[a] += x; sums[a + 1] += y; sums[a + 2] += z;
    sums[b] += x; sums[b + 1] += y; sums[b + 2] += z;
    sums[c] += x; sums[c + 1] += y; sums[c + 2] += z;
  }
  const normals = new Int16Array(positions.length / 3 * 4);
  for (let v = 0; 3 * v < positions.length; ++v) {
    const x = sums[3 * v], y = sums[3 * v + 1], z = sums[3 * v + 2];
    const scale = 32767 / (Math.hypot(x, y, z) || 1);
    normals[4 * v] = x * scale;
    normals[4 * v + 1] = y * scale;
    normals[4 * v + 2] = z * scale;
  }
  return normals;
}
