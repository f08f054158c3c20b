# For the Python console of 3D Slicer: repairs a model, or several that should lie inside each other.
# It was not run in Slicer.
import slicer
import unsnarl  # once: slicer.util.pip_install("FOLDER/unsnarl-....whl")


def repair_models(*names, **options):
    """names: of models, the innermost first. options: those of unsnarl.repair. Gives the status."""
    nodes = [slicer.util.getNode(name) for name in names]
    surfaces = [node.GetPolyData() for node in nodes]
    if len(nodes) > 1:
        options.setdefault("nested", list(range(len(nodes))))
    result = unsnarl.repair(surfaces if len(nodes) > 1 else surfaces[0], **options)
    for node, mesh in zip(nodes, result.mesh if len(nodes) > 1 else [result.mesh]):
        node.SetAndObservePolyData(mesh)
    return result.status
