# The code of a Python SOP in Houdini: repairs the polygons of its input. Polylines and other primitives are refused.
# It was not run in Houdini.
import hou
import numpy as np
import unsnarl

node = hou.pwd()
geometry = node.geometry()
polygons = geometry.prims()
if not all(isinstance(one, hou.Polygon) and one.isClosed() for one in polygons):
    raise hou.NodeError("convert the input to closed polygons first")
sizes = [one.numVertices() for one in polygons]
corners = [vertex.point().number() for one in polygons for vertex in one.vertices()]
positions = np.frombuffer(geometry.pointFloatAttribValuesAsString("P"), np.float32).reshape(-1, 3)

result = unsnarl.repair(positions, (corners, np.concatenate([[0], np.cumsum(sizes)])))
geometry.setPointFloatAttribValuesFromString("P", result.V.astype(np.float32).tobytes())
if result.status != "embedded":
    node.addWarning(f"unsnarl: {result.status.value}")
