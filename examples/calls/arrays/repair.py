"""Repairs of the meshes of other Python packages. options: those of unsnarl.repair, as in min_gap=0.001."""

import numpy as np
import unsnarl


def of_open3d(mesh, **options):
    """Moves the vertices of an open3d.geometry.TriangleMesh, and gives the result with status and report."""
    import open3d

    result = unsnarl.repair(np.asarray(mesh.vertices), np.asarray(mesh.triangles), **options)
    mesh.vertices = open3d.utility.Vector3dVector(result.V)
    mesh.compute_vertex_normals()
    return result


def of_trimesh(mesh, **options):
    """A copy of a trimesh.Trimesh or trimesh.Scene, repaired, and the status."""
    result = unsnarl.repair(mesh, **options)
    return result.mesh, result.status


def of_body_model(vertices, faces, **options):
    """Frames of SMPL and its like: vertices (frames, n, 3), as output.vertices; faces (m, 3), as model.faces. Gives
    the repaired frames as numpy array, without flicker, and whether all are free of self-intersections."""
    if hasattr(vertices, "detach"):  # a tensor
        vertices = vertices.detach().cpu().numpy()
    result = unsnarl.repair_sequence(vertices, np.asarray(faces), **options)
    return result.V, result.embedded


def of_pytorch3d(meshes, **options):
    """The pytorch3d.structures.Meshes with every mesh of the batch repaired by itself, and their statuses. Gradients
    do not flow through a repair."""
    import torch

    padded, statuses = meshes.verts_padded().detach().clone(), []
    for k, (V, F) in enumerate(zip(meshes.verts_list(), meshes.faces_list())):
        result = unsnarl.repair(V.detach().cpu().numpy(), F.cpu().numpy(), **options)
        padded[k, : len(V)] = torch.from_numpy(result.V).to(padded)
        statuses.append(result.status)
    return meshes.update_padded(padded), statuses
