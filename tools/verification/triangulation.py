"""How polygons are cut into triangles, by the rule that src/mesh/triangulation.h states."""
import math
from fractions import Fraction

from .vectors import cross, dot, minus, sides

LARGEST_EXPONENT = 100  # numbers up to 2^100 and down to 2^-100 are taken as they are


def at_moderate_scale(points):
    """The points times a power of two at which no product of four lengths over- or underflows."""
    magnitudes = [abs(c) for p in points.values() for c in p if c]
    if not magnitudes:
        return points
    exponent = math.frexp(max(magnitudes))[1]
    if abs(exponent) <= LARGEST_EXPONENT:
        return points
    if exponent > 0:  # no bit of the smallest is lost
        exponent = min(exponent, max(0, math.frexp(min(magnitudes))[1] + 1021))
    return {v: tuple(math.ldexp(c, -exponent) for c in p) for v, p in points.items()}


def cut(face, positions):
    """Triangles of a polygon. In floating point, as near-ties have to be decided like everybody else does."""
    if len(face) == 3:
        return [face]
    p = at_moderate_scale({v: positions[v] for v in face})
    normal = (0.0, 0.0, 0.0)
    for a, b in sides(face):
        part = cross(minus(p[a], p[face[0]]), minus(p[b], p[face[0]]))
        normal = normal[0] + part[0], normal[1] + part[1], normal[2] + part[2]

    def side(a, b, c):
        return dot(normal, cross(minus(p[b], p[a]), minus(p[c], p[a])))

    if len(face) == 4:
        a, b, c, d = face
        if min(side(a, b, c), side(a, c, d)) > 0 or min(side(b, c, d), side(b, d, a)) <= 0:
            return [(a, b, c), (a, c, d)]
        return [(b, c, d), (b, d, a)]

    def is_ear(a, b, c):
        return side(a, b, c) > 0 and not any(
            side(a, b, x) >= 0 and side(b, c, x) >= 0 and side(c, a, x) >= 0 for x in ring if x not in (a, b, c))

    ring, triangles = list(face), []
    while len(ring) > 3:
        ears = (k for k in range(len(ring)) if is_ear(ring[k - 1], ring[k], ring[(k + 1) % len(ring)]))
        k = next(ears, 0)
        triangles.append((ring[k - 1], ring[k], ring[(k + 1) % len(ring)]))
        del ring[k]
    return triangles + [tuple(ring)]


def triangulate(mesh, vertex_of):
    """(triangle of welded vertices, its face). One with a repeated vertex is a segment or a point; it is left out where
    it is an edge or a corner of a triangle with area."""
    triangles = []
    for f, face in enumerate(mesh.faces):
        for t in cut(face, mesh.positions):
            triangles.append(((vertex_of[t[0]], vertex_of[t[1]], vertex_of[t[2]]), f))
    extents = {frozenset(t) for t, _ in triangles if len(set(t)) < 3}
    if not extents:
        return triangles
    first = {}
    for v in range(len(mesh.positions)):
        first.setdefault(vertex_of[v], mesh.positions[v])

    def has_area(t):
        a, b, c = (tuple(Fraction(x) for x in first[v]) for v in t)
        return any(cross(minus(b, a), minus(c, a)))

    covered = set()
    for t, _ in triangles:
        parts = [frozenset(part) for part in list(sides(t)) + [(v,) for v in t]]
        if len(set(t)) == 3 and not extents.isdisjoint(parts) and has_area(t):
            covered.update(parts)
    return [(t, f) for t, f in triangles if len(set(t)) == 3 or frozenset(t) not in covered]
