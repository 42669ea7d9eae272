# SPDX-License-Identifier: Apache-2.0
"""What stands on the floors: each thing is one mesh that many nodes use."""

from __future__ import annotations

import math

from ..rounded import cushion, lathe, rounded_box, sphere
from ..shapes import box, seated, tube
from ..solid import SceneObject, Solid, Vec, add


def _moved(solid: Solid, by: Vec) -> Solid:
    solid.points = [add(p, by) for p in solid.points]
    return solid


def _keyboard(x: float, z: float) -> list[Solid]:
    solids = [_moved(rounded_box((-0.22, 0, -0.07), (0.22, 0.014, 0.07), 0.005, "plastic"),
                     (x, 0.7405, z))]
    for row in range(3):
        for column in range(8):
            left, near = x - 0.21 + 0.053 * column, z - 0.062 + 0.042 * row
            solids.append(box((left, 0.7555, near), (left + 0.047, 0.761, near + 0.037), "keys"))
    return solids


def _monitor(x: float, z: float) -> list[Solid]:
    return [_moved(rounded_box((-0.3, 0, -0.02), (0.3, 0.36, 0.02), 0.01, "plastic"),
                   (x, 0.86, z)),
            box((x - 0.28, 0.88, z + 0.0205), (x + 0.28, 1.2, z + 0.022), "screen"),
            tube([(x, 0.75, z - 0.03), (x, 0.95, z - 0.03)], 0.02, 8, "metal"),
            _moved(lathe([(0.0, 0.0), (0.12, 0.0), (0.12, 0.008), (0.0, 0.008)], 12, "metal"),
                   (x, 0.741, z - 0.03))]


def _drawers(x: float, z: float) -> list[Solid]:
    solids = [rounded_box((x - 0.21, 0.03, z - 0.28), (x + 0.21, 0.58, z + 0.28), 0.01, "cabinet")]
    for k in range(3):
        low = 0.06 + 0.17 * k
        solids.append(box((x - 0.2, low, z + 0.281), (x + 0.2, low + 0.155, z + 0.3), "cabinet"))
        y = low + 0.12
        solids.append(tube([(x - 0.06, y, z + 0.3005), (x - 0.06, y, z + 0.33),
                            (x + 0.06, y, z + 0.33), (x + 0.06, y, z + 0.3005)], 0.004, 5, "metal"))
    return solids


def desk() -> SceneObject:
    """1.6 x 0.8 m, used from +z: with a monitor, a keyboard, drawers, a mug and papers."""
    solids = [rounded_box((-0.8, 0.7, -0.4), (0.8, 0.74, 0.4), 0.01, "desk")]
    for x in (-0.75, 0.75):
        for z in (-0.35, 0.35):
            solids.append(tube([(x, 0.0, z), (x, 0.699, z)], 0.025, 6, "metal"))
    solids += _monitor(0.0, -0.15) + _keyboard(0.0, 0.2) + _drawers(0.45, 0.0)
    solids.append(_moved(lathe([(0.0, 0.0), (0.035, 0.0), (0.04, 0.09), (0.036, 0.09),
                                (0.031, 0.006), (0.0, 0.006)], 10, "mug"), (-0.55, 0.741, 0.1)))
    for k in range(3):
        solids.append(box((-0.72, 0.7405 + 0.004 * k, -0.3), (-0.51, 0.7435 + 0.004 * k, -0.02),
                          "paper"))
    return SceneObject("desk", solids, movable=False)


def chair() -> SceneObject:
    """A swivel chair that looks to -z."""
    solids = [_moved(cushion((0.48, 0.08, 0.46), 0.03, 0.02, "fabric", divisions=3),
                     (0.0, 0.48, 0.0)),
              _moved(rounded_box((-0.22, 0.0, -0.03), (0.22, 0.5, 0.03), 0.025, "fabric", 1,
                                 (2, 2, 1)), (0.0, 0.6, 0.24)),
              tube([(0.0, 0.1, 0.0), (0.0, 0.43, 0.0)], [0.03, 0.022], 8, "metal"),
              tube([(0.0, 0.46, 0.2), (0.0, 0.52, 0.29), (0.0, 0.7, 0.29)], 0.018, 6, "metal")]
    for k in range(5):
        angle = 2 * math.pi * k / 5
        end = (0.3 * math.cos(angle), 0.07, 0.3 * math.sin(angle))
        inner = (0.035 * math.cos(angle), 0.09, 0.035 * math.sin(angle))
        solids.append(tube([inner, end], [0.02, 0.014], 5, "metal"))
        solids.append(_moved(sphere(0.026, 6, 4, "plastic"), (end[0], 0.027, end[2])))
    for x in (-0.27, 0.27):
        solids.append(tube([(x, 0.5, 0.18), (x, 0.68, 0.15), (x, 0.68, -0.12)], 0.015, 5,
                           "plastic"))
    return SceneObject("chair", solids)


def shelf() -> SceneObject:
    """1 x 0.35 x 1.9 m, filled with folders."""
    solids = [box((-0.5, 0.0, -0.17), (-0.48, 1.9, 0.17), "cabinet"),
              box((0.48, 0.0, -0.17), (0.5, 1.9, 0.17), "cabinet"),
              box((-0.479, 0.0, -0.17), (0.479, 1.9, -0.16), "cabinet")]
    for k in range(5):
        low = 0.05 + 0.37 * k
        solids.append(box((-0.479, low, -0.159), (0.479, low + 0.02, 0.17), "cabinet"))
        for n in range(11):
            left = -0.46 + 0.082 * n
            solids.append(box((left, low + 0.021, -0.15), (left + 0.07, low + 0.34, 0.13),
                              ("folder blue", "folder red", "paper")[(n + k) % 3]))
    return SceneObject("shelf", solids, movable=False)


def table() -> SceneObject:
    """A round table of 1.2 m with its foot."""
    top = [(0.0, 0.72), (0.59, 0.72), (0.6, 0.73), (0.6, 0.745), (0.59, 0.755), (0.0, 0.755)]
    foot = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.015), (0.05, 0.05), (0.04, 0.3), (0.04, 0.7),
            (0.0, 0.7)]
    return SceneObject("table", [lathe(top, 24, "desk"), lathe(foot, 16, "metal")], movable=False)


def door() -> SceneObject:
    """A leaf of 0.88 x 2.08 m; its hinge is the origin, and it reaches to +x."""
    solids = [seated(box((0.01, 0.01, -0.02), (0.89, 2.09, 0.02), "door"), bottom=0.01)]
    for z in (-0.021, 0.021):
        out = z + math.copysign(0.05, z)
        solids.append(tube([(0.82, 1.05, z), (0.82, 1.05, out), (0.71, 1.05, out)], 0.009, 6,
                           "metal"))
    return SceneObject("door", solids)
