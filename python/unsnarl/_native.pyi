from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

version: str
pair_kinds: tuple[str, ...]

def find_intersections(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    *,
    weld: str,
    weld_tolerance: float,
    both_diagonals: bool,
    threads: int,
) -> tuple[NDArray[np.int32], NDArray[np.uint8]]: ...
def certify(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    moved: NDArray[np.float64],
    *,
    weld: str,
    weld_tolerance: float,
    both_diagonals: bool,
    threads: int,
) -> dict[str, Any]: ...
def repair(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    fixed: NDArray[np.uint8],
    *,
    vertex_counts: list[int],
    face_counts: list[int],
    goal: str,
    precision: str,
    min_gap: float,
    min_dihedral: float,
    max_displacement: float,
    absolute: bool,
    time_limit: float,
    memory_limit: float,
    recover: bool,
    paper: bool,
    each_component: bool,
    weld: str,
    weld_tolerance: float,
    both_diagonals: bool,
    threads: int,
    progress: Callable[[float, str, int, float], object] | None,
) -> tuple[NDArray[np.float64], str, str]: ...
def repair_sequence(
    frames: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    fixed: NDArray[np.uint8],
    moved: NDArray[np.float64],
    *,
    first: int,
    last: int,
    goal: str,
    precision: str,
    min_gap: float,
    max_displacement: float,
    time_limit: float,
    weld: str,
    weld_tolerance: float,
    both_diagonals: bool,
    threads: int,
    progress: Callable[[float, str, int, float], object] | None,
) -> list[dict[str, Any]]: ...
def component_of_faces(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    *,
    weld: str,
    weld_tolerance: float,
) -> NDArray[np.int32]: ...
def boundary_vertices(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    *,
    weld: str,
    weld_tolerance: float,
) -> NDArray[np.uint8]: ...
def vertices_of_faces(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    offsets: NDArray[np.int32],
    faces: NDArray[np.uint8],
) -> NDArray[np.uint8]: ...
def find_crossings(points: list[NDArray[np.float64]], closed: list[bool]) -> NDArray[np.int32]: ...
def untangle_curves(
    points: list[NDArray[np.float64]],
    closed: list[bool],
    fixed: list[NDArray[np.uint8]],
    *,
    gap: float,
    junction: float,
    fix_ends: bool,
    time_limit: float,
    recover: bool,
    progress: Callable[[float, str, int, float], object] | None,
) -> tuple[list[NDArray[np.float64]], str, dict[str, Any]]: ...
def seifert_surface(
    link: list[NDArray[np.float64]],
    *,
    edge: float,
    views: int,
    fair: bool,
    time_limit: float,
    progress: Callable[[float, str, int, float], object] | None,
) -> tuple[NDArray[np.float64], NDArray[np.int32], str, dict[str, Any]]: ...
def check_seifert_surface(
    positions: NDArray[np.float64], corners: NDArray[np.int32], link: list[NDArray[np.float64]], *, views: int
) -> dict[str, Any]: ...
def knot_of_table(name: str) -> list[NDArray[np.float64]]: ...
def planar_isotopy(
    start: list[NDArray[np.float64]],
    end: list[NDArray[np.float64]],
    *,
    points: int,
    time_limit: float,
    progress: Callable[[float, str, int, float], object] | None,
) -> tuple[
    NDArray[np.float64], list[list[NDArray[np.float64]]], NDArray[np.float64], NDArray[np.int32], str
]: ...
