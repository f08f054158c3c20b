"""Which triangles meet outside the hull of the vertices that they share, decided in integers."""
import math

from .vectors import cross, dot, minus, sides


def scaled_to_integers(positions):
    ratios = [[c.as_integer_ratio() for c in p] for p in positions]
    scale = max((d for p in ratios for _, d in p), default=1)
    return [tuple(n * (scale // d) for n, d in p) for p in ratios]


def bounds(items):
    boxes = [box for box, _ in items]
    return tuple(min(b[k] for b in boxes) for k in range(3)) + tuple(max(b[k] for b in boxes) for k in range(3, 6))


def touch(a, b):
    return (a[0] <= b[3] and b[0] <= a[3] and a[1] <= b[4] and b[1] <= a[4] and a[2] <= b[5] and b[2] <= a[5])


def halves(items):
    box = bounds(items)
    axis = max(range(3), key=lambda k: box[k + 3] - box[k])
    items.sort(key=lambda item: item[0][axis] + item[0][axis + 3])
    return items[:len(items) // 2], items[len(items) // 2:]


def overlapping_pairs(items):
    """Pairs of ids whose boxes touch; items: (box, id)."""
    stack = [(items, None)]
    while stack:
        a, b = stack.pop()
        if b is None:
            if len(a) > 12:
                left, right = halves(a)
                stack += [(left, None), (right, None), (left, right)]
            else:
                for k, (box, i) in enumerate(a):
                    for other, j in a[:k]:
                        if touch(box, other):
                            yield i, j
            continue
        around = bounds(b)
        a = [item for item in a if touch(item[0], around)]
        if a:
            around = bounds(a)
            b = [item for item in b if touch(item[0], around)]
        if not a or not b:
            continue
        if len(a) * len(b) <= 100:
            for box, i in a:
                for other, j in b:
                    if touch(box, other):
                        yield i, j
        else:
            stack += [(part, other) for part in (halves(a) if len(a) > 1 else [a])
                      for other in (halves(b) if len(b) > 1 else [b])]


def clipped(points, normal, offset, both_sides):
    """What of a convex polygon of homogeneous points (x, y, z, w > 0) lies where normal . x >= offset (or = offset)."""
    for flip in (1, -1) if both_sides else (1,):
        heights = [flip * (dot(normal, q) - offset * q[3]) for q in points]
        kept = []
        for k, (q, h) in enumerate(zip(points, heights)):
            before, low = points[k - 1], heights[k - 1]
            if h * low < 0:
                s, t = abs(h), abs(low)
                new = [s * a + t * b for a, b in zip(before, q)]
                factor = math.gcd(*new)
                kept.append(tuple(c // factor for c in new))
            if h >= 0:
                kept.append(q)
        points = kept
        if not points:
            break
    return points


def half_spaces(corners):
    """(normal, offset, is a plane) whose intersection is the hull of three points: a triangle, a segment or a point."""
    a, b, c = corners
    normal = cross(minus(b, a), minus(c, a))
    if any(normal):
        inner = [cross(normal, minus(q, p)) for p, q in ((a, b), (b, c), (c, a))]
        return [(normal, dot(normal, a), True)] + [(n, dot(n, p), False) for n, p in zip(inner, corners)]
    a, b = max(((a, b), (b, c), (c, a)), key=lambda e: dot(minus(*e), minus(*e)))
    along = minus(b, a)
    if not any(along):
        return [(axis, dot(axis, a), True) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    across = next(n for n in (cross(along, axis) for axis in ((1, 0, 0), (0, 1, 0))) if any(n))
    planes = [(n, dot(n, a), True) for n in (across, cross(along, across))]
    back = (-along[0], -along[1], -along[2])
    return planes + [(along, dot(along, a), False), (back, dot(back, b), False)]


def in_hull(q, shared):
    """Is the homogeneous point in the hull of at most two points?"""
    if not shared:
        return False
    start, w = shared[0], q[3]
    from_start = q[0] - w * start[0], q[1] - w * start[1], q[2] - w * start[2]
    if len(shared) == 1:
        return not any(from_start)
    along = minus(shared[1], start)
    return not any(cross(from_start, along)) and 0 <= dot(from_start, along) <= w * dot(along, along)


def meet_outside_hull(a, b, shared):
    """The definition taken literally: some corner of the convex set in which two faces meet is not in the hull."""
    points = [corner + (1,) for corner in a]
    for normal, offset, is_plane in half_spaces(b):
        points = clipped(points, normal, offset, is_plane)
        if not points:
            return False
    return not all(in_hull(q, shared) for q in points)


class Detector:
    """`points`: integers. `triangles`: their corners."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles
        self.normals = []
        for a, b, c in triangles:
            self.normals.append(cross(minus(points[b], points[a]), minus(points[c], points[a])))

    def has_area(self, t):
        return any(self.normals[t])

    def is_separated(self, i, j, shared):
        """A quick proof that two triangles with area meet in the shared vertices at most (none, one or two)."""
        p = self.points
        ta, tb = self.triangles[i], self.triangles[j]
        na, nb = self.normals[i], self.normals[j]
        origin = p[shared[0]] if shared else p[ta[0]]
        a = [minus(p[v], origin) for v in ta if v not in shared]
        b = [minus(p[v], origin) for v in tb if v not in shared]
        if len(shared) == 2:
            height = dot(na, b[0])
            if height:
                return True
            across = cross(na, minus(p[shared[1]], origin))
            return dot(across, a[0]) * dot(across, b[0]) < 0

        def separates(axis):
            ha, hb = [dot(axis, q) for q in a], [dot(axis, q) for q in b]
            if not shared:
                return max(ha) < min(hb) or max(hb) < min(ha)
            # Both through the origin, so one strictly on its side is enough.
            low_a, high_a, low_b, high_b = min(ha), max(ha), min(hb), max(hb)
            return ((high_a <= 0 <= low_b and (high_a < 0 or low_b > 0)) or
                    (high_b <= 0 <= low_a and (high_b < 0 or low_a > 0)) or
                    (low_a == high_a == 0 and (low_b > 0 or high_b < 0)) or
                    (low_b == high_b == 0 and (low_a > 0 or high_a < 0)))

        if separates(na) or separates(nb):
            return True
        edges_a = [minus(p[w], p[v]) for v, w in sides(ta)]
        edges_b = [minus(p[w], p[v]) for v, w in sides(tb)]
        return (any(separates(cross(e, f)) for e in edges_a for f in edges_b) or
                any(separates(cross(na, e)) for e in edges_a) or any(separates(cross(nb, e)) for e in edges_b))

    def kind(self, i, j):
        """The class in which two triangles intersect; None where they do not."""
        ta, tb = self.triangles[i], self.triangles[j]
        shared = [v for v in dict.fromkeys(ta) if v in tb]
        if len(shared) == 3:
            return 'duplicate'
        have_area = self.has_area(i) and self.has_area(j)
        if have_area and self.is_separated(i, j, shared):
            return None
        p = self.points
        # Triangles apart have a separating axis among those tried, so without a shared vertex that was the answer.
        if (shared or not have_area) and not meet_outside_hull(
                [p[v] for v in ta], [p[v] for v in tb], [p[v] for v in shared]):
            return None
        return ('disjoint', 'one_vertex', 'folded')[len(shared)] if have_area else 'degenerate'

    def find(self):
        """(i, j, class), i < j."""
        boxes = []
        for t, corners in enumerate(self.triangles):
            x, y, z = zip(*(self.points[v] for v in corners))
            boxes.append(((min(x), min(y), min(z), max(x), max(y), max(z)), t))
        found = ((min(i, j), max(i, j), self.kind(i, j)) for i, j in overlapping_pairs(boxes))
        return sorted(pair for pair in found if pair[2])
