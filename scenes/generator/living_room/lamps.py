# SPDX-License-Identifier: Apache-2.0
"""Floor lamp, pendant lamps and wall sconces.

Each lamp's emitting faces have a material of its own, so that it is dimmed alone.
"""

from __future__ import annotations

import math

from ..rounded import disc, lathe
from ..shapes import box, tube
from ..solid import SceneObject
from .shell import GAP, SIZE

PENDANT_RIM = 1.52  # height of the opening, m


def floor_lamp() -> SceneObject:
    """Conical shade, open at both ends, over a drum-shaped bulb."""
    base = lathe([(0.0, GAP), (0.15, GAP), (0.15, 0.012), (0.14, 0.022), (0.014, 0.032),
                  (0.0, 0.032)], 16, "black metal")
    pole = tube([(0.0, 0.033, 0.0), (0.0, 1.40, 0.0)], 0.011, 8, "black metal")
    socket = disc(0.022, 1.401, 1.46, 8, "black metal")
    bulb = disc(0.05, 1.461, 1.52, 12, "floor lamp")
    shade = lathe([(0.235, 1.36), (0.24, 1.36), (0.15, 1.68), (0.145, 1.68)], 22, "lamp shade",
                  closed=True, crease=50.0)
    spokes = []
    for k in range(3):
        a = 2 * math.pi * k / 3
        c, s = math.cos(a), math.sin(a)
        spokes.append(tube([(0.023 * c, 1.43, 0.023 * s), (0.209 * c, 1.43, 0.209 * s)], 0.003, 4,
                           "black metal"))
    return SceneObject("floor lamp", [base, pole, socket, bulb, shade, *spokes])


def pendant_lamp(number: int) -> SceneObject:
    """Enamelled dome whose opening is a luminous disc; hung from the ceiling."""
    y = PENDANT_RIM
    inner = [(0.0, y + 0.155), (0.08, y + 0.147), (0.15, y + 0.092), (0.187, y)]
    outer = [(0.193, y), (0.156, y + 0.096), (0.083, y + 0.154), (0.03, y + 0.164),
             (0.024, y + 0.2), (0.0, y + 0.2)]
    dome = lathe(inner + outer, 20, "pendant enamel", crease=50.0,
                 bands={k: "pendant lining" for k in range(3)})
    name = f"pendant lamp {number}"
    bulb = disc(0.12, y + 0.045, y + 0.06, 16, "pendant lining", under=name)
    stem = tube([(0.0, y + 0.061, 0.0), (0.0, y + 0.15, 0.0)], 0.015, 6, "brass")
    ceiling = SIZE[1] - GAP
    cord = tube([(0.0, y + 0.201, 0.0), (0.0, ceiling - 0.031, 0.0)], 0.004, 4, "black metal")
    rose = disc(0.05, ceiling - 0.03, ceiling, 12, "pendant enamel")
    return SceneObject(name, [dome, bulb, stem, cord, rose])


def wall_sconce(number: int) -> SceneObject:
    """Upright cylinder that shines up and down along the wall; its back plate is at z = 0."""
    name = f"wall sconce {number}"
    low, high, recess = -0.11, 0.11, 0.025
    profile = [(0.0, low + recess), (0.048, low + recess), (0.048, low), (0.054, low),
               (0.054, high), (0.048, high), (0.048, high - recess), (0.0, high - recess)]
    body = lathe(profile, 16, "brass", bands={0: name, 6: name}).moved(z=0.095)
    plate = box((-0.04, -0.06, GAP), (0.04, 0.06, 0.013), "brass")
    arm = box((-0.012, -0.012, 0.014), (0.012, 0.012, 0.0405), "brass")
    return SceneObject(name, [plate, arm, body], movable=False)
