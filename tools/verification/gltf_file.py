"""glTF 2.0 and GLB: the triangles of all meshes, where the default scene shows them first."""
import base64
import json
import math
import os
import struct
import urllib.parse
from collections import defaultdict

from .mesh import Mesh, float32, outside
from .vectors import cross, dot


def times(a, b):
    """Product of affine maps, 3 rows of 4 numbers."""
    return [[sum(a[r][k] * b[k][c] for k in range(3)) + (a[r][3] if c == 3 else 0) for c in range(4)] for r in range(3)]


IDENTITY = [[1.0, 0, 0, 0], [0, 1.0, 0, 0], [0, 0, 1.0, 0]]


def transform_of(node):
    if 'matrix' in node:
        m = list(map(float, node['matrix']))
        return [[m[4 * c + r] for c in range(4)] for r in range(3)]
    x, y, z, w = map(float, node.get('rotation', (0, 0, 0, 1)))
    s = list(map(float, node.get('scale', (1, 1, 1))))
    t = list(map(float, node.get('translation', (0, 0, 0))))
    rotation = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[rotation[r][c] * s[c] for c in range(3)] + [t[r]] for r in range(3)]


def is_flat(m):
    columns = [[m[r][c] for r in range(3)] for c in range(3)]
    return abs(dot(columns[0], cross(columns[1], columns[2]))) <= 1e-10 * math.prod(math.hypot(*c) for c in columns)


def places_of_meshes(root):
    """Where the default scene shows each mesh first; the identity for what it does not show."""
    nodes = root.get('nodes', [])
    if 'scenes' in root:
        roots = root['scenes'][int(root.get('scene', 0))].get('nodes', [])
    else:
        children = {int(c) for node in nodes for c in node.get('children', [])}
        roots = [n for n in range(len(nodes)) if n not in children]
    places, stack = {}, [(int(n), IDENTITY) for n in reversed(roots)]
    while stack:
        n, parent = stack.pop()
        world = times(parent, transform_of(nodes[n]))
        stack += [(int(c), world) for c in reversed(nodes[n].get('children', []))]
        if 'mesh' in nodes[n]:
            place = IDENTITY if 'skin' in nodes[n] else world
            mesh = int(nodes[n]['mesh'])
            if mesh not in places or (places[mesh] is None and not is_flat(place)):
                places[mesh] = None if is_flat(place) else place
    return {mesh: place or IDENTITY for mesh, place in places.items()}


def read_gltf(data, folder):
    chunks = []
    if data[:4] == b'glTF':
        at = 12
        while at + 8 <= len(data):
            size, kind = struct.unpack_from('<I4s', data, at)
            chunks.append((kind, data[at + 8:at + 8 + size]))
            at += 8 + size
        text = chunks[0][1]
    else:
        text = data
    numbers = {'parse_float': str, 'parse_int': str}  # as they are written
    root = json.loads(text, **numbers)

    buffers = []
    for buffer in root.get('buffers', []):
        uri = buffer.get('uri')
        if uri is None:
            buffers.append(next(content for kind, content in chunks if kind == b'BIN\0'))
        elif uri.startswith('data:'):
            buffers.append(base64.b64decode(uri.split(',', 1)[1]))
        else:
            with open(os.path.join(folder, urllib.parse.unquote(uri)), 'rb') as file:
                buffers.append(file.read())
    accessors, views = root.get('accessors', []), root.get('bufferViews', [])

    def elements(number, size):
        """Of an accessor: (buffer, where each element starts)."""
        accessor = accessors[int(number)]
        view = views[int(accessor['bufferView'])]
        first = int(view.get('byteOffset', 0)) + int(accessor.get('byteOffset', 0))
        stride = int(view.get('byteStride', size))
        return int(view['buffer']), range(first, first + stride * int(accessor['count']), stride)

    mesh, places, vertex_at, place_of, users = Mesh(), places_of_meshes(root), {}, [], []
    primitives = [(m, p) for m, entry in enumerate(root.get('meshes', [])) for p in entry['primitives']]
    primitives = [(m, p) for m, p in primitives if int(p.get('mode', 4)) >= 4 and 'POSITION' in p['attributes']]
    for m, primitive in primitives:
        number = int(primitive['attributes']['POSITION'])
        buffer, offsets = elements(number, 12)
        for offset in offsets:
            if (buffer, offset) not in vertex_at:
                vertex_at[buffer, offset] = len(vertex_at)
                place_of.append(None)
                users.append(places.get(m, IDENTITY))
    for m, primitive in primitives:
        place, mode = places.get(m, IDENTITY), int(primitive.get('mode', 4))
        buffer, offsets = elements(primitive['attributes']['POSITION'], 12)
        ids = range(len(offsets))
        if 'indices' in primitive:
            kind = {'5121': '<B', '5123': '<H', '5125': '<I'}[accessors[int(primitive['indices'])]['componentType']]
            source, starts = elements(primitive['indices'], struct.calcsize(kind))
            ids = [struct.unpack_from(kind, buffers[source], start)[0] for start in starts]
        ids = [vertex_at[buffer, offsets[i]] for i in ids]
        if mode == 4:
            faces = zip(ids[0::3], ids[1::3], ids[2::3])
        elif mode == 5:
            faces = [(ids[i], ids[i + 1 + i % 2], ids[i + 2 - i % 2]) for i in range(len(ids) - 2)]
            faces = [face for face in faces if len(set(face)) == 3]
        else:
            faces = [(ids[i + 1], ids[i + 2], ids[0]) for i in range(len(ids) - 2)]
        for face in faces:
            if all(place_of[v] in (None, place) for v in face):  # a vertex belongs to the first place that shows it
                for v in face:
                    place_of[v] = place
                mesh.faces.append(face)
    for v, (buffer, offset) in enumerate(vertex_at):
        local, place = struct.unpack_from('<3f', buffers[buffer], offset), place_of[v] or users[v]
        world = local if place == IDENTITY else [r[0] * local[0] + r[1] * local[1] + r[2] * local[2] + r[3] for r in place]
        mesh.add_vertex(world, [buffers[buffer][offset + 4 * k:offset + 4 * k + 4] for k in range(3)])

    for number in {int(p['attributes']['POSITION']) for _, p in primitives}:
        buffer, offsets = elements(number, 12)
        points = [struct.unpack_from('<3f', buffers[buffer], offset) for offset in offsets]
        for key, bound in (('min', min), ('max', max)):
            stored = accessors[number].pop(key, None)
            if stored and points and any(float32(s) != bound(p[k] for p in points) for k, s in enumerate(stored)):
                mesh.rest.append(f'accessor {number} has a wrong {key}')
    for buffer in root.get('buffers', []):
        if buffer.get('uri', '').startswith('data:'):
            del buffer['uri']
    spans = defaultdict(list)
    for buffer, offset in vertex_at:
        spans[buffer].append((offset, offset + 12))
    mesh.rest += [root, [kind for kind, _ in chunks], [content for kind, content in chunks if kind not in (b'JSON', b'BIN\0')]]
    mesh.rest += [outside(content, sorted(spans[b])) for b, content in enumerate(buffers)]
    return mesh.check_ids()
