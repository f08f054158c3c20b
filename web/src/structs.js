// The structs of include/unsnarl/unsnarl.h as they lie in the memory of WebAssembly: addresses and sizes have 32 bits.
const kinds = {
  address: { size: 4, put: (view, at, value) => view.setUint32(at, value, true) },
  count: { size: 4, put: (view, at, value) => view.setUint32(at, value, true) },
  int: { size: 4, put: (view, at, value) => view.setInt32(at, value, true) },
  number: { size: 8, put: (view, at, value) => view.setFloat64(at, value, true) },
};

const roundedUp = (offset, step) => Math.ceil(offset / step) * step;

/** fields: [name, kind] in their order. Returns {size, fields: {name: {offset, kind}}}. */
function layout(fields) {
  const placed = {};
  let offset = 0;
  for (const [name, kind] of fields) {
    offset = roundedUp(offset, kinds[kind].size);
    placed[name] = { offset, kind };
    offset += kinds[kind].size;
  }
  const widest = Math.max(...fields.map(([, kind]) => kinds[kind].size));
  return { size: roundedUp(offset, widest), fields: placed };
}

export const surfaceStruct = layout([
  ['size', 'count'],
  ['positions', 'address'],
  ['vertex_count', 'count'],
  ['corners', 'address'],
  ['corner_count', 'count'],
  ['offsets', 'address'],
  ['offset_count', 'count'],
  ['fixed', 'address'],
  ['mesh_sizes', 'address'],
  ['mesh_count', 'count'],
  ['document', 'address'],
  ['rigid', 'address'],
  ['nested', 'address'],
  ['nested_count', 'count'],
  ['rigid_names', 'address'],
  ['rigid_name_count', 'count'],
  ['nested_surface', 'address'],
  ['nested_names', 'address'],
  ['nested_name_count', 'count'],
  ['face_parts', 'address'],
  ['allowed', 'address'],
  ['allowed_count', 'count'],
]);

export const optionsStruct = layout([
  ['size', 'count'],
  ['weld', 'address'],
  ['weld_tolerance', 'number'],
  ['both_diagonals', 'int'],
  ['threads', 'int'],
  ['goal', 'address'],
  ['precision', 'address'],
  ['min_gap', 'number'],
  ['max_displacement', 'number'],
  ['absolute', 'int'],
  ['min_dihedral', 'number'],
  ['memory_limit', 'number'],
  ['each_component', 'int'],
  ['paper', 'int'],
  ['time_limit', 'number'],
  ['recover', 'int'],
  ['first_frame', 'count'],
  ['last_frame', 'count'],
  ['gap', 'number'],
  ['junction', 'number'],
  ['fix_ends', 'int'],
  ['edge', 'number'],
  ['views', 'int'],
  ['fair', 'int'],
  ['points', 'int'],
  ['paper_bandwidth', 'address'],
  ['paper_adaptive', 'int'],
  ['paper_bandwidth_scale', 'number'],
  ['paper_neighbourhood', 'number'],
  ['paper_gaussian', 'number'],
  ['paper_mesh', 'number'],
  ['paper_mesh_energy', 'address'],
  ['paper_whole_polygons', 'int'],
  ['paper_arap', 'number'],
  ['paper_memory', 'int'],
  ['paper_iterations', 'int'],
  ['spacing', 'number'],
  ['handles', 'int'],
  ['keep_partial', 'int'],
  ['no_partial', 'int'],
  ['gap_near_conflicts', 'int'],
  ['move_strands', 'int'],
  ['pairs', 'address'],
]);

/** Writes these values into a struct that begins at address `at`. */
export function fill(memory, struct, at, values) {
  const view = new DataView(memory);
  for (const [name, value] of Object.entries(values)) {
    const { offset, kind } = struct.fields[name];
    kinds[kind].put(view, at + offset, value);
  }
}
