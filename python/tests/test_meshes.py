"""Meshes of other packages: stand-ins with their attributes, and the packages themselves where they are installed."""

import importlib
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import unsnarl

PYPROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"


class Trimesh:
    def __init__(self, vertices, faces):
        self.vertices, self.faces, self.visual = vertices, faces, "colours"

    def copy(self):
        copied = Trimesh(self.vertices.copy(), self.faces.copy())
        copied.visual = self.visual
        return copied


class PolyData:
    """With a copy() as pyvista's, and faces stored as their size, then their vertices."""

    def __init__(self, points, faces):
        self.points, self.faces = points, faces

    def copy(self):
        return PolyData(self.points.copy(), self.faces.copy())


class MeshioMesh:
    """Without a copy()."""

    def __init__(self, points, cells):
        self.points, self.point_data = points, {"colour": np.arange(len(points))}
        self.cells = [SimpleNamespace(type=kind, data=data) for kind, data in cells]


def padded(faces):
    return np.concatenate([[len(face), *face] for face in faces])


def repaired_as_arrays(mesh, positions, V, F):
    """Checks that a mesh is repaired as its arrays are, into a copy of its own type; gives the copy."""
    before = np.array(positions(mesh))
    result, expected = unsnarl.repair(mesh), unsnarl.repair(V, F)
    assert result.status == "embedded"
    assert type(result.mesh) is type(mesh) and result.mesh is not mesh
    assert np.array_equal(positions(result.mesh), expected.V)
    assert np.array_equal(result.V, expected.V) and result.V.dtype == expected.V.dtype
    assert np.array_equal(positions(mesh), before)
    assert np.array_equal(unsnarl.find_intersections(mesh).pairs, unsnarl.find_intersections(V, F).pairs)
    return result.mesh


def test_vertices_and_faces(crossing):
    V, F = crossing
    mesh = repaired_as_arrays(Trimesh(V, F), lambda mesh: mesh.vertices, V, F)
    assert mesh.visual == "colours"
    assert np.array_equal(mesh.faces, F)


@pytest.mark.parametrize("mixed", [False, True])
def test_points_and_padded_faces(sheets, mixed):
    V, F = sheets
    V = V.astype(np.float32)
    faces = [*F[:-1].tolist(), F[-1, :3].tolist()] if mixed else F.tolist()
    polygons = (np.concatenate(faces), np.cumsum([0, *map(len, faces)]))
    mesh = repaired_as_arrays(PolyData(V, padded(faces)), lambda mesh: mesh.points, V, polygons)
    assert mesh.points.dtype == np.float32


def test_points_and_cells(sheets):
    V, F = sheets
    cells = [
        ("line", np.array([[0, 1]])),
        ("quad", F[:100]),
        ("vertex", np.array([[3]])),
        ("triangle", F[100:101, :3]),
        ("polygon", [list(face) for face in F[101:]]),
    ]
    faces = [*F[:100].tolist(), F[100, :3].tolist(), *F[101:].tolist()]
    polygons = (np.concatenate(faces), np.cumsum([0, *map(len, faces)]))
    mesh = repaired_as_arrays(MeshioMesh(V, cells), lambda mesh: mesh.points, V, polygons)
    assert np.array_equal(mesh.point_data["colour"], np.arange(len(V)))


def test_fixed_vertices_of_a_mesh(crossing):
    V, F = crossing
    result = unsnarl.repair(Trimesh(V, F), fixed=[0, 1, 2])
    assert np.array_equal(result.mesh.vertices[:3], V[:3])
    assert unsnarl.certify(Trimesh(V, F), None, result.V).embedded


@pytest.mark.parametrize("kind", ["tetra", "triangle6", "quad9", "hexahedron"])
def test_cells_that_are_no_faces_are_refused(kind):
    with pytest.raises(ValueError, match=f"cells of type {kind}; only triangles"):
        unsnarl.repair(MeshioMesh(np.zeros((10, 3)), [(kind, np.arange(4)[None])]))


def test_broken_padding_and_strips_are_refused():
    with pytest.raises(ValueError, match="ends in the middle of face 1"):
        unsnarl.repair(PolyData(np.zeros((5, 3)), np.array([3, 0, 1, 2, 4, 0, 1])))
    strips = PolyData(np.zeros((5, 3)), np.array([], int))
    strips.n_strips = 1
    with pytest.raises(ValueError, match="triangle strips"):
        unsnarl.repair(strips)


def test_what_is_no_mesh_is_refused():
    with pytest.raises(TypeError, match=r"SimpleNamespace is no mesh: give arrays V and F, or a mesh with .vertices"):
        unsnarl.repair(SimpleNamespace(points=np.zeros((3, 3)), cells=np.array([4, 0, 1, 2, 3])))


def test_namespace_in_pyvista(sheets, monkeypatch):
    """With a stand-in for PyVista, which imports the module by the entry point once the namespace is asked for."""
    registered = {}

    def register_dataset_accessor(name, target):
        return lambda accessor: registered.setdefault((name, target), accessor)

    class WithFieldData(PolyData):
        def __init__(self, points, faces):
            super().__init__(points, faces)
            self.field_data = {}

        def copy(self):
            return WithFieldData(self.points.copy(), self.faces.copy())

    module = SimpleNamespace(PolyData=WithFieldData, register_dataset_accessor=register_dataset_accessor)
    monkeypatch.setitem(sys.modules, "pyvista", module)
    monkeypatch.delitem(sys.modules, "unsnarl._pyvista", raising=False)
    (point,) = re.findall(r'"pyvista.accessors"]\nunsnarl = "(.*)"', PYPROJECT.read_text())
    importlib.import_module(point)
    monkeypatch.delitem(sys.modules, point)

    V, F = sheets
    mesh = WithFieldData(V, padded(F))
    accessor = registered["unsnarl", WithFieldData](mesh)
    assert np.array_equal(accessor.find_intersections().pairs, unsnarl.find_intersections(V, F).pairs)
    repaired = accessor.repair(precision="float64")
    assert np.array_equal(repaired.points, unsnarl.repair(V, F, precision="float64").V)
    assert repaired.field_data["unsnarl_status"] == ["embedded"] and np.array_equal(mesh.points, V)
    with pytest.warns(UserWarning, match=r"Result\(obstructed"):
        assert accessor.repair(np.ones(len(V), bool)).field_data["unsnarl_status"] == ["obstructed"]


@pytest.mark.parametrize("mixed", [False, True])
def test_real_vtk(sheets, mixed):
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    core = pytest.importorskip("vtkmodules.vtkCommonCore")
    V, F = sheets
    V = V.astype(np.float32)
    points = core.vtkPoints()
    for position in V.tolist():
        points.InsertNextPoint(position)
    faces = [*F[:-1].tolist(), F[-1, :3].tolist()] if mixed else F.tolist()
    polygons, lines = model.vtkCellArray(), model.vtkCellArray()
    for face in faces:
        polygons.InsertNextCell(len(face), face)
    lines.InsertNextCell(2, [0, 1])
    mesh = model.vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(polygons)
    mesh.SetLines(lines)
    moved = repaired_as_arrays(
        mesh,
        lambda mesh: np.array([mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())], dtype=np.float32),
        V,
        (np.concatenate(faces), np.cumsum([0, *map(len, faces)])),
    )
    assert moved.GetNumberOfLines() == 1 and moved.GetNumberOfPolys() == len(faces)
    wide = unsnarl.repair(mesh, precision="float64")  # float points do not hold it
    assert np.array_equal([wide.mesh.GetPoint(i) for i in range(len(V))], wide.V)
    empty = unsnarl.repair(model.vtkPolyData())
    assert empty.status == "embedded" and empty.mesh.GetNumberOfPoints() == 0
    mesh.SetStrips(lines)
    with pytest.raises(ValueError, match="triangle strips"):
        unsnarl.repair(mesh)


def test_real_meshio(sheets):
    meshio = pytest.importorskip("meshio")
    V, F = sheets
    mesh = meshio.Mesh(V, [("quad", F)], point_data={"colour": np.arange(len(V))})
    moved = repaired_as_arrays(mesh, lambda mesh: mesh.points, V, F)
    assert np.array_equal(moved.point_data["colour"], np.arange(len(V)))


def test_real_trimesh(crossing):
    trimesh = pytest.importorskip("trimesh")
    V, F = crossing
    moved = repaired_as_arrays(trimesh.Trimesh(V, F, process=False), lambda mesh: np.asarray(mesh.vertices), V, F)
    assert np.array_equal(moved.faces, F)


def test_real_pyvista(sheets):
    pyvista = pytest.importorskip("pyvista")
    V, F = sheets
    V = V.astype(np.float32)
    moved = repaired_as_arrays(pyvista.PolyData(V, padded(F)), lambda mesh: np.asarray(mesh.points), V, F)
    assert moved.points.dtype == np.float32
