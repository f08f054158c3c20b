# SPDX-License-Identifier: Apache-2.0
"""Runs in pvpython: the plug-in gives the positions that `unsnarl fix` gives, and keeps all else. filter_test.py PROGRAM"""

import json
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkMultiBlockDataSet, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import unsnarl
from unsnarl.vtk import RepairFilter

PROGRAM = sys.argv.pop(1)
simple.LoadPlugin(str(Path(__file__).with_name("unsnarl_paraview.py")), remote=False, ns=globals())


def surface_of(V, F, dtype=np.float32):
    points, polygons, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.asarray(V, dtype), deep=1))
    for face in F:
        polygons.InsertNextCell(len(face), [int(i) for i in face])
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    return surface


def tubes(dtype=np.float32):
    return surface_of(*unsnarl.sample("crossing_tubes", resolution=16), dtype)


def with_arrays(surface):
    """The surface with lines, single points, and an array of each kind."""
    lines, points = vtkCellArray(), vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    points.InsertNextCell(1, [3])
    surface.SetLines(lines)
    surface.SetVerts(points)
    for data, count in ((surface.GetPointData(), surface.GetNumberOfPoints()),
                        (surface.GetCellData(), surface.GetNumberOfCells()), (surface.GetFieldData(), 5)):
        array = numpy_to_vtk(np.arange(count), deep=1)
        array.SetName("own")
        data.AddArray(array)
    return surface


def positions(surface):
    return vtk_to_numpy(surface.GetPoints().GetData())


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def status(surface):
    return surface.GetFieldData().GetAbstractArray("unsnarl_status").GetValue(0)


def updated(given, **options):
    repair = RepairFilter()
    repair.SetInputDataObject(given)
    for name, value in options.items():
        getattr(repair, f"Set{name}")(value)
    repair.Update()
    return repair.GetOutputDataObject(0)


class Silent(vtkOutputWindow):
    pass


class Filter(unittest.TestCase):
    def fixed_by_the_program(self, surface, *options):
        with tempfile.TemporaryDirectory() as folder:
            writer, reader = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader()
            writer.SetFileName(f"{folder}/in.vtp")
            writer.SetInputData(surface)
            writer.Write()
            done = subprocess.run([PROGRAM, "fix", f"{folder}/in.vtp", "-o", f"{folder}/out.vtp", "--quiet",
                                   "--keep-partial", *options], capture_output=True, text=True)
            self.assertIn(done.returncode, (0, 1, 5, 7), done.stderr)
            reader.SetFileName(f"{folder}/out.vtp")
            reader.Update()
            return positions(reader.GetOutput()).copy()

    def test_positions_are_those_of_the_program(self):
        for dtype in (np.float32, np.float64):
            with self.subTest(dtype=dtype.__name__):
                given = with_arrays(tubes(dtype))
                source = simple.TrivialProducer()
                source.GetClientSideObject().SetOutput(given)
                shown = RepairSelfIntersections(source)  # noqa: F821 (LoadPlugin brings it)
                shown.MinGap = 0.001
                result = servermanager.Fetch(shown)
                self.assertEqual(status(result), "embedded")
                expected = self.fixed_by_the_program(given, "--min-gap", "0.001")
                self.assertEqual(positions(result).dtype, dtype)
                self.assertEqual(positions(result).tobytes(), expected.tobytes())

    def test_all_else_is_kept(self):
        given = with_arrays(tubes())
        result = updated(given)
        for one, other in ((result.GetPointData(), given.GetPointData()), (result.GetCellData(), given.GetCellData()),
                           (result.GetFieldData(), given.GetFieldData())):
            self.assertTrue(np.array_equal(array(one, "own"), array(other, "own")))
        self.assertEqual((result.GetNumberOfLines(), result.GetNumberOfVerts()), (1, 1))
        moved = array(result.GetPointData(), "unsnarl_displacement")
        self.assertTrue(np.array_equal(moved, positions(result) - positions(given)))
        before = array(result.GetCellData(), "unsnarl_intersecting_before")
        pairs = unsnarl.find_intersections(given).pairs
        self.assertTrue(np.array_equal(np.flatnonzero(before), np.unique(pairs) + 2))
        self.assertFalse(array(result.GetCellData(), "unsnarl_intersecting").any())
        report = json.loads(result.GetFieldData().GetAbstractArray("unsnarl_report").GetValue(0))
        self.assertEqual(report["before"]["total"], len(pairs))

    def test_held_points_and_what_is_left(self):
        given = tubes()
        held = numpy_to_vtk(np.ones(given.GetNumberOfPoints()), deep=1)
        held.SetName("held")
        given.GetPointData().AddArray(held)
        result = updated(given, FixedArray="held")
        self.assertEqual(status(result), "obstructed")
        self.assertEqual(positions(result).tobytes(), positions(given).tobytes())
        self.assertTrue(array(result.GetCellData(), "unsnarl_intersecting").any())
        self.assertEqual(updated(given, FixedArray="none such").GetNumberOfPoints(), 0)

    def test_blocks_are_one_scene(self):
        V, F = unsnarl.sample("crossing_tubes", resolution=16)
        halves = [surface_of(V, part) for part in np.split(F, 2)]
        blocks, inner = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
        blocks.SetBlock(0, halves[0])
        inner.SetBlock(1, halves[1])
        blocks.SetBlock(2, inner)
        result = updated(blocks)
        self.assertIsInstance(result, vtkMultiBlockDataSet)
        expected = unsnarl.repair(halves).V
        self.assertEqual(positions(result.GetBlock(0)).tobytes(), expected[0].tobytes())
        self.assertEqual(positions(result.GetBlock(2).GetBlock(1)).tobytes(), expected[1].tobytes())
        blocks.SetBlock(3, vtkUnstructuredGrid())
        self.assertEqual(updated(blocks).GetNumberOfBlocks(), 0)

    def test_empty_input_and_strips(self):
        self.assertEqual(status(updated(vtkPolyData())), "embedded")
        strips, given = vtkCellArray(), tubes()
        strips.InsertNextCell(4, [0, 1, 2, 3])
        given.SetStrips(strips)
        self.assertEqual(updated(given).GetNumberOfPoints(), 0)

    def test_progress_and_abort(self):
        repair, seen = RepairFilter(), []
        repair.SetInputDataObject(tubes())

        def watch(caller, event):
            seen.append(caller.GetProgress())
            caller.AbortExecuteOn()

        repair.AddObserver("ProgressEvent", watch)
        repair.Update()
        self.assertTrue(seen)
        result = repair.GetOutputDataObject(0)
        self.assertEqual(status(result), "cancelled")
        self.assertEqual(positions(result).tobytes(), positions(tubes()).tobytes())

    def test_overhead_is_measured(self):
        given = surface_of(*unsnarl.sample("crossing_tubes", resolution=136))
        begin = time.monotonic()
        own = unsnarl.repair(given)
        library = time.monotonic() - begin
        begin = time.monotonic()
        result = updated(given)
        print(f"{given.GetNumberOfCells()} cells: {time.monotonic() - begin:.2f} s in the filter, {library:.2f} s in the "
              "library alone", file=sys.stderr)
        self.assertEqual(positions(result).tobytes(), own.V.tobytes())


if __name__ == "__main__":
    unittest.main(argv=["filter_test.py"])
