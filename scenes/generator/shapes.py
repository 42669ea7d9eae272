# SPDX-License-Identifier: Apache-2.0
"""Solids from boxes, outlines and paths. Every result is closed and looks outward."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from .solid import Solid, Vec, add, cross, mul, sub, unit

Point2 = tuple[float, float]


def box(low: Vec, high: Vec, material: str) -> Solid:
    """Axis-aligned box between two corners; faces in the order -x, +x, -y, +y, -z, +z."""
    points = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
              for z in (low[2], high[2])]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Solid(points, faces, material)


def outward(solid: Solid) -> Solid:
    """The solid with its faces reversed if they looked inward."""
    if solid.volume() > 0:
        return solid
    return replace(solid, faces=[face[::-1] for face in solid.faces])


def loft(rings: Sequence[Sequence[Vec]], material: str, start: Vec | None = None,
         end: Vec | None = None, closed: bool = False, crease: float = 40.0) -> Solid:
    """Skin over rings of equal length.

    The ends are capped by the ring itself (convex rings only), or drawn to the points `start` and
    `end`; a `closed` loft joins its last ring to the first instead.
    """
    size = len(rings[0])
    points = [p for ring in rings for p in ring]
    faces: list[tuple[int, ...]] = []
    count = len(rings)
    for i in range(count if closed else count - 1):
        lower, upper = i * size, (i + 1) % count * size
        for j in range(size):
            k = (j + 1) % size
            faces.append((lower + j, lower + k, upper + k, upper + j))
    if not closed:
        faces += _cap(points, list(range(size))[::-1], start)
        faces += _cap(points, list(range((count - 1) * size, count * size)), end)
    return outward(Solid(points, faces, material, crease))


def _cap(points: list[Vec], ring: list[int], tip: Vec | None) -> list[tuple[int, ...]]:
    if tip is None:
        return [tuple(ring)]
    points.append(tip)
    top = len(points) - 1
    return [(a, b, top) for a, b in zip(ring, ring[1:] + ring[:1])]


def prism(outline: Sequence[Point2], low: float, high: float, material: str,
          axis: str = "y") -> Solid:
    """Convex outline drawn out along an axis; outline coordinates are the two other axes in order
    (x, z), (y, z) or (x, y)."""
    place: dict[str, Callable[[Point2, float], Vec]] = {
        "x": lambda p, t: (t, p[0], p[1]),
        "y": lambda p, t: (p[0], t, p[1]),
        "z": lambda p, t: (p[0], p[1], t),
    }
    return loft([[place[axis](p, t) for p in outline] for t in (low, high)], material)


def tube(path: Sequence[Vec], radius: float | Sequence[float], sides: int, material: str) -> Solid:
    """Round bar along a path; one radius, or one for every point of the path."""
    radii = [radius] * len(path) if isinstance(radius, (int, float)) else list(radius)
    tangents = [unit(sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
                for i in range(len(path))]
    helper = (0.0, 0.0, 1.0) if abs(tangents[0][2]) < 0.9 else (1.0, 0.0, 0.0)
    rings = []
    for point, tangent, r in zip(path, tangents, radii):
        across = unit(cross(helper, tangent))
        helper = cross(tangent, across)  # carried along, so that the bar does not twist
        angles = [2 * math.pi * (j + 0.5) / sides for j in range(sides)]
        rings.append([add(point, add(mul(across, r * math.cos(a)), mul(helper, r * math.sin(a))))
                      for a in angles])
    return loft(rings, material, crease=80.0 if sides > 4 else 40.0)


def leg(foot: Vec, top: Vec, foot_size: float, top_size: float, material: str) -> Solid:
    """Square tapered leg with horizontal ends, between the centres of its ends."""
    def ring(centre: Vec, size: float) -> list[Vec]:
        h = size / 2
        return [add(centre, (x, 0.0, z)) for x, z in ((-h, -h), (h, -h), (h, h), (-h, h))]

    return loft([ring(foot, foot_size), ring(top, top_size)], material)


def moulding(path: Sequence[Point2], profile: Sequence[Point2], material: str,
             place: Callable[[float, float, float], Vec], closed: bool = False) -> Solid:
    """Convex profile drawn along a plane path with mitred corners.

    A profile point (a, b) lies `a` to the left of the path and `b` above its plane; `place` maps
    (path x, path y, height) to space.
    """
    rings = []
    for i, point in enumerate(path):
        mitre = _mitre(path, i, closed)
        rings.append([place(point[0] + mitre[0] * a, point[1] + mitre[1] * a, b)
                      for a, b in profile])
    return loft(rings, material, closed=closed)


def _mitre(path: Sequence[Point2], i: int, closed: bool) -> Point2:
    """Offset of a path's corner for a unit distance to the left of both its segments."""
    def left(a: Point2, b: Point2) -> Point2:
        d = math.dist(a, b)
        return (-(b[1] - a[1]) / d, (b[0] - a[0]) / d)

    last = len(path) - 1
    before = left(path[i - 1], path[i]) if i > 0 or closed else None
    after = left(path[i], path[(i + 1) % len(path)]) if i < last or closed else None
    n, m = before or after, after or before
    scale = 1.0 + n[0] * m[0] + n[1] * m[1]
    return ((n[0] + m[0]) / scale, (n[1] + m[1]) / scale)


def frame(low: Point2, high: Point2, profile: Sequence[Point2], material: str,
          place: Callable[[float, float, float], Vec]) -> Solid:
    """Mitred rectangular frame; the profile's first coordinate points into the opening."""
    path = [low, (high[0], low[1]), high, (low[0], high[1])]
    return moulding(path, profile, material, place, closed=True)


def sheet(grid: Sequence[Sequence[Vec]], thickness: float, material: str,
          crease: float = 60.0) -> Solid:
    """Cloth or bent board: a grid of points given a thickness to both sides."""
    rows, columns = len(grid), len(grid[0])

    def normal(i: int, j: int) -> Vec:
        u = sub(grid[min(i + 1, rows - 1)][j], grid[max(i - 1, 0)][j])
        v = sub(grid[i][min(j + 1, columns - 1)], grid[i][max(j - 1, 0)])
        return unit(cross(u, v))

    sides = [[add(grid[i][j], mul(normal(i, j), s * thickness / 2))
              for i in range(rows) for j in range(columns)] for s in (1, -1)]
    back = rows * columns
    faces: list[tuple[int, ...]] = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a = i * columns + j
            quad = (a, a + columns, a + columns + 1, a + 1)
            faces += [quad, tuple(k + back for k in quad[::-1])]
    rim = ([i * columns for i in range(rows)] +
           [(rows - 1) * columns + j for j in range(1, columns)] +
           [i * columns + columns - 1 for i in range(rows - 2, -1, -1)] +
           list(range(columns - 2, 0, -1)))
    faces += [(b, a, a + back, b + back) for a, b in zip(rim, rim[1:] + rim[:1])]
    return outward(Solid(sides[0] + sides[1], faces, material, crease))


def seated(solid: Solid, x: float | None = None, bottom: float | None = None,
           back: float | None = None) -> Solid:
    """Moved so that its middle is at x, its lowest point at `bottom`, its rearmost at `back`."""
    low = [min(p[k] for p in solid.points) for k in range(3)]
    high = [max(p[k] for p in solid.points) for k in range(3)]
    return solid.moved(0.0 if x is None else x - (low[0] + high[0]) / 2,
                       0.0 if bottom is None else bottom - low[1],
                       0.0 if back is None else back - low[2])
