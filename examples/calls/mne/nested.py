"""Makes surfaces of FreeSurfer ready for mne.make_bem_model: without intersections, and nested.

nested.py FOLDER [GAP]   rewrites inner_skull.surf, outer_skull.surf and outer_skin.surf of FOLDER; GAP: millimetres
"""

import sys
from pathlib import Path

import mne
import unsnarl


def repair(folder, gap=0.0):
    """The result: status and report. Nothing is written unless the surfaces are nested."""
    paths = [Path(folder, f"{name}.surf") for name in ("inner_skull", "outer_skull", "outer_skin")]  # innermost first
    surfaces = [mne.read_surface(path, read_metadata=True) for path in paths]
    meshes = [(positions, faces) for positions, faces, _ in surfaces]
    result = unsnarl.repair(meshes, nested=[0, 1, 2], min_gap=gap, absolute=True, precision="float32")
    if result.status == "embedded":
        for path, moved, (_, faces, metadata) in zip(paths, result.V, surfaces):
            mne.write_surface(path, moved, faces, volume_info=metadata or None, overwrite=True, verbose="error")
    return result


if __name__ == "__main__":
    print(repair(sys.argv[1], *map(float, sys.argv[2:])).status)
