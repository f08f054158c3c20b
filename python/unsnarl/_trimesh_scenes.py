"""Scenes of trimesh: geometries that nodes place in one world. trimesh itself is not imported."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Instance(NamedTuple):
    """A geometry with faces, where a node puts it."""

    node: Any
    geometry: str
    mesh: Any
    to_world: NDArray[np.float64]  # (4, 4)

    @property
    def positions(self) -> NDArray[np.float64]:
        return world_of(self.to_world, self.mesh.vertices)


def is_scene(value: Any) -> bool:
    return hasattr(value, "geometry") and hasattr(value, "graph") and not hasattr(value, "faces")


def instances_of(scene: Any) -> list[Instance]:
    """All geometries with faces, one for each node that shows it, in the order of the scene's graph."""
    instances = []
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph.get(node)
        mesh = scene.geometry[name]
        if not (hasattr(mesh, "vertices") and hasattr(mesh, "faces")):
            continue  # points and paths intersect nothing
        to_world = np.asarray(transform, dtype=np.float64)
        if to_world.shape != (4, 4) or not np.array_equal(to_world[3], [0, 0, 0, 1]):
            raise ValueError(f"node {node!r} of the scene has a transform that is not affine")
        if not np.all(np.isfinite(to_world)) or np.linalg.matrix_rank(to_world[:3, :3]) < 3:
            raise ValueError(f"node {node!r} of the scene has a transform that flattens its geometry {name!r}")
        instances.append(Instance(node, name, mesh, to_world))
    if not instances:
        raise ValueError("the scene has no geometry with faces")
    return instances


def world_of(to_world: NDArray[np.float64], vertices: Any) -> NDArray[np.float64]:
    """Positions in the world; of an identity the same bits."""
    local = np.asarray(vertices, dtype=np.float64)
    if np.array_equal(to_world, np.eye(4)):
        return local
    # A sum for each coordinate rather than a product of matrices: the same bits whatever else is in the array.
    x, y, z = local.T
    return np.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in to_world[:3]], axis=1)


def local_of(instance: Instance, moved: NDArray[np.float64]) -> NDArray[np.float64]:
    """Positions in the geometry's own frame: those of vertices that did not move keep their bits."""
    local = np.array(instance.mesh.vertices, dtype=np.float64)
    if np.array_equal(instance.to_world, np.eye(4)):
        return np.array(moved, dtype=np.float64)
    has_moved = np.any(moved != instance.positions, axis=1)
    offsets = moved[has_moved] - instance.to_world[:3, 3]
    local[has_moved] = np.linalg.solve(instance.to_world[:3, :3], offsets.T).T
    return local


def with_positions(scene: Any, moved: list[NDArray[np.float64]]) -> tuple[Any, list[NDArray[np.float64]], list[str]]:
    """A copy of the scene with its geometries where `moved`, positions in the world for each instance, puts them; the
    positions in the world that this copy has; and what is worth knowing, one sentence each.

    A geometry that several nodes show gets a copy for each node where it comes out otherwise than at the first.
    """
    result = scene.copy()
    held: list[NDArray[np.float64]] = []
    notes: list[str] = []
    placed: dict[str, NDArray[np.float64]] = {}
    for instance, world in zip(instances_of(scene), moved):
        local = local_of(instance, world)
        name = instance.geometry
        if name in placed and not np.array_equal(placed[name], local):
            name = _free_name(result, name)
            result.geometry[name] = instance.mesh.copy()
            _show(result.graph, instance.node, name)
            notes.append(
                f"geometry {instance.geometry!r} is shown by several nodes: {instance.node!r} has a copy of its own now, "
                f"{name!r}"
            )
        if name not in placed:
            placed[name] = local
            if not np.array_equal(local, np.asarray(result.geometry[name].vertices)):
                result.geometry[name].vertices = local
        held.append(world_of(instance.to_world, local))
    return result, held, notes


def _show(graph: Any, node: Any, geometry: str) -> None:
    """Has a node show another geometry, where it is."""
    parent = graph.transforms.parents[node]
    edge = {key: value for key, value in graph.transforms.edge_data[(parent, node)].items() if key != "geometry"}
    graph.update(frame_to=node, frame_from=parent, geometry=geometry, **edge)


def _free_name(scene: Any, name: str) -> str:
    number = 1
    while f"{name}_{number}" in scene.geometry:
        number += 1
    return f"{name}_{number}"
