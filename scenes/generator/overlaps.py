# SPDX-License-Identifier: Apache-2.0
"""Finds solids that run into each other: an edge of one pierces a face of the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .solid import SceneModel, SceneObject, Solid, Vec, cross, dot, sub

Triangle = tuple[Vec, Vec, Vec]
Bounds = tuple[Vec, Vec]


@dataclass
class _Placed:
    """World-space triangles of a solid."""

    name: str
    triangles: list[Triangle]
    bounds: Bounds


def _bounds(points: list[Vec] | Triangle) -> Bounds:
    return (tuple(map(min, zip(*points))), tuple(map(max, zip(*points))))


def _meet(a: Bounds, b: Bounds) -> bool:
    return all(a[0][k] <= b[1][k] and b[0][k] <= a[1][k] for k in range(3))


def _place(thing: SceneObject, index: int, solid: Solid) -> _Placed:
    c, s = math.cos(math.radians(thing.rotation_y)), math.sin(math.radians(thing.rotation_y))
    x, y, z = thing.translation
    points = [(c * p[0] + s * p[2] + x, p[1] + y, -s * p[0] + c * p[2] + z) for p in solid.points]
    triangles = [tuple(points[k] for k in corners) for _, corners in solid.triangles()]
    return _Placed(f"{thing.name}, solid {index} ({solid.material})", triangles, _bounds(points))


def _pierces(start: Vec, end: Vec, triangle: Triangle) -> bool:
    """Whether the segment crosses the triangle (Möller and Trumbore 1997)."""
    direction = sub(end, start)
    e1, e2 = sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0])
    p = cross(direction, e2)
    determinant = dot(e1, p)
    if abs(determinant) < 1e-15:
        return False
    offset = sub(start, triangle[0])
    u = dot(offset, p) / determinant
    if not 0 <= u <= 1:
        return False
    q = cross(offset, e1)
    v = dot(direction, q) / determinant
    return v >= 0 and u + v <= 1 and 0 <= dot(e2, q) / determinant <= 1


def _any_edge_pierces(edges_of: list[Triangle], faces_of: list[Triangle]) -> bool:
    faces = [(face, _bounds(face)) for face in faces_of]
    for triangle in edges_of:
        for k in range(3):
            start, end = triangle[k], triangle[(k + 1) % 3]
            reach = _bounds([start, end])
            if any(_meet(reach, bounds) and _pierces(start, end, face) for face, bounds in faces):
                return True
    return False


def _intersect(a: _Placed, b: _Placed) -> bool:
    near_b = [t for t in a.triangles if _meet(_bounds(t), b.bounds)]
    near_a = [t for t in b.triangles if _meet(_bounds(t), a.bounds)]
    return _any_edge_pierces(near_b, near_a) or _any_edge_pierces(near_a, near_b)


def _pairs(solids: list[_Placed]) -> Iterator[tuple[_Placed, _Placed]]:
    """Pairs whose boxes meet, by a sweep along x."""
    solids = sorted(solids, key=lambda s: s.bounds[0][0])
    active: list[_Placed] = []
    for solid in solids:
        active = [s for s in active if s.bounds[1][0] >= solid.bounds[0][0]]
        yield from ((s, solid) for s in active if _meet(s.bounds, solid.bounds))
        active.append(solid)


def check_overlaps(model: SceneModel) -> list[str]:
    """Names every pair of solids that intersect. Faces that only touch may be named as well."""
    solids = [_place(thing, i, solid) for thing in model.objects
              for i, solid in enumerate(thing.solids) if len(solid.faces) > 1]
    return [f"{a.name} runs into {b.name}" for a, b in _pairs(solids) if _intersect(a, b)]
