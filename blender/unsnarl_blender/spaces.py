# SPDX-License-Identifier: GPL-3.0-or-later
"""The coordinates in which the library sees objects, and back to the float32 numbers that Blender keeps.

Objects that share one matrix without distortion, and so every object alone with an even scale, are seen in their own
coordinates: the library's result is what Blender keeps, bit for bit. Others are seen in the world, in double
precision.
"""

import numpy as np

#: A matrix counts as an even scale where the axes' lengths and angles agree so far; displacement is no less even then
#: than float32 matrices of rotations are.
EVEN = 1e-5


class OwnSpace:
    """Of objects that share one matrix: the numbers that Blender keeps."""

    is_own = True

    def __init__(self, length):
        self.length = length  # of one unit of these coordinates, in units of the scene

    def placed(self, positions):
        return positions

    def step(self, kept):
        """How far apart the numbers are that Blender keeps, at most."""
        return max(map(spacing, kept))

    def kept(self, moved, before):
        return [np.asarray(one, np.float32) for one in moved]


class WorldSpace:
    """Positions in the world, float64, each computed from the float32 numbers and the matrix of its object."""

    is_own = False
    length = 1.0

    def __init__(self, matrices):
        self.matrices = matrices

    def placed(self, positions):
        return [in_world(matrix, one) for matrix, one in zip(self.matrices, positions)]

    def step(self, kept):
        return max(spacing(own) * np.linalg.norm(matrix[:3, :3], 2) for matrix, own in zip(self.matrices, kept))

    def kept(self, moved, before):
        """What Blender keeps of positions in the world; where a vertex did not move, its bits from before."""
        kept = []
        for matrix, world, own in zip(self.matrices, moved, before):
            changed = np.any(world != in_world(matrix, own), axis=1)
            new = own.copy()
            new[changed] = np.linalg.solve(matrix[:3, :3], (world[changed] - matrix[:3, 3]).T).T
            kept.append(new)
        return kept


def space_of(matrices):
    """The space for objects with these matrices to the world."""
    first = matrices[0]
    gram = first[:3, :3].T @ first[:3, :3]
    squared = np.trace(gram) / 3
    is_even = np.all(np.abs(gram - squared * np.eye(3)) <= EVEN * squared)
    if is_even and all(np.array_equal(first, other) for other in matrices):
        return OwnSpace(float(np.sqrt(squared)))
    return WorldSpace(matrices)


def spaces_of(frames):
    """Of each frame, from the matrices of its objects: all of one kind, and of one length."""
    spaces = [space_of(matrices) for matrices in frames]
    lengths = [space.length for space in spaces]
    if all(space.is_own for space in spaces) and max(lengths) - min(lengths) <= EVEN * max(lengths):
        return [OwnSpace(lengths[0])] * len(spaces)
    return [WorldSpace(matrices) for matrices in frames]


def spacing(positions):
    """Between float32 numbers at the largest coordinate."""
    return float(np.spacing(np.float32(np.abs(positions).max(initial=0))))


def in_world(matrix, positions):
    x, y, z = positions.astype(np.float64).T
    # Sums rather than a product of matrices: the same bits whatever else is in the array.
    return np.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in matrix[:3]], axis=1)
