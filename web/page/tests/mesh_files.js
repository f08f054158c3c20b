// The same triangles in every format that the program reads: { name: bytes } each, the mesh first.

const text = (...lines) => Buffer.from(`${lines.flat().join('\n')}\n`);

/** Vertices and triangles of an OBJ file; polygons are cut from their first corner. */
export function readObj(bytes) {
  const V = [], F = [];
  for (const line of bytes.toString().split('\n')) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v') V.push(words.slice(0, 3).map((word) => Math.fround(Number(word))));
    if (kind !== 'f') continue;
    const corners = words.map((word) => Number.parseInt(word, 10) - 1);
    for (let k = 1; k + 1 < corners.length; ++k) F.push([corners[0], corners[k], corners[k + 1]]);
  }
  return { V, F };
}

const join = (rows) => rows.map((row) => row.join(' '));

function binary({ V, F }, write, number) {
  const bytes = Buffer.alloc(12 * V.length + 12 * F.length);
  V.flat().forEach((x, i) => bytes[write](x, 4 * i));
  F.flat().forEach((v, i) => bytes[number](v, 12 * V.length + 4 * i));
  return bytes;
}

const stl = ({ V, F }) => text('solid mesh', F.map((f) => ['facet normal 0 0 0', 'outer loop',
  ...f.map((v) => `vertex ${V[v].join(' ')}`), 'endloop', 'endfacet']).flat(), 'endsolid mesh');

const off = ({ V, F }) => text('OFF', `${V.length} ${F.length} 0`, join(V), F.map((f) => `3 ${f.join(' ')}`));

const ply = ({ V, F }) => text('ply', 'format ascii 1.0', `element vertex ${V.length}`, 'property float x', 'property float y',
  'property float z', `element face ${F.length}`, 'property list uchar int vertex_indices', 'end_header', join(V),
  F.map((f) => `3 ${f.join(' ')}`));

const vtk = ({ V, F }) => text('# vtk DataFile Version 3.0', 'mesh', 'ASCII', 'DATASET POLYDATA', `POINTS ${V.length} float`,
  join(V), `POLYGONS ${F.length} ${4 * F.length}`, F.map((f) => `3 ${f.join(' ')}`));

const vtp = ({ V, F }) => text('<?xml version="1.0"?>', '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">',
  `<PolyData><Piece NumberOfPoints="${V.length}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="${F.length}">`,
  '<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">', join(V), '</DataArray></Points>',
  '<Polys><DataArray type="Int32" Name="connectivity" format="ascii">', join(F), '</DataArray>',
  '<DataArray type="Int32" Name="offsets" format="ascii">', F.map((_, k) => 3 * k + 3), '</DataArray></Polys>',
  '</Piece></PolyData></VTKFile>');

const msh = ({ V, F }) => text('$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', V.length,
  V.map((p, k) => `${k + 1} ${p.join(' ')}`), '$EndNodes', '$Elements', F.length,
  F.map((f, k) => `${k + 1} 2 2 0 1 ${f.map((v) => v + 1).join(' ')}`), '$EndElements');

const inp = ({ V, F }) => text('*Heading', 'mesh', '*Node', V.map((p, k) => `${k + 1}, ${p.join(', ')}`),
  '*Element, type=S3', F.map((f, k) => `${k + 1}, ${f.map((v) => v + 1).join(', ')}`));

const gii = ({ V, F }) => text('<?xml version="1.0" encoding="UTF-8"?>', '<GIFTI Version="1.0" NumberOfDataArrays="2">',
  `<DataArray Intent="NIFTI_INTENT_POINTSET" DataType="NIFTI_TYPE_FLOAT32" ArrayIndexingOrder="RowMajorOrder" Dimensionality="2" Dim0="${V.length}" Dim1="3" Encoding="ASCII" Endian="LittleEndian" ExternalFileName="" ExternalFileOffset=""><Data>`,
  join(V), '</Data></DataArray>',
  `<DataArray Intent="NIFTI_INTENT_TRIANGLE" DataType="NIFTI_TYPE_INT32" ArrayIndexingOrder="RowMajorOrder" Dimensionality="2" Dim0="${F.length}" Dim1="3" Encoding="ASCII" Endian="LittleEndian" ExternalFileName="" ExternalFileOffset=""><Data>`,
  join(F), '</Data></DataArray>', '</GIFTI>');

function surf(mesh) {
  const head = Buffer.concat([Buffer.from([0xff, 0xff, 0xfe]), Buffer.from('created by a test\n\n'), Buffer.alloc(8)]);
  head.writeInt32BE(mesh.V.length, head.length - 8);
  head.writeInt32BE(mesh.F.length, head.length - 4);
  return Buffer.concat([head, binary(mesh, 'writeFloatBE', 'writeInt32BE')]);
}

function gltf(mesh, uri) {
  const { V, F } = mesh;
  const bounds = (pick) => [0, 1, 2].map((k) => pick(...V.map((p) => p[k])));
  return {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ name: 'mesh', mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: V.length, type: 'VEC3', min: bounds(Math.min), max: bounds(Math.max) },
      { bufferView: 1, componentType: 5125, count: 3 * F.length, type: 'SCALAR' }],
    bufferViews: [{ buffer: 0, byteLength: 12 * V.length }, { buffer: 0, byteOffset: 12 * V.length, byteLength: 12 * F.length }],
    buffers: [{ byteLength: 12 * (V.length + F.length), ...uri ? { uri } : {} }],
  };
}

function glb(mesh) {
  const padded = (bytes, by) => Buffer.concat([bytes, Buffer.alloc((4 - bytes.length % 4) % 4, by)]);
  const chunks = [[0x4e4f534a, padded(Buffer.from(JSON.stringify(gltf(mesh))), 0x20)], [0x004e4942, binary(mesh, 'writeFloatLE', 'writeUInt32LE')]];
  const parts = chunks.map(([kind, bytes]) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length, 0);
    head.writeUInt32LE(kind, 4);
    return Buffer.concat([head, bytes]);
  });
  const head = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  head.writeUInt32LE(12 + parts[0].length + parts[1].length, 8);
  return Buffer.concat([head, ...parts]);
}

function crc32(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let k = 0; k < 8; ++k) sum = sum >>> 1 ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

/** A zip archive that compresses nothing. */
function zip(files) {
  const locals = [], directory = [];
  let at = 0;
  for (const [name, bytes] of Object.entries(files)) {
    const fields = Buffer.alloc(26);  // what both headers have in common
    fields.writeUInt16LE(20, 0);
    fields.writeUInt16LE(0x21, 8);  // 1 January 1980
    fields.writeUInt32LE(crc32(bytes), 10);
    fields.writeUInt32LE(bytes.length, 14);
    fields.writeUInt32LE(bytes.length, 18);
    fields.writeUInt16LE(name.length, 22);
    const local = Buffer.concat([Buffer.from('PK\x03\x04'), fields, Buffer.from(name), bytes]);
    const place = Buffer.alloc(14);
    place.writeUInt32LE(at, 10);
    directory.push(Buffer.concat([Buffer.from('PK\x01\x02\x14\0', 'latin1'), fields, place, Buffer.from(name)]));
    locals.push(local);
    at += local.length;
  }
  const listed = Buffer.concat(directory);
  const end = Buffer.alloc(22);
  end.write('PK\x05\x06', 'latin1');
  end.writeUInt16LE(locals.length, 8);
  end.writeUInt16LE(locals.length, 10);
  end.writeUInt32LE(listed.length, 12);
  end.writeUInt32LE(at, 16);
  return Buffer.concat([...locals, listed, end]);
}

const threemf = ({ V, F }) => zip({
  '[Content_Types].xml': text('<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'),
  '_rels/.rels': text('<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'),
  '3D/3dmodel.model': text('<?xml version="1.0" encoding="UTF-8"?>', '<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices>',
    V.map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`), '</vertices><triangles>',
    F.map(([a, b, c]) => `<triangle v1="${a}" v2="${b}" v3="${c}"/>`), '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>'),
});

/** { format: { name: bytes } } of an OBJ file. */
export function inEveryFormat(obj) {
  const mesh = readObj(obj);
  return {
    obj: { 'mesh.obj': obj }, off: { 'mesh.off': off(mesh) }, ply: { 'mesh.ply': ply(mesh) }, stl: { 'mesh.stl': stl(mesh) },
    glb: { 'mesh.glb': glb(mesh) },
    gltf: { 'mesh.gltf': Buffer.from(JSON.stringify(gltf(mesh, 'mesh.bin'))), 'mesh.bin': binary(mesh, 'writeFloatLE', 'writeUInt32LE') },
    surf: { 'lh.pial': surf(mesh) }, gii: { 'mesh.surf.gii': gii(mesh) }, vtk: { 'mesh.vtk': vtk(mesh) }, vtp: { 'mesh.vtp': vtp(mesh) },
    msh: { 'mesh.msh': msh(mesh) }, inp: { 'mesh.inp': inp(mesh) }, threemf: { 'mesh.3mf': threemf(mesh) },
  };
}
