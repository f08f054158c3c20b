/**
 * A part of the mesh, as options of the program name it: { kind: 'component', 'object', 'group', 'material' or 'file',
 * name: of a component its number }.
 */

/** The parts that a face is of, the smallest kind first. */
export function partsOfFace({ parts, scene }, face) {
  const found = parts.map(({ kind, names, faces }) => ({ kind, at: faces[face], names }))
    .filter(({ at }) => at >= 0)
    .map(({ kind, at, names }) => ({ kind, name: names.length ? names[at] : String(at) }));
  const file = (scene.files ?? []).length > 1 && scene.files.find((f) => face >= f.first_face && face < f.first_face + f.faces);
  return file ? [...found, { kind: 'file', name: file.name }] : found;
}

/** Adds the faces of a part to `flags`, one a face. */
export function flagPart({ parts, scene }, { kind, name }, flags) {
  if (kind === 'file') {
    for (const { name: own, first_face: first, faces } of scene.files) if (own === name) flags.fill(1, first, first + faces);
    return;
  }
  for (const part of parts) {
    const at = part.kind !== kind ? -1 : part.names.length ? part.names.indexOf(name) : Number(name);
    if (at >= 0) for (let f = 0; f < part.faces.length; ++f) if (part.faces[f] === at) flags[f] = 1;
  }
}

export const samePart = (a, b) => a.kind === b.kind && a.name === b.name;
