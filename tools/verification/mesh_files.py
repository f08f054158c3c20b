"""Readers of mesh files."""
import os
import re
import struct
import zipfile
import zlib

from .gifti_file import read_gifti
from .gltf_file import read_gltf
from .mesh import Mesh, Unreadable, float32, outside
from .node_files import read_abaqus, read_gmsh
from .threemf_file import read_3mf
from .vtk_files import read_vtk, read_vtk_xml


WORDS = re.compile(rb'#[^\r\n]*|\\(?:\r\n|\r|\n)|\r\n|\r|\n|[^\x00-\x20#\\]+|\\')


def lines_of_words(data, continued):
    """Lists of (word, begin, end), one a line that holds any; '#' starts a comment."""
    line, start = [], 3 if data.startswith(b'\xef\xbb\xbf') else 0
    for match in WORDS.finditer(data, start):
        word = match.group()
        if word[0] in b'\r\n' or (word[0] == 92 and len(word) > 1 and not continued):
            if line:
                yield line
            line = []
        elif word[0] != 35 and not (word[0] == 92 and len(word) > 1):
            line.append((word, match.start(), match.end()))
    if line:
        yield line


def read_obj(data):
    mesh, spans = Mesh(), []
    for line in lines_of_words(data, continued=True):
        if line[0][0] == b'v':
            numbers = line[1:4]
            mesh.add_vertex([float(word) for word, _, _ in numbers], [word for word, _, _ in numbers])
            spans += [(begin, end) for _, begin, end in numbers]
        elif line[0][0] in (b'f', b'fo'):
            ids = [int(word.split(b'/')[0]) for word, _, _ in line[1:]]
            mesh.faces.append(tuple(i - 1 if i > 0 else len(mesh.positions) + i for i in ids))
    mesh.rest = outside(data, spans)
    return mesh.check_ids()


def read_off(data):
    mesh, spans = Mesh(), []
    lines = list(lines_of_words(data, continued=False))
    keyword = re.match(rb'(ST)?(C)?(N)?OFF', lines[0][0][0])
    if not keyword:
        raise Unreadable('no OFF file')
    word, begin, end = lines[0][0]
    lines[0][0] = (word[keyword.end():], begin + keyword.end(), end)
    lines = [[w for w in line if w[0]] for line in lines]
    lines = [line for line in lines if line]
    stream = iter([(w, number) for number, line in enumerate(lines) for w in line])
    (vertices, _), (faces, header) = next(stream), next(stream)
    vertices, faces = int(vertices[0]), int(faces[0])
    body = lines[header + 1:]
    if len(body) < vertices + faces:  # not a line each
        extra = 3 + sum(count for flag, count in zip(keyword.groups(), (2, 4, 3)) if flag)
        words = iter([w for line in body for w in line])
        body = [[next(words) for _ in range(extra)] for _ in range(vertices)]
        for _ in range(faces):
            first = next(words)
            body.append([first] + [next(words) for _ in range(int(first[0]))])
    for line in body[:vertices]:
        mesh.add_vertex([float(word) for word, _, _ in line[:3]], [word for word, _, _ in line[:3]])
        spans += [(begin, end) for _, begin, end in line[:3]]
    for line in body[vertices:vertices + faces]:
        mesh.faces.append(tuple(int(word) for word, _, _ in line[1:1 + int(line[0][0])]))
    mesh.rest = outside(data, spans)
    return mesh.check_ids()


PLY_TYPES = {'char': 'b', 'int8': 'b', 'uchar': 'B', 'uint8': 'B', 'short': 'h', 'int16': 'h', 'ushort': 'H', 'uint16': 'H',
             'int': 'i', 'int32': 'i', 'uint': 'I', 'uint32': 'I', 'float': 'f', 'float32': 'f', 'double': 'd', 'float64': 'd'}


def read_ply(data):
    header = re.match(rb'ply[ \t]*(\r\n|\r|\n)(?s:.*?)end_header[ \t]*(?:\1|\r|\n)', data)
    if not header:
        raise Unreadable('no PLY file')
    elements, form = [], None
    for words in (line.split() for line in header.group().decode('latin-1').splitlines()):
        if words[:1] == ['format']:
            form = words[1]
        elif words[:1] == ['element']:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ['property']:
            elements[-1][2].append((words[-1], [PLY_TYPES[word] for word in words[1:-1] if word != 'list']))
    if form == 'ascii':
        words = re.finditer(rb'[^\x00-\x20]+', data[header.end():])

        def take(kind):
            match = next(words)
            begin, end = match.start() + header.end(), match.end() + header.end()
            return (float32 if kind == 'f' else float if kind == 'd' else lambda t: int(float(t)))(match.group()), begin, end
    else:
        order, at = '>' if form == 'binary_big_endian' else '<', header.end()
        structs = {kind: struct.Struct(order + kind) for kind in 'bBhHiIfd'}

        def take(kind):
            nonlocal at
            begin, at = at, at + structs[kind].size
            return structs[kind].unpack_from(data, begin)[0], begin, at
    mesh, spans = Mesh(), []
    for name, count, properties in elements:
        for _ in range(count):
            record = {}
            for key, kinds in properties:
                record[key] = take(kinds[0]) if len(kinds) == 1 else [take(kinds[1]) for _ in range(take(kinds[0])[0])]
            if name == 'vertex':
                numbers = [record[axis] for axis in 'xyz']
                mesh.add_vertex([value for value, _, _ in numbers], [data[begin:end] for _, begin, end in numbers])
                spans += sorted((begin, end) for _, begin, end in numbers)
            elif name == 'face':
                corners = record.get('vertex_indices', record.get('vertex_index'))
                mesh.faces.append(tuple(value for value, _, _ in corners))
    mesh.rest = outside(data, spans)
    return mesh.check_ids()


def read_stl(data):
    mesh, spans = Mesh(), []
    count = struct.unpack_from('<I', data, 80)[0] if len(data) >= 84 else -1
    if count >= 0 and (len(data) == 84 + 50 * count or not data.lstrip()[:5].lower() == b'solid' or b'\0' in data[:1024]):
        for begin in range(84, 84 + 50 * count, 50):
            numbers = struct.unpack_from('<12f', data, begin)
            spans.append((begin, begin + 48))
            mesh.normals.append((data[begin:begin + 12], numbers[:3]))
            for k in (3, 6, 9):
                mesh.add_vertex(numbers[k:k + 3], [data[begin + 4 * i:begin + 4 * i + 4] for i in range(k, k + 3)])
    else:
        for match in re.finditer(rb'(?i)\bfacet\s+normal((?:\s+\S+){3})\s+outer\s+loop((?:\s+vertex(?:\s+\S+){3}){3})', data):
            spans += [match.span(1), match.span(2)]
            normal = match.group(1).split()
            mesh.normals.append((match.group(1), tuple(map(float, normal))))
            words = match.group(2).split()
            mesh.rest.append([word.lower() for word in words[::4]])
            for k in (1, 5, 9):
                mesh.add_vertex(map(float32, words[k:k + 3]), words[k:k + 3])
    mesh.faces = [(3 * f, 3 * f + 1, 3 * f + 2) for f in range(len(mesh.positions) // 3)]
    mesh.rest += outside(data, spans)
    return mesh.check_ids()


FREESURFER_TRIANGLES, FREESURFER_HUNDREDTHS, FREESURFER_QUADRANGLES = b'\xff\xff\xfe', b'\xff\xff\xff', b'\xff\xff\xfd'
FREESURFER = (FREESURFER_TRIANGLES, FREESURFER_HUNDREDTHS, FREESURFER_QUADRANGLES)


def three_bytes(data, begin, count):
    return [int.from_bytes(data[begin + 3 * k:begin + 3 * k + 3], 'big') for k in range(count)]


def read_freesurfer(data):
    """Vertices marked by NaN are missing, and so are the faces that use them; their bytes must stay."""
    if data.startswith(FREESURFER_TRIANGLES):
        counts = re.compile(rb'[^\n]*\n\n?').match(data, 3).end()
        (vertices, faces), points = struct.unpack_from('>2i', data, counts), counts + 8
    else:
        (vertices, faces), points = three_bytes(data, 3, 2), 9
    kind, unit = ('h', 100) if data.startswith(FREESURFER_HUNDREDTHS) else ('f', 1)
    size = struct.calcsize(kind)
    mesh, missing, spans = Mesh(), set(), []
    for v in range(vertices):
        begin = points + 3 * size * v
        values = [x / unit for x in struct.unpack_from('>3' + kind, data, begin)]
        if any(x != x for x in values):
            missing.add(v)
            values = (0, 0, 0)
        else:
            spans.append((begin, begin + 3 * size))
        mesh.add_vertex(values, [data[begin + size * k:begin + size * (k + 1)] for k in range(3)])
    for f in range(faces):
        begin = points + 3 * size * vertices + 12 * f
        face = struct.unpack_from('>3i', data, begin) if data.startswith(FREESURFER_TRIANGLES) else three_bytes(data, begin, 4)
        if not missing.intersection(face):
            mesh.faces.append(tuple(face))
    mesh.rest = outside(data, spans)
    return mesh.check_ids()


READERS = {'obj': read_obj, 'off': read_off, 'ply': read_ply, 'stl': read_stl, 'vtk': read_vtk, 'vtp': read_vtk_xml,
           'vtu': read_vtk_xml, 'msh': read_gmsh, 'inp': read_abaqus, '3mf': read_3mf}
WITH_OTHER_FILES = {'glb': read_gltf, 'gltf': read_gltf, 'gii': read_gifti}


def read(path, form=None):
    form = form or os.path.splitext(path)[1].lower().lstrip('.')
    try:
        with open(path, 'rb') as file:
            data = file.read()
        if data.startswith(FREESURFER):
            return read_freesurfer(data)
        if form in WITH_OTHER_FILES:
            return WITH_OTHER_FILES[form](data, os.path.dirname(path))
        if form not in READERS:
            raise Unreadable(f'{form or "a file without extension"} is no format that is checked here; they are '
                             f'{", ".join([*READERS, *WITH_OTHER_FILES])} and FreeSurfer surfaces')
        return READERS[form](data)
    except (OSError, ValueError, KeyError, IndexError, StopIteration, struct.error, zipfile.BadZipFile, zlib.error,
            AttributeError, TypeError, Unreadable) as error:
        raise Unreadable(f'{path}: {error or type(error).__name__}') from error
