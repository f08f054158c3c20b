"""Scenes of trimesh: a stand-in with their attributes, and trimesh itself where it is installed."""

import copy
from types import SimpleNamespace

import numpy as np
import pytest
from test_meshes import Trimesh
from test_scenes import sphere

import unsnarl


class Graph:
    """As trimesh's SceneGraph: nodes below one world, with a transform each."""

    def __init__(self, nodes):
        self.transforms = SimpleNamespace(
            parents={node: "world" for node in nodes},
            edge_data={("world", node): {"matrix": np.asarray(matrix)} for node, (matrix, _) in nodes.items()},
            node_data={"world": {}, **{node: {"geometry": geometry} for node, (_, geometry) in nodes.items()}},
        )

    @property
    def nodes_geometry(self):
        return [node for node, data in self.transforms.node_data.items() if "geometry" in data]

    def get(self, node):
        return self.transforms.edge_data[("world", node)]["matrix"], self.transforms.node_data[node]["geometry"]

    def update(self, frame_to, frame_from, geometry, matrix):
        self.transforms.edge_data[(frame_from, frame_to)] = {"matrix": matrix}
        self.transforms.node_data[frame_to]["geometry"] = geometry


class Scene:
    def __init__(self, geometry, nodes):
        self.geometry, self.graph = geometry, Graph(nodes)

    def copy(self):
        copied = copy.deepcopy(self)
        copied.geometry = {name: mesh.copy() for name, mesh in self.geometry.items()}
        return copied


def stand_in(geometry, nodes):
    return Scene({name: Trimesh(V, F) for name, (V, F) in geometry.items()}, nodes)


def of_trimesh(geometry, nodes):
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene()
    for node, (matrix, name) in nodes.items():
        V, F = geometry[name]
        if name in scene.geometry:
            scene.graph.update(frame_to=node, matrix=matrix, geometry=name)
        else:
            scene.add_geometry(trimesh.Trimesh(V, F, process=False), node_name=node, geom_name=name, transform=matrix)
    return scene


KINDS = pytest.mark.parametrize("make", [stand_in, of_trimesh])


def turned(shift, scale=1.0):
    """A rotation by 0.3 around (1, 2, 3), scaled and shifted."""
    x, y, z = np.array([1.0, 2, 3]) / np.sqrt(14)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = scale * (np.eye(3) + np.sin(0.3) * cross + (1 - np.cos(0.3)) * cross @ cross)
    matrix[:3, 3] = shift
    return matrix


def world(scene):
    meshes = []
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph.get(node)
        mesh = scene.geometry[name]
        V = np.asarray(mesh.vertices)
        meshes.append((V @ matrix[:3, :3].T + matrix[:3, 3], np.asarray(mesh.faces)))
    return meshes


def two_spheres(make, first=np.eye(4), second=np.eye(4)):
    geometry = {"inner": sphere(1.0, 0.08), "outer": sphere(1.05), "far": sphere(0.5, 40.0)}
    inverse = np.linalg.inv(first)
    V, F = geometry["inner"]
    geometry["inner"] = V @ inverse[:3, :3].T + inverse[:3, 3], F
    inverse = np.linalg.inv(second)
    V, F = geometry["outer"]
    geometry["outer"] = V @ inverse[:3, :3].T + inverse[:3, 3], F
    return make(geometry, {"a": (first, "inner"), "b": (second, "outer"), "c": (np.eye(4), "far")})


@KINDS
@pytest.mark.parametrize(
    "first, second",
    [(np.eye(4), np.eye(4)), (turned([3, -2, 1], 2.5), turned([0, 0, 100], -0.1))],
    ids=["identities", "turned"],
)
def test_geometries_are_separated_where_nodes_put_them(make, first, second):
    scene = two_spheres(make, first, second)
    before = {name: np.array(mesh.vertices) for name, mesh in scene.geometry.items()}
    found = unsnarl.find_intersections(scene)
    assert len(found) > 0 and np.array_equal(np.unique(found.meshes, axis=0), [[0, 1]])
    result = unsnarl.repair(scene)
    assert result.status == "embedded" and type(result.mesh) is type(scene) and result.mesh is not scene
    assert len(unsnarl.find_intersections(result.mesh)) == 0
    for own, (V, _) in zip(result.V, world(result.mesh)):
        assert np.allclose(own, V, rtol=0, atol=1e-12 * 200)
    for name, V in before.items():
        assert np.array_equal(scene.geometry[name].vertices, V)
    assert np.array_equal(result.mesh.geometry["far"].vertices, before["far"])
    moved = np.array(result.mesh.geometry["inner"].vertices)
    has_moved = np.any(moved != before["inner"], axis=1)
    assert has_moved.any()
    assert list(result.mesh.graph.nodes_geometry) == ["a", "b", "c"] and set(result.mesh.geometry) == set(before)


@KINDS
def test_what_did_not_move_keeps_its_bits_in_its_own_frame(make):
    V, F = sphere(1.0)
    spike = np.array([[0.9, 0.02, 0.03], [2.0, 0.02, 0.04], [2.0, 0.1, 0.05]]), np.array([[0, 1, 2]])
    matrix = turned([5, 6, 7], 3.0)
    scene = make({"ball": (V, F), "spike": spike}, {"ball": (matrix, "ball"), "spike": (matrix, "spike")})
    result = unsnarl.repair(scene, fixed={"spike": [0, 1, 2]})
    after = np.asarray(result.mesh.geometry["ball"].vertices)
    same = np.all(after == V, axis=1)
    assert result.status == "embedded" and 0 < np.count_nonzero(~same) < len(V) / 2


@KINDS
def test_nodes_are_named(make):
    scene = two_spheres(make, turned([3, -2, 1]), np.eye(4))
    outer = np.array(scene.geometry["outer"].vertices)
    for held in ({"b": np.ones(len(outer), bool)}, [None, np.ones(len(outer), bool), None]):
        result = unsnarl.repair(scene, fixed=held)
        assert result.status == "embedded" and np.array_equal(result.mesh.geometry["outer"].vertices, outer)
    assert unsnarl.repair(scene, nested=["a", "b"]).report["nested"][0]["nested"]
    with pytest.raises(ValueError, match="fixed names node 'x'; the scene has faces at these: 'a', 'b', 'c'"):
        unsnarl.repair(scene, fixed={"x": [0]})
    with pytest.raises(ValueError, match="nested names node 'z'"):
        unsnarl.repair(scene, nested=["a", "z"])


@KINDS
def test_a_geometry_that_several_nodes_show_gets_copies_where_they_differ(make):
    V, F = sphere(1.0)
    shifted, far = np.eye(4), np.eye(4)
    shifted[0, 3], far[0, 3] = 1.7, 50.0
    scene = make({"ball": (V, F)}, {"a": (np.eye(4), "ball"), "b": (shifted, "ball"), "c": (far, "ball")})
    result = unsnarl.repair(scene)
    assert result.status == "embedded" and len(unsnarl.find_intersections(result.mesh)) == 0
    shown = [result.mesh.graph.get(node)[1] for node in ("a", "b", "c")]
    assert shown[0] == "ball" and len(set(shown)) == 3 and set(scene.geometry) == {"ball"}
    assert any("copy of its own" in note for note in result.report["input"]["notes"])
    assert np.array_equal(result.mesh.geometry[shown[2]].vertices, V)
    alone = unsnarl.repair(make({"ball": (V, F)}, {"a": (np.eye(4), "ball"), "c": (far, "ball")}))
    assert set(alone.mesh.geometry) == {"ball"} and not alone.report["input"]["notes"]


def test_what_has_no_faces_is_left_alone_and_what_is_flat_refused():
    scene = two_spheres(stand_in)
    scene.geometry["points"] = SimpleNamespace(vertices=np.zeros((3, 3)), copy=lambda: SimpleNamespace(vertices=1))
    scene.graph.transforms.node_data["p"] = {"geometry": "points"}
    scene.graph.transforms.edge_data[("world", "p")] = {"matrix": np.eye(4)}
    assert unsnarl.repair(scene).status == "embedded"
    flat = np.diag([1.0, 1, 0, 1])
    with pytest.raises(ValueError, match="node 'a'.*flattens"):
        unsnarl.repair(stand_in({"ball": sphere(1.0)}, {"a": (flat, "ball")}))
    with pytest.raises(ValueError, match="no geometry with faces"):
        unsnarl.repair(stand_in({}, {}))
