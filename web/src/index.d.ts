/** Repairs self-intersecting surface meshes; the program and the library unsnarl, compiled to WebAssembly. */

/** x y z of each vertex: flat, or an array of rows. Computed with as 64-bit floats. */
export type Positions = Float64Array | Float32Array | ArrayLike<number>[] | number[];
/** Faces by vertex ids, counted from 0: triangles, flat; an array of rows of any size; or `corners` and `offsets`, where
 * face f has the vertices corners[offsets[f]] to corners[offsets[f + 1] - 1]. */
export type Faces = Int32Array | Uint32Array | Uint16Array | ArrayLike<number>[] | number[] | Polygons;
export interface Polygons {
  corners: Int32Array | Uint32Array | number[];
  offsets: Int32Array | Uint32Array | number[];
}
/** Some of the vertices, or faces: a mask (a Uint8Array with one number each, or booleans), or ids. */
export type Chosen = Uint8Array | boolean[] | Int32Array | Uint32Array | number[];
/** Faces that may intersect: [A, B] of two parts, or those of one part among each other. */
export type Rule = Chosen | [Chosen, Chosen];

export type PairKind = 'disjoint' | 'one_vertex' | 'folded' | 'duplicate' | 'degenerate';
export type Status =
  | 'embedded'
  | 'reduced'
  | 'no_progress'
  | 'obstructed'
  | 'allowed'
  | 'time_limit'
  | 'memory_limit'
  | 'displacement_exceeded'
  | 'gap_not_met'
  | 'cancelled';

export interface SurfaceOptions {
  /** Which vertices count as one: none; ends of open edges at equal positions; all at equal positions. Default "seams". */
  weld?: 'none' | 'seams' | 'all';
  /** Length, from 0 on: vertices this close count as equal. Default 0. */
  weldTolerance?: number;
  /** Faces intersect where they do for any choice of the diagonals of quads. Default false. */
  bothDiagonals?: boolean;
  /** 0: as many as there are. The result does not depend on it. Default 0. */
  threads?: number;
  /** Pairs of faces that may intersect. Default: none. */
  allow?: Rule[];
}

export interface RepairOptions extends SurfaceOptions {
  /** Vertices that must not move. Default: all may. */
  fixed?: Chosen;
  /** Parts, of vertices, that are turned and shifted as one body each. Default: none. */
  rigid?: Chosen[];
  /** "all": no intersecting pair of any kind (default); "disjoint": none of faces that share no vertex. */
  goal?: 'all' | 'disjoint';
  /** Numbers the result must hold in. "auto" (default): 32-bit floats where V is a Float32Array or conflicts lie on
   * coordinates coarse enough for it. */
  precision?: 'auto' | 'float32' | 'float64';
  /** Wanted gap between sheets, a fraction of the diagonal of the bounding box, at most 8 mean widths of the faces. 0
   * (default): just enough to be safe where faces intersect. */
  minGap?: number;
  /** Open gaps only around what intersects, and promise none. Default false. */
  gapNearConflicts?: boolean;
  /** Degrees, [0, 90): faces that are folded together closer are opened. Default 0. */
  minDihedral?: number;
  /** How far any vertex may move, a fraction of the diagonal. 0 (default): any distance. */
  maxDisplacement?: number;
  /** minGap and maxDisplacement are lengths in the units of V. Default false. */
  absolute?: boolean;
  /** Seconds after which to stop. 0 (default): none. */
  timeLimit?: number;
  /** MB that the call may hold. 0 (default): what WebAssembly has, 4295. */
  memoryLimit?: number;
  /** Repair every component as if alone. Default false. */
  eachComponent?: boolean;
  /** false: stop after untangling, for research. Default true. */
  recover?: boolean;
  /** The configuration of the paper, for research: true, or its settings. Default false. */
  paper?: boolean | Record<string, number | string | boolean>;
}

export interface Progress {
  /** [0, 1], never decreases. */
  fraction: number;
  phase: string;
  /** Intersecting pairs of faces at this moment. */
  pairsLeft: number;
  /** Largest displacement at this moment / diagonal of the bounding box. */
  displacementRel: number;
}

/** What asks a call to end: an AbortSignal will do. It is looked at whenever the call tells its progress. */
export interface Cancellation {
  readonly aborted: boolean;
}

export interface RepairControl {
  /** Called a few times a second at most, while the call is at work. What it throws ends the call and is thrown. */
  onProgress?: (progress: Progress) => void;
  /** A call that is asked to end gives what it has reached, with status "cancelled". */
  signal?: Cancellation;
}

export interface Intersections {
  /** Two face ids a < b each, sorted; a == b where a polygon meets itself. */
  pairs: Int32Array;
  /** How the two are related. */
  kinds: PairKind[];
  /** Number of pairs of each kind. */
  counts: Record<PairKind, number>;
}

export interface RepairResult {
  /** In the order of the input; a Float32Array where the input is one and `precision` is not "float64". What did not have
   * to move is bit-identical. */
  V: Float64Array | Float32Array;
  /** "embedded" and "gap_not_met" promise that no two faces intersect, "allowed" that none do but those that may. */
  status: Status;
  /** The document that `unsnarl fix --report` writes. */
  report: Record<string, unknown>;
}

export interface Certificate {
  /** No two faces meet, none has lost its area, no seam has opened. */
  embedded: boolean;
  /** No two faces meet after rounding to 32-bit floats. */
  float32Embedded: boolean;
  pairs: Record<PairKind, number>;
  pairsFloat32: Record<PairKind, number>;
  newZeroAreaFaces: number;
  seamsClosed: boolean;
  allowed: Record<PairKind, number>;
  /** Embedded but for pairs that may intersect. */
  resolved: boolean;
}

export interface Sample {
  name: string;
  description: string;
  /** false: no motion of vertices can embed it. */
  embeddable: boolean;
  parameters: { name: string; value: number; minimum: number; maximum: number; description: string }[];
}

export interface RunOptions {
  /** What lies in the working folder of the program, by name ("in.obj", "frames/1.obj"). Texts are written as UTF-8. */
  files?: Record<string, Uint8Array | string>;
  /** What `-` reads. Default: nothing. */
  input?: Uint8Array;
  /** Called for each line of standard error when it is written; `--progress json` makes lines for programs. What it throws
   * ends the run and is thrown. */
  onOutput?: (line: string) => void;
  /** A run that is asked to end keeps what it has reached, as the program does at Ctrl-C: exit code 6. */
  signal?: Cancellation;
}

export interface RunResult {
  /** As of the program, which lists them in `unsnarl --help`. */
  exitCode: number;
  /** Standard output, as UTF-8. */
  stdout: string;
  stdoutBytes: Uint8Array;
  stderr: string;
  /** All files that the program has written or changed, by name. */
  files: Record<string, Uint8Array>;
}

/** What all calls have in common: what is passed in is never changed; each works in memory of its own, which is gone
 * afterwards. Arguments that make no sense throw TypeError or UnsnarlError. */
export interface Unsnarl {
  readonly version: string;
  /** Runs the program with these arguments, as in ["fix", "in.obj", "-o", "out.obj"], over files in memory. */
  run(args: string[], options?: RunOptions): Promise<RunResult>;
  /** All pairs of faces that meet anywhere but in the hull of the vertices they share, decided exactly. */
  findIntersections(V: Positions, F: Faces, options?: SurfaceOptions): Promise<Intersections>;
  /** Moves the vertices as little as possible so that no two faces intersect. The result is that of `unsnarl fix` on a file
   * of the same numbers, bit for bit. A mesh that could not be untangled throws nothing: `status` says so. */
  repair(V: Positions, F: Faces, options?: RepairOptions, control?: RepairControl): Promise<RepairResult>;
  /** Decides exactly whether the positions `moved` embed the faces of the mesh (V, F). */
  certify(V: Positions, F: Faces, moved: Positions, options?: SurfaceOptions): Promise<Certificate>;
  /** A self-intersecting test surface. resolution: steps along its longest direction, [8, 2000]; 0 (default): its own. */
  sample(
    name: string,
    options?: { resolution?: number; [parameter: string]: number | undefined },
  ): Promise<{ V: Float64Array; F: Int32Array | { corners: Int32Array; offsets: Int32Array } }>;
  samples(): Promise<Sample[]>;
}

export interface LoadOptions {
  /** Where unsnarl_module.wasm is: its address, its bytes or the compiled module. Default: beside this script. */
  wasm?: string | URL | ArrayBuffer | Uint8Array | WebAssembly.Module;
}

/** The calls, made in the thread that calls them: a page does not answer meanwhile. */
export function load(options?: LoadOptions): Promise<Unsnarl>;

/** The same calls, made in a worker, which a page should prefer. `signal` has to be an AbortSignal. Where memory can be
 * shared (Node.js, pages that are cross-origin isolated), a call that is cancelled gives what it has reached; elsewhere it
 * rejects with an AbortError. */
export function loadInWorker(options?: LoadOptions): Promise<Unsnarl & { close(): Promise<void> }>;

/** What the library refuses, or fails of. */
export class UnsnarlError extends Error {
  readonly code:
    | 'invalid_argument'
    | 'cannot_read'
    | 'cannot_write'
    | 'out_of_memory'
    | 'system_error'
    | 'limit_reached'
    | 'internal_error';
}
