# SPDX-License-Identifier: Apache-2.0
"""Renders the picture of docs/paraview.md: a sample before and after the filter, coloured by the arrays that it adds.

  export PYTHONPATH=paraview/python_3_11:build/release/python
  xvfb-run -s '-screen 0 1400x700x24 -noreset' pvbatch paraview/picture.py docs/images/paraview.png
"""

import sys
import tempfile
from pathlib import Path

from paraview import simple

import unsnarl

SAMPLE, RESOLUTION = "crossing_tubes", 80
SIZE = (1300, 440)
GREY, RED, BLUE, DARK_BLUE = (0.78, 0.8, 0.83), (0.8, 0.1, 0.1), (0.3, 0.5, 0.85), (0.02, 0.1, 0.45)

simple._DisableFirstRenderCameraReset()
simple.LoadPlugin(str(Path(__file__).with_name("unsnarl_paraview.py")), remote=False, ns=globals())


def read_sample(folder):
    V, F = unsnarl.sample(SAMPLE, resolution=RESOLUTION)
    lines = [f"v {x} {y} {z}" for x, y, z in V.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in F.tolist()]
    path = Path(folder, "sample.obj")
    path.write_text("\n".join(lines) + "\n")
    return simple.OpenDataFile(str(path))


def show(source, view, association, array, colours, title=None):
    """colours: (value, colour) from the least value up. title: of a bar of colours; None: there is none."""
    shown = simple.Show(source, view)
    simple.ColorBy(shown, (association, array))
    shown.Specular = 0.2
    transfer = simple.GetColorTransferFunction(array)
    transfer.RGBPoints = [number for value, colour in colours for number in (value, *colour)]
    if title:
        bar = simple.GetScalarBar(transfer, view)
        bar.Title, bar.ComponentTitle, bar.Visibility = title, "", 1
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Lower Center", 0.4
        bar.TitleFontSize = bar.LabelFontSize = 12
        bar.ScalarBarThickness, bar.AddRangeLabels = 10, 0


def new_view(layout, cell):
    view = simple.CreateView("RenderView")
    simple.AssignViewToLayout(view, layout, cell)
    view.UseColorPaletteForBackground, view.Background, view.OrientationAxesVisibility = 0, [1, 1, 1], 0
    return view


with tempfile.TemporaryDirectory() as folder:
    repaired = RepairSelfIntersections(read_sample(folder))  # noqa: F821, the plug-in's
    repaired.UpdatePipeline()
    before = simple.WarpByVector(repaired, Vectors=["POINTS", "unsnarl_displacement"], ScaleFactor=-1)
    longest = repaired.PointData["unsnarl_displacement"].GetRange(-1)[1]

    layout = simple.CreateLayout("before and after")
    layout.SplitHorizontal(0, 0.5)
    left, right = new_view(layout, 1), new_view(layout, 2)
    show(before, left, "CELLS", "unsnarl_intersecting_before", [(0, GREY), (0.5, RED), (1, RED)])
    moved = [(0, GREY), (longest / 5, BLUE), (longest, DARK_BLUE)]
    show(repaired, right, "POINTS", "unsnarl_displacement", moved, "displacement")
    for view in (left, right):
        simple.ResetCamera(view)
        view.GetActiveCamera().Elevation(-70)
        view.GetActiveCamera().Dolly(1.45)
    simple.SaveScreenshot(sys.argv[1], layout, ImageResolution=SIZE, SeparatorWidth=0)
