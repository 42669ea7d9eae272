# SPDX-License-Identifier: Apache-2.0
"""Rug, television, pictures and the plant."""

from __future__ import annotations

import math
import random

from ..rounded import lathe, rounded_box
from ..shapes import box, frame, loft, tube
from ..solid import SceneObject, Solid, Vec, add, cross, mul, unit
from .shell import GAP

RUG_SIZE = (2.4, 0.012, 1.8)


def rug() -> SceneObject:
    """Woven rug; the pattern covers its top."""
    w, h, d = RUG_SIZE
    slab = box((-w / 2, GAP, -d / 2), (w / 2, GAP + h, d / 2), "cream wool")
    slab.face_materials[3] = "rug"
    return SceneObject("rug", [slab.textured(lambda p, _: (p[0] / w + 0.5, p[2] / d + 0.5))])


def television() -> SceneObject:
    """Flat screen on a wall bracket; the wall is at z = 0, the screen's middle at y = 0."""
    w, h = 0.68, 0.39
    body = rounded_box((-w, -h, 0.03), (w, h, 0.06), 0.008, "black metal")
    screen = box((-w + 0.012, -h + 0.016, 0.061), (w - 0.012, h - 0.012, 0.063), "television glass")
    bracket = box((-0.2, -0.15, GAP), (0.2, 0.15, 0.029), "black metal")
    return SceneObject("television", [body, screen, bracket], movable=False)


def picture(name: str, image: str, width: float, height: float, mount: float,
            wood: str) -> SceneObject:
    """Framed picture hung at z = 0: frame, mount (if any) and the picture itself."""
    profile = [(-0.032, 0.0), (0.0, 0.0), (0.0, 0.018), (-0.008, 0.024), (-0.032, 0.024)]
    x, y = width / 2 + mount, height / 2 + mount
    parts = [frame((-x, -y), (x, y), profile, wood, lambda u, v, h: (u, v, GAP + h))]
    gap = 0.0005
    if mount:
        parts.append(box((-x + gap, -y + gap, 0.002), (x - gap, y - gap, 0.008), "picture mount"))
    low = 0.009 if mount else 0.002
    w, h = (width / 2 - (0 if mount else gap), height / 2 - (0 if mount else gap))
    canvas = box((-w, -h, low), (w, h, low + 0.003), "picture mount")
    canvas.face_materials[5] = image
    parts.append(canvas.textured(lambda p, _: (p[0] / width + 0.5, 0.5 - p[1] / height)))
    return SceneObject(name, parts, movable=False)


def _leaf(base: Vec, heading: float, rise: float, size: float) -> Solid:
    """Broad pointed leaf that starts at `base`, rises at `rise` degrees and droops to its tip."""
    across = (-math.sin(heading), 0.0, math.cos(heading))
    stations = ((0.0, 0.012), (0.25, 0.2), (0.5, 0.24), (0.75, 0.16))
    point, rings, previous = base, [], 0.0
    angle = rise
    for t, half in stations:
        angle = rise - 75 * t
        point = add(point, mul(_direction(heading, angle), (t - previous) * size))
        previous = t
        up = unit(cross(across, _direction(heading, angle)))
        up = up if up[1] >= 0 else mul(up, -1.0)
        keel = mul(up, -0.12 * half * size)
        rings.append([add(point, mul(across, -half * size)), add(point, add(keel, mul(up, -0.004))),
                      add(point, mul(across, half * size)), add(point, keel)])
    tip = add(point, mul(_direction(heading, angle - 15), 0.25 * size))
    start = add(base, mul(_direction(heading, rise), -0.006))
    return loft(rings, "leaf", start, tip, crease=50.0)


def _direction(heading: float, rise: float) -> Vec:
    r = math.radians(rise)
    return (math.cos(heading) * math.cos(r), math.sin(r), math.sin(heading) * math.cos(r))


def plant() -> SceneObject:
    """Rubber fig in a glazed pot: stems with leaves in a spiral."""
    rng = random.Random(355)  # one of the few for which no leaf meets another
    pot = lathe([(0.0, GAP), (0.14, GAP), (0.165, 0.16), (0.18, 0.34), (0.19, 0.36), (0.175, 0.36),
                 (0.165, 0.32), (0.0, 0.325)], 18, "terracotta", bands={6: "soil"}, crease=35.0)
    parts = [pot]
    for k, (height, lean) in enumerate(((1.25, 0.1), (1.0, 0.22), (0.82, 0.26))):
        azimuth = 2 * math.pi * k / 3 + 0.5
        c, s = math.cos(azimuth), math.sin(azimuth)
        path = [((0.05 + lean * t * t) * c, 0.326 + (height - 0.326) * t,
                 (0.05 + lean * t * t) * s) for t in (0.0, 0.35, 0.7, 1.0)]
        parts.append(tube(path, [0.014, 0.012, 0.009, 0.005], 6, "stem"))
        parts += _foliage(path, 8 - k, rng)
    return SceneObject("plant", parts)


def _foliage(path: list[Vec], count: int, rng: random.Random) -> list[Solid]:
    """Leaves from the lower third of a stem to its top, 137.5 degrees apart."""
    leaves = []
    for i in range(count):
        t = 0.35 + 0.65 * i / (count - 1)
        segment = min(2, sum(t >= knot for knot in (0.35, 0.7)))
        knots = (0.0, 0.35, 0.7, 1.0)
        share = (t - knots[segment]) / (knots[segment + 1] - knots[segment])
        a, b = path[segment], path[segment + 1]
        centre = tuple(p + (q - p) * share for p, q in zip(a, b))
        heading = math.radians(137.5) * i + 0.6 * rng.random()
        base = add(centre, mul(_direction(heading, 30), 0.026))
        leaves.append(_leaf(base, heading, 35 + 30 * t, 0.3 + 0.08 * rng.random() - 0.08 * t))
    return leaves
