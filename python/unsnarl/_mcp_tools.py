"""The tools of the server of unsnarl.mcp: what they take, and the command of the program that does it."""

from __future__ import annotations

import json
import sys
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Optional

from . import _program
from ._mcp_folders import Folders, Refused, written_beside

#: Lists in an answer are cut to so many entries: an assistant reads all of it.
_MOST_LISTED = 20
#: A call that does not end by itself is ended so long after its limit (unit: seconds).
_PATIENCE = 60.0

_NAMES: dict[str, Any] = {"type": "array", "items": {"type": "string"}}
_INPUTS: dict[str, Any] = {
    **_NAMES,
    "minItems": 1,
    "description": "Mesh files (obj, off, ply, stl, glb, gltf, surf, gii, vtk, vtp, msh, inp, 3mf). Several files are "
                   "one scene, whose surfaces must not pass through each other either.",
}
_HOW_READ: dict[str, Any] = {
    "goal": {"enum": ["all", "disjoint"], "description": "Which intersections count. 'disjoint': only between faces "
                                                         "that share no vertex."},
    "weld": {"enum": ["none", "seams", "all"], "description": "Vertices at one position that count as one."},
    "both_diagonals": {"type": "boolean", "description": "The result must hold whichever way quads are split."},
    "allow": {**_NAMES, "description": "Parts that may pass through each other, 'A:B', or through themselves, 'A'."},
}
_PARTS: dict[str, Any] = {
    f"{what}_{kind}": {**_NAMES, "description": f"{kind.capitalize()}s that {says}."}
    for what, says in (("fix", "must not move"), ("only", "alone may move"), ("rigid", "move as rigid bodies"))
    for kind in ("object", "group", "material", "file", "component")
}
_REPAIR: dict[str, Any] = {
    "min_gap": {"type": "number", "minimum": 0, "description": "Distance to keep between surfaces, as a fraction of "
                                                               "the bounding-box diagonal."},
    "max_displacement": {"type": "number", "minimum": 0, "description": "Farthest that a vertex may move, as a "
                                                                        "fraction of the diagonal. 0: no limit."},
    "absolute": {"type": "boolean", "description": "min_gap and max_displacement are lengths in the file's units."},
    "fix_boundary": {"type": "boolean", "description": "Boundary vertices must not move."},
    "keep_partial": {"type": "boolean", "description": "Write the result even if intersections are left."},
}


class Limits(NamedTuple):
    """Of each call."""

    time_s: float
    memory_mb: float  #: 0: none


class Answer(NamedTuple):
    text: str
    content: dict[str, Any]


class Work:
    """A call of the program, which another thread may cancel."""

    def __init__(self, limits: Limits, progress: Callable[[float, str], None]) -> None:
        self.limits = limits
        self._progress = progress
        self._child: Optional[subprocess.Popen[bytes]] = None
        self._lock = threading.Lock()
        self.is_cancelled = False

    def cancel(self) -> None:
        with self._lock:
            self.is_cancelled = True
            if self._child is not None:
                self._child.send_signal(signal.SIGTERM if sys.platform == "win32" else signal.SIGINT)

    def run(self, words: Sequence[str], result: Optional[Path] = None) -> str:
        """Runs the program. Returns its standard output. Raises Refused with what it complained of where it failed, or
        ended before there was a result: the file of this name or, without one, the standard output."""
        said = []
        with tempfile.TemporaryFile() as out:
            with self._lock:
                if self.is_cancelled:
                    raise Refused("It was cancelled")
                child = self._child = subprocess.Popen([str(_program.path()), *words], stdin=subprocess.DEVNULL,
                                                       stdout=out, stderr=subprocess.PIPE, start_new_session=True)
            timer = threading.Timer(self.limits.time_s + _PATIENCE, child.kill)
            timer.start()
            try:
                assert child.stderr is not None
                with child.stderr:
                    for line in child.stderr:
                        said += self._taken(line.decode("utf-8", "replace").rstrip("\n"))
                code = child.wait()
            finally:
                timer.cancel()
                with self._lock:
                    self._child = None
            out.seek(0)
            text = out.read().decode("utf-8", "replace")
        if code in (2, 3, 4, 9, 70) or code < 0 or not (result.exists() if result else text):
            raise Refused("\n".join(said) or f"The program ended with code {code}, before there was a result")
        return text

    def _taken(self, line: str) -> list[str]:
        """Complaints; progress is passed on."""
        if not line.startswith("{"):
            return [line.removeprefix("unsnarl: ")] if line else []
        told = json.loads(line)
        self._progress(told["fraction"], f"{told['phase']}, {told['pairs_left'] or 0} intersecting pairs")
        return []


def check(folders: Folders, given: dict[str, Any], work: Work) -> Answer:
    inputs = [str(folders.existing(name)) for name in given["inputs"]]
    report = json.loads(work.run(["check", *inputs, "--json", *_words(given, _HOW_READ), *_limits(work)]))
    pairs, faces = report["pairs"]["total"], report["intersecting_faces"]
    text = f"{pairs} intersecting pairs among {faces} faces." if pairs else "No self-intersections."
    return Answer(text, _shortened(report))


def fix(folders: Folders, given: dict[str, Any], work: Work) -> Answer:
    inputs = [str(folders.existing(name)) for name in given["inputs"]]
    output = folders.new(given["output"])
    with _program.scratch_folder() as scratch, written_beside(output) as unfinished:
        report_file = scratch / "report.json"
        incomplete = "--keep-partial" if given.get("keep_partial") else "--no-partial"
        words = _words({**given, "keep_partial": None}, {**_HOW_READ, **_REPAIR, **_PARTS})
        text = work.run(["fix", *inputs, "-o", str(unfinished), "--report", str(report_file), "--progress", "json",
                         incomplete, *words, *_limits(work)], report_file)
        report = json.loads(report_file.read_text("utf-8").replace(_inner(unfinished), _inner(output)))
        is_written = unfinished.exists()
    lines = [line for line in text.replace(str(unfinished), str(output)).splitlines() if str(report_file) not in line]
    if not is_written:
        lines.append("Nothing was written: keep_partial would write what was reached.")
    return Answer("\n".join(lines), _shortened(report))


def view(folders: Folders, given: dict[str, Any], work: Work) -> Answer:
    inputs = [str(folders.existing(name)) for name in given["inputs"]]
    repaired = [str(folders.existing(given["repaired"]))] if given.get("repaired") else []
    if repaired and len(inputs) > 1:
        raise Refused("'repaired' goes with one input; give a scene alone")
    page = folders.new(given["page"])
    if page.suffix != ".html":
        raise Refused("'page' must end with .html")
    scene = ["--scene"] if len(inputs) > 1 else []
    with written_beside(page) as unfinished:
        work.run(["view", *inputs, *repaired, *scene, "-o", str(unfinished), *_words(given, _HOW_READ)], unfinished)
    return Answer(f"Wrote {page}; any browser shows it.", {"page": str(page), "bytes": page.stat().st_size})


class Tool(NamedTuple):
    name: str
    title: str
    description: str
    properties: dict[str, Any]
    required: list[str]
    writes: bool
    call: Callable[[Folders, dict[str, Any], Work], Answer]

    @property
    def declaration(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "title": self.title,
            "description": self.description,
            "inputSchema": {"type": "object", "properties": self.properties, "required": self.required,
                            "additionalProperties": False},
            "annotations": {"title": self.title, "readOnlyHint": not self.writes, "destructiveHint": False,
                            "idempotentHint": not self.writes, "openWorldHint": False},
        }


TOOLS = {
    tool.name: tool
    for tool in (
        Tool("check", "Find self-intersections",
             "Counts and locates the self-intersections of a mesh, or of several that form a scene, by exact arithmetic. "
             "Also lists the parts and components that 'fix' can hold. Writes nothing.",
             {"inputs": _INPUTS, **_HOW_READ}, ["inputs"], False, check),
        Tool("fix", "Repair self-intersections",
             "Moves vertices as little as possible until nothing intersects; faces and attributes stay. The result is "
             "certified by exact arithmetic on the written file. Never overwrites a file.",
             {"inputs": _INPUTS,
              "output": {"type": "string", "description": "A new file of the same format; with several inputs a new "
                                                          "folder."},
              **_REPAIR, **_HOW_READ, **_PARTS}, ["inputs", "output"], True, fix),
        Tool("view", "Make a page that shows a mesh",
             "Writes one HTML file that shows a mesh and its intersections in 3D, or a mesh before and after its repair.",
             {"inputs": _INPUTS,
              "repaired": {"type": "string", "description": "The repaired mesh, beside the one input."},
              "page": {"type": "string", "description": "A new file that ends with .html."},
              **_HOW_READ}, ["inputs", "page"], True, view),
    )
}


def checked(tool: Tool, given: Any) -> dict[str, Any]:
    """The arguments of a call. Raises Refused where one is missing, unknown, or of another type."""
    if not isinstance(given, dict):
        raise Refused("The arguments must be an object")
    for name in tool.required:
        if name not in given:
            raise Refused(f"'{name}' is missing")
    for name, value in given.items():
        if name not in tool.properties:
            raise Refused(f"'{name}' is no argument of {tool.name}; it takes {', '.join(tool.properties)}")
        _check_value(name, value, tool.properties[name])
    return given


def _check_value(name: str, value: Any, schema: dict[str, Any]) -> None:
    if "enum" in schema:
        if value not in schema["enum"]:
            raise Refused(f"'{name}' must be one of {', '.join(schema['enum'])}")
        return
    kinds = {"string": str, "boolean": bool, "number": (int, float), "array": list}
    kind = schema["type"]
    if not isinstance(value, kinds[kind]) or (kind == "number" and isinstance(value, bool)):  # type: ignore[arg-type]
        raise Refused(f"'{name}' must be of type {kind}")
    if kind == "number" and not 0 <= value < float("inf"):
        raise Refused(f"'{name}' must not be negative")
    if kind == "array":
        if len(value) < schema.get("minItems", 0):
            raise Refused(f"'{name}' is empty")
        for item in value:
            _check_value(f"{name}[]", item, schema["items"])


def _words(given: dict[str, Any], known: dict[str, Any]) -> list[str]:
    """Options of the command line. A value is joined to its option: one that begins with a dash is no option."""
    words = []
    for name in known:
        value = given.get(name)
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif isinstance(value, list):
            words += [f"{option}={item}" for item in value]
        elif value is not None and value is not False:
            words.append(f"{option}={value!r}" if isinstance(value, float) else f"{option}={value}")
    return words


def _limits(work: Work) -> list[str]:
    words = [f"--time-limit={work.limits.time_s!r}"]
    return words + [f"--memory-limit={work.limits.memory_mb!r}"] if work.limits.memory_mb else words


def _inner(path: Path) -> str:
    """How a JSON text says it."""
    return json.dumps(str(path), ensure_ascii=False)[1:-1]


def _shortened(value: Any) -> Any:
    """A report with the first entries of long lists, and how many were left out."""
    if isinstance(value, list):
        return [_shortened(item) for item in value[:_MOST_LISTED]]
    if not isinstance(value, dict):
        return value
    short: dict[str, Any] = {}
    for key, inner in value.items():
        short[key] = _shortened(inner)
        if isinstance(inner, list) and len(inner) > _MOST_LISTED:
            short[f"{key}_left_out"] = len(inner) - _MOST_LISTED
    return short
