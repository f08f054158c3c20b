"""Which vertices count as one, by the rule that src/mesh/weld_map.h states."""
import math
from collections import defaultdict

from .vectors import sides


class Sets:
    """Disjoint sets; the root is the smallest member."""

    def __init__(self, n):
        self.parent = list(range(n))

    def find(self, i):
        while self.parent[i] != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def unite(self, i, j):
        i, j = sorted((self.find(i), self.find(j)))
        self.parent[j] = i


def position_classes(positions, tolerance):
    first, classes = {}, Sets(len(positions))
    for v, p in enumerate(positions):
        classes.unite(v, first.setdefault(tuple(c + 0.0 for c in p), v))
    if tolerance > 0:
        cells = defaultdict(list)
        for p, v in first.items():
            cells[tuple(math.floor(c / tolerance) for c in p)].append(v)
        for (i, j, k), members in cells.items():
            near = [w for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)
                    for w in cells.get((i + a, j + b, k + c), ())]
            for v in members:
                for w in near:
                    if w < v and sum((a - b) ** 2 for a, b in zip(positions[v], positions[w])) <= tolerance ** 2:
                        classes.unite(v, w)
    return [classes.find(v) for v in range(len(positions))]


def pairings(left, are_partners):
    """All ways to pair off a list, as lists of pairs."""
    if not left:
        yield []
    for k in range(1, len(left)):
        if are_partners(left[0], left[k]):
            for rest in pairings(left[1:k] + left[k + 1:], are_partners):
                yield [(left[0], left[k])] + rest


def open_sides(faces, rename):
    users = defaultdict(list)
    for f, face in enumerate(faces):
        for a, b in sides(face):
            ra, rb = rename(a), rename(b)
            if ra != rb:
                users[min(ra, rb), max(ra, rb)].append((f, a, b))
    return [found[0] for found in users.values() if len(found) == 1]


class Seams:
    """The rule of Weld::seams, in its steps (a) to (c)."""

    def __init__(self, mesh, class_of):
        self.faces, self.class_of, n = mesh.faces, class_of, len(mesh.positions)
        self.welded, self.shells = Sets(n), Sets(n)
        for face in self.faces:  # (a)
            for v in face[1:]:
                self.shells.unite(face[0], v)
        sets = defaultdict(list)
        for f, face in enumerate(self.faces):
            classes = frozenset(class_of[v] for v in face)
            if len(classes) > 2:
                sets[classes].append(f)
        self.twins = {f: classes for classes, members in sets.items() if len(members) > 1 for f in members}
        self.twins_at = defaultdict(list)
        for f in self.twins:
            for v in set(self.faces[f]):
                self.twins_at[v].append(f)
        open_edges = open_sides(self.faces, lambda v: v)
        for _, a, b in open_edges:
            if class_of[a] == class_of[b]:
                self.welded.unite(a, b)
        ambiguous = self.weld_edges([side for side in open_edges if class_of[side[1]] != class_of[side[2]]])
        owner = {}
        if all(owner.setdefault(v, f) == f for f, face in enumerate(self.faces) for v in face):  # (c)
            self.weld_ambiguous(ambiguous)
            self.weld_open_vertices()

    def coincide(self, f, g):
        return f != g and f in self.twins and self.twins.get(g) == self.twins[f]

    def weld(self, s, t):
        same = (self.class_of[s[1]] < self.class_of[s[2]]) == (self.class_of[t[1]] < self.class_of[t[2]])
        self.welded.unite(s[1], t[1] if same else t[2])
        self.welded.unite(s[2], t[2] if same else t[1])
        self.shells.unite(s[1], t[1])

    def are_partners(self, s, t):
        opposite = (self.class_of[s[1]] < self.class_of[s[2]]) != (self.class_of[t[1]] < self.class_of[t[2]])
        return opposite and not self.coincide(s[0], t[0])

    def settle(self, edges):
        if len(edges) == 2 and not self.coincide(edges[0][0], edges[1][0]):
            self.weld(*edges)
            return True
        if len(edges) < 3 or len(edges) > 8 or len(edges) % 2:
            return False
        ways = pairings(edges, self.are_partners)
        way = next(ways, None)
        if way is None or next(ways, None) is not None:
            return False
        for pair in way:
            self.weld(*pair)
        return True

    def weld_edges(self, open_edges):  # (b)
        """Returns the places where more than one pairing is possible, or none: (all edges, those still apart)."""
        places = defaultdict(list)
        for side in open_edges:
            places[tuple(sorted((self.class_of[side[1]], self.class_of[side[2]])))].append(side)
        places = [sorted(places[key]) for key in sorted(places) if len(places[key]) > 1]
        for edges in places:
            if len(edges) == 2:
                self.settle(edges)
        crowded = [(edges, list(edges)) for edges in places if len(edges) > 2]
        changed = bool(crowded)
        for _ in range(32):
            if not changed:
                break
            changed, left_over = False, []
            for edges, still_open in crowded:
                by_shell = defaultdict(list)
                for side in still_open:
                    by_shell[self.shells.find(side[1])].append(side)
                rest = []
                for shell in sorted(by_shell):
                    if self.settle(by_shell[shell]):
                        changed = True
                    else:
                        rest += by_shell[shell]
                rest.sort()
                if rest and self.settle(rest):
                    changed, rest = True, []
                if rest:
                    left_over.append((edges, rest))
            crowded = left_over
        return crowded

    def weld_ambiguous(self, crowded):  # (c), first part
        for edges, rest in crowded:
            clusters = []
            for side in edges if len(rest) % 2 else rest:
                for cluster in clusters:
                    if not any(self.coincide(side[0], other[0]) for other in cluster):
                        self.weld(cluster[0], side)
                        cluster.append(side)
                        break
                else:
                    clusters.append([side])

    def weld_open_vertices(self):  # (c), second part
        find = self.welded.find
        ends = {find(v) for side in open_sides(self.faces, find) for v in side[1:]}
        places = defaultdict(lambda: defaultdict(list))
        for v in range(len(self.class_of)):
            if find(v) in ends:
                places[self.class_of[v]][find(v)].append(v)
        for place in sorted(places):
            clusters = []
            for root in sorted(places[place]):
                twins = [f for v in places[place][root] for f in self.twins_at.get(v, ())]
                for cluster_root, cluster_twins in clusters:
                    if not any(self.coincide(f, g) for f in twins for g in cluster_twins):
                        self.welded.unite(cluster_root, root)
                        cluster_twins += twins
                        break
                else:
                    clusters.append((root, twins))


def weld_map(mesh, weld, tolerance):
    """The first vertex that each vertex counts as."""
    if weld == 'none':
        return list(range(len(mesh.positions)))
    classes = position_classes(mesh.positions, tolerance)
    if weld == 'all':
        return classes
    welded = Seams(mesh, classes).welded
    return [welded.find(v) for v in range(len(mesh.positions))]
