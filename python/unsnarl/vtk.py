"""The repair as a filter of VTK: ``RepairFilter`` in a pipeline, with or without ParaView. Tested with VTK 9.2.

    repair = unsnarl.vtk.RepairFilter()
    repair.SetInputConnection(reader.GetOutputPort())
    repair.SetMinGap(0.001)
    repair.Update()
    surface = repair.GetOutput()
"""

from __future__ import annotations

import json
from typing import Any, Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # type: ignore
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase  # type: ignore
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringArray  # type: ignore
from vtkmodules.vtkCommonDataModel import (  # type: ignore
    vtkCompositeDataSet, vtkDataObject, vtkDataObjectTree, vtkPolyData,
)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline  # type: ignore

from ._intersections import find_intersections
from ._progress import Progress
from ._repair import repair

#: What counts as an intersection; find_intersections() takes these too.
_FIND_OPTIONS = ("weld", "weld_tolerance", "both_diagonals", "threads")


class _Aborted(Exception):
    """The pipeline asked the filter to stop."""


def _accessors(option: str, kind: type) -> tuple[Any, Any]:
    """The Set and Get methods of an option of unsnarl.repair()."""

    def set_option(self: Any, value: Any) -> None:
        value = kind(value)
        if self._options.get(option, kind()) != value:
            self._options[option] = value
            self.Modified()

    def get_option(self: Any) -> Any:
        return self._options.get(option, kind())

    return set_option, get_option


class RepairFilter(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """Moves the points of a surface as little as possible until no two of its polygons intersect.

    Input: vtkPolyData, or a composite data set whose leaves are vtkPolyData: one scene, whose blocks are separated from
    each other too. Polygons of any size; vertices and lines are kept and move with their points. Triangle strips,
    leaves of other types, and data spread over several processes are refused with an error.

    Output: a copy with all arrays, and

    - point data ``unsnarl_displacement``, 3 components: how far each point moved, in the units of the points;
    - cell data ``unsnarl_intersecting_before`` and ``unsnarl_intersecting``: the number of polygons that each cell
      intersects, in the input and in the output;
    - field data ``unsnarl_status`` (see unsnarl.Status) and ``unsnarl_report`` (JSON, docs/report.md). The whole of a
      composite data set has one status, which each of its leaves holds.

    Points of type float stay so and are certified as such; all others come out as double. Stored normals are kept as
    they are. Options have the names, units and defaults of unsnarl.repair(), as in SetMinGap(0.001). A status other
    than "embedded" is a warning; what is left is in the arrays. An abort gives the input back, with status "cancelled".
    """

    SetMinGap, GetMinGap = _accessors("min_gap", float)
    SetGapNearConflicts, GetGapNearConflicts = _accessors("gap_near_conflicts", bool)
    SetMinDihedral, GetMinDihedral = _accessors("min_dihedral", float)
    SetMaxDisplacement, GetMaxDisplacement = _accessors("max_displacement", float)
    SetAbsolute, GetAbsolute = _accessors("absolute", bool)
    SetTimeLimit, GetTimeLimit = _accessors("time_limit", float)
    SetMemoryLimit, GetMemoryLimit = _accessors("memory_limit", float)
    SetWeldTolerance, GetWeldTolerance = _accessors("weld_tolerance", float)
    SetBothDiagonals, GetBothDiagonals = _accessors("both_diagonals", bool)
    SetEachComponent, GetEachComponent = _accessors("each_component", bool)
    SetThreads, GetThreads = _accessors("threads", int)
    SetGoal, GetGoal = _accessors("goal", str)
    SetPrecision, GetPrecision = _accessors("precision", str)
    SetWeld, GetWeld = _accessors("weld", str)

    def __init__(self) -> None:
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkPolyData")
        self._options: dict[str, Any] = {"goal": "all", "precision": "auto", "weld": "seams"}
        self._fixed_array = ""

    def SetFixedArray(self, name: Optional[str]) -> None:
        """The point array, of one component, whose points other than 0 must not move; "" or "None": all may move."""
        name = "" if name in (None, "None") else str(name)
        if name != self._fixed_array:
            self._fixed_array = name
            self.Modified()

    def GetFixedArray(self) -> str:
        return self._fixed_array

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData")
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkDataObject.DATA_TYPE_NAME(), "vtkDataObject")
        return 1

    def RequestDataObject(self, request: Any, inInfo: Any, outInfo: Any) -> int:
        given, output = self.GetInputData(inInfo, 0, 0), self.GetOutputData(outInfo, 0)
        if given is not None and (output is None or output.GetClassName() != given.GetClassName()):
            outInfo.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), given.NewInstance())
        return 1

    def RequestData(self, request: Any, inInfo: Any, outInfo: Any) -> int:
        given, output = self.GetInputData(inInfo, 0, 0), self.GetOutputData(outInfo, 0)
        try:
            _refuse_pieces(outInfo.GetInformationObject(0))
            surfaces = _surfaces(given)
            _put(given, output, self._repaired(surfaces) if surfaces else [])
        except (TypeError, ValueError, OSError, MemoryError) as error:
            self._say("ErrorEvent", f"unsnarl: {error}")
            output.Initialize()
            return 0
        return 1

    def _repaired(self, surfaces: list[Any]) -> list[Any]:
        fixed = [_mask(surface, self._fixed_array) for surface in surfaces] if self._fixed_array else None
        try:
            result = repair(surfaces, fixed=fixed, progress=self._tell, **self._options)
        except _Aborted:
            return [_with_status(_copied(surface), "cancelled", None) for surface in surfaces]
        if result.status != "embedded":
            left = result.report["after"]["total"]
            self._say("WarningEvent", f"unsnarl: {result.status}, {left} intersecting pairs are left; the field array "
                                      "unsnarl_report says why")
        find = {name: value for name, value in self._options.items() if name in _FIND_OPTIONS}
        before = find_intersections(surfaces, **find)
        after = find_intersections(result.mesh, **find)
        moved = list(result.mesh)
        first = 0
        for surface, own in zip(surfaces, moved):
            _add_displacement(surface, own)
            _add_counts(own, "unsnarl_intersecting_before", before, first)
            _add_counts(own, "unsnarl_intersecting", after, first)
            _with_status(own, str(result.status), result.report)
            first += own.GetNumberOfPolys()
        return moved

    def _tell(self, progress: Progress) -> None:
        self.UpdateProgress(progress.fraction)
        if self.GetAbortExecute():
            raise _Aborted

    def _say(self, event: str, text: str) -> None:
        """Tells observers of the event that there is one, and writes the text to VTK's output window."""
        if self.HasObserver(event):
            self.InvokeEvent(event)
        window = vtkOutputWindow.GetInstance()
        (window.DisplayErrorText if event == "ErrorEvent" else window.DisplayWarningText)(text + "\n")


def _refuse_pieces(information: Any) -> None:
    pieces = information.Get(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES())
    if pieces is not None and pieces > 1:
        raise ValueError(
            f"the surface is spread over {pieces} processes, and intersections between them would be missed; repair it "
            "in one process"
        )


def _surfaces(given: Any) -> list[Any]:
    """The vtkPolyData, or all leaves of a composite data set in their order."""
    if isinstance(given, vtkPolyData):
        return [given]
    if not isinstance(given, vtkDataObjectTree):
        raise ValueError(f"a {given.GetClassName()} is no tree of surfaces; give vtkPolyData or blocks of it")
    surfaces = []
    for name, leaf in _leaves(given):
        if not isinstance(leaf, vtkPolyData):
            raise ValueError(f"block {name} is a {leaf.GetClassName()}; extract its surface first (vtkGeometryFilter)")
        surfaces.append(leaf)
    return surfaces


def _leaves(given: Any) -> list[tuple[str, Any]]:
    iterator, found = given.NewIterator(), []
    while not iterator.IsDoneWithTraversal():
        name = iterator.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME()) if iterator.HasCurrentMetaData() else None
        found.append((repr(name) if name else str(iterator.GetCurrentFlatIndex()), iterator.GetCurrentDataObject()))
        iterator.GoToNextItem()
    return found


def _put(given: Any, output: Any, moved: list[Any]) -> None:
    if isinstance(given, vtkPolyData):
        output.ShallowCopy(moved[0])
        return
    output.CopyStructure(given)
    output.GetFieldData().PassData(given.GetFieldData())
    iterator = given.NewIterator()
    for own in moved:
        output.SetDataSet(iterator, own)
        iterator.GoToNextItem()


def _copied(surface: Any) -> Any:
    copy = surface.NewInstance()
    copy.ShallowCopy(surface)
    return copy


def _mask(surface: Any, name: str) -> Any:
    array = surface.GetPointData().GetArray(name)
    if array is None:
        raise ValueError(f"FixedArray is {name!r}, but there is no point array of numbers of this name")
    if array.GetNumberOfComponents() != 1:
        raise ValueError(f"FixedArray {name!r} has {array.GetNumberOfComponents()} components; give an array of one")
    return vtk_to_numpy(array) != 0


def _add(data: Any, name: str, values: Any) -> None:
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    data.AddArray(array)


def _positions(surface: Any) -> Any:
    points = surface.GetPoints()
    return np.asarray(points.GetData()) if points and points.GetNumberOfPoints() > 0 else np.empty((0, 3))


def _add_displacement(before: Any, after: Any) -> None:
    own = _positions(after)
    _add(after.GetPointData(), "unsnarl_displacement", own - _positions(before).astype(own.dtype))


def _add_counts(surface: Any, name: str, found: Any, first: int) -> None:
    """`found`: the intersections of all surfaces, of which the polygons of this one are counted from `first` on."""
    counts = np.zeros(surface.GetNumberOfCells(), np.int32)
    begin = surface.GetNumberOfVerts() + surface.GetNumberOfLines()  # VTK numbers polygons after these
    ids = found.pairs.ravel() - first
    own = ids[(ids >= 0) & (ids < surface.GetNumberOfPolys())]
    counts[begin:] = np.bincount(own, minlength=surface.GetNumberOfPolys())
    _add(surface.GetCellData(), name, counts)


def _with_status(surface: Any, status: str, report: Any) -> Any:
    texts = {"unsnarl_status": status, **({} if report is None else {"unsnarl_report": json.dumps(report)})}
    for name, text in texts.items():
        array = vtkStringArray()
        array.SetName(name)
        array.InsertNextValue(text)
        surface.GetFieldData().AddArray(array)
    return surface
