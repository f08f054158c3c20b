"""The namespace `unsnarl` of PyVista's meshes, from PyVista 0.48 on.

PyVista itself imports this when `mesh.unsnarl` is first used: it is named in the entry points "pyvista.accessors".
"""

from __future__ import annotations

import warnings
from typing import Any

import pyvista

from ._intersections import Intersections, find_intersections
from ._repair import repair
from ._view import Page, view


@pyvista.register_dataset_accessor("unsnarl", pyvista.PolyData)
class UnsnarlAccessor:
    """``mesh.unsnarl.repair()``, ``mesh.unsnarl.find_intersections()``, ``mesh.unsnarl.view()``"""

    def __init__(self, mesh: Any):
        self._mesh = mesh

    def find_intersections(self, **options: Any) -> Intersections:
        """As unsnarl.find_intersections, with its options."""
        return find_intersections(self._mesh, **options)

    def view(self, after: Any = None, **options: Any) -> Page:
        """As unsnarl.view, with its options; `after`: the repaired mesh."""
        return view(self._mesh, after=after, **options)

    def repair(self, fixed: Any = None, **options: Any) -> Any:
        """A repaired copy of the mesh, as unsnarl.repair makes it, with its options.

        Its field data "unsnarl_status" holds the status; a warning says so where that is not "embedded".
        """
        result = repair(self._mesh, fixed=fixed, **options)
        if result.status != "embedded":
            warnings.warn(f"{result!r}; unsnarl.repair(mesh).report says why", stacklevel=2)
        result.mesh.field_data["unsnarl_status"] = [str(result.status)]
        return result.mesh
