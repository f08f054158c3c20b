"""GIFTI surfaces: the points of each POINTSET array, joined by the TRIANGLE array in the same place of the order."""
import os
import re
import zlib

from .encoded_arrays import base64_of, from_bytes, from_text
from .mesh import Mesh, Unreadable, outside

TYPES = {'INT8': 'b', 'UINT8': 'B', 'INT16': 'h', 'UINT16': 'H', 'INT32': 'i', 'UINT32': 'I', 'INT64': 'q', 'UINT64': 'Q',
         'FLOAT32': 'f', 'FLOAT64': 'd'}
ARRAY = re.compile(rb'<DataArray\b([^>]*?)(?:/>|>(.*?)</DataArray>)', re.S)
ATTRIBUTE = re.compile(rb'([\w:.-]+)\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')


class Array:
    """`numbers` row by row. `span`: of the text in <Data>. `rest`: of the file that holds the numbers, if it is another."""

    def __init__(self, data, match, folder):
        a = {m.group(1).decode(): (m.group(2) or m.group(3) or b'').decode() for m in ATTRIBUTE.finditer(match.group(1))}
        self.intent, self.encoding, self.rest = a['Intent'], a['Encoding'], None
        rows, columns = int(a['Dim0']), int(a.get('Dim1', 1))
        kind, order = TYPES[a['DataType'].rpartition('_')[2]], '<' if a.get('Endian') == 'LittleEndian' else '>'
        text = re.compile(rb'<Data>(.*?)</Data>', re.S).search(data, *match.span())
        self.span = text.span(1) if text else (match.end(), match.end())
        count = rows * columns
        if self.encoding == 'ASCII':
            numbers = from_text(data, *self.span, count, kind)
        elif self.encoding == 'ExternalFileBinary':
            with open(os.path.join(folder, a['ExternalFileName']), 'rb') as file:
                outer = file.read()
            begin = int(a.get('ExternalFileOffset') or 0)
            numbers = from_bytes(outer[begin:], count, kind, order, begin)
            self.rest = outside(outer, numbers.spans)
            numbers.spans = []
        else:
            raw = base64_of(data[slice(*self.span)])
            numbers = from_bytes(zlib.decompress(raw, 47) if self.encoding.startswith('GZip') else raw, count, kind, order)
        if a.get('ArrayIndexingOrder') == 'ColumnMajorOrder':
            at = [column * rows + row for row in range(rows) for column in range(columns)]
            numbers.values, numbers.texts = [numbers.values[i] for i in at], [numbers.texts[i] for i in at]
        self.numbers = numbers


def read_gifti(data, folder):
    arrays = [Array(data, match, folder) for match in ARRAY.finditer(data)
              if re.search(rb'NIFTI_INTENT_(POINTSET|TRIANGLE)', match.group(1))]
    points = [array for array in arrays if array.intent == 'NIFTI_INTENT_POINTSET']
    triangles = [array for array in arrays if array.intent == 'NIFTI_INTENT_TRIANGLE']
    if not points or len(points) != len(triangles):
        raise Unreadable('no surface, or points and triangles that do not belong together')
    mesh, spans, missing = Mesh(), [], set()
    for place, faces in zip(points, triangles):
        first, values, texts = len(mesh.positions), place.numbers.values, place.numbers.texts
        for k in range(0, len(values), 3):
            position = values[k:k + 3]
            if any(x != x for x in position):  # missing; its bytes must stay
                missing.add(len(mesh.positions))
                mesh.rest.append(texts[k:k + 3])
                position = (0, 0, 0)
            mesh.add_vertex(position, texts[k:k + 3])
        corners = faces.numbers.values
        for k in range(0, len(corners), 3):
            face = tuple(first + v for v in corners[k:k + 3])
            if not missing.intersection(face):
                mesh.faces.append(face)
        spans += place.numbers.spans if place.encoding == 'ASCII' else [place.span]
        mesh.rest.append(place.rest)
    text = b'|'.join(outside(data, sorted(spans)))
    mesh.rest.append(re.sub(rb'ExternalFileName\s*=\s*("[^"]*"|\'[^\']*\')', b'', text))
    return mesh.check_ids()
