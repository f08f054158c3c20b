import { bytesOfBase64 } from './packed_words.js';

/** Pixels of a side; larger images are scaled down to it: 22 MB of graphics memory each. */
const largestSide = 2048;

/** One image of the page, decoded; null where the browser cannot. */
async function readImage(root, { media_type: type, width, height }, i) {
  try {
    const bytes = bytesOfBase64(root.getElementById(`image_${i}`).textContent);
    const scale = Math.min(1, largestSide / Math.max(width, height));
    return await createImageBitmap(new Blob([bytes], { type }), {
      resizeWidth: Math.max(1, Math.round(scale * width)),
      resizeHeight: Math.max(1, Math.round(scale * height)),
      resizeQuality: 'high',
      premultiplyAlpha: 'none',
      colorSpaceConversion: 'none',
    });
  } catch {
    return null;
  }
}

/**
 * How the faces look in the file; null where it says nothing of that.
 *
 *   materials     [{ colour: [r, g, b] in [0, 1], image: a bitmap or null, alpha_cutoff, wrap: [u, v] }]
 *   faceMaterials the material of each face, or -1
 *   uv            2 numbers a vertex and a copy of one; null where there are no images
 *   triangles     as those of the page, but with copies of vertices: those after the page's own
 *   copies        the vertex that each of them copies
 *   notes         what is not shown, a sentence each
 *
 * list(id): the list of this name in the page, or null.
 */
export async function readAppearance(root, scene, triangles, list) {
  const described = scene.appearance;
  if (!described) return null;
  const images = await Promise.all(described.images.map((image, i) => readImage(root, image, i)));
  const undecoded = described.images.filter((_, i) => !images[i])
    .map(({ name }) => `Image ${name} is left out: this browser cannot decode it.`);
  return {
    materials: described.materials.map((material) => ({ ...material, image: images[material.image] ?? null })),
    faceMaterials: await list('face_materials'),
    uv: await list('texture_uv'),
    triangles: await list('texture_triangles') ?? triangles,
    copies: await list('texture_copies') ?? new Int32Array(0),
    notes: [...described.notes, ...undecoded],
  };
}

/**
 * Corners of the triangles that look alike: [{ material, file, triangles }], material null where faces have none, and
 * then of one file each.
 */
export function trianglesOfMaterials({ scene, appearance, triangleFaces }) {
  const { faceMaterials, materials, triangles } = appearance;
  const ends = (scene.files ?? []).map((file) => file.first_face + file.faces);
  const total = triangles.length / 3;
  let file = 0;
  const groups = new Map();
  const keys = new Int32Array(total);  // the material, or -1 - file
  for (let t = 0; t < total; ++t) {
    const face = triangleFaces ? triangleFaces[t] : t;
    while (file + 1 < ends.length && face >= ends[file]) ++file;
    keys[t] = faceMaterials[face] >= 0 ? faceMaterials[face] : -1 - file;
    groups.set(keys[t], (groups.get(keys[t]) ?? 0) + 1);
  }
  for (const [key, count] of groups) groups.set(key, { corners: new Uint32Array(3 * count), at: 0 });
  for (let t = 0; t < total; ++t) {
    const group = groups.get(keys[t]);
    for (let k = 0; k < 3; ++k) group.corners[group.at++] = triangles[3 * t + k];
  }
  return [...groups].sort(([a], [b]) => a - b).map(([key, { corners }]) => ({
    material: key >= 0 ? materials[key] : null, file: key >= 0 ? 0 : -1 - key, triangles: corners,
  }));
}

/** A list of `size` numbers a vertex, with those of the copies behind them; the list itself where there are none. */
export function withCopies(values, size, copies) {
  if (!copies?.length) return values;
  const result = new values.constructor(values.length + size * copies.length);
  fillWithCopies(result, values, size, copies);
  return result;
}

/** The same into a list that is there. */
export function fillWithCopies(result, values, size, copies) {
  result.set(values);
  if (!copies) return;
  for (let i = 0; i < copies.length; ++i)
    for (let k = 0; k < size; ++k) result[values.length + size * i + k] = values[size * copies[i] + k];
}
