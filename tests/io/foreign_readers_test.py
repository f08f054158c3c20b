#!/usr/bin/env python3
"""What other programs wrote is repaired, and they read it back: the same faces and data, and no self-intersection in
the positions as they see them. Each is asked where it is installed, and what is not installed is named (all: Debian's
python3-nibabel, python3-meshio, python3-vtk9, python3-gmsh, lib3mf1, connectome-workbench). Skipped (77) where none is.

usage: foreign_readers_test.py PROGRAM
"""
import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile
from pathlib import Path

VERIFY = Path(__file__).resolve().parents[2] / 'tools' / 'verify.py'
DEBIAN_PYTHON = '/usr/bin/python3'  # has the modules of Debian's packages
SKIPPED = 77
MODULES = ['numpy', 'nibabel', 'meshio', 'vtk', 'gmsh']
PROGRAM = None


def module(test, name):
    try:
        return __import__(name)
    except ImportError:
        test.skipTest(f'the module {name} is not installed')


def write_off(path, points, faces):
    lines = ['OFF', f'{len(points)} {len(faces)} 0']
    lines += [' '.join(repr(float(x)) for x in point) for point in points]
    lines += [f'{len(face)} ' + ' '.join(str(int(v)) for v in face) for face in faces]
    path.write_text('\n'.join(lines) + '\n')


class ForeignReaders(unittest.TestCase):
    def setUp(self):
        self.np = module(self, 'numpy')
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        # A tetrahedron, and a small one whose tip sticks into it.
        self.points = self.np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1.2, 1.2, 1.1], [2.6, 2.5, 2],
                                     [2.5, 2.6, 2.2], [2.4, 2.4, 2.7]])
        self.faces = self.np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2], [4, 6, 5], [4, 5, 7], [5, 6, 7],
                                    [4, 7, 6]])

    def repaired(self, name):
        target = self.folder / ('fixed_' + name)
        done = subprocess.run([PROGRAM, 'fix', self.folder / name, '-o', target, '--quiet'], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return target

    def judge(self, before, after, faces):
        """Positions as the other program sees them."""
        self.assertEqual(before.shape, after.shape)
        self.assertFalse(self.np.array_equal(before, after))
        self.assertLess(self.np.abs(before - after).max(), 2)
        write_off(self.folder / 'before.off', before, faces)
        write_off(self.folder / 'after.off', after, faces)
        done = subprocess.run([sys.executable, VERIFY, self.folder / 'before.off', self.folder / 'after.off'],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_freesurfer(self):
        module(self, 'nibabel')
        from nibabel import freesurfer
        freesurfer.write_geometry(self.folder / 'lh.pial', self.points, self.faces, 'made by a test')
        target = self.repaired('lh.pial')
        before, faces = freesurfer.read_geometry(self.folder / 'lh.pial')
        after, same_faces, stamp = freesurfer.read_geometry(target, read_stamp=True)
        self.assertTrue(self.np.array_equal(faces, same_faces))
        self.assertEqual(stamp, 'made by a test')
        self.judge(before, after, faces)

    def test_gifti(self):
        nibabel = module(self, 'nibabel')
        from nibabel import gifti
        for encoding in ('ASCII', 'B64BIN', 'B64GZ'):
            with self.subTest(encoding):
                arrays = [gifti.GiftiDataArray(self.points.astype('f4'), 'NIFTI_INTENT_POINTSET', 'NIFTI_TYPE_FLOAT32',
                                               'GIFTI_ENCODING_' + encoding, meta={'AnatomicalStructurePrimary': 'CortexLeft'}),
                          gifti.GiftiDataArray(self.faces.astype('i4'), 'NIFTI_INTENT_TRIANGLE', 'NIFTI_TYPE_INT32',
                                               'GIFTI_ENCODING_' + encoding)]
                nibabel.save(gifti.GiftiImage(darrays=arrays), self.folder / 'a.surf.gii')
                images = [nibabel.load(self.folder / 'a.surf.gii'), nibabel.load(self.repaired('a.surf.gii'))]
                (before, faces), (after, same_faces) = [image.agg_data() for image in images]
                self.assertTrue(self.np.array_equal(faces, same_faces))
                self.assertEqual(images[0].darrays[0].meta, images[1].darrays[0].meta)
                self.judge(before, after, faces)

    def external_gifti(self, order, points_in, faces_in):
        """a.surf.gii with its numbers in these files (behind `offset` other bytes where it is one), without nibabel,
        which does not write such files."""
        points, faces = self.points.astype(order + 'f4').tobytes(), self.faces.astype(order + 'i4').tobytes()
        offset = 16
        if points_in == faces_in:
            (self.folder / points_in).write_bytes(bytes(offset) + points + faces)
            faces_at = offset + len(points)
        else:
            (self.folder / points_in).write_bytes(bytes(offset) + points)
            (self.folder / faces_in).write_bytes(faces)
            faces_at = 0
        endian = {'<': 'LittleEndian', '>': 'BigEndian'}[order]
        array = ('<DataArray Intent="NIFTI_INTENT_{}" DataType="NIFTI_TYPE_{}" ArrayIndexingOrder="RowMajorOrder" '
                 'Dimensionality="2" Dim0="8" Dim1="3" Encoding="ExternalFileBinary" Endian="' + endian +
                 '" ExternalFileName="{}" ExternalFileOffset="{}"><MetaData><MD><Name>made by</Name><Value>a test</Value>'
                 '</MD></MetaData>{}<Data></Data></DataArray>\n')
        matrix = ('<CoordinateSystemTransformMatrix><DataSpace>NIFTI_XFORM_TALAIRACH</DataSpace><TransformedSpace>'
                  'NIFTI_XFORM_TALAIRACH</TransformedSpace><MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</MatrixData>'
                  '</CoordinateSystemTransformMatrix>')
        (self.folder / 'a.surf.gii').write_text(
            '<?xml version="1.0" encoding="UTF-8"?>\n<GIFTI Version="1.0" NumberOfDataArrays="2">\n' +
            array.format('POINTSET', 'FLOAT32', points_in, offset, matrix) +
            array.format('TRIANGLE', 'INT32', faces_in, faces_at, '') + '</GIFTI>\n')

    def test_gifti_with_external_files(self):
        nibabel = module(self, 'nibabel')
        for order in '<>':
            for points_in, faces_in in (('a.dat', 'a.dat'), ('p.dat', 'f.dat')):
                with self.subTest(order=order, files=(points_in, faces_in)):
                    self.external_gifti(order, points_in, faces_in)
                    kept = {name: (self.folder / name).read_bytes() for name in ('a.surf.gii', points_in, faces_in)}
                    images = [nibabel.load(self.folder / 'a.surf.gii', mmap=False)]
                    target = self.repaired('a.surf.gii')
                    self.assertEqual(kept, {name: (self.folder / name).read_bytes() for name in kept})
                    images.append(nibabel.load(target, mmap=False))
                    (before, faces), (after, same_faces) = [image.agg_data() for image in images]
                    self.assertEqual(images[1].darrays[0].ext_fname, target.name + '.data')
                    self.assertTrue(self.np.array_equal(before, self.points.astype('f4')))
                    self.assertTrue(self.np.array_equal(faces, same_faces))
                    self.assertEqual(images[0].darrays[0].meta, images[1].darrays[0].meta)
                    self.judge(before, after, faces)
                    target.unlink()
                    for path in self.folder.glob(target.name + '.*'):
                        path.unlink()

    def test_connectome_workbench(self):
        """What it writes in each encoding, and how it reads the repaired file."""
        nibabel = module(self, 'nibabel')
        program = shutil.which('wb_command')
        if not program:
            self.skipTest('wb_command (connectome-workbench) is not installed')

        def convert(encoding, source, target):
            done = subprocess.run([program, '-gifti-convert', encoding, self.folder / source, self.folder / target],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

        def seen(name):
            convert('ASCII', name, 'seen.surf.gii')
            image = nibabel.load(self.folder / 'seen.surf.gii')
            return *image.agg_data(), image.darrays[0].coordsys.xform.tolist()

        self.external_gifti('<', 'p.dat', 'f.dat')
        for encoding in ('ASCII', 'BASE64_BINARY', 'GZIP_BASE64_BINARY', 'EXTERNAL_FILE_BINARY'):
            with self.subTest(encoding):
                name = encoding.lower() + '.surf.gii'
                convert(encoding, 'a.surf.gii', name)
                before, faces, matrix = seen(name)
                after, same_faces, same_matrix = seen(self.repaired(name).name)
                self.assertTrue(self.np.array_equal(faces, same_faces))
                self.assertEqual(matrix, same_matrix)
                self.judge(before, after, faces)

    def test_missing_vertices(self):
        module(self, 'nibabel')
        from nibabel import freesurfer
        points = self.np.vstack([self.points, [[self.np.nan] * 3, [9, 9, 9]]])
        faces = self.np.vstack([self.faces, [[3, 8, 9]]])
        freesurfer.write_geometry(self.folder / 'rh.white', points, faces)
        after, same_faces = freesurfer.read_geometry(self.repaired('rh.white'))
        self.assertTrue(self.np.array_equal(faces, same_faces))
        self.assertTrue(self.np.isnan(after[8]).all())
        self.assertTrue(self.np.array_equal(after[9], points[9]))
        self.judge(points[:8].astype('f4'), after[:8], self.faces)

    def test_meshio(self):
        meshio = module(self, 'meshio')
        for name, options in (('a.msh', {'file_format': 'gmsh', 'binary': False}),
                              ('a.msh', {'file_format': 'gmsh', 'binary': True}),
                              ('a.msh', {'file_format': 'gmsh22', 'binary': False}),
                              ('a.msh', {'file_format': 'gmsh22', 'binary': True}), ('a.inp', {})):
            with self.subTest(name, **options):
                meshio.write(self.folder / name, meshio.Mesh(self.points, [('triangle', self.faces)]), **options)
                before, after = meshio.read(self.folder / name), meshio.read(self.repaired(name))
                self.assertTrue(self.np.array_equal(before.cells_dict['triangle'], after.cells_dict['triangle']))
                self.judge(before.points, after.points, after.cells_dict['triangle'])

    def package(self, name):
        vertices = ''.join('<vertex x="%r" y="%r" z="%r"/>' % tuple(map(float, p)) for p in self.points)
        triangles = ''.join('<triangle v1="%d" v2="%d" v3="%d"/>' % tuple(f) for f in self.faces)
        model = ('<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" '
                 'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model">'
                 f'<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources>'
                 '<build><item objectid="1"/></build></model>')
        packages = 'http://schemas.openxmlformats.org/package/2006/'
        types = (f'<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="{packages}content-types">'
                 '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
                 '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        relations = (f'<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="{packages}relationships"><Relationship '
                     'Target="/3D/3dmodel.model" Id="a" '
                     'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        with zipfile.ZipFile(self.folder / name, 'w', zipfile.ZIP_DEFLATED) as archive:
            for part, content in (('[Content_Types].xml', types), ('_rels/.rels', relations), ('3D/3dmodel.model', model),
                                  ('Metadata/notes.txt', 'keep me ' * 100)):
                archive.writestr(part, content)

    def test_3mf_as_a_plain_archive(self):
        self.package('a.3mf')
        with zipfile.ZipFile(self.folder / 'a.3mf') as old, zipfile.ZipFile(self.repaired('a.3mf')) as new:
            self.assertIsNone(new.testzip())
            self.assertEqual(old.namelist(), new.namelist())
            for name in set(old.namelist()) - {'3D/3dmodel.model'}:
                self.assertEqual(old.read(name), new.read(name))
            tree = xml.etree.ElementTree.fromstring(new.read('3D/3dmodel.model'))
        after = [[float(v.get(k)) for k in 'xyz'] for v in tree.iter() if v.tag.endswith('}vertex')]
        self.judge(self.points, self.np.array(after), self.faces)

    def test_lib3mf(self):
        try:
            library = ctypes.CDLL('lib3MF.so.1')
        except OSError:
            self.skipTest('lib3mf1 is not installed')

        def call(name, *arguments):
            self.assertEqual(getattr(library, 'lib3mf_' + name)(*arguments), 0, name)

        def read(path):
            model, reader, objects, mesh = (ctypes.c_void_p() for _ in range(4))
            call('createmodel', ctypes.byref(model))
            call('model_queryreader', model, b'3mf', ctypes.byref(reader))
            call('reader_readfromfileutf8', reader, str(path).encode())
            call('model_getmeshobjects', model, ctypes.byref(objects))
            call('resourceiterator_movenext', objects, ctypes.byref(ctypes.c_int()))
            call('resourceiterator_getcurrent', objects, ctypes.byref(mesh))
            result = []
            for kind, number in (('vertex', ctypes.c_float), ('triangle', ctypes.c_uint32)):
                count, record = ctypes.c_uint32(), (number * 3)()
                call(f'meshobject_get{kind}count', mesh, ctypes.byref(count))
                result.append([])
                for i in range(count.value):
                    call(f'meshobject_get{kind}', mesh, i, ctypes.byref(record))
                    result[-1].append(list(record))
            return result

        self.package('a.3mf')
        before, faces = read(self.folder / 'a.3mf')
        after, same_faces = read(self.repaired('a.3mf'))
        self.assertEqual(faces, same_faces)
        self.judge(self.np.array(before), self.np.array(after), faces)

    def vtk_data(self, vtk):
        points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
        for p in self.points:
            points.InsertNextPoint(*map(float, p))
        for face in self.faces:
            cells.InsertNextCell(3)
            for v in face:
                cells.InsertCellPoint(int(v))
        data, values = vtk.vtkPolyData(), vtk.vtkFloatArray()
        data.SetPoints(points)
        data.SetPolys(cells)
        values.SetName('values')
        for i in range(len(self.points)):
            values.InsertNextValue(i / 3)
        data.GetPointData().AddArray(values)
        return data

    def judge_vtk(self, vtk, reader, name):
        seen = []
        for path in (self.folder / name, self.repaired(name)):
            source = reader()
            source.SetFileName(str(path))
            source.Update()
            data = source.GetOutput()
            points = self.np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
            faces = [[data.GetCell(c).GetPointId(k) for k in range(3)] for c in range(data.GetNumberOfCells())]
            values = data.GetPointData().GetArray('values')
            seen.append((points, faces, [values.GetValue(i) for i in range(len(points))]))
        self.assertEqual(seen[0][1:], seen[1][1:])
        self.judge(seen[0][0], seen[1][0], seen[0][1])

    def test_vtk(self):
        vtk = module(self, 'vtk')
        for version in (42, 51):
            for mode in ('ASCII', 'Binary'):
                with self.subTest('legacy', version=version, mode=mode):
                    writer = vtk.vtkPolyDataWriter()
                    writer.SetInputData(self.vtk_data(vtk))
                    writer.SetFileName(str(self.folder / 'a.vtk'))
                    writer.SetFileVersion(version)
                    getattr(writer, 'SetFileTypeTo' + mode)()
                    writer.Write()
                    self.judge_vtk(vtk, vtk.vtkPolyDataReader, 'a.vtk')
        for mode in ('Ascii', 'Binary', 'Appended'):
            for compressor in ('None', 'ZLib'):
                for raw in (False, True):
                    for wide in (False, True):
                        with self.subTest('xml', mode=mode, compressor=compressor, raw=raw, wide=wide):
                            writer = vtk.vtkXMLPolyDataWriter()
                            writer.SetInputData(self.vtk_data(vtk))
                            writer.SetFileName(str(self.folder / 'a.vtp'))
                            getattr(writer, f'SetDataModeTo{mode}')()
                            getattr(writer, f'SetCompressorTypeTo{compressor}')()
                            writer.SetBlockSize(64)
                            writer.SetEncodeAppendedData(not raw)
                            getattr(writer, 'SetHeaderTypeToUInt64' if wide else 'SetHeaderTypeToUInt32')()
                            (writer.SetByteOrderToBigEndian if wide else writer.SetByteOrderToLittleEndian)()
                            writer.Write()
                            self.judge_vtk(vtk, vtk.vtkXMLPolyDataReader, 'a.vtp')

    def test_gmsh(self):
        gmsh = module(self, 'gmsh')
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber('General.Terminal', 0)
        for version in (2.2, 4.1):
            for binary in (0, 1):
                with self.subTest(version=version, binary=binary):
                    gmsh.clear()
                    gmsh.model.addDiscreteEntity(2, 1)
                    gmsh.model.mesh.addNodes(2, 1, range(1, 9), self.points.ravel())
                    gmsh.model.mesh.addElementsByType(1, 2, range(1, 9), (self.faces + 1).ravel())
                    gmsh.option.setNumber('Mesh.MshFileVersion', version)
                    gmsh.option.setNumber('Mesh.Binary', binary)
                    gmsh.write(str(self.folder / 'a.msh'))
                    seen = []
                    for path in (self.folder / 'a.msh', self.repaired('a.msh')):
                        gmsh.clear()
                        gmsh.open(str(path))
                        tags, points, _ = gmsh.model.mesh.getNodes()
                        order = self.np.argsort(tags)
                        _, nodes = gmsh.model.mesh.getElementsByType(2)
                        seen.append((points.reshape(-1, 3)[order], nodes.reshape(-1, 3).astype(int) - 1))
                    self.assertTrue(self.np.array_equal(seen[0][1], seen[1][1]))
                    self.judge(seen[0][0], seen[1][0], seen[0][1])


def all_are_there(python):
    modules = 'import importlib.util, sys; sys.exit(not all(map(importlib.util.find_spec, ' + repr(MODULES) + ')))'
    return subprocess.run([python, '-c', modules], capture_output=True).returncode == 0


if __name__ == '__main__':
    if sys.executable != DEBIAN_PYTHON and os.path.exists(DEBIAN_PYTHON) and not all_are_there(sys.executable):
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON] + sys.argv)
    PROGRAM = sys.argv[1]
    result = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False).result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if len(result.skipped) == result.testsRun else 0)
