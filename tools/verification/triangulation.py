"""How polygons are cut into triangles, by the rule that src/mesh/triangulation.h states."""
from .vectors import cross, dot, minus, sides


def cut(face, p):
    """Triangles of a polygon. In floating point, as near-ties have to be decided like everybody else does."""
    if len(face) == 3:
        return [face]
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
    """(triangle of welded vertices, its face)."""
    triangles = []
    for f, face in enumerate(mesh.faces):
        for t in cut(face, mesh.positions):
            t = vertex_of[t[0]], vertex_of[t[1]], vertex_of[t[2]]
            if len(set(t)) == 3:
                triangles.append((t, f))
    return triangles
