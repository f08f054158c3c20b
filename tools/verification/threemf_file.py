"""3MF: the meshes of all objects that the build shows, where it shows them first."""
import io
import re
import zipfile
from xml.sax.saxutils import unescape

from .gltf_file import IDENTITY, times
from .mesh import Mesh, Unreadable, outside

TAG = re.compile(rb'<!--.*?-->|<!\[CDATA\[.*?\]\]>|<(/?)([\w:.-]+)((?:\s+[\w:.-]+\s*=\s*(?:"[^"]*"|\'[^\']*\'))*)\s*/?>', re.S)
ATTRIBUTE = re.compile(rb'([\w:.-]+)\s*=\s*(?:"([^"]*)"|\'([^\']*)\')')


class Part:
    """The objects of a model part: a dictionary of (type, vertices, triangles, components) by their ids."""

    def __init__(self, data):
        self.data, self.objects, self.items, self.spans, current = data, {}, [], [], None
        for match in TAG.finditer(data):
            is_end, name, text = match.group(1), match.group(2), match.group(3) or b''
            if name is None or is_end:
                continue
            attributes = {m.group(1).decode(): m.span(2) if m.group(2) is not None else m.span(3)
                          for m in ATTRIBUTE.finditer(data, match.start(3), match.end(3))}
            values = {key: unescape(data[slice(*span)].decode()) for key, span in attributes.items()}
            if name == b'object':
                current = self.objects[values['id']] = (values.get('type', 'model'), [], [], [])
            elif name == b'vertex' and current:
                current[1].append([self.number(attributes[axis]) for axis in 'xyz'])
            elif name == b'triangle' and current:
                current[2].append(tuple(int(values[key]) for key in ('v1', 'v2', 'v3')))
            elif name == b'component' and current:
                current[3].append(values)
            elif name == b'item':
                self.items.append(values)

    def number(self, span):
        """The value of an attribute, and where it is."""
        word = re.compile(rb'\S+').search(self.data, *span)
        return float(word.group()), word.span()


def placement(values):
    m = [float(word) for word in values.get('transform', '1 0 0 0 1 0 0 0 1 0 0 0').split()]
    return [[m[3 * column + row] for column in range(4)] for row in range(3)]


def root_of(archive):
    for relation in re.findall(rb'<Relationship\b[^>]*>', archive.get('_rels/.rels', b'')):
        values = {m.group(1): m.group(2) or m.group(3) for m in ATTRIBUTE.finditer(relation)}
        if values.get(b'Type', b'').endswith(b'/3dmodel'):
            return values[b'Target'].decode().lstrip('/')
    return '3D/3dmodel.model'


def read_3mf(data):
    with zipfile.ZipFile(io.BytesIO(data)) as package:
        archive = {entry.filename: package.read(entry) for entry in package.infolist()}
    by_small_letters = {name.lower(): name for name in archive}
    mesh, parts, shown = Mesh(), {}, set()

    def part_called(name):
        name = by_small_letters[name.lstrip('/').lower()]
        if name not in parts:
            parts[name] = Part(archive[name])
        return name

    def show(values, name, outer, is_component, depth=0):
        if depth > 256:
            raise Unreadable('components within themselves')
        target = next((part_called(value) for key, value in values.items() if key.endswith(':path')), name)
        kind, vertices, triangles, components = parts[target].objects[values['objectid']]
        place = times(outer, placement(values))
        if vertices and not (is_component and kind == 'other') and (target, values['objectid']) not in shown:
            shown.add((target, values['objectid']))
            first = len(mesh.positions)
            for vertex in vertices:
                local, spans = [value for value, _ in vertex], [span for _, span in vertex]
                mesh.add_vertex([sum(row[k] * local[k] for k in range(3)) + row[3] for row in place],
                                [parts[target].data[begin:end] for begin, end in spans])
                parts[target].spans += spans
            mesh.faces += [tuple(first + v for v in triangle) for triangle in triangles]
        for component in components:
            show(component, target, place, True, depth + 1)

    root = part_called(root_of(archive))
    for item in parts[root].items:
        show(item, root, IDENTITY, False)
    mesh.rest = [(name, outside(content, sorted(parts[name].spans)) if name in parts else content)
                 for name, content in archive.items()]
    return mesh.check_ids()
