"""Vectors of three numbers, of any kind, as tuples."""


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def sides(face):
    """Of a polygon: its pairs of consecutive corners."""
    return zip(face, face[1:] + face[:1])
