#!/usr/bin/env python3
"""Checks a repaired mesh against its input, exactly, and shares no code with unsnarl.

What is checked, and said line by line:

  faces       OUT has the faces of IN, corner by corner
  file        every byte of OUT but the positions is that of IN, and coordinates that did not change kept their text
              (what follows from positions may follow: STL normals of moved facets, glTF min and max;
              of glTF, every value of the JSON is compared; of compressed arrays and archives what is in them)
  seams       vertices that count as one in IN still lie at one place
  fixed       the vertices listed by --fixed did not move
  embedded    no two faces of OUT meet anywhere but in the hull of the vertices that they share
  areas       no face has lost its area
  float32     both also hold with all positions rounded to float32 (with --float32)

Which vertices count as one is decided by IN, by the rules that src/mesh/weld_map.h states. Polygons are cut into
triangles by IN and once more by OUT, by those of src/mesh/triangulation.h; faces must not meet either way. All geometry
is decided in integers: coordinates are scaled by one power of two. Only the standard library is needed.

Exit codes: 0 all holds, 1 something does not, 2 the command line is wrong, 3 a file cannot be read.
"""
import argparse
import copy
import math
import sys

from verification.intersections import Detector, scaled_to_integers
from verification.mesh import Unreadable, float32
from verification.mesh_files import read
from verification.triangulation import triangulate
from verification.vectors import cross, minus, sides
from verification.weld_map import weld_map

CLASSES = ('disjoint', 'one_vertex', 'folded', 'duplicate', 'degenerate')


def pairs_of_faces(pairs, triangles):
    """(face, face) -> the first of the classes in which their triangles intersect."""
    found = {}
    for i, j, kind in pairs:
        key = min(triangles[i][1], triangles[j][1]), max(triangles[i][1], triangles[j][1])
        found[key] = min(kind, found.get(key, kind), key=CLASSES.index)
    return found


def count_text(pairs):
    counts = [(kind, sum(k == kind for k in pairs.values())) for kind in CLASSES]
    return ', '.join(f'{n} {kind}' for kind, n in counts if n) or 'none'


def normal_fits(corners, stored):
    normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
    length = math.hypot(*normal)
    longest = max(math.dist(a, b) for a, b in sides(corners))
    if length <= 1e-5 * longest * longest or not all(map(math.isfinite, stored)):
        return True  # a needle: no digit of its normal is certain
    return math.dist([c / length for c in normal], stored) < 1e-3


class Verification:
    """Runs the checks; `findings` holds (name, holds, text)."""

    def __init__(self, before, after, options):
        self.before, self.after, self.options, self.findings = before, after, options, []
        if self.check_faces():
            self.check_file()
            self.vertex_of = weld_map(before, options.weld, options.weld_tolerance)
            self.triangles = triangulate(before, self.vertex_of)
            self.check_seams()
            self.check_fixed()
            self.check_geometry(after.positions, 'embedded', 'areas')
            if options.float32:
                self.check_geometry([tuple(map(float32, p)) for p in after.positions], 'float32', 'float32 areas')

    def say(self, name, holds, text):
        self.findings.append((name, holds, text))

    def moved(self, v):
        return self.before.positions[v] != self.after.positions[v]

    def check_faces(self):
        before, after = self.before, self.after
        same = before.faces == after.faces and len(before.positions) == len(after.positions)
        self.say('faces', same, f'{len(after.faces)} faces, {len(after.positions)} vertices' +
                 ('' if same else f'; in the input {len(before.faces)} and {len(before.positions)}, or other corners'))
        return same

    def check_file(self):
        before, after = self.before, self.after
        wrong = []
        if before.rest != after.rest:
            wrong.append('something else than positions differs')
        values = zip((c for p in before.positions for c in p), (c for p in after.positions for c in p))
        rewritten = sum(x == y and s != t for (x, y), s, t in zip(values, before.texts, after.texts))
        if rewritten:
            wrong.append(f'{rewritten} coordinates did not change but were written anew')
        for f, ((old, old_normal), (new, new_normal)) in enumerate(zip(before.normals, after.normals)):
            corners = [after.positions[3 * f + k] for k in range(3)]
            has_moved = any(self.moved(3 * f + k) for k in range(3))
            fits = new == old if not has_moved or not any(old_normal) else normal_fits(corners, new_normal)
            if not fits:
                wrong.append(f'the normal of facet {f} is wrong')
                break
        self.say('file', not wrong, '; '.join(wrong) or 'same but for positions')

    def check_seams(self):
        if self.options.weld_tolerance > 0:
            return
        torn = sum(self.after.positions[v] != self.after.positions[w] for v, w in enumerate(self.vertex_of))
        merged = sum(v != w for v, w in enumerate(self.vertex_of))
        self.say('seams', not torn, f'{merged} vertices count as an earlier one' + (f'; {torn} left it' if torn else ''))

    def check_fixed(self):
        if self.options.fixed is None:
            return
        away = [v for v in self.options.fixed if self.moved(v)]
        self.say('fixed', not away, f'{len(away)} of {len(self.options.fixed)} fixed vertices moved' +
                 (f', first {away[0]}' if away else ''))

    def pairs(self, positions):
        detector = Detector(scaled_to_integers(positions), [t for t, _ in self.triangles])
        pairs = pairs_of_faces(detector.find(), self.triangles)
        read = copy.copy(self.before)
        read.positions = positions
        triangles = triangulate(read, self.vertex_of)
        if triangles != self.triangles:
            found = Detector(scaled_to_integers(positions), [t for t, _ in triangles]).find()
            for faces, kind in pairs_of_faces(found, triangles).items():
                pairs[faces] = min(kind, pairs.get(faces, kind), key=CLASSES.index)
        return detector, pairs

    def check_geometry(self, positions, name, areas_name):
        detector, pairs = self.pairs(positions)
        wanted = {f: k for f, k in pairs.items() if k == 'disjoint'} if self.options.goal == 'disjoint' else pairs
        text = 'intersecting pairs of faces: ' + count_text(pairs)
        if self.options.no_worse:
            _, old = self.pairs(self.before.positions)
            holds = len(wanted) <= len(old) and list(pairs.values()).count('disjoint') <= list(old.values()).count('disjoint')
            text += '; in the input: ' + count_text(old)
        else:
            holds = not wanted
            if wanted:
                text += '; first ' + ', '.join(f'{f} x {g}' for f, g in sorted(wanted)[:5])
        self.say(name, holds, text)
        rest = Detector(scaled_to_integers(self.before.positions), detector.triangles)
        lost = [self.triangles[t][1] for t in range(len(self.triangles)) if rest.has_area(t) and not detector.has_area(t)]
        if self.options.no_worse:
            return
        self.say(areas_name, not lost, f'{len(lost)} faces have lost their area' + (f', first {lost[0]}' if lost else ''))


def read_ids(path, count):
    try:
        with open(path, encoding='utf-8') as file:
            ids = [int(word) for line in file for word in line.split('#')[0].split()]
    except (OSError, ValueError) as error:
        raise Unreadable(f'{path}: {error}') from error
    if any(not 0 <= v < count for v in ids):
        raise Unreadable(f'{path}: names a vertex that does not exist')
    return ids


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('input', metavar='IN', help='the mesh before repair, in any format that unsnarl reads')
    parser.add_argument('output', metavar='OUT', help='the mesh after repair')
    parser.add_argument('--format', help='of both files; else by their extensions')
    parser.add_argument('--float32', action='store_true', help='also check with all positions rounded to float32')
    parser.add_argument('--fixed', metavar='FILE', help='vertices that must not have moved: 0-based ids, # for comments')
    parser.add_argument('--weld', choices=('none', 'seams', 'all'), default='seams', help='as given to unsnarl')
    parser.add_argument('--weld-tolerance', type=float, default=0, help='as given to unsnarl')
    parser.add_argument('--goal', choices=('all', 'disjoint'), default='all', help='as given to unsnarl')
    parser.add_argument('--no-worse', action='store_true',
                        help='for partial results: no more intersecting pairs than in IN, instead of none')
    parser.add_argument('--quiet', action='store_true', help='say only what does not hold')
    options = parser.parse_args(arguments)
    try:
        before, after = read(options.input, options.format), read(options.output, options.format)
        if options.fixed:
            options.fixed = read_ids(options.fixed, len(before.positions))
        findings = Verification(before, after, options).findings
    except Unreadable as error:
        print(f'error: {error}', file=sys.stderr)
        return 3
    for name, holds, text in findings:
        if not holds or not options.quiet:
            print(f'{"holds" if holds else "BROKEN":7} {name:14} {text}')
    return 0 if all(holds for _, holds, _ in findings) else 1


if __name__ == '__main__':
    sys.exit(main())
