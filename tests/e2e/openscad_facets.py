#!/usr/bin/env python3
"""Numbers of facets and places of vertices, against OpenSCAD's formulas for $fn, $fa and $fs, over a table of cases:
spheres, cylinders, circles, extrusions with twist and scale, turned outlines. Each is given as a tree, and as a script.
"""
import itertools
import math

import csg_to_lua
import support

FACETS = ((0, 12, 2), (0, 12, 0.5), (0, 5, 2), (0, 30, 0.01), (3, 12, 2), (4.2, 12, 2), (5, 1, 1), (8, 12, 2), (17, 12, 2))


def fragments(r, facets, angle=360.0):
    fn, fa, fs = facets
    if fn > 0:
        count = math.ceil(max(fn, 3)) * abs(angle) / 360
    else:
        count = math.ceil(max(min(360 / fa, 2 * math.pi * r / fs), 5)) * abs(angle) / 360
    return max(1, math.ceil(count))


def turned(x, y, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return x * c - y * s, x * s + y * c


def ring(r, n, z):
    return [(*turned(r, 0, 360 * k / n), z) for k in range(n)]


def sphere(r, facets):
    n = fragments(r, facets)
    rings = (n + 1) // 2
    angles = [math.radians(180 * (i + 0.5) / rings) for i in range(rings)]
    return [p for phi in angles for p in ring(r * math.sin(phi), n, r * math.cos(phi))]


def cylinder(h, r1, r2, facets):
    n = fragments(max(r1, r2), facets)
    return ring(r1, n, 0) + ring(r2, n, h)


def helix(height, twist, radius, facets, scale=1.0):
    """Slices of a twisted extrusion with the same scale along both axes."""
    fn, fa, fs = facets
    least = max(math.ceil(abs(twist) / 120), 1)
    if fn > 0:
        return max(math.ceil(abs(twist) / 360 * fn), least)
    t = math.radians(abs(twist))
    if scale == 1:
        length = t * math.sqrt(radius ** 2 + (height / t) ** 2)
    else:
        end = t * scale / (scale - 1) if scale > 1 else t / (1 - scale)
        f = lambda angle: radius / end / 2 * (angle * math.sqrt(1 + angle ** 2) + math.asinh(angle))
        length = math.hypot(f(end) - f(end - t), height)  # along Archimedes' spiral
    return max(min(math.ceil(abs(twist) / fa), math.ceil(length / fs)), least)


def slices(outline, height, twist, scale, facets):
    fn, _, fs = facets
    radius = max(math.hypot(x, y) for x, y in outline)
    uneven = scale[0] != scale[1]
    diagonal = 1
    if uneven:
        move = max(math.hypot(x * (1 - scale[0]), y * (1 - scale[1])) for x, y in outline)
        diagonal = max(math.floor(fn), 1) if fn > 0 else max(math.ceil(math.hypot(move, height) / fs), 1)
    if twist == 0:
        return diagonal
    if uneven:
        return max(diagonal, helix(height, twist, radius, facets))
    return helix(height, twist, radius, facets, scale[0])


def linear_extrude(outline, height, twist, scale, facets):
    n = slices(outline, height, twist, scale, facets)
    points = []
    for i in range(n + 1):
        for x, y in outline:
            a, b = turned(x, y, -twist * i / n)
            points.append((a * (1 - (1 - scale[0]) * i / n), b * (1 - (1 - scale[1]) * i / n), height * i / n))
    return points


def rotate_extrude(outline, angle, start, facets):
    n = fragments(max(abs(x) for x, _ in outline), facets, angle)
    steps = n if angle == 360 else n + 1
    return [(*turned(x, 0, start + angle * j / n), y) for j in range(steps) for x, y in outline]


def edges_of_ends(outline, angle, start):
    """The edges of caps that are cut, docs/decisions/0123: a facet that the grid made bent has a corner on one."""
    ends = [a for a in (start, start + angle) if angle != 360 and a % 90 != 0]
    return [tuple((*turned(x, 0, a), y) for x, y in edge) for a in ends for edge in zip(outline, outline[1:] + outline[:1])]


def distance_from_edge(p, edge):
    a, b = edge
    along = sum((q - s) * (t - s) for q, s, t in zip(p, a, b)) / math.dist(a, b) ** 2
    return math.dist(p, tuple(s + along * (t - s) for s, t in zip(a, b))) if 0 <= along <= 1 else math.inf


# No edge of it lies along an axis, and no scale makes its walls flat.
OUTLINE = [(5, 1), (-1, 4), (-3, -2)]
PROFILE = [(4, 0), (9, 1), (6, 5)]


def text_of(facets):
    return "$fn = {:g}, $fa = {:g}, $fs = {:g}".format(*facets)


def polygon(points):
    return f"polygon(points = {[list(p) for p in points]}, paths = undef, convexity = 1);"


def cases():
    """A tree, the vertices that it must have, and edges on each of which there may be one more."""
    for tree, points in solids_of_formulas():
        yield tree, points, []
    for facets, (angle, start) in itertools.product(FACETS, ((360, 180), (360, 0), (90, 0), (-45, 10), (200, -30))):
        tree = (f"rotate_extrude(angle = {angle}, start = {start}, convexity = 2, {text_of(facets)}) "
                f"{{ {polygon(PROFILE)} }}")
        yield tree, rotate_extrude(PROFILE, angle, start, facets), edges_of_ends(PROFILE, angle, start)


def solids_of_formulas():
    for facets, r in itertools.product(FACETS, (0.5, 1, 7.25)):
        yield f"sphere({text_of(facets)}, r = {r});", sphere(r, facets)
        circle = [(x, y, z) for z in (0, 2) for x, y, _ in ring(r, fragments(r, facets), 0)]
        yield f"linear_extrude(height = 2, {text_of(facets)}) {{ circle({text_of(facets)}, r = {r}); }}", circle
        for r1, r2 in ((r, r), (r, r / 2), (0, r), (r, 0)):
            yield (f"cylinder({text_of(facets)}, h = 3, r1 = {r1}, r2 = {r2}, center = false);",
                   cylinder(3, r1, r2, facets))
    for facets, twist, scale in itertools.product(FACETS, (30, -90, 400), ((1, 1), (0.5, 0.5), (2, 2))):
        tree = (f"linear_extrude(height = 6, twist = {twist}, segments = 0, scale = [{scale[0]}, {scale[1]}], "
                f"{text_of(facets)}) {{ {polygon(OUTLINE)} }}")
        yield tree, linear_extrude(OUTLINE, 6, twist, scale, facets)
    for facets, twist in itertools.product(FACETS, (0, 30)):
        tree = (f"linear_extrude(height = 6, twist = {twist}, segments = 0, scale = [2, 0.5], {text_of(facets)}) "
                f"{{ {polygon(OUTLINE)} }}")
        yield tree, linear_extrude(OUTLINE, 6, twist, (2, 0.5), facets)


class Facets(support.Case):

    def points_of(self, model):
        """One run writes it; the vertices of the file are those of the solid."""
        self.csgrun(model, "-q", "-o", self.folder / "x.off")
        return support.read_off(self.folder / "x.off").points

    def test_table(self):
        tried = 0
        for tree, expected, edges in cases():
            with self.subTest(tree):
                path = self.folder / "x.csg"
                path.write_text(tree + "\n")
                points = sorted(self.points_of(path))
                script = self.folder / "x.lua"
                script.write_text(csg_to_lua.translate(tree))
                self.assertEqual(sorted(self.points_of(script)), points)
                wanted = {tuple(round(c, 6) + 0.0 for c in p) for p in expected}  # an apex is one
                more = list(edges)
                rest = list(points)
                for p in sorted(wanted):
                    best = min(range(len(rest)), key=lambda i: math.dist(p, rest[i]))
                    self.assertLess(math.dist(p, rest[best]), 3e-6, f"no vertex is at {p}, where the formula has one")
                    del rest[best]
                for p in rest:
                    edge = min(more, key=lambda e: distance_from_edge(p, e), default=None)
                    self.assertIsNotNone(edge, f"{p} is not among the places of the formula")
                    self.assertLess(distance_from_edge(p, edge), 3e-6, f"{p} is not among the places of the formula")
                    more.remove(edge)
                tried += 1
        self.assertGreater(tried, 300)


if __name__ == "__main__":
    support.main()
