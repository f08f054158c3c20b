import { Trouble } from './trouble.js';

/** Files that belong to a mesh, and are none: materials, images, buffers. */
const companions = /\.(mtl|png|jpe?g|webp|gif|bmp|tga|bin|dat)$/i;
/** Files that hide others. */
const archives = /\.(zip|gz|7z|rar|tar|tgz|xz|bz2)$/i;

/** What an entry of a drop holds: [{ name, file }], names with folders in front. */
async function filesOfEntry(entry, folder = '') {
  if (entry.isFile) return [{ name: folder + entry.name, file: await new Promise((take, fail) => entry.file(take, fail)) }];
  const reader = entry.createReader();
  const found = [];
  for (;;) {  // a reader gives a hundred at a time
    const more = await new Promise((take, fail) => reader.readEntries(take, fail));
    if (more.length === 0) break;
    found.push(...more);
  }
  const nested = await Promise.all(found.map((inner) => filesOfEntry(inner, `${folder}${entry.name}/`)));
  return nested.flat();
}

/** The files of a drop, and of the folders in it: [{ name, file }]. */
export async function filesOfDrop({ items, files }) {
  // Entries are there only until the event has passed.
  const entries = [...items ?? []].filter(({ kind }) => kind === 'file').map((item) => item.webkitGetAsEntry?.());
  if (entries.length && entries.every(Boolean))
    return (await Promise.all(entries.map((entry) => filesOfEntry(entry)))).flat();
  return filesOfList(files);
}

export const filesOfList = (list) => [...list].map((file) => ({ name: file.name, file }));

/**
 * What to open: { meshes: names in their order, files: { name: Uint8Array } of all }. Throws Trouble
 * where there is no mesh among them, or one cannot be read.
 */
export async function readInput(list) {
  const shown = list.filter(({ name }) => !/(^|\/)\./.test(name));
  const meshes = shown.map(({ name }) => name).filter((name) => !companions.test(name))
    .sort((a, b) => a.localeCompare(b, 'en', { numeric: true }));
  const packed = meshes.find((name) => archives.test(name));
  if (packed) throw new Trouble(`${packed} cannot be read`, 'It is an archive. Unpack it, and drop the files that are in it.');
  if (meshes.length === 0)
    throw new Trouble('There is no mesh in this', shown.length
      ? `${shown.map(({ name }) => name).join(', ')} belongs to a mesh. Drop the mesh together with it.` : 'Nothing was in it.');
  const bytes = await Promise.all(shown.map(async ({ name, file }) => {
    try {
      return [name, new Uint8Array(await file.arrayBuffer())];
    } catch {
      throw new Trouble(`${name} cannot be read`, 'The browser has no access to it, or it is too large for a page.');
    }
  }));
  return { meshes, files: Object.fromEntries(bytes) };
}
