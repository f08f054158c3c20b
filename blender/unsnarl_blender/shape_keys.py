# SPDX-License-Identifier: GPL-3.0-or-later
"""Relative shape keys: the numbers to store so that Blender displays given positions, and what it displays of them.

At value 1 Blender takes basis - key off the mix of the other keys, both in float32.
"""

import numpy as np

#: Rounds after which displayed positions no longer change, in practice after one.
ROUNDS = 8


def stored(positions, basis, mix):
    """The key for these positions, on the mix of all other keys. All are arrays (n, 3) float32."""
    return basis - (mix - positions)


def displayed(key, basis, mix):
    return mix - (basis - key)


def nearest_displayed(positions, basis, mix):
    """Positions that a key can display, near the given ones: storing them displays them again."""
    for _ in range(ROUNDS):
        near = displayed(stored(positions, basis, mix), basis, mix)
        if np.array_equal(near, positions):
            break
        positions = near
    return positions
