# SPDX-License-Identifier: Apache-2.0
"""The window and what belongs to it: frame, sashes, sill, radiator, pelmet, curtains."""

from __future__ import annotations

import math

from ..rounded import rounded_box
from ..shapes import box, frame, prism, sheet, tube
from ..solid import SceneObject, Solid
from .shell import GAP, WINDOW_Y, WINDOW_Z

SASHES = 3


def _in_wall(z: float, y: float, x: float) -> tuple[float, float, float]:
    return (x, y, z)


def _bar(width: float, low: float, high: float) -> list[tuple[float, float]]:
    """Profile of a bar: `width` into the opening, from x = low to x = high, edge softened."""
    return [(0.0, low), (width, low), (width, high - 0.008), (width - 0.008, high), (0.0, high)]


def window() -> SceneObject:
    """Fixed frame with mullions, three sashes that overlap it, handles, and a sill; no glass."""
    low = (WINDOW_Z[0] + GAP, WINDOW_Y[0] + GAP)
    high = (WINDOW_Z[1] - GAP, WINDOW_Y[1] - GAP)
    bar, overlap = 0.06, 0.015
    parts = [frame(low, high, _bar(bar, -0.22, -0.17), "white woodwork", _in_wall)]
    z_start, z_end = low[0] + bar - overlap, high[0] - bar + overlap
    width = (z_end - z_start) / SASHES
    bottom, top = low[1] + bar, high[1] - bar
    for i in range(SASHES):
        z0, z1 = z_start + i * width + 0.001, z_start + (i + 1) * width - 0.001
        parts.append(frame((z0, bottom - overlap), (z1, top + overlap), _bar(0.055, -0.168, -0.11),
                           "white woodwork", _in_wall))
        if i < SASHES - 1:
            parts.append(box((-0.22, bottom + GAP, z1 - 0.025), (-0.17, top - GAP, z1 + 0.027),
                             "white woodwork"))
            parts.append(_handle(z1 - 0.028))
    parts.append(rounded_box((-0.108, WINDOW_Y[0] + GAP, WINDOW_Z[0] + 2 * GAP),
                             (0.06, WINDOW_Y[0] + 0.03, WINDOW_Z[1] - 2 * GAP), 0.006, "oak"))
    return SceneObject("window", parts, movable=False)


def _handle(z: float) -> Solid:
    path = [(-0.109, 1.5, z), (-0.085, 1.5, z), (-0.08, 1.485, z), (-0.08, 1.39, z)]
    return tube(path, 0.007, 6, "brass")


def radiator() -> SceneObject:
    """Column radiator: a folded panel between two headers, on two feet."""
    x, z0, z1, folds = 0.075, 1.5, 3.5, 14
    columns = [z0 + (z1 - z0) * i / (2 * folds) for i in range(2 * folds + 1)]
    grid = [[(x + (0.014 if i % 2 else -0.014), y, z) for y in (0.15, 0.64)]
            for i, z in enumerate(columns)]
    parts = [sheet(grid, 0.03, "radiator enamel", crease=20.0)]
    for y0 in (0.115, 0.642):
        parts.append(rounded_box((0.04, y0, z0), (0.11, y0 + 0.033, z1), 0.01, "radiator enamel"))
    for z in (1.7, 3.3):
        parts.append(tube([(x, GAP, z), (x, 0.114, z)], 0.014, 8, "radiator enamel"))
    return SceneObject("radiator", parts, movable=False)


def pelmet() -> SceneObject:
    """Board above the window that hides the heads of the curtains: an upturned L in section."""
    z0, z1 = 0.42, 4.58
    top = prism([(2.60, z0), (2.60, z1), (2.618, z1), (2.618, z0)], 0.002, 0.171, "oak", axis="x")
    front = prism([(2.47, z0), (2.47, z1), (2.618, z1), (2.618, z0)], 0.172, 0.19, "oak", axis="x")
    return SceneObject("pelmet", [top, front], movable=False)


def _curtain(z0: float, z1: float, phase: float) -> Solid:
    """Linen in deep folds, which open a little towards the hem."""
    folds, per_fold, levels = 5, 5, (0.012, 1.2, 2.597)
    count = folds * per_fold
    grid = []
    for i in range(count + 1):
        t = i / count
        column = []
        for y in levels:
            drop = 1.0 - y / levels[-1]
            angle = 2 * math.pi * (folds * t + phase)
            depth = 0.032 + 0.012 * drop
            sway = 0.012 * drop * math.sin(3.1 * angle / folds)
            column.append((0.098 + depth * math.sin(angle), y,
                           z0 + (z1 - z0) * t + sway * (1 - t) * t * 4))
        grid.append(column)
    return sheet(grid, 0.004, "curtain linen", crease=75.0)


def curtains() -> SceneObject:
    return SceneObject("curtains", [_curtain(0.5, 1.13, 0.0), _curtain(3.87, 4.5, 0.35)],
                       movable=False)
