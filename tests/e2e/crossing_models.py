#!/usr/bin/env python3
"""Models that cross themselves, made here and as they are found: each fill rule and each outer hull gives a
closed mesh that --check proves free of self-intersections as it is written, and volumes that fit the
signed volume of the mesh on the engine's grid."""
import math

import support
from support import Fraction

RULES = ("nonzero", "positive", "evenodd")
HULLS = [f"{{orientation_sensitive = {o}, keep_voids = {v}}}" for o in ("false", "true") for v in ("false", "true")]
# A coordinate x is rounded to floor(x / step + this): ties never decide.
ROUNDING = Fraction(2049, 4096)


def prism(outline, height):
    """Over a polygon that may cross itself: fans of its middle are floor and lid."""
    n = len(outline)
    points = [(x, y, z) for z in (0, height) for x, y in outline] + [(0, 0, 0), (0, 0, height)]
    faces = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    faces += [((i + 1) % n, i, 2 * n) for i in range(n)] + [(n + i, n + (i + 1) % n, 2 * n + 1) for i in range(n)]
    return points, faces


def star(corners, step, height):
    at = [2 * math.pi * step * i / corners for i in range(corners)]
    return prism([(10 * math.cos(a), 10 * math.sin(a)) for a in at], height)


def tube(curve, rings, sides, radius):
    """Around a closed curve, by a frame that stays near the z axis."""
    points, faces = [], []
    for i in range(rings):
        p, q = curve(2 * math.pi * i / rings), curve(2 * math.pi * (i + 0.01) / rings)
        d = [b - a for a, b in zip(p, q)]
        length = math.hypot(*d)
        d = [x / length for x in d]
        side = [-d[1], d[0], 0]
        length = math.hypot(*side)
        side = [x / length for x in side]
        up = [d[1] * side[2] - d[2] * side[1], d[2] * side[0] - d[0] * side[2], d[0] * side[1] - d[1] * side[0]]
        for j in range(sides):
            c, s = (radius * f(2 * math.pi * j / sides) for f in (math.cos, math.sin))
            points.append(tuple(p[k] + c * side[k] + s * up[k] for k in range(3)))
    for i in range(rings):
        for j in range(sides):
            k, l = (i + 1) % rings * sides, (j + 1) % sides
            faces.append((i * sides + j, i * sides + l, k + l, k + j))
    return points, faces


def trefoil(t):
    return (10 * math.sin(t) + 20 * math.sin(2 * t), 10 * math.cos(t) - 20 * math.cos(2 * t), -10 * math.sin(3 * t))


def eight(t):
    return (30 * math.sin(t), 15 * math.sin(2 * t) + 3, 3 * math.cos(t))


def ball(rows, sides, radius):
    """A sphere whose radius may be negative: the surface passes through the middle, turned inside out."""
    points = [(0, 0, radius(0, 0)), (0, 0, -radius(0, math.pi))]
    for i in range(1, rows):
        for j in range(sides):
            a, b = 2 * math.pi * j / sides, math.pi * i / rows
            r = radius(a, b)
            points.append((r * math.cos(a) * math.sin(b), r * math.sin(a) * math.sin(b), r * math.cos(b)))
    ring = [[2 + i * sides + j for j in range(sides)] for i in range(rows - 1)]
    faces = [(0, ring[0][j], ring[0][(j + 1) % sides]) for j in range(sides)]
    faces += [(1, ring[-1][(j + 1) % sides], ring[-1][j]) for j in range(sides)]
    for upper, lower in zip(ring, ring[1:]):
        faces += [(upper[j], lower[j], lower[(j + 1) % sides], upper[(j + 1) % sides]) for j in range(sides)]
    return points, faces


def together(*meshes):
    points, faces = [], []
    for more, over in meshes:
        faces += [tuple(i + len(points) for i in f) for f in over]
        points += more
    return points, faces


def moved(mesh, x, y, z):
    return [(p[0] + x, p[1] + y, p[2] + z) for p in mesh[0]], mesh[1]


def inside_out(mesh):
    return mesh[0], [f[::-1] for f in mesh[1]]


def ring(t):
    return (20 * math.cos(t), 20 * math.sin(t), 0.001)


RINGS = together(tube(ring, 24, 8, 4), moved(tube(ring, 24, 8, 4), 20, 1, 2), moved(tube(ring, 24, 8, 4), 9, 17, -1))
MADE = {
    "star_5_2": star(5, 2, 4), "star_7_2": star(7, 2, 9), "star_8_3": together(star(8, 3, 5)),
    "trefoil": tube(trefoil, 60, 8, 9), "eight": tube(eight, 40, 10, 5), "rings": RINGS,
    "turned_through": ball(10, 16, lambda a, b: 10 + 14 * math.cos(2 * a) * math.sin(b)),
    "spiky": ball(9, 14, lambda a, b: 10 + 11 * math.sin(5 * a) * math.sin(b) ** 2),
    "half_inside_out": together(tube(ring, 24, 8, 4), inside_out(moved(tube(ring, 24, 8, 4), 3, 1, 2))),
    "nested": together(ball(6, 9, lambda a, b: 20), inside_out(ball(6, 9, lambda a, b: 12)),
                       ball(6, 9, lambda a, b: 13)),
}
FOUND = ("c3_cow.obj", "mf_self_intersectA.obj", "mf_self_intersectB.obj")


def write_off(path, points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *(" ".join(repr(float(x)) for x in p) for p in points),
             *(" ".join(map(str, (len(f), *f))) for f in faces)]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def read_obj(path):
    words = [line.split() for line in path.read_text(errors="replace").splitlines()]
    return ([tuple(map(float, w[1:4])) for w in words if w[:1] == ["v"]],
            [[int(n.split("/")[0]) - 1 for n in w[1:]] for w in words if w[:1] == ["f"]])


class CrossingModels(support.Case):
    def volume(self, path, call):
        """Of a part that is closed, proved and clean as it is written and read again."""
        text = f"local m = function(fill) return import({str(path)!r}, {{fill = fill}}) end\nreturn {call}"
        found = self.script(text, "--check", "-o", self.folder / "out.stl")
        (part,) = found["parts"]
        self.assertTrue(part["closed"], (path, call))
        verdict = found["check"][0]["parts"][0]["verdict"]
        self.assertIn(verdict, ("clean", "repaired"), (path, call))
        written = self.info(self.folder / "out.stl")
        self.assertEqual(written["self_intersections"], 0, (path, call))
        self.assertTrue(written["parts"][0]["closed"], (path, call))
        if verdict == "clean":  # a repaired mesh may be off by more near what was wrong
            extent = max(abs(x) for corner in part["bbox"] for x in corner)
            self.assertLessEqual(abs(written["parts"][0]["volume"] - part["volume"]),
                                 part["area"] * extent * 2.0**-23, (path, call))
        self.grid = Fraction(str(found["grid_mm"]))
        return part["volume"]

    def volumes(self, path):
        by_rule = {rule: self.volume(path, f"m('{rule}')") for rule in RULES}
        by_hull = [self.volume(path, f"outer_hull(m(), {hull})") for hull in HULLS]
        slack = 1e-12 * by_rule["nonzero"]
        self.assertLessEqual(by_rule["positive"], by_rule["nonzero"] + slack, path)
        self.assertLessEqual(by_rule["evenodd"], by_rule["nonzero"] + slack, path)
        # Without voids a hull has more than with them, and more than what is inside by any winding number.
        self.assertGreaterEqual(by_hull[0] + slack, max(by_hull[1], by_rule["nonzero"]), path)
        self.assertGreaterEqual(by_hull[2] + slack, by_hull[3], path)
        self.assertGreaterEqual(by_hull[0] + slack, by_hull[2], path)
        return by_rule, by_hull

    def signed(self, points, faces):
        """Of the mesh on the grid; faces of more than three corners as fans from their first."""
        p = [[math.floor(Fraction(x) / self.grid + ROUNDING) for x in point] for point in points]
        total = 0
        for f in faces:
            for i in range(1, len(f) - 1):
                a, b, c = p[f[0]], p[f[i]], p[f[i + 1]]
                total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]))
        return float(total * self.grid**3 / 6)

    def assert_fits(self, path, points, faces):
        """With winding numbers from -1 to 2 only: two of the rules give the signed volume."""
        by_rule, _ = self.volumes(path)
        self.assert_relative(2 * by_rule["positive"] - by_rule["evenodd"], self.signed(points, faces), 1e-12, path)

    def test_made(self):
        for name, (points, faces) in MADE.items():
            with self.subTest(name):
                path = self.folder / f"{name}.off"
                # Triangles: what is between bent corners of a quadrilateral would be for the engine to say.
                triangles = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
                write_off(path, points, triangles)
                self.assertGreater(self.info(path)["self_intersections"] + (name == "nested"), 0)
                if name in ("star_8_3", "rings", "turned_through"):
                    self.volumes(path)  # three times around, or minus twice
                else:
                    self.assert_fits(path, points, triangles)

    def test_components_are_united(self):
        """The three rings in one file are what they are as three operands."""
        points, faces = MADE["rings"]
        a_third = len(points) // 3
        for i in range(3):
            write_off(self.folder / f"ring{i}.off", points[i * a_third:(i + 1) * a_third], faces[:len(faces) // 3])
        write_off(self.folder / "rings.off", points, faces)
        rings = ", ".join(f"import({str(self.folder / f'ring{i}.off')!r})" for i in range(3))
        self.assertEqual(self.volume(self.folder / "rings.off", "m('nonzero')"),
                         self.volume(self.folder / "rings.off", f"union({rings})"))
        self.assertEqual(self.volume(self.folder / "rings.off", "m('evenodd')"),
                         self.volume(self.folder / "rings.off", f"symmetric_difference({rings})"))

    @support.needs_shared("meshes")
    def test_found(self):
        for name in FOUND:
            with self.subTest(name):
                path = self.folder / name  # where a script may read it
                path.write_bytes((support.SHARED / "meshes" / name).read_bytes())
                self.assert_fits(path, *read_obj(path))


if __name__ == "__main__":
    support.main()
