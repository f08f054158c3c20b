# SPDX-License-Identifier: Apache-2.0
"""ParaView plug-in: the filter "Repair Self Intersections". Load it by Tools > Manage Plugins; docs/paraview.md.

The filter itself is unsnarl.vtk.RepairFilter of the Python package, which has to be importable: on PYTHONPATH, or
unpacked in the folder of this file.
"""

import sys
from pathlib import Path

from paraview.util.vtkAlgorithm import smdomain, smproperty, smproxy

sys.path.append(str(Path(__file__).resolve().parent))
try:
    from unsnarl.vtk import RepairFilter
except ImportError as error:
    raise ImportError(f"{error}: install the Python package unsnarl into {Path(__file__).parent}, as docs/paraview.md "
                      "says") from error


def _number(name, most, text, default=0):
    return f"""<DoubleVectorProperty name="{name}" command="Set{name}" number_of_elements="1"
      default_values="{default}"><DoubleRangeDomain name="range" min="0" max="{most}"/>
      <Documentation>{text}</Documentation></DoubleVectorProperty>"""


def _switch(name, text):
    return f"""<IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1"
      default_values="0" panel_visibility="advanced"><BooleanDomain name="bool"/>
      <Documentation>{text}</Documentation></IntVectorProperty>"""


def _choice(name, values, text):
    strings = "".join(f'<String value="{value}"/>' for value in values)
    return f"""<StringVectorProperty name="{name}" command="Set{name}" number_of_elements="1"
      default_values="{values[0]}" panel_visibility="advanced"><StringListDomain name="list">{strings}</StringListDomain>
      <Documentation>{text}</Documentation></StringVectorProperty>"""


_FIXED = """<StringVectorProperty name="FixedArray" command="SetFixedArray" number_of_elements="1"
  default_values="None"><ArrayListDomain name="arrays" attribute_type="Scalars" input_domain_name="points"
  none_string="None"><RequiredProperties><Property name="Input" function="Input"/></RequiredProperties></ArrayListDomain>
  <Documentation>Point array: points where it is not 0 do not move.</Documentation></StringVectorProperty>"""

_PROPERTIES = [
    _FIXED,
    _number("MinGap", 0.01, "Distance to keep between surfaces, as a fraction of the diagonal of the bounding "
            "box. 0: where they had to be moved apart, as little as is safe."),
    _number("MaxDisplacement", 1, "How far a point may move, as a fraction of the diagonal. 0: any "
            "distance."),
    _number("MinDihedral", 10, "Neighbouring faces that meet at less are opened. 0: off."),
    _number("TimeLimit", 3600, "Seconds after which the repair stops. 0: none."),
    _number("MemoryLimit", 65536, "What the process may hold. 0: no limit."),
    _number("WeldTolerance", 1, "Points this close count as one. 0: only at equal positions."),
    _switch("Absolute", "Gap and largest move are lengths, not fractions."),
    _switch("GapNearConflicts", "Open gaps only around what intersects."),
    _switch("BothDiagonals", "The result holds whichever way quads are split."),
    _switch("EachComponent", "Components may go on passing through each other."),
    _choice("Goal", ["all", "disjoint"], "disjoint: only pairs of faces that share no point count."),
    _choice("Weld", ["seams", "all", "none"], "Which points at equal positions count as one."),
    _choice("Precision", ["auto", "float32", "float64"], "Number format in which the result must hold."),
]


def _with_properties(decorated):
    for xml in reversed(_PROPERTIES):
        decorated = smproperty.xml(xml)(decorated)
    return decorated


@smproxy.filter(name="RepairSelfIntersections", label="Repair Self Intersections")
@_with_properties
@smproperty.input(name="Input")
@smdomain.xml('<InputArrayDomain name="points" attribute_type="point" number_of_components="1" optional="1"/>')
@smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=True)
class RepairSelfIntersections(RepairFilter):
    """Moves the points of a surface as little as possible until no two of its polygons intersect."""
