/** Classes of intersecting pairs as the summary of the program words them: "disjoint" would sound like not intersecting. */
const words = {
  disjoint: 'sharing no vertex',
  one_vertex: 'sharing a vertex',
  folded: 'folded along an edge',
  duplicate: 'on the same vertices',
  degenerate: 'of a face without area',
};

export const classInWords = (name) => words[name] ?? name.replace('_', '-');
