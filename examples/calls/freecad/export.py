# Exports overlapping solids from FreeCAD as one mesh, and shows the repaired mesh in the document.
# freecadcmd export.py, or as a macro. Needs the program `unsnarl` on the PATH.
import subprocess

import FreeCAD
import Mesh
import MeshPart

document = FreeCAD.newDocument()
box = document.addObject("Part::Box", "Box")
ball = document.addObject("Part::Sphere", "Ball")
ball.Placement.Base = FreeCAD.Vector(10, 5, 5)
document.recompute()

mesh = Mesh.Mesh()
for part in (box, ball):
    mesh.addMesh(MeshPart.meshFromShape(Shape=part.Shape, MaxLength=1.5))
mesh.write("in.stl")
done = subprocess.run(["unsnarl", "fix", "in.stl", "-o", "out.stl", "-q"])
if done.returncode == 0:  # no self-intersections
    document.addObject("Mesh::Feature", "Repaired").Mesh = Mesh.Mesh("out.stl")
    document.saveAs("repaired.FCStd")
