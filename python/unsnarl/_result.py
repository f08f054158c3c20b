"""What a repair came to."""

from __future__ import annotations

import base64
import ctypes
import html
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Generic, Literal, Optional, TypedDict, TypeVar, Union

import numpy as np

from ._arguments import Surface
from ._call import Status, call
from ._view import Repaired, Shown, view

#: Faces beyond which notebooks do not draw a result unasked: it would take seconds.
_MOST_DRAWN_FACES = 300_000


class PaperSettings(TypedDict, total=False):
    """Settings of the paper's configuration, docs/paper.md."""

    bandwidth: Literal["global", "independent", "symmetric"]
    adaptive: bool
    bandwidth_scale: float
    neighbourhood: float
    gaussian: float
    mesh: float
    mesh_energy: Literal["depth", "length"]
    whole_polygons: bool
    arap: float
    memory: int
    iterations: int


Paper = Union[bool, PaperSettings]

#: Positions of one mesh, or a list of them.
V_ = TypeVar("V_", covariant=True)


@dataclass(frozen=True, repr=False)
class Result(Repaired, Generic[V_]):
    """What a repair came to; of one mesh Result[Positions], of several Result[list[Positions]]."""

    #: (n, 3), vertex order of the input. float32 where the input is and precision is not "float64", else float64.
    #: What did not have to move is bit-identical. Never has more intersecting pairs than the input, but for
    #: allowed ones. Of a list of meshes: a list of such arrays.
    V: V_
    #: Only "embedded" and "gap_not_met" promise a surface without self-intersections, "allowed" one that has none but
    #: those allowed.
    status: Status
    #: The document that the command line writes with --report, see docs/report.md.
    report: dict[str, Any]
    #: Where a mesh or a trimesh.Scene was given: a copy of it, of its own type, at the new positions. Else None. Of a
    #: list of meshes: a list.
    mesh: Any = None
    #: Of fix(): the file that was written; None: none was.
    output: Optional[Path] = None
    _before: Optional[Surface] = field(default=None, compare=False)
    _after: Any = field(default=None, compare=False)
    _mesh_sizes: Any = field(default=None, compare=False)
    _document: Any = field(default=None, compare=False)
    #: Of fix(): the file beside it in which an unfinished repair is kept, of several files a list; None: none is.
    partial: Union[Path, list[Path], None] = None

    def picture(self, width: int = 1200) -> bytes:
        """Before and after, side by side, intersecting faces in red: the bytes of a PNG file.

        width: pixels, from 128 to 8192.
        """
        if self._before is None:
            raise ValueError("this result does not know its input; take the one that repair or fix returned")
        return picture_of(self._before, self._after, width)

    def view(self, **options: Any) -> Any:
        """A page to turn it and look at it, before and after; see unsnarl.view, whose options it takes."""
        return view(self, **options)

    def _shown(self) -> Shown:
        if self._before is None:
            raise ValueError("this result does not know its input; take the one that repair or fix returned")
        sizes = np.empty(0) if self._mesh_sizes is None else self._mesh_sizes
        struct = self._before.struct(mesh_sizes=sizes, mesh_count=len(sizes))
        if self._document is not None:
            struct.document = self._document.handle
        output = None if self.output is None else self.output.name
        return Shown(struct, self, self._after, None, output, self.report)

    def _repr_html_(self) -> str:
        report = self.report
        allowed = report["allowed"]
        rows = {
            "status": str(self.status),
            "intersecting pairs": f"{report['before']['total']} before, {report['after']['total']} after",
            "moved": f"{100 * (1 - report['untouched_share']):.3g} % of the vertices, "
            f"by {100 * report['displacement_max_rel']:.2g} % of the diagonal ({report['displacement_max']:.2g}) at most",
            "time": f"{report['seconds']:.2f} s",
        }
        if allowed["before"]["total"] + allowed["after"]["total"] > 0:
            rows["pairs that may intersect"] = f"{allowed['before']['total']} before, {allowed['after']['total']} after"
        if self.output is not None:
            rows["file"] = str(self.output)
        rows.update({"not repaired": o["message"] for o in report["obstructions"][:1]})
        if changed := report["changed_components"]:
            more = f"; and {len(changed) - 1} more" if len(changed) > 1 else ""
            rows["parts"] = changed[0]["message"] + more
        rows.update({"advice": advice for advice in report["advice"]})
        text = "".join(f"<tr><th>{html.escape(k)}</th><td>{html.escape(v)}</td></tr>" for k, v in rows.items())
        text = f"<table>{text}</table>"
        if self._before is None or self._before.face_count > _MOST_DRAWN_FACES:
            return text
        png = base64.b64encode(self.picture(960)).decode()
        return text + f'<img alt="before and after" src="data:image/png;base64,{png}"/>'

    def __repr__(self) -> str:
        before, after = self.report["before"]["total"], self.report["after"]["total"]
        return (
            f"Result({self.status}: {before} intersecting pairs before, {after} after; "
            f"moved by {self.report['displacement_max']:.2g} at most, {self.report['displacement_max_rel']:.2g} of the "
            "diagonal)"
        )


def picture_of(before: Surface, after: Any, width: int) -> bytes:
    """A PNG of a surface, and of it at positions `after` (n, 3) unless that is None."""
    moved = None if after is None else np.ascontiguousarray(after, dtype=np.float64)
    pointer = None if moved is None else ctypes.c_void_p(moved.ctypes.data)
    drawn = call("picture", before.struct(), pointer, ctypes.c_size_t(0 if moved is None else len(moved)),
                 ctypes.c_int32(width), None)
    return drawn.array("png").tobytes()
