import { element } from './element.js';
import { plural } from './numbers.js';

/** So many colours there are in style.css; further files begin again. */
export const fileColours = 6;

/** Corners of the triangles of each file of the scene, or of the one mesh. Triangles lie in the order of their faces. */
export function trianglesOfFiles({ scene, triangles, triangleFaces }) {
  if (!scene.files?.length) return [triangles];
  const count = triangles.length / 3;
  const firstFrom = (face) => {  // the first triangle of this face or a later one
    if (!triangleFaces) return Math.min(face, count);
    let low = 0, high = count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (triangleFaces[middle] < face) low = middle + 1;
      else high = middle;
    }
    return low;
  };
  return scene.files.map(({ first_face: first, faces }) =>
    triangles.subarray(3 * firstFrom(first), 3 * firstFrom(first + faces)));
}

/** The files of a scene with their colours; null where there is only one. */
export function fileList({ files }) {
  if (!files || files.length < 2) return null;
  return element('ul', { class: 'files' }, files.map(({ name, faces }, i) => element('li', {},
    element('span', { class: 'swatch', style: `background: var(--file-${i % fileColours})` }),
    element('span', {}, name), element('small', {}, plural(faces, 'face', 'faces')))));
}
