/**
 * The triangle that a ray meets first, over flat lists: -1 where it meets none. Every triangle is looked at; for a million
 * this takes tens of milliseconds, once a click. Positions are between a and b: (1 - t) a + t b.
 */
export function firstTriangleHit(origin, direction, triangles, a, b, t) {
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  const s = 1 - t;
  let nearest = Infinity;
  let hit = -1;
  for (let i = 0; i < triangles.length; i += 3) {
    const p = 3 * triangles[i], q = 3 * triangles[i + 1], r = 3 * triangles[i + 2];
    const px = s * a[p] + t * b[p], py = s * a[p + 1] + t * b[p + 1], pz = s * a[p + 2] + t * b[p + 2];
    const ux = s * a[q] + t * b[q] - px, uy = s * a[q + 1] + t * b[q + 1] - py, uz = s * a[q + 2] + t * b[q + 2] - pz;
    const vx = s * a[r] + t * b[r] - px, vy = s * a[r + 1] + t * b[r + 1] - py, vz = s * a[r + 2] + t * b[r + 2] - pz;
    // Moller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
    const hx = dy * vz - dz * vy, hy = dz * vx - dx * vz, hz = dx * vy - dy * vx;
    const determinant = ux * hx + uy * hy + uz * hz;
    if (determinant === 0) continue;
    const wx = ox - px, wy = oy - py, wz = oz - pz;
    const u = (wx * hx + wy * hy + wz * hz) / determinant;
    if (!(u >= 0 && u <= 1)) continue;
    const kx = wy * uz - wz * uy, ky = wz * ux - wx * uz, kz = wx * uy - wy * ux;
    const v = (dx * kx + dy * ky + dz * kz) / determinant;
    if (!(v >= 0 && u + v <= 1)) continue;
    const distance = (vx * kx + vy * ky + vz * kz) / determinant;
    if (distance > 0 && distance < nearest) {
      nearest = distance;
      hit = i / 3;
    }
  }
  return hit;
}
