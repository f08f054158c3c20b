#!/usr/bin/env python3
"""tools/verify.py accepts what is right and names what is not. Every check is broken here in turn."""
import base64
import contextlib
import io
import itertools
import json
import math
import os
import random
import struct
import sys
import tempfile
import unittest
import zipfile
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'tools'))
import verify  # noqa: E402
from verification.weld_map import weld_map  # noqa: E402
from verification.intersections import Detector, meet_outside_hull  # noqa: E402
from verification.mesh import Mesh  # noqa: E402
from verification.triangulation import cut  # noqa: E402

# A tetrahedron whose tip is stuck in a triangle, and the same with the tip drawn back.
OBJ = (b'# two parts\nv 0 0 0\nv 4 0 0 # kept\nv 0 4.0 0\nv 1 1 %s\nv 0 0 -3\nv 3 0 -3\nv 0 3 -3\n'
       b'vt 0 0\nusemtl x\nf 1 2 3\nf 4 5/1 6\nf 4 6 7\nf 4 7 5\nf 5 7 6\n')
STUCK, DRAWN_BACK = OBJ % b'1', OBJ % b'-1'


class VerifyTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, content):
        path = os.path.join(self.folder.name, name)
        with open(path, 'wb') as file:
            file.write(content)
        return path

    def run_on(self, before, after, extension='obj', *options):
        """(exit code, names of the checks that do not hold, all that was said)."""
        paths = self.file('in.' + extension, before), self.file('out.' + extension, after)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                code = verify.main([*paths, *options])
            except SystemExit as usage:
                code = usage.code
        said = said.getvalue()
        return code, [line.split()[1] for line in said.splitlines() if line.startswith('BROKEN')], said

    def expect(self, broken, before, after, extension='obj', *options):
        code, names, said = self.run_on(before, after, extension, *options)
        self.assertEqual(names, broken, said)
        self.assertEqual(code, 1 if broken else 0, said)

    # What is right.

    def test_reads_freesurfer(self):
        def surface(tip, end=b'tags', missing=b'\x7f\xc0\0\0'):
            points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, tip), (0, 0, -3), (3, 0, -3), (0, 3, -3), (9, 9, 0)]
            faces = [(0, 1, 2), (3, 4, 5), (3, 5, 6), (3, 6, 4), (4, 6, 5), (3, 0, 7)]
            return (b'\xff\xff\xfemade\n\n' + struct.pack('>2i', 8, 6) + b''.join(struct.pack('>3f', *p) for p in points)[:-4]
                    + missing + b''.join(struct.pack('>3i', *f) for f in faces) + end)
        self.expect([], surface(1), surface(-1), 'pial')
        self.expect(['embedded'], surface(-1), surface(1), 'pial')
        self.expect(['file'], surface(1), surface(-1, end=b'gats'), 'pial')
        self.expect(['file'], surface(1), surface(-1, missing=b'\x7f\xc0\0\1'), 'pial')

    POINTS = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, None), (0, 0, -3), (3, 0, -3), (0, 3, -3)]
    FACES = [(0, 1, 2), (3, 4, 5), (3, 5, 6), (3, 6, 4), (4, 6, 5)]

    def points(self, tip, separator='\n'):
        return separator.join(' '.join(str(tip if x is None else x) for x in p) for p in self.POINTS)

    def expect_judged(self, surface, extension, *others):
        """surface(points) is a file; `others`: replacements that change something else."""
        stuck, apart = surface(1), surface(-1)
        self.expect([], stuck, apart, extension)
        self.expect(['embedded'], stuck, stuck, extension)
        for old, new in others:
            self.assertIn(old, apart)
            self.expect(['file'], stuck, apart.replace(old, new, 1), extension)

    def test_reads_vtk(self):
        def polygons(tip):
            faces = '\n'.join('3 %d %d %d' % f for f in self.FACES)
            return (f'# vtk DataFile Version 4.2\nmade\nASCII\nDATASET POLYDATA\nPOINTS 7 float\n{self.points(tip)}\n'
                    f'POLYGONS 5 20\n{faces}\nPOINT_DATA 7\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3 4 5 6 7\n').encode()

        def grid(tip):
            numbers = [float(x) for x in self.points(tip).split()]
            return (b'# vtk DataFile Version 5.1\nmade\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n'
                    + struct.pack('>21d', *numbers) + b'\nCELLS 7 16\nOFFSETS vtktypeint64\n'
                    + struct.pack('>7q', 0, 1, 4, 7, 10, 13, 16)[:56] + b'\nCONNECTIVITY vtktypeint64\n'
                    + struct.pack('>16q', 0, *[v for f in self.FACES for v in f]) + b'\nCELL_TYPES 6\n'
                    + struct.pack('>6i', 1, 5, 5, 5, 5, 5) + b'\n')
        self.expect_judged(polygons, 'vtk', (b'made', b'Made'), (b'6 7\n', b'6 8\n'))
        self.expect_judged(grid, 'vtk', (b'made', b'Made'))

    def test_reads_vtk_in_xml(self):
        def array(name, kind, numbers, compressed):
            raw = struct.pack(f'<{len(numbers)}{kind}', *numbers)
            if compressed:
                packed = zlib.compress(raw)
                data = base64.b64encode(struct.pack('<4I', 1, len(raw), 0, len(packed))) + base64.b64encode(packed)
            else:
                data = base64.b64encode(struct.pack('<I', len(raw)) + raw)
            types = {'d': 'Float64', 'q': 'Int64', 'B': 'UInt8'}
            return (f'<DataArray type="{types[kind]}" Name="{name}" NumberOfComponents="3" format="binary">\n'
                    f'{data.decode()}\n</DataArray>')

        def surface(tip, compressed, kind):
            numbers = [float(x) for x in self.points(tip).split()]
            corners = [v for f in self.FACES for v in f]
            tag, count = ('Polys', 'NumberOfPolys') if kind == 'PolyData' else ('Cells', 'NumberOfCells')
            compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ''
            return (f'<?xml version="1.0"?><VTKFile type="{kind}" byte_order="LittleEndian"{compressor}><{kind}>'
                    f'<Piece NumberOfPoints="7" {count}="5"><PointData>{array("a", "d", [1, 2], compressed)}</PointData>'
                    f'<Points>{array("Points", "d", numbers, compressed)}</Points><{tag}>'
                    f'{array("connectivity", "q", corners, compressed)}{array("offsets", "q", [3, 6, 9, 12, 15], compressed)}'
                    f'{array("types", "B", [5] * 5, compressed)}</{tag}></Piece></{kind}></VTKFile>').encode()
        for compressed in (False, True):
            other = array('a', 'd', [1, 2], compressed).encode(), array('a', 'd', [1, 3], compressed).encode()
            self.expect_judged(lambda tip: surface(tip, compressed, 'PolyData'), 'vtp', other, (b'1.0', b'1.1'))
            self.expect_judged(lambda tip: surface(tip, compressed, 'UnstructuredGrid'), 'vtu', other)

    def test_reads_gmsh(self):
        def surface(tip):
            nodes = '\n'.join(f'{k + 1} {p}' for k, p in enumerate(self.points(tip).split('\n')))
            faces = '\n'.join(f'{k + 1} 2 2 0 9 ' + ' '.join(str(v + 1) for v in f) for k, f in enumerate(self.FACES))
            return (f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n{nodes}\n$EndNodes\n'
                    f'$Elements\n6\n9 15 2 0 1 1\n{faces}\n$EndElements\n').encode()
        self.expect_judged(surface, 'msh', (b' 0 9 ', b' 0 8 '))

    def test_reads_abaqus(self):
        def surface(tip):
            nodes = '\n'.join(f'{10 * k + 10}, {p.replace(" ", ", ")}' for k, p in enumerate(self.points(tip).split('\n')))
            faces = '\n'.join(f'{k + 1}, ' + ', '.join(str(10 * v + 10) for v in f) for k, f in enumerate(self.FACES))
            return f'*Heading\nmade\n*Node\n{nodes}\n*Element, type=S3, elset=a\n{faces}\n*Step\n1, 2\n'.encode()
        self.expect_judged(surface, 'inp', (b'made', b'Made'), (b'1, 2\n', b'1, 3\n'))

    def test_reads_gifti(self):
        def surface(tip):
            return (f'<?xml version="1.0"?><GIFTI><DataArray Intent="NIFTI_INTENT_POINTSET" DataType="NIFTI_TYPE_FLOAT32" '
                    f'ArrayIndexingOrder="RowMajorOrder" Dim0="7" Dim1="3" Encoding="ASCII"><Data>{self.points(tip)}</Data>'
                    f'</DataArray><DataArray Intent="NIFTI_INTENT_TRIANGLE" DataType="NIFTI_TYPE_INT32" Encoding="ASCII" '
                    f'ArrayIndexingOrder="RowMajorOrder" Dim0="5" Dim1="3"><Data>'
                    + ' '.join(str(v) for f in self.FACES for v in f) + '</Data></DataArray></GIFTI>').encode()
        self.expect_judged(surface, 'gii', (b'1.0', b'1.1'))

    def test_reads_3mf(self):
        head = '<?xml version="1.0"?><model><resources>'

        def package(tip, other='kept'):
            # The second part is where its component says: 3 below its own zero.
            vertices = ['<vertex x="%s" y="%s" z="%s"/>' % tuple(p.split()) for p in self.points(tip).split('\n')]
            vertices[3:] = [v.replace('z="-3"', 'z="0"').replace(f'z="{tip}"', f'z="{tip + 3}"') for v in vertices[3:]]
            faces = ['<triangle v1="%d" v2="%d" v3="%d"/>' % f for f in [(0, 1, 2), (0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]]

            def mesh(vertices, faces):
                return f'<mesh><vertices>{"".join(vertices)}</vertices><triangles>{"".join(faces)}</triangles></mesh>'
            parts = f'{head}<object id="1">{mesh(vertices[3:], faces[1:])}</object></resources><build/></model>'
            model = (f'{head}<object id="1">{mesh(vertices[:3], faces[:1])}</object><object id="2"><components>'
                     '<component objectid="1"/><component p:path="/3D/Objects/a.model" objectid="1" '
                     'transform="1 0 0 0 1 0 0 0 1 0 0 -3"/></components></object></resources>'
                     '<build><item objectid="2"/></build></model>')
            file = io.BytesIO()
            with zipfile.ZipFile(file, 'w') as archive:
                for name, text in (('3D/3dmodel.model', model), ('3D/Objects/a.model', parts), ('Metadata/a', other)):
                    archive.writestr(zipfile.ZipInfo(name), text)
            return file.getvalue()
        self.expect_judged(package, '3mf')
        self.expect(['file'], package(1), package(-1, 'lost'), '3mf')

    def test_reads_what_the_fuzzers_start_from(self):
        seeds = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'fuzz', 'seeds')
        count = 0
        for folder, form in (('vtk', 'vtk'), ('vtp', 'vtp'), ('msh', 'msh'), ('inp', 'inp'), ('gii', 'gii'), ('threemf', '3mf'),
                             ('surf', 'surf')):
            for name in sorted(os.listdir(os.path.join(seeds, folder))):
                if name == 'external.gii':  # its other file is not there
                    continue
                with self.subTest(seed=name):
                    self.assertGreater(len(verify.read(os.path.join(seeds, folder, name), form).faces), 0)
                    count += 1
        self.assertGreater(count, 15)

    def test_reads_freesurfer_quadrangles(self):
        def surface(tip):
            points = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, tip), (1, 3, tip), (3, 2, -3), (3, 1, -3)]
            corners = b''.join(v.to_bytes(3, 'big') for v in (0, 1, 2, 3, 4, 5, 6, 7))
            return (b'\xff\xff\xfd' + (8).to_bytes(3, 'big') + (2).to_bytes(3, 'big')
                    + b''.join(struct.pack('>3f', *p) for p in points) + corners + b'tags')
        self.expect_judged(surface, 'surf', (b'tags', b'gats'))

    def test_accepts_a_repair(self):
        self.expect([], STUCK, DRAWN_BACK)
        self.expect([], STUCK, DRAWN_BACK, 'obj', '--float32')
        self.expect([], STUCK, DRAWN_BACK, 'obj', '--fixed', self.file('ids', b'0 1 # the triangle\n2'))

    def test_says_only_what_is_broken_when_quiet(self):
        self.assertEqual(self.run_on(STUCK, DRAWN_BACK, 'obj', '--quiet')[2], '')
        self.assertIn('BROKEN', self.run_on(STUCK, STUCK, 'obj', '--quiet')[2])

    def test_accepts_partial_results_that_are_no_worse(self):
        self.expect([], STUCK, STUCK, 'obj', '--no-worse')
        self.expect(['embedded'], DRAWN_BACK, STUCK, 'obj', '--no-worse')

    # What is not.

    def test_intersections(self):
        self.expect(['embedded'], STUCK, STUCK)
        self.expect(['embedded'], STUCK, OBJ % b'0')  # touches

    def test_other_faces(self):
        self.expect(['faces'], STUCK, DRAWN_BACK.replace(b'f 1 2 3', b'f 1 3 2'))
        self.expect(['faces'], STUCK, DRAWN_BACK.replace(b'f 5 7 6\n', b''))
        self.expect(['faces'], STUCK, DRAWN_BACK.replace(b'vt', b'v 9 9 9\nvt'))

    def test_other_bytes(self):
        for old, new in ((b'# two', b'# 2'), (b'vt 0 0', b'vt 0 1'), (b'usemtl x', b'usemtl y'), (b'5/1', b'5/2'),
                         (b'v 0 0 0\n', b'v 0 0 0\r\n'), (b'# kept', b'# Kept'), (b'v 4 0', b'v  4 0')):
            self.expect(['file'], STUCK, DRAWN_BACK.replace(old, new, 1))

    def test_a_coordinate_written_anew_without_need(self):
        self.expect(['file'], STUCK, DRAWN_BACK.replace(b'4.0', b'4'))

    def test_fixed_vertices(self):
        self.expect(['fixed'], STUCK, DRAWN_BACK, 'obj', '--fixed', self.file('ids', b'0 3'))

    def test_rounding_to_float32(self):
        lid = b'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 %s\nv 0.2 0.2 1\nv 0.3 0.2 1\nf 1 2 3\nf 4 5 6\n'
        high, close = lid % b'0.5', lid % b'1e-60'
        self.expect([], close, close)
        self.expect(['float32'], high, close, 'obj', '--float32')

    def test_lost_area(self):
        flat = b'v 0 0 0\nv 1 0 0\nv %s 0\nf 1 2 3\n'
        self.expect(['areas'], flat % b'0 1', flat % b'2 0')
        self.expect([], flat % b'2 0', flat % b'2 0')

    def test_torn_seams(self):
        # Two triangles with a common side, each with corners of its own.
        sheet = b'v 0 0 0\nv 1 0 0\nv 0 1 0\nv %s 1 0\nv 1 0 0\nv 1 1 1\nf 1 2 3\nf 4 5 6\n'
        self.expect([], sheet % b'0', sheet % b'0')
        self.expect(['embedded'], sheet % b'0', sheet % b'0', 'obj', '--weld', 'none')
        self.expect(['seams'], sheet % b'0', sheet % b'0.1')

    def test_every_class(self):
        def pair(*points, faces='f 1 2 3\nf 4 5 6\n'):
            return (''.join('v %s %s %s\n' % p for p in points) + faces).encode()
        one_vertex = pair((0, 0, 0), (2, -1, 0), (2, 1, 0), (2, 0, -1), (2.1, 0, 1), faces='f 1 2 3\nf 1 4 5\n')
        folded = pair((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), faces='f 1 2 3\nf 1 2 4\n')
        apart = pair((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), faces='f 1 2 3\nf 1 2 4\n')
        duplicate = pair((0, 0, 0), (1, 0, 0), (0, 1, 0), faces='f 1 2 3\nf 3 2 1\n')
        degenerate = pair((0, 0, 0), (1, 0, 0), (0, 1, 0), (.2, .2, -1), (.2, .2, 1), (.2, .2, 3))
        coplanar = pair((0, 0, 0), (2, 0, 0), (0, 2, 0), (.5, .5, 0), (1, .5, 0), (.5, 3, 0))
        for mesh, name in ((one_vertex, '1 one_vertex'), (folded, '1 folded'), (duplicate, '1 duplicate'),
                           (degenerate, '1 degenerate'), (coplanar, '1 disjoint')):
            code, broken, said = self.run_on(mesh, mesh)
            self.assertEqual((code, broken), (1, ['embedded']), said)
            self.assertIn('faces: ' + name, said)
        self.expect([], apart, apart)
        self.expect([], one_vertex, one_vertex, 'obj', '--goal', 'disjoint')

    def test_polygons_are_cut_as_the_input_is(self):
        # A dart: cut along its other diagonal. In the second state the first one would be taken.
        dart = [(0., 0., 0.), (4., 4., 0.), (0., 1., 0.), (-4., 4., 0.)]
        self.assertEqual(cut((3, 0, 1, 2), dart), [(0, 1, 2), (0, 2, 3)])
        self.assertEqual(cut((0, 1, 2, 3), dart), [(0, 1, 2), (0, 2, 3)])
        square = [(0., 0., 0.), (4., 0., 0.), (4., 4., 0.), (0., 4., 0.)]
        self.assertEqual(cut((3, 0, 1, 2), square), [(3, 0, 1), (3, 1, 2)])
        ell = [(0., 0., 0.), (2., 0., 0.), (2., 1., 0.), (1., 1., 0.), (1., 2., 0.), (0., 2., 0.)]
        area = sum(abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2
                   for a, b, c in ([ell[v] for v in t] for t in cut(tuple(range(6)), ell)))
        self.assertEqual(area, 3)

    def test_polygons_are_cut_alike_at_any_power_of_two(self):
        dice = random.Random(3)
        for size in (4, 4, 7):
            for _ in range(200):
                points = [tuple(dice.uniform(-1, 1) for _ in range(3)) for _ in range(size)]
                expected = cut(tuple(range(size)), points)
                for exponent in (-1000, -300, 300, 512, 900, 1022):
                    scaled = [tuple(math.ldexp(c, exponent) for c in p) for p in points]
                    self.assertEqual(cut(tuple(range(size)), scaled), expected)

    def test_faces_with_a_repeated_vertex_are_segments_and_points(self):
        sheet = b'v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 %s\nv 1 1 2\nf 1 2 3\n'
        for face in (b'f 4 4 5\n', b'f 4 5 4 5\n'):
            self.expect(['embedded'], sheet % b'-1' + face, sheet % b'-1' + face)
            self.expect([], sheet % b'-1' + face, sheet % b'1' + face)
        self.expect(['embedded'], sheet % b'0' + b'f 4 4 4\n', sheet % b'0' + b'f 4 4 4\n')
        self.expect([], sheet % b'0' + b'f 4 4 4\n', sheet % b'1' + b'f 4 4 4\n')
        flat = b'v 0 0 0\nv 2 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n'
        self.expect([], flat, flat)  # the triangle without area shares the edge on which it lies
        self.expect(['embedded'], flat + b'f 1 1 3\n', flat + b'f 1 1 3\n')
        own = sheet % b'1' + b'f 1 1 1\nf 2 1 2\n'  # an edge and a corner of the triangle
        self.expect([], own, own)

    def test_unreadable_files_and_senseless_arguments(self):
        self.assertEqual(self.run_on(STUCK, b'v 1 2\n')[0], 3)
        self.assertEqual(self.run_on(STUCK, b'v 1 2 x\n')[0], 3)
        self.assertEqual(self.run_on(STUCK, b'v 1 2 nan\n')[0], 3)
        self.assertEqual(self.run_on(b'f 1 2 3\n', b'f 1 2 3\n')[0], 3)
        self.assertEqual(self.run_on(b'', b'', 'ply')[0], 3)
        self.assertEqual(self.run_on(STUCK, STUCK, 'doc')[0], 3)
        self.assertEqual(self.run_on(STUCK, STUCK, 'obj', '--fixed', self.file('ids', b'7'))[0], 3)
        self.assertEqual(self.run_on(STUCK, STUCK, 'obj', '--weld', 'some')[0], 2)

    # Other formats.

    def test_off(self):
        for layout in (b'OFF\n# c\n6 2 0\n%s\n3 0 1 2 9 9 9\n3 3 4 5\n', b'OFF6 2\n%s 3 0 1 2 3 3 4 5'):
            points = b'0 0 0\n2 0 0\n0 2 0\n.5 .5 %s\n.5 1 3\n1 .5 3'
            bad, good = layout % (points % b'-1'), layout % (points % b'1')
            self.expect([], bad, good, 'off')
            self.expect(['embedded'], bad, bad, 'off')
            self.expect(['faces'], bad, good.replace(b'3 3 4 5', b'3 3 5 4'), 'off')

    def test_ply(self):
        points = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (.5, .5, -1), (.5, 1, 3), (1, .5, 3)]

        def ply(form, tip, colour=7):
            header = (f'ply\nformat {form} 1.0\nelement vertex 6\nproperty uchar red\nproperty float x\nproperty float y\n'
                      'property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n').encode()
            at = points[:3] + [(.5, .5, tip)] + points[4:]
            if form == 'ascii':
                return header + ''.join(f'{colour} {x} {y} {z}\n' for x, y, z in at).encode() + b'3 0 1 2\n3 3 4 5\n'
            order = '>' if 'big' in form else '<'
            return (header + b''.join(struct.pack(order + 'Bffd', colour, *p) for p in at) +
                    struct.pack(order + 'B3iB3i', 3, 0, 1, 2, 3, 3, 4, 5))
        for form in ('ascii', 'binary_little_endian', 'binary_big_endian'):
            self.expect([], ply(form, -1), ply(form, 1), 'ply')
            self.expect(['embedded'], ply(form, -1), ply(form, -2), 'ply')
            self.expect(['file'], ply(form, -1), ply(form, 1, 8), 'ply')

    def test_stl(self):
        def facets(tip):
            return [((0, 0, 1), [(0, 0, 0), (2, 0, 0), (0, 2, 0)]), (None, [(.5, .5, tip), (.5, 1, 3), (1, .5, 3)])]

        def normal(tip):
            a, b, c = facets(tip)[1][1]
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            return tuple(k / sum(q * q for q in n)**.5 for k in n)

        def text(tip, n=None):
            lines = ['solid s']
            for stored, corners in facets(tip):
                lines += ['facet normal %s %s %s' % (stored or n or normal(tip)), 'outer loop']
                lines += ['vertex %s %s %s' % p for p in corners] + ['endloop', 'endfacet']
            return '\n'.join(lines + ['endsolid s\n']).encode()

        def binary(tip, n=None):
            return bytes(80) + struct.pack('<I', 2) + b''.join(
                struct.pack('<12fH', *(stored or n or normal(tip)), *itertools.chain(*corners), 5)
                for stored, corners in facets(tip))
        for stl in (text, binary):
            self.expect([], stl(-1), stl(1), 'stl')
            self.expect(['embedded'], stl(-1), stl(-2), 'stl')
            self.expect(['file'], stl(-1), stl(1, (0, 0, 1)), 'stl')
            self.expect([], stl(-1, (0, 0, 0)), stl(1, (0, 0, 0)), 'stl')
        self.expect(['file'], binary(-1), binary(1)[:-1] + b'x', 'stl')

    def test_glb(self):
        def glb(tip, low=None, name='n', colour=b'\1\2\3\4'):
            points = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (.5, .5, tip), (.5, 1, 3), (1, .5, 3)]
            data = b''.join(struct.pack('<3f', *p) for p in points) + struct.pack('<6H', *range(6)) + colour
            lo, hi = [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]
            root = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}],
                    'nodes': [{'mesh': 0, 'name': name, 'translation': [1, 2, 3], 'rotation': [0, 0.6, 0, 0.8]}],
                    'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
                    'buffers': [{'byteLength': len(data)}], 'bufferViews': [
                        {'buffer': 0, 'byteLength': 72}, {'buffer': 0, 'byteOffset': 72, 'byteLength': 12}],
                    'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 6, 'type': 'VEC3', 'min': low or lo,
                                   'max': hi}, {'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'}]}
            text = json.dumps(root).encode()
            text += b' ' * (-len(text) % 4)
            return (struct.pack('<4sII', b'glTF', 2, 28 + len(text) + len(data)) + struct.pack('<I4s', len(text), b'JSON') +
                    text + struct.pack('<I4s', len(data), b'BIN\0') + data)
        self.expect([], glb(-1), glb(1), 'glb')
        self.expect(['embedded'], glb(-1), glb(-2), 'glb')
        self.expect(['file'], glb(-1), glb(1, low=[0, 0, -1]), 'glb')
        self.expect(['file'], glb(-1), glb(1, name='m'), 'glb')
        self.expect(['file'], glb(-1), glb(1, colour=b'\1\2\3\5'), 'glb')

    # The geometry.

    def test_quick_proofs_agree_with_the_definition(self):
        """On a small lattice, where everything that can touch does."""
        chance = random.Random(1)
        met = apart = 0
        for _ in range(3000):
            size = chance.choice((2, 3, 5))
            points = [tuple(chance.randrange(size) for _ in range(3)) for _ in range(6)]
            shared = chance.randrange(3)
            triangles = [(0, 1, 2), tuple(range(shared)) + tuple(range(3, 6 - shared))]
            detector = Detector(points, triangles)
            literally = meet_outside_hull(*([points[v] for v in t] for t in triangles), [points[v] for v in range(shared)])
            backwards = meet_outside_hull(*([points[v] for v in t] for t in triangles[::-1]),
                                          [points[v] for v in range(shared)])
            self.assertEqual(literally, backwards, (points, shared))
            self.assertEqual(detector.kind(0, 1) is not None, literally, (points, shared))
            met += literally
            apart += not literally
        self.assertGreater(min(met, apart), 500)

    def test_the_broad_phase_misses_nothing(self):
        chance = random.Random(2)
        points = [tuple(chance.randrange(40) for _ in range(3)) for _ in range(240)]
        triangles = [tuple(chance.sample(range(240), 3)) for _ in range(120)]
        detector = Detector(points, triangles)
        expected = [(i, j, detector.kind(i, j)) for i in range(120) for j in range(i + 1, 120)]
        self.assertEqual(detector.find(), [pair for pair in expected if pair[2]])

    def test_weld_map(self):
        def vertices_of(faces, positions, weld='seams', tolerance=0):
            mesh = Mesh()
            mesh.positions, mesh.faces = positions, faces
            return len(set(weld_map(mesh, weld, tolerance)))
        square = [(0., 0., 0.), (1., 0., 0.), (1., 1., 0.), (0., 1., 0.)]
        soup = [square[v] for v in (0, 1, 2, 0, 2, 3)]
        self.assertEqual(vertices_of([(0, 1, 2), (3, 4, 5)], soup), 4)
        self.assertEqual(vertices_of([(0, 1, 2), (3, 4, 5)], soup, 'none'), 6)
        self.assertEqual(vertices_of([(0, 1, 2, 3), (7, 6, 5, 4)], square + square), 8)  # coincident sheets
        self.assertEqual(vertices_of([(0, 1, 2, 3), (7, 6, 5, 4)], square + square, 'all'), 4)
        # A closed surface, two inner vertices of which (0 and 1) lie at one position; and a book of four pages.
        octahedron = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
        self.assertEqual(vertices_of(octahedron, [(0., 0., 0.)] * 2 + square), 6)
        for pages, count in ((2, 6), (4, 16)):
            book = [p for k in range(pages) for p in ((0., 0., 0.), (0., 0., 1.), (1., k, 0.), (2., k, 1.))]
            faces = [f for v in range(0, 4 * pages, 4)
                     for f in ((v + v // 4 % 2, v + 1 - v // 4 % 2, v + 2), (v + 2, v + 1, v + 3))]
            self.assertEqual(vertices_of(faces, book), count)
        near = soup[:3] + [(x + 1e-3, y, z) for x, y, z in soup[3:]]
        self.assertEqual(vertices_of([(0, 1, 2), (3, 4, 5)], near), 6)
        self.assertEqual(vertices_of([(0, 1, 2), (3, 4, 5)], near, 'seams', 0.01), 4)


if __name__ == '__main__':
    unittest.main()
