// Calls on arrays.
import { allowedOf, faceCountOf, facesOf, flagsOf, positionsOf, rigidNumbersOf } from './arguments.js';
import { Library } from './library.js';

const surfaceOptions = ['weld', 'weldTolerance', 'bothDiagonals', 'threads'];
const repairOptions = [
  ...surfaceOptions,
  'goal',
  'precision',
  'minGap',
  'gapNearConflicts',
  'minDihedral',
  'maxDisplacement',
  'absolute',
  'timeLimit',
  'memoryLimit',
  'eachComponent',
  'recover',
];

const snakeCase = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
const camelCase = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const renamed = (object, rename) =>
  Object.fromEntries(Object.entries(object).map(([name, value]) => [rename(name), value]));

function checkedOption(name, value) {
  if (!['string', 'number', 'boolean'].includes(typeof value))
    throw new TypeError(`${name} is ${value}; see the types of this package`);
  if (typeof value === 'number' && !(value >= 0 && value < Infinity))
    throw new TypeError(`${name} is ${value}; give a number from 0 on`);
  return value;
}

/** Options by the names of the library; undefined ones are left at their defaults. */
function optionsOf(given, known) {
  const set = Object.entries(given).filter(([, value]) => value !== undefined);
  for (const [name] of set)
    if (!known.includes(name)) throw new TypeError(`there is no option "${name}" here; there are: ${known.join(', ')}`);
  return Object.fromEntries(set.map(([name, value]) => [snakeCase(name), checkedOption(name, value)]));
}

function paperOptionsOf(paper) {
  if (paper === undefined || paper === false) return {};
  if (paper === true) return { paper };
  return { paper: true, ...renamed(paper, (name) => `paper_${snakeCase(name)}`) };
}

function meshOf(V, F, allow) {
  const positions = positionsOf(V);
  const faces = facesOf(F);
  return {
    positions,
    vertexCount: positions.length / 3,
    fields: {
      positions,
      vertex_count: positions.length / 3,
      corners: faces.corners,
      corner_count: faces.corners.length,
      offsets: faces.offsets,
      offset_count: faces.offsets.length,
      ...(allow === undefined ? {} : allowedOf(allow, faceCountOf(faces))),
    },
  };
}

const splitOf = (pairKinds, kinds) =>
  Object.fromEntries(pairKinds.map((name, kind) => [name, kinds.filter((one) => one === kind).length]));

export async function findIntersections(compiled, V, F, { allow, ...given } = {}) {
  const options = optionsOf(given, surfaceOptions);
  const mesh = meshOf(V, F, allow);
  const library = await Library.open(compiled);
  const found = library.call('find_intersections', library.surface(mesh.fields), library.options(options));
  const pairKinds = library.pairKinds();
  const kinds = found.array('kinds');
  return {
    pairs: found.array('pairs'),
    kinds: Array.from(kinds, (kind) => pairKinds[kind]),
    counts: splitOf(pairKinds, kinds),
  };
}

export async function certify(compiled, V, F, moved, { allow, ...given } = {}) {
  const options = optionsOf(given, surfaceOptions);
  const mesh = meshOf(V, F, allow);
  const positions = positionsOf(moved, 'moved');
  const library = await Library.open(compiled);
  const found = library.call(
    'certify',
    library.surface(mesh.fields),
    library.copied(positions),
    positions.length / 3,
    library.options(options),
  );
  return renamed(found.report, camelCase);
}

export async function repair(
  compiled,
  V,
  F,
  { fixed, rigid, allow, paper, ...given } = {},
  { onProgress, signal } = {},
) {
  const isSingle = V instanceof Float32Array;
  const options = { ...optionsOf(given, repairOptions), ...paperOptionsOf(paper) };
  if (isSingle && (options.precision ?? 'auto') === 'auto') options.precision = 'float32';
  const mesh = meshOf(V, F, allow);
  if (fixed !== undefined) mesh.fields.fixed = flagsOf(fixed, 'fixed', mesh.vertexCount, 'vertices');
  if (rigid !== undefined) mesh.fields.rigid = rigidNumbersOf(rigid, mesh.vertexCount);
  let failure;
  const tell = (fraction, phase, pairsLeft, displacementRel) => {
    try {
      onProgress?.({ fraction, phase, pairsLeft, displacementRel });
    } catch (error) {
      failure ??= error; // thrown when the library, which is asked to end, has done so
    }
    return failure !== undefined || (signal?.aborted ?? false);
  };
  const library = await Library.open(compiled, { onProgress: tell });
  const result = library.call('repair', library.surface(mesh.fields), library.options(options), library.context());
  if (failure !== undefined) throw failure;
  const positions = result.array('positions');
  const isNarrow = isSingle && options.precision === 'float32';
  return { V: isNarrow ? Float32Array.from(positions) : positions, status: result.status, report: result.report };
}

export const samples = async (compiled) => (await Library.open(compiled)).call('list_samples').report;

export async function sample(compiled, name, { resolution = 0, ...parameters } = {}) {
  const library = await Library.open(compiled);
  const made = library.call('sample', library.text(String(name)), resolution, library.text(JSON.stringify(parameters)));
  const [corners, offsets] = [made.array('corners'), made.array('offsets')];
  return { V: made.array('positions'), F: offsets.length === 0 ? corners : { corners, offsets } };
}
