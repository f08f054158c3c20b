"""VTK PolyData and UnstructuredGrid, as the files of version 1 to 5.1 (.vtk) and as XML (.vtp, .vtu)."""
import re
import struct

from .encoded_arrays import base64_of, from_bytes, from_text, in_blocks
from .mesh import Mesh, Unreadable, outside

TYPES = {'float': 'f', 'double': 'd', 'char': 'b', 'unsigned_char': 'B', 'short': 'h', 'unsigned_short': 'H', 'int': 'i',
         'unsigned_int': 'I', 'long': 'q', 'unsigned_long': 'Q', 'vtktypeint64': 'q', 'vtkidtype': 'i', 'bit': 'B'}
XML_TYPES = {'Int8': 'b', 'UInt8': 'B', 'Int16': 'h', 'UInt16': 'H', 'Int32': 'i', 'UInt32': 'I', 'Int64': 'q',
             'UInt64': 'Q', 'Float32': 'f', 'Float64': 'd'}
NO_FACES, STRIP = {1, 2, 3, 4}, 6


def add_cells(mesh, first, cells, types):
    for points, kind in zip(cells, types):
        points = [first + p for p in points]
        if kind == STRIP:
            mesh.faces += [tuple(points[k:k + 3]) for k in range(len(points) - 2)]
        elif kind not in NO_FACES:
            mesh.faces.append(tuple(points))


def add_points(mesh, numbers):
    for k in range(0, len(numbers.values), 3):
        mesh.add_vertex(numbers.values[k:k + 3], numbers.texts[k:k + 3])


def cut_up(connectivity, ends):
    return [connectivity[begin:end] for begin, end in zip([0, *ends], ends)]


class Legacy:
    def __init__(self, data):
        self.data, self.at = data, 0
        self.line(), self.line()
        self.is_binary = self.line().strip().upper() == b'BINARY'

    def line(self):
        end = self.data.find(b'\n', self.at)
        end = len(self.data) if end < 0 else end
        begin, self.at = self.at, end + 1
        return self.data[begin:end]

    def words(self):
        """Of the next line that has any; none: the file ends."""
        while self.at < len(self.data):
            if words := self.line().decode('latin-1').split():
                return words
        return []

    def array(self, count, kind):
        if self.is_binary:
            begin = self.at
            numbers = from_bytes(self.data[begin:begin + count * struct.calcsize(kind)], count, kind, '>', begin)
            self.at += count * struct.calcsize(kind)
        else:
            numbers = from_text(self.data, self.at, len(self.data), count, kind)
            self.at = numbers.spans[-1][1] if count else self.at
        return numbers

    def cells(self, count, size):
        """Of one keyword, as versions before 5.1 write them, and since."""
        place = self.at
        words = self.words() if count or size else []
        if words[:1] == ['OFFSETS']:
            ends = self.array(count, TYPES[words[1].lower()]).values
            return cut_up(self.array(size, TYPES[self.words()[1].lower()]).values, ends[1:])
        self.at = place
        values, cells, at = self.array(size, 'i').values, [], 0
        for _ in range(count):
            cells.append(values[at + 1:at + 1 + values[at]])
            at += 1 + values[at]
        return cells

    def read(self):
        mesh, cells, types = Mesh(), [], []
        points = None
        while words := self.words():
            keyword = words[0].upper()
            if keyword == 'POINTS':
                points = self.array(3 * int(words[1]), TYPES[words[2].lower()])
            elif keyword in ('VERTICES', 'LINES'):
                self.cells(int(words[1]), int(words[2]))
            elif keyword in ('POLYGONS', 'TRIANGLE_STRIPS', 'CELLS'):
                found = self.cells(int(words[1]), int(words[2]))
                cells += found
                types += [] if keyword == 'CELLS' else [STRIP if keyword == 'TRIANGLE_STRIPS' else 7] * len(found)
            elif keyword == 'CELL_TYPES':
                types = self.array(int(words[1]), 'i').values
            elif keyword == 'FIELD':
                for _ in range(int(words[2])):
                    _, components, tuples, kind = self.words()[:4]
                    self.array(int(components) * int(tuples), TYPES[kind.lower()])
            elif keyword == 'METADATA':
                while self.at < len(self.data) and self.line().strip():
                    pass
            elif keyword in ('POINT_DATA', 'CELL_DATA'):
                break
            elif keyword != 'DATASET':
                raise Unreadable(f'{words[0]} is not known')
        add_points(mesh, points)
        add_cells(mesh, 0, cells, types)
        mesh.rest = outside(self.data, points.spans)
        return mesh.check_ids()


def read_vtk(data):
    return Legacy(data).read()


TAG = re.compile(rb'<(/?)([\w:.-]+)((?:\s+[\w:.-]+\s*=\s*(?:"[^"]*"|\'[^\']*\'))*)\s*(/?)>')
ATTRIBUTE = re.compile(rb'([\w:.-]+)\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')


class Xml:
    """`rest`: the text without arrays and the offsets of appended ones, and what is in all arrays but the points."""

    def __init__(self, data):
        appended = re.search(rb'<AppendedData\b[^>]*>\s*_', data)
        self.data, self.text_end = data, appended.start() if appended else len(data)
        self.appended = appended.end() if appended else 0
        self.is_raw = bool(appended) and b'raw' in appended.group()
        root = self.attributes(re.search(rb'<VTKFile\b([^>]*)>', data).group(1))
        self.order = '>' if root.get('byte_order') == 'BigEndian' else '<'
        self.header = 'Q' if root.get('header_type') == 'UInt64' else 'I'
        self.is_compressed = 'compressor' in root

    @staticmethod
    def attributes(text):
        return {m.group(1).decode(): (m.group(2) or m.group(3) or b'').decode() for m in ATTRIBUTE.finditer(text)}

    def stored(self, begin, is_base64):
        """The bytes of an array that is stored from this place on."""
        size = struct.calcsize(self.header)
        if is_base64:
            text = re.compile(rb'[A-Za-z0-9+/=\s]*').match(self.data, begin).group()
            text = re.sub(rb'\s', b'', text)

        def taken(start, count):
            """`start`: bytes that are decoded by themselves, before those wanted."""
            if not is_base64:
                return self.data[begin + start:begin + start + count]
            at = (start + 2) // 3 * 4
            return base64_of(text[at:at + (count + 2) // 3 * 4])[:count]
        if self.is_compressed:
            return in_blocks(lambda count: taken(0, count), taken, self.order, self.header)
        length = struct.unpack(self.order + self.header, taken(0, size))[0]
        return taken(0, size + length)[size:]

    def array(self, attributes, begin, end, count):
        kind, form = XML_TYPES[attributes['type']], attributes.get('format', 'ascii')
        if form == 'ascii' or count == 0:
            return from_text(self.data, begin, end, count, kind)
        is_base64 = form == 'binary' or not self.is_raw
        place = begin if form == 'binary' else self.appended + int(attributes['offset'])
        return from_bytes(self.stored(place, is_base64), count, kind, self.order)

    def all_numbers(self, attributes, begin, end):
        """Of an array of any length."""
        kind, form = XML_TYPES.get(attributes['type']), attributes.get('format', 'ascii')
        if form == 'ascii' or kind is None or (form == 'binary' and not self.data[begin:end].strip()):
            return self.data[begin:end]
        place = begin if form == 'binary' else self.appended + int(attributes['offset'])
        return self.stored(place, form == 'binary' or not self.is_raw)

    def read(self):
        mesh, path, spans = Mesh(), [], []
        piece, arrays = {}, {}
        for match in TAG.finditer(self.data, 0, self.text_end):
            name, attributes = match.group(2).decode(), self.attributes(match.group(3))
            if match.group(1):
                path.pop()
                if name == 'Piece':
                    self.add_piece(mesh, piece, arrays)
                continue
            is_empty = bool(match.group(4))
            if name == 'Piece':
                piece, arrays = attributes, {}
            if name in ('DataArray', 'Array'):
                end = match.end() if is_empty else self.data.index(b'</', match.end())
                key = (path[-1], attributes.get('Name', '') if path[-1] != 'Points' else '')
                arrays[key] = (attributes, match.end(), end)
                if path[-1] != 'Points':
                    mesh.rest.append((path[-1], key, self.all_numbers(attributes, match.end(), end)))
                if attributes.get('format', 'ascii') == 'ascii' and path[-1] == 'Points':
                    spans += from_text(self.data, match.end(), end, 3 * int(piece['NumberOfPoints']), 'd').spans
                else:
                    spans.append((match.end(), end))
            if not is_empty:
                path.append(name)
        text = b'|'.join(outside(self.data[:self.text_end], spans))
        mesh.rest.append(re.sub(rb'\soffset\s*=\s*["\']\d+["\']', b'', text))
        return mesh.check_ids()

    def add_piece(self, mesh, piece, arrays):
        first = len(mesh.positions)
        if ('Points', '') in arrays:
            add_points(mesh, self.array(*arrays['Points', ''], 3 * int(piece['NumberOfPoints'])))
        for kind, counter in (('Polys', 'NumberOfPolys'), ('Strips', 'NumberOfStrips'), ('Cells', 'NumberOfCells')):
            count = int(piece.get(counter, 0))
            if count == 0 or (kind, 'offsets') not in arrays:
                continue
            ends = self.array(*arrays[kind, 'offsets'], count).values
            cells = cut_up(self.array(*arrays[kind, 'connectivity'], ends[-1]).values, ends)
            types = {'Polys': [7] * count, 'Strips': [STRIP] * count}.get(kind)
            add_cells(mesh, first, cells, types or self.array(*arrays[kind, 'types'], count).values)


def read_vtk_xml(data):
    return Xml(data).read()
