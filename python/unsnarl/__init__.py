"""Takes the self-intersections out of surface meshes, moving vertices only.

    import unsnarl

    pairs = unsnarl.find_intersections(V, F)      # which faces meet where they should not
    result = unsnarl.repair(V, F)                 # the same mesh, moved as little as possible
    if result.status == "embedded":
        V = result.V

Everything takes arrays (``V``, ``F``) or a mesh of meshio, trimesh, pyvista or VTK in their place; find_intersections,
repair and certify also a list of these, ``repair([(V, F), mesh])``: meshes in one coordinate system that must not meet.

``V``
    Positions, shape (n, 3), of any real dtype and memory order. Computed with as float64.
``F``
    Faces by 0-based vertex ids of any integer dtype: (m, 3) triangles, (m, 4) quads, (m, k) polygons; or a tuple
    ``(corners, offsets)`` for polygons of mixed sizes, where face f has the vertices
    ``corners[offsets[f]:offsets[f + 1]]``.

Files: ``fix("in.obj", "out.obj")`` repairs one as the program does, ``fix(["a.obj", "b.obj"], "folder")`` several
together, ``fix_sequence`` frames, ``batch`` many; ``check("in.obj")`` looks for intersections and lists the parts that the
file names, ``V, F = read("in.obj")`` gives arrays. ``view(...)`` of a mesh, a file or a Result is a page to turn it and look at it,
before and after. What a repair came to goes to the logger "unsnarl" too, and a Result shows itself in notebooks.

What is passed in is never changed. Arguments that make no sense raise ValueError or TypeError, files OSError with its
errno; a mesh that could not be
untangled raises nothing, its ``Result.status`` says so.
"""

from ._batch import BatchResult, batch
from ._call import Status
from ._certify import Certificate, certify
from ._curves import CurveResult, find_crossings, untangle_curves
from ._documents import read
from ._file_sequences import FileSequenceResult, fix_sequence
from ._files import Check, Component, Part, check, fix
from ._intersections import Intersections, find_intersections
from ._library import version as __version__
from ._parts import boundary_vertices, component_of_faces, vertices_of_faces
from ._progress import Progress
from ._repair import repair
from ._result import PaperSettings, Result
from ._samples import Sample, SampleParameter, sample, samples
from ._routes import Routes, check_routes, plan_routes
from ._sequence import Frame, Jitter, SequenceResult, repair_sequence
from ._spaces import (
    Isotopy,
    KnotIsotopy,
    KnotTube,
    RelaxedWire,
    SeifertSurface,
    check_seifert_surface,
    knot_isotopy,
    knot_of_table,
    knot_tube,
    planar_isotopy,
    relaxed_wire,
    seifert_surface,
    untangled_seifert_surface,
)
from ._view import Page, view

__all__ = [
    "BatchResult",
    "Certificate",
    "Check",
    "Component",
    "CurveResult",
    "FileSequenceResult",
    "Frame",
    "Intersections",
    "Isotopy",
    "Jitter",
    "KnotIsotopy",
    "KnotTube",
    "Page",
    "PaperSettings",
    "Part",
    "Progress",
    "RelaxedWire",
    "Result",
    "Routes",
    "Sample",
    "SampleParameter",
    "SeifertSurface",
    "SequenceResult",
    "Status",
    "batch",
    "boundary_vertices",
    "certify",
    "check",
    "check_routes",
    "check_seifert_surface",
    "component_of_faces",
    "find_crossings",
    "find_intersections",
    "fix",
    "fix_sequence",
    "knot_isotopy",
    "knot_of_table",
    "knot_tube",
    "plan_routes",
    "planar_isotopy",
    "read",
    "relaxed_wire",
    "repair",
    "repair_sequence",
    "sample",
    "samples",
    "seifert_surface",
    "untangle_curves",
    "untangled_seifert_surface",
    "vertices_of_faces",
    "view",
]
