import { readAppearance } from './appearance.js';
import { unpackWords } from './packed_words.js';

/** The lists in a page are its elements <script id=... data-kind data-count data-stride|data-like>. */
async function readList(root, id) {
  const element = root.getElementById(id);
  if (!element) return null;
  const { kind, count, stride, like } = element.dataset;
  const words = await unpackWords(element.textContent, {
    kind, count: Number(count), stride: Number(stride ?? 0), like: like ? await readList(root, like) : null,
  });
  return words;
}

/**
 * All that the page shows; lengths in units of the diagonal of the input's bounding box, around its middle.
 *
 *   scene       what make_page wrote as JSON: names, counts, diagonal, camera, report
 *   before      { positions, pairs, curves }: 3 n floats; (face, face, class) triples; 6 floats a segment
 *   after       the same, or null
 *   displacement  length of each vertex's motion, or null
 *   appearance    see readAppearance
 *   parts       [{ kind, names, faces: the part of each face, see parts.js }]
 *   corners, sizes (null: triangles), triangles, triangleFaces (null: triangles are the faces)
 */
export async function readPage(root) {
  const text = root.getElementById('scene')?.textContent;
  if (!text) throw new Error('there is no mesh in this page; `unsnarl view IN -o page.html` writes pages with one');
  const scene = JSON.parse(text);
  const list = (id) => readList(root, id);
  const state = async (suffix) => {
    const positions = await list(`positions_${suffix}`);
    if (!positions) return null;
    return { positions, pairs: await list(`pairs_${suffix}`), curves: await list(`curves_${suffix}`) };
  };
  const corners = await list('corners');
  const triangles = await list('triangles') ?? corners;
  return {
    scene,
    before: await state('before'),
    after: await state('after'),
    displacement: await list('displacement'),
    appearance: await readAppearance(root, scene, triangles, list),
    corners,
    sizes: await list('sizes'),
    triangles,
    triangleFaces: await list('triangle_faces'),
    parts: await Promise.all(scene.parts.map(async (part, k) => ({ ...part, faces: await list(`part_faces_${k}`) }))),
    frames: readFrames(scene.frames ?? [], {
      vertices: await list('frame_vertices'),
      displacements: await list('frame_displacements'),
      faces: await list('frame_faces'),
    }),
  };
}

/** Recorded frames: what the JSON says of each, with its parts of the lists. */
function readFrames(frames, lists) {
  let vertex = 0;
  let face = 0;
  return frames.map((frame) => {
    const vertices = lists.vertices.subarray(vertex, vertex + frame.moved);
    const displacements = lists.displacements.subarray(3 * vertex, 3 * (vertex + frame.moved));
    const faces = lists.faces.subarray(face, face + frame.faces);
    vertex += frame.moved;
    face += frame.faces;
    return { ...frame, vertices, displacements, faces };
  });
}
