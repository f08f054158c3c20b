/** Plays the recorded frames: positions at each, from what has moved since the frame before. */
export class FramePlayer {
  constructor(frames, rest) {
    this.frames = frames;
    this.rest = rest;
    this.positions = rest.slice();
    this.displacement = new Float32Array(rest.length / 3);
    this.at = -1;
  }

  /** Goes to frame k; `positions`, and `displacement` (lengths), are its then. */
  seek(k) {
    if (k < this.at) {
      this.positions.set(this.rest);
      this.displacement.fill(0);
      this.at = -1;
    }
    while (this.at < k) this.#apply(this.frames[++this.at]);
    return this.frames[k];
  }

  #apply({ vertices, displacements }) {
    for (let i = 0; i < vertices.length; ++i) {
      const v = vertices[i];
      const x = displacements[3 * i], y = displacements[3 * i + 1], z = displacements[3 * i + 2];
      this.positions[3 * v] = this.rest[3 * v] + x;
      this.positions[3 * v + 1] = this.rest[3 * v + 1] + y;
      this.positions[3 * v + 2] = this.rest[3 * v + 2] + z;
      this.displacement[v] = Math.hypot(x, y, z);
    }
  }
}
