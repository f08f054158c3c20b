# Repairs surfaces of one hemisphere that SimNIBS has made, the pial one around the central one. It was not run.
# simnibs_python repair.py m2m_SUBJECT
import sys

import unsnarl
from simnibs import mesh_io

surfaces = [mesh_io.read_gifti_surface(f"{sys.argv[1]}/surfaces/lh.{name}.gii") for name in ("central", "pial")]
meshes = [(one.nodes.node_coord, one.elm.node_number_list[:, :3] - 1) for one in surfaces]
result = unsnarl.repair(meshes, nested=[0, 1], precision="float32")
for one, moved, name in zip(surfaces, result.V, ("central", "pial")):
    one.nodes.node_coord = moved
    mesh_io.write_msh(one, f"lh.{name}.msh")
print(result.status.value)
