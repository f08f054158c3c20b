"""The shared library unsnarl_c beside this file: its structs and functions, as unsnarl.h has them."""

from __future__ import annotations

import ctypes
import sys
from ctypes import POINTER, c_char_p, c_double, c_int, c_int32, c_size_t, c_void_p
from pathlib import Path
from typing import Any

_PATH = Path(__file__).with_name("unsnarl_c.dll" if sys.platform == "win32" else "libunsnarl_c.so")
try:
    library = ctypes.CDLL(str(_PATH))
except OSError as error:
    raise ImportError(f"{error}. The package unsnarl is not whole: install it with pip") from error


class _Struct(ctypes.Structure):
    """A struct that begins with its size. Holds on to the arrays that it points to."""

    def __init__(self, **fields: Any):
        super().__init__(size=ctypes.sizeof(self))
        self.arrays: list[Any] = []
        self.lend(**fields)

    def lend(self, **fields: Any) -> None:
        """Sets fields, of arrays to where they are."""
        for name, value in fields.items():
            if hasattr(value, "ctypes"):  # numpy.ndarray
                self.arrays.append(value)
                value = value.ctypes.data if value.size > 0 else None
            setattr(self, name, value)

    def lend_names(self, field: str, count_field: str, names: list[str]) -> None:
        """Sets a list of texts and their number."""
        texts = (c_char_p * len(names))(*(name.encode("utf-8", "surrogateescape") for name in names))
        self.arrays.append(texts)
        setattr(self, field, ctypes.cast(texts, c_void_p) if names else None)
        setattr(self, count_field, len(names))


class SurfaceStruct(_Struct):
    _fields_ = [
        ("size", c_size_t),
        ("positions", c_void_p),
        ("vertex_count", c_size_t),
        ("corners", c_void_p),
        ("corner_count", c_size_t),
        ("offsets", c_void_p),
        ("offset_count", c_size_t),
        ("fixed", c_void_p),
        ("mesh_sizes", c_void_p),
        ("mesh_count", c_size_t),
        ("document", c_void_p),
        ("rigid", c_void_p),
        ("nested", c_void_p),
        ("nested_count", c_size_t),
        ("rigid_names", c_void_p),
        ("rigid_name_count", c_size_t),
        ("nested_surface", c_void_p),
        ("nested_names", c_void_p),
        ("nested_name_count", c_size_t),
        ("face_parts", c_void_p),
        ("allowed", c_void_p),
        ("allowed_count", c_size_t),
    ]


class CurvesStruct(_Struct):
    _fields_ = [
        ("size", c_size_t),
        ("points", c_void_p),
        ("offsets", c_void_p),
        ("curve_count", c_size_t),
        ("closed", c_void_p),
        ("fixed", c_void_p),
    ]


class OptionsStruct(_Struct):
    _fields_ = [
        ("size", c_size_t),
        ("weld", c_char_p),
        ("weld_tolerance", c_double),
        ("both_diagonals", c_int32),
        ("threads", c_int32),
        ("goal", c_char_p),
        ("precision", c_char_p),
        ("min_gap", c_double),
        ("max_displacement", c_double),
        ("absolute", c_int32),
        ("min_dihedral", c_double),
        ("memory_limit", c_double),
        ("each_component", c_int32),
        ("paper", c_int32),
        ("time_limit", c_double),
        ("recover", c_int32),
        ("first_frame", c_size_t),
        ("last_frame", c_size_t),
        ("gap", c_double),
        ("junction", c_double),
        ("fix_ends", c_int32),
        ("edge", c_double),
        ("views", c_int32),
        ("fair", c_int32),
        ("points", c_int32),
        ("paper_bandwidth", c_char_p),
        ("paper_adaptive", c_int32),
        ("paper_bandwidth_scale", c_double),
        ("paper_neighbourhood", c_double),
        ("paper_gaussian", c_double),
        ("paper_mesh", c_double),
        ("paper_mesh_energy", c_char_p),
        ("paper_whole_polygons", c_int32),
        ("paper_arap", c_double),
        ("paper_memory", c_int32),
        ("paper_iterations", c_int32),
        ("spacing", c_double),
        ("handles", c_int32),
        ("keep_partial", c_int32),
        ("no_partial", c_int32),
        ("gap_near_conflicts", c_int32),
        ("move_strands", c_int32),
        ("pairs", c_char_p),
    ]


class PageContentStruct(_Struct):
    _fields_ = [
        ("size", c_size_t),
        ("moved", c_void_p),
        ("moved_count", c_size_t),
        ("name", c_char_p),
        ("moved_name", c_char_p),
        ("report", c_char_p),
    ]


class ProgressStruct(ctypes.Structure):
    _fields_ = [
        ("size", c_size_t),
        ("fraction", c_double),
        ("phase", c_char_p),
        ("pairs_left", c_size_t),
        ("displacement_rel", c_double),
    ]


class ArrayStruct(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("rows", c_size_t), ("columns", c_size_t), ("type", c_int)]


ProgressFunction = ctypes.CFUNCTYPE(c_int, POINTER(ProgressStruct), c_void_p)

#: What functions take and return that is not int, or not told by what is passed.
_SIGNATURES = {
    "error_message": ([], c_char_p),
    "error_number": ([], c_int),
    "version": ([], c_char_p),
    "pair_kind": ([c_int], c_char_p),
    "context_new": ([ProgressFunction, c_void_p], c_void_p),
    "context_cancel": ([c_void_p], None),
    "context_free": ([c_void_p], None),
    "result_status": ([c_void_p], c_char_p),
    "result_report": ([c_void_p], c_char_p),
    "result_array": ([c_void_p, c_char_p, POINTER(ArrayStruct)], c_int),
    "result_free": ([c_void_p], None),
    "document_read_scene": ([POINTER(c_char_p), c_size_t, c_char_p, POINTER(c_void_p)], c_int),
    "document_surface": ([c_void_p, c_void_p], c_int),
    "document_report": ([c_void_p], c_char_p),
    "document_recompute_normals": ([c_void_p, POINTER(c_int32)], c_int),
    "document_partial": ([c_void_p, c_size_t], c_char_p),
    "document_free": ([c_void_p], None),
}
for _name, (_arguments, _result) in _SIGNATURES.items():
    _function = getattr(library, f"unsnarl_{_name}")
    _function.argtypes, _function.restype = _arguments, _result

#: By unsnarl_error; what is not there is an error of the library's own.
_EXCEPTIONS = {1: ValueError, 2: OSError, 3: OSError, 4: MemoryError, 5: OSError, 6: TimeoutError}


def check(code: int) -> None:
    """Raises what the last call in this thread complained of, if it did."""
    if code != 0:
        message = library.unsnarl_error_message().decode("utf-8", "replace")
        kind, number = _EXCEPTIONS.get(code, RuntimeError), library.unsnarl_error_number()
        # OSError chooses its subclass by the number: FileNotFoundError, PermissionError, ...
        raise OSError(number, message) if kind is OSError and number != 0 else kind(message)


version: str = library.unsnarl_version().decode()


def _pair_kinds() -> tuple[str, ...]:
    kinds: list[str] = []
    while kind := library.unsnarl_pair_kind(len(kinds)):
        kinds.append(kind.decode())
    return tuple(kinds)


#: Names of the kinds of intersecting pairs, in the order in which they are numbered.
pair_kinds = _pair_kinds()
