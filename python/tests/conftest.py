import numpy as np
import pytest

import unsnarl


@pytest.fixture
def crossing():
    """Two triangles that cross, and how they are called."""
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 2], [2, 1, 2]], dtype=float)
    F = np.array([[0, 1, 2], [3, 4, 5]])
    return V, F


@pytest.fixture
def sheets():
    """Two bumpy sheets of quads that run through each other; coordinates are float32 numbers."""
    return crossing_sheets(12)


def crossing_sheets(n):
    u, v = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    bump = 0.4 * np.exp(-4 * (u**2 + v**2))
    sheets = [np.stack([u, v, bump - 0.15], -1), np.stack([u, v, 0.15 - bump], -1)]
    V = np.concatenate([sheet.reshape(-1, 3) for sheet in sheets]).astype(np.float32).astype(float)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    corner = (i * (n + 1) + j).ravel()
    quads = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], -1)
    return V, np.concatenate([quads, quads + (n + 1) ** 2])
