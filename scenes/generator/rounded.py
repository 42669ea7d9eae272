# SPDX-License-Identifier: Apache-2.0
"""Solids with round edges: bevelled boxes, cushions, surfaces of revolution."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .shapes import Point2
from .solid import Solid, Vec, length, mul

BEVEL_STEP = math.tan(math.radians(22.5))


def _axis_steps(half: float, radius: float, steps: int, divisions: int) -> list[Point2]:
    """(position on the inner box, component of the bevel's direction) along one axis."""
    inner = half - radius
    slopes = [0.0, 1.0] if steps == 1 else [0.0, BEVEL_STEP, 1.0]
    flat = [(-inner + 2 * inner * k / divisions, 0.0) for k in range(1, divisions)]
    return ([(-inner, -s) for s in reversed(slopes)] + flat + [(inner, s) for s in slopes])


def rounded_box(low: Vec, high: Vec, radius: float, material: str, steps: int = 1,
                divisions: Vec = (1, 1, 1)) -> Solid:
    """Box with round edges and corners: `steps` facets (1 or 2) on each side of an edge's middle;
    flat parts divided as often as `divisions` says along x, y, z."""
    half = [(h - l) / 2 for l, h in zip(low, high)]
    centre = [(h + l) / 2 for l, h in zip(low, high)]
    if radius >= min(half):
        raise ValueError("rounded_box: radius must be less than half the smallest edge")
    axes = [_axis_steps(half[k], radius, steps, int(divisions[k])) for k in range(3)]
    points: dict[Vec, int] = {}
    faces = []

    def vertex(axis: int, sign: int, u: Point2, v: Point2) -> int:
        base, slope = [0.0] * 3, [0.0] * 3
        base[axis], slope[axis] = sign * (half[axis] - radius), float(sign)
        for k, step in (((axis + 1) % 3, u), ((axis + 2) % 3, v)):
            base[k], slope[k] = step
        offset = mul(tuple(slope), radius / length(tuple(slope)))
        point = tuple(round(centre[k] + base[k] + offset[k], 6) for k in range(3))
        return points.setdefault(point, len(points))

    for axis in range(3):
        us, vs = axes[(axis + 1) % 3], axes[(axis + 2) % 3]
        for sign in (-1, 1):
            for u0, u1 in zip(us, us[1:]):
                for v0, v1 in zip(vs, vs[1:]):
                    quad = tuple(vertex(axis, sign, u, v)
                                 for u, v in ((u0, v0), (u1, v0), (u1, v1), (u0, v1)))
                    faces.append(quad if sign > 0 else quad[::-1])
    return Solid(list(points), faces, material, crease=60.0)


def cushion(size: Vec, radius: float, bulge: float, material: str, both_sides: bool = False,
            divisions: int = 3) -> Solid:
    """Cushion centred on the origin, thick along y, bulging by `bulge` at the middle of its top
    (and bottom, if `both_sides`); its corners are pinched as those of a filled cover are."""
    half = mul(size, 0.5)
    plain = rounded_box(mul(half, -1.0), half, radius, material, 1, (divisions, 1, divisions))

    def fill(p: Vec) -> Vec:
        u, v = p[0] / half[0], p[2] / half[2]
        swell = bulge * (1 - u * u) * (1 - v * v)
        y = p[1]
        if y > 0:
            y += swell
        elif both_sides:
            y -= swell
        waist = 1.0 - 0.06 * (1 - min(u * u, v * v)) if both_sides else 1.0
        return (p[0] * waist, y, p[2] * waist)

    return plain.mapped(fill)


def lathe(profile: Sequence[Point2], segments: int, material: str, closed: bool = False,
          bands: dict[int, str] | None = None, crease: float = 40.0) -> Solid:
    """Surface of revolution about the y axis from points (radius, height).

    An open profile starts and ends on the axis; a closed one is a ring. The profile runs upward on
    the outside. `bands` gives other materials to some of the profile's segments.
    """
    points: list[Vec] = []
    rings: list[list[int]] = []
    for r, y in profile:
        if r == 0.0:
            rings.append([len(points)] * segments)
            points.append((0.0, y, 0.0))
            continue
        rings.append(list(range(len(points), len(points) + segments)))
        angles = [2 * math.pi * j / segments for j in range(segments)]
        points += [(r * math.cos(a), y, r * math.sin(a)) for a in angles]
    faces: list[tuple[int, ...]] = []
    materials: dict[int, str] = {}
    pairs = list(zip(rings, rings[1:] + (rings[:1] if closed else [])))
    for band, (lower, upper) in enumerate(pairs):
        for j in range(segments):
            k = (j + 1) % segments
            corners = tuple(dict.fromkeys((lower[j], upper[j], upper[k], lower[k])))
            if bands and band in bands:
                materials[len(faces)] = bands[band]
            faces.append(corners)
    return Solid(points, faces, material, crease, face_materials=materials)


def sphere(radius: float, segments: int, rings: int, material: str) -> Solid:
    """Sphere centred on the origin."""
    angles = [-math.pi / 2 + math.pi * i / rings for i in range(1, rings)]
    middle = [(radius * math.cos(a), radius * math.sin(a)) for a in angles]
    return lathe([(0.0, -radius), *middle, (0.0, radius)], segments, material, crease=80.0)


def disc(radius: float, low: float, high: float, segments: int, material: str,
         under: str | None = None) -> Solid:
    """Flat round plate; its lower face may be of another material (a luminaire's opening)."""
    profile = [(0.0, low), (radius, low), (radius, high), (0.0, high)]
    return lathe(profile, segments, material, bands={0: under} if under else None)
