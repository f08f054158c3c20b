"""Files of numbered nodes and elements: Gmsh (.msh, versions 2.2 and 4.1), and Abaqus (.inp)."""
import re
import struct

from .encoded_arrays import from_bytes, from_text
from .mesh import Mesh, Unreadable, outside

# Gmsh: nodes of an element, by its type.
NODES = (0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5, 6, 20, 35, 56)
TRIANGLE, QUADRANGLE = 2, 3


class Section:
    """Numbers behind each other, as text or in binary, between $Name and $EndName."""

    def __init__(self, data, name, order):
        begin = re.search(rb'(?m)^\$' + name + rb'[ \t]*\r?\n', data)
        if not begin:
            raise Unreadable(f'no ${name.decode()}')
        self.data, self.at, self.order = data, begin.end(), order

    def take(self, count, kind):
        """order '': text."""
        if not self.order:
            numbers = from_text(self.data, self.at, len(self.data), count, kind)
            self.at = numbers.spans[-1][1] if count else self.at
        else:
            size = count * struct.calcsize(kind)
            numbers = from_bytes(self.data[self.at:self.at + size], count, kind, self.order, self.at)
            self.at += size
        return numbers

    def line(self):
        """The numbers in what is left of the next line that has any; text alone."""
        while True:
            end = self.data.index(b'\n', self.at)
            words, self.at = self.data[self.at:end].split(), end + 1
            if words:
                return [int(word) for word in words]

    def integers(self, count, kind='i'):
        return self.take(count, kind).values


class Gmsh:
    def __init__(self, data):
        self.data, self.mesh, self.vertex_of, self.spans = data, Mesh(), {}, []
        form = re.search(rb'(?m)^\$MeshFormat[ \t]*\r?\n(\S+) (\d) (\d+)[^\n]*\n', data)
        self.order = ''
        if int(form.group(2)):
            self.order = '<' if struct.unpack_from('<i', data, form.end())[0] == 1 else '>'
        self.read_2() if form.group(1).startswith(b'2') else self.read_4()
        self.mesh.rest = outside(data, self.spans)

    def node(self, number, numbers):
        self.vertex_of[number] = len(self.mesh.positions)
        self.mesh.add_vertex(numbers.values, numbers.texts)
        self.spans += numbers.spans

    def element(self, kind, nodes):
        if kind in (TRIANGLE, QUADRANGLE):
            self.mesh.faces.append(tuple(self.vertex_of[n] for n in nodes))

    def read_2(self):
        section = Section(self.data, b'Nodes', '')
        count = section.line()[0]
        section.order = self.order
        for _ in range(count):
            self.node(section.integers(1)[0], section.take(3, 'd'))
        section = Section(self.data, b'Elements', '')
        count = section.line()[0]
        section.order = self.order
        while count > 0:
            if self.order:
                kind, following, tags = section.integers(3)
                for _ in range(following):
                    self.element(kind, section.integers(1 + tags + NODES[kind])[1 + tags:])
                count -= following
            else:
                words = section.line()
                self.element(words[1], words[3 + words[2]:])
                count -= 1

    def read_4(self):
        section = Section(self.data, b'Nodes', self.order)
        blocks = section.integers(4, 'Q')[0]
        for _ in range(blocks):
            dimension, _, parametric = section.integers(3)
            tags = section.integers(section.integers(1, 'Q')[0], 'Q')
            for tag in tags:
                self.node(tag, section.take(3, 'd'))
                if parametric:
                    section.take(dimension, 'd')
        section = Section(self.data, b'Elements', self.order)
        blocks = section.integers(4, 'Q')[0]
        for _ in range(blocks):
            _, _, kind = section.integers(3)
            for _ in range(section.integers(1, 'Q')[0]):
                self.element(kind, section.integers(1 + NODES[kind], 'Q')[1:])


def read_gmsh(data):
    return Gmsh(data).mesh.check_ids()


def size_of_face(kind):
    """Corners of the faces of a type of Abaqus' elements: the digits behind its letters; 0: no shell, membrane or plane element."""
    match = re.fullmatch(r'(?:S|M3D|SFM3D|R3D|DS|STRI|CPS|CPE)([34])(?:R|S|W|T|I|5)*', kind)
    return int(match.group(1)) if match else 0


def read_abaqus(data):
    mesh, spans, vertex_of, keyword, corners, pending = Mesh(), [], {}, '', 0, []
    for match in re.finditer(rb'[^\n]*\n?', data):
        line = match.group()
        if line.startswith(b'**') or not line.strip():
            continue
        if line.startswith(b'*'):
            words = [word.strip() for word in line.decode('latin-1').upper().split(',')]
            keyword, corners, pending = words[0], 0, []
            if keyword in ('*PART', '*INSTANCE', '*END PART', '*END INSTANCE'):
                vertex_of = {}
            if keyword == '*ELEMENT':
                values = dict(word.replace(' ', '').split('=', 1) for word in words[1:] if '=' in word)
                corners = size_of_face(values.get('TYPE', ''))
            continue
        words = [(m.group(), m.start() + match.start(), m.end() + match.start()) for m in re.finditer(rb'[^,\s]+', line)]
        if keyword == '*NODE':
            vertex_of[int(words[0][0])] = len(mesh.positions)
            mesh.add_vertex([float(word.lower().replace(b'd', b'e')) for word, _, _ in words[1:4]], [word for word, _, _ in words[1:4]])
            spans += [(begin, end) for _, begin, end in words[1:4]]
        elif corners:
            pending += [int(word) for word, _, _ in words]
            if len(pending) > corners:
                mesh.faces.append(tuple(vertex_of[n] for n in pending[1:1 + corners]))
                pending = []
    mesh.rest = outside(data, spans)
    return mesh.check_ids()
