"""Exact counts of the crossings of polylines in the plane, and distances between drawings of them: for benchmarks of
curves, whose checks must share no code with the program."""

from fractions import Fraction

import numpy as np

MOST_PAIRS = 1 << 21  # that are looked at together


class Segments:
    """The segments of drawings, one after the other. A drawing is a list of (points (n, 2), is closed)."""

    def __init__(self, drawings):
        a, b, after, drawing, ends, start = [], [], [], [], [], 0
        for number, polylines in enumerate(drawings):
            for points, closed in polylines:
                points = np.asarray(points, dtype=float)
                n = len(points) if closed else len(points) - 1
                a.append(points[:n])
                b.append(np.roll(points, -1, axis=0)[:n])
                after.append(start + np.roll(np.arange(n), -1))
                if not closed:
                    after[-1][-1] = -1
                    ends += [(number, *points[0]), (number, *points[-1])]
                drawing.append(np.full(n, number))
                start += n
        self.a, self.b = np.concatenate(a), np.concatenate(b)
        self.after = np.concatenate(after)  # the segment that begins where each ends; -1: none
        self.drawing = np.concatenate(drawing)
        self.ends = set(ends)  # of open polylines: the drawing, x, y


def exact_sides(p, q, r):
    """The signs of the areas of triangles: by doubles where their error is bounded, else by fractions."""
    left = (q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1])
    right = (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0])
    value = left - right
    sign = np.sign(value).astype(int)
    is_end = np.all(r == p, axis=1) | np.all(r == q, axis=1)
    sign[is_end] = 0
    for k in np.nonzero((np.abs(value) <= 1e-15 * (np.abs(left) + np.abs(right)) + 1e-300) & ~is_end)[0]:
        (px, py), (qx, qy), (rx, ry) = ([Fraction(float(x)) for x in point[k]] for point in (p, q, r))
        exact = (qx - px) * (ry - py) - (qy - py) * (rx - px)
        sign[k] = (exact > 0) - (exact < 0)
    return sign


def pairs_with_boxes_that_meet(s):
    """Numbers of segments of one drawing whose boxes meet, in parts."""
    low, high = np.minimum(s.a, s.b), np.maximum(s.a, s.b)
    # The places in the order of all x, so that those of one drawing lie together and nothing is rounded.
    x, rank = np.unique(np.concatenate([low[:, 0], high[:, 0]]), return_inverse=True)
    first, last = s.drawing * len(x) + rank[: len(low)], s.drawing * len(x) + rank[len(low) :]
    order = np.argsort(first, kind="stable")
    counts = np.searchsorted(first[order], last[order], side="right") - np.arange(len(order)) - 1
    sums = np.concatenate([[0], np.cumsum(counts)])
    begin = 0
    while begin < len(order):
        end = max(begin + 1, int(np.searchsorted(sums, sums[begin] + MOST_PAIRS, side="right")) - 1)
        of = counts[begin:end]
        one = np.repeat(np.arange(begin, end), of)
        other = one + 1 + np.arange(len(one)) - np.repeat(sums[begin:end] - sums[begin], of)
        i, j = order[one], order[other]
        near = (low[i, 1] <= high[j, 1]) & (low[j, 1] <= high[i, 1])
        yield i[near], j[near]
        begin = end


def crossings(drawings):
    """Of each drawing: the number of pairs of its segments that meet anywhere but in the point between neighbours, or in
    a point of both at which an open polyline ends."""
    s = Segments(drawings)
    found = np.zeros(len(drawings), dtype=int)
    a, b, after = s.a, s.b, s.after
    for i, j in pairs_with_boxes_that_meet(s):
        by_i = exact_sides(a[i], b[i], a[j]), exact_sides(a[i], b[i], b[j])
        near = by_i[0] * by_i[1] <= 0
        i, j, by_i = i[near], j[near], (by_i[0][near], by_i[1][near])
        meets = exact_sides(a[j], b[j], a[i]) * exact_sides(a[j], b[j], b[i]) <= 0
        # Segments that share a point overlap where they are on one line and go the same way from there.
        meets &= ((after[i] != j) & (after[j] != i)) | ((by_i[0] == 0) & (by_i[1] == 0))
        for k in np.nonzero(meets)[0]:
            p, q = i[k], j[k]
            joined = [
                (x, y)
                for x, y, is_joint in ((b[p], a[q], after[p] == q), (a[p], b[q], after[q] == p), (a[p], a[q], False), (b[p], b[q], False))
                if is_joint or (np.array_equal(x, y) and (s.drawing[p], *x) in s.ends)
            ]
            if joined:
                at = joined[0][0]
                ways = [np.where(np.array_equal(one, at), other, one) - at for one, other in ((a[p], b[p]), (a[q], b[q]))]
                meets[k] = by_i[0][k] == 0 and by_i[1][k] == 0 and np.dot(*ways) > 0
        found += np.bincount(s.drawing[i[meets]], minlength=len(drawings))
    return found


SPACING = 0.002  # of places along drawings that are compared, in diagonals
CELL = 0.01  # squares of a grid in which places are looked for, in diagonals


def places(drawing, scale):
    """Places along a drawing, scaled: points (n, 2) and the length that each stands for."""
    s = Segments([drawing])
    a, b = s.a * scale, s.b * scale
    length = np.hypot(*(b - a).T)
    count = np.maximum(1, np.ceil(length / SPACING).astype(int))
    k = np.repeat(np.arange(len(a)), count)
    t = (np.arange(len(k)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[k]
    return a[k] + t[:, None] * (b - a)[k], length[k] / count[k]


def nearest(points, others):
    """The distance from each point to the nearest of the others: in the squares around it, else among all."""
    low = np.minimum(points.min(axis=0), others.min(axis=0)) - CELL
    of_points, of_others = (((p - low) // CELL).astype(np.int64) for p in (points, others))
    rows = int(max(of_points[:, 1].max(), of_others[:, 1].max())) + 2
    keys = of_others[:, 0] * rows + of_others[:, 1]
    order = np.argsort(keys, kind="stable")
    keys, others = keys[order], others[order]
    best = np.full(len(points), np.inf)

    def compare(which, begin, end):
        counts = end - begin
        sums = np.concatenate([[0], np.cumsum(counts)])
        at = 0
        while at < len(which):
            to = max(at + 1, int(np.searchsorted(sums, sums[at] + MOST_PAIRS, side="right")) - 1)
            p = np.repeat(np.arange(at, to), counts[at:to])
            q = np.arange(len(p)) - np.repeat(sums[at:to] - sums[at], counts[at:to]) + begin[p]
            np.minimum.at(best, which[p], np.hypot(*(points[which[p]] - others[q]).T))
            at = to

    for column in (-1, 0, 1):
        key = (of_points[:, 0] + column) * rows + of_points[:, 1]
        compare(np.arange(len(points)), np.searchsorted(keys, key - 1), np.searchsorted(keys, key + 1, side="right"))
    far = np.nonzero(best > CELL)[0]
    compare(far, np.zeros(len(far), dtype=int), np.full(len(far), len(others)))
    return best


def distances(drawing, other):
    """From one drawing to another: mean and largest distance along the first, and the share of its length that is
    farther than 0.5 %, all in units of the diagonal of the first."""
    points = np.concatenate([np.asarray(p, dtype=float) for p, _ in drawing])
    scale = 1 / np.hypot(*(points.max(axis=0) - points.min(axis=0)))
    points, length = places(drawing, scale)
    apart = np.maximum(0, nearest(points, places(other, scale)[0]) - SPACING / 2)
    return np.dot(length, apart) / length.sum(), apart.max(), length[apart > 0.005].sum() / length.sum()
