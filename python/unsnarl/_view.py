"""A page to turn a mesh and look at it, before and after a repair."""

from __future__ import annotations

import ctypes
import html
import json
import os
import tempfile
import webbrowser
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._call import call
from ._documents import Document, read
from ._library import PageContentStruct, SurfaceStruct
from ._meshes import is_path
from ._log import log_notes
from ._options import options_of
from ._scenes import Scene, scene_of
from ._types import Goal, PathLike, Weld

#: Bytes beyond which a notebook is not made to hold a page unasked: it keeps all that it shows.
_MOST_SHOWN = 40_000_000

#: What the page may do inside of a notebook: run, and save pictures; nothing of the notebook is within its reach.
_SANDBOX = "allow-scripts allow-downloads"


@dataclass(frozen=True, repr=False)
class Page:
    """What view() made: an HTML file that any browser of today shows without a network. Notebooks show it themselves."""

    #: The file, UTF-8.
    html: bytes = field(repr=False)
    #: Where it was written; None: nowhere yet.
    output: Optional[Path] = None
    #: Of the frame in a notebook, CSS pixels.
    height: int = 560

    def write(self, output: PathLike) -> Path:
        """Writes the file: an earlier one is there until it is replaced as a whole. Raises OSError where it cannot."""
        path = Path(output)
        unfinished = path.with_name(f".{path.name}.{os.getpid()}")
        try:
            unfinished.write_bytes(self.html)
            unfinished.replace(path)
        finally:
            unfinished.unlink(missing_ok=True)
        return path

    def show(self) -> None:
        """Opens the page in the browser of this machine, from a temporary file unless it was written already."""
        path = self.output
        if path is None:
            handle, name = tempfile.mkstemp(prefix="unsnarl-", suffix=".html")
            os.close(handle)
            path = self.write(name)
        webbrowser.open(path.resolve().as_uri())

    def _repr_html_(self) -> str:
        if len(self.html) > _MOST_SHOWN:
            return f"<p>{html.escape(repr(self))}</p>"
        text = html.escape(self.html.decode("utf-8", "replace"))
        return (
            f'<iframe srcdoc="{text}" sandbox="{_SANDBOX}" width="100%" height="{self.height}" '
            'style="border: 1px solid #8884; border-radius: 6px" title="unsnarl view"></iframe>'
        )

    def __repr__(self) -> str:
        what = f"in {os.fspath(self.output)!r}" if self.output is not None else ".write(PATH) saves it, .show() opens it"
        return f"Page({len(self.html) / 1e6:.1f} MB; {what})"


def view(
    V: Any,
    F: Any = None,
    after: Any = None,
    *,
    output: Optional[PathLike] = None,
    height: int = 560,
    goal: Optional[Goal] = None,
    weld: Optional[Weld] = None,
    weld_tolerance: Optional[float] = None,
    both_diagonals: Optional[bool] = None,
    threads: Optional[int] = None,
) -> Page:
    """The page of ``unsnarl view``: a mesh to turn and look at, intersecting faces in red; before and after a repair,
    side by side, with how far every vertex moved.

    In a notebook it shows itself; elsewhere ``output`` writes it, or ``view(...).show()`` opens it in a browser.

    Parameters
    ----------
    V, F
        A mesh, or a list of them, as for repair; or the name of a mesh file, whose colours and images are shown too
        (glTF, OBJ), and as F that of its repaired version, as in ``view("in.obj", "out.obj")``; or a list of such names,
        one scene; or the Result of repair() or fix() alone, which shows all that it knows.
    after
        The same mesh repaired: positions (n, 3), a mesh, a Result, or the name of a file; of a list a list of positions
        or meshes, or a Result. None: the mesh is shown alone.
    output
        File to write, an HTML file; overwritten where it is there. None: none.
    height
        Of the frame in a notebook, CSS pixels.
    goal, weld, weld_tolerance, both_diagonals, threads
        What counts as an intersection: as for repair. None: as it was for the Result, or the default.

    Returns a Page.

    Raises ValueError and TypeError as repair does, and where `after` is no version of the mesh; OSError where a file
    cannot be read or written.
    """
    if output is not None and Path(output).suffix.lower() not in (".html", ".htm"):
        raise ValueError(f"output is {os.fspath(output)!r}; the page is an HTML file: end its name in .html")
    shown = _shown(V, F, after)
    options = dict(goal=goal, weld=weld, weld_tolerance=weld_tolerance, both_diagonals=both_diagonals, threads=threads)
    repaired_with = {} if shown.report is None else shown.report["options"]
    wanted = {name: repaired_with.get(name) if value is None else value for name, value in options.items()}
    moved = None if shown.moved is None else np.ascontiguousarray(shown.moved, dtype=np.float64).reshape(-1, 3)
    content = PageContentStruct(
        moved=np.empty(0) if moved is None else moved,
        moved_count=0 if moved is None else len(moved),
        name=_encoded(shown.name),
        moved_name=_encoded(shown.moved_name),
        report=None if shown.report is None else json.dumps(shown.report).encode(),
    )
    made = call("page", shown.struct, content, options_of(**{k: v for k, v in wanted.items() if v is not None}))
    log_notes(made.report["notes"])
    page = Page(made.array("html").tobytes(), None, height)
    return page if output is None else Page(page.html, page.write(output), height)


@dataclass
class Shown:
    """What a page shows; `struct` lends arrays of `kept`."""

    struct: SurfaceStruct
    kept: Any
    moved: Optional[NDArray[np.float64]] = None
    name: Optional[str] = None
    moved_name: Optional[str] = None
    report: Optional[dict[str, Any]] = None


class Repaired:
    """A repair that can be shown: Result, which builds on this module."""

    V: Any
    report: dict[str, Any]

    def _shown(self) -> Shown:
        raise NotImplementedError


def _encoded(text: Optional[str]) -> Optional[bytes]:
    return None if text is None else text.encode("utf-8", "replace")


def _shown(V: Any, F: Any, after: Any) -> Shown:
    if isinstance(V, Repaired):
        if F is not None or after is not None:
            raise ValueError("a Result knows both, before and after: give it alone")
        return V._shown()
    if is_path(V):
        if is_path(F) and after is None:
            F, after = None, F
        if F is not None:
            raise TypeError(f"F is a {type(F).__name__}, but V is the name of a file; give a repaired version of it as `after`")
        return _shown_file(V, after)
    if F is None and isinstance(V, (list, tuple)) and V and all(is_path(path) for path in V):
        V = [read(path) for path in V]
        if isinstance(after, (list, tuple)):
            after = [read(one) if is_path(one) else one for one in after]
    scene = scene_of(V, F)
    shown = Shown(scene.struct(), scene)
    if after is not None:
        shown.moved, shown.report = _moved(scene, after)
    return shown


def _shown_file(path: PathLike, after: Any) -> Shown:
    document = Document(path)
    shown = Shown(document.struct, document, name=Path(path).name)
    if is_path(after):
        repaired = Document(after).surface()
        own = document.surface()
        if not (np.array_equal(own.corners, repaired.corners) and np.array_equal(own.offsets, repaired.offsets)):
            raise ValueError(f"{os.fspath(after)!r}: its faces are not those of {os.fspath(path)!r}; give a repaired version")
        shown.moved, shown.moved_name = repaired.positions, Path(after).name
    elif after is not None:
        shown.moved, shown.report = _moved(scene_of(*read(path)), after)
    return shown


def _moved(scene: Scene, after: Any) -> tuple[NDArray[np.float64], Optional[dict[str, Any]]]:
    """Flat positions of all meshes after a repair, and the report of it."""
    if isinstance(after, Repaired):
        return scene.positions_of(after.V, "after"), after.report
    if scene.is_list and isinstance(after, (list, tuple)):
        return scene.positions_of([_positions(one) for one in after], "after"), None
    return scene.positions_of(_positions(after), "after"), None


def _positions(mesh: Any) -> Any:
    """Positions as they are, or those of a mesh of another package, or of (V, F)."""
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return mesh[0]
    is_mesh = any(hasattr(mesh, name) for name in ("vertices", "points", "GetPoints"))
    return scene_of(mesh, None).surface.positions.reshape(-1, 3) if is_mesh else mesh
