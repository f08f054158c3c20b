"""What is read from a mesh file: positions, faces, and all that is neither."""
import math
import struct


class Unreadable(Exception):
    pass


class Mesh:
    """`texts`: the bytes of each coordinate. `rest`: what must be equal in IN and OUT. `normals`: of STL facets."""

    def __init__(self):
        self.positions, self.faces, self.texts, self.rest, self.normals = [], [], [], [], []

    def add_vertex(self, values, texts):
        values = tuple(values)
        if len(values) != 3:
            raise Unreadable(f'vertex {len(self.positions)} has {len(values)} coordinates')
        if not all(map(math.isfinite, values)):
            raise Unreadable(f'vertex {len(self.positions)} is not finite')
        self.positions.append(values)
        self.texts.extend(texts)

    def check_ids(self):
        for f, face in enumerate(self.faces):
            if any(not 0 <= v < len(self.positions) for v in face):
                raise Unreadable(f'face {f} uses a vertex that does not exist')
        self.faces = [face for face in self.faces if len(face) >= 3]
        return self


def outside(data, spans):
    """The bytes between the given (begin, end)."""
    parts, at = [], 0
    for begin, end in spans:
        parts.append(data[at:begin])
        at = end
    return parts + [data[at:]]


def float32(text):
    return struct.unpack('<f', struct.pack('<f', float(text)))[0]
