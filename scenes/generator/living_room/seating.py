# SPDX-License-Identifier: Apache-2.0
"""Sofa, armchair, dining chairs and bench."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..rounded import cushion, rounded_box
from ..shapes import box, leg, loft, seated, sheet
from ..solid import SceneObject, Solid, add
from .shell import GAP


@dataclass(frozen=True)
class Couch:
    """Measures of an upholstered seat, metres."""

    seats: int
    seat_width: float
    arm_width: float
    depth: float
    foot_height: float
    arm_height: float
    back_height: float
    fabric: str
    cushion_fabric: str

    @property
    def half_inner(self) -> float:
        return self.seats * self.seat_width / 2 + 0.003

    @property
    def seat_height(self) -> float:
        """Top of the frame, on which the seat cushions lie."""
        return self.foot_height + 0.19


SOFA = Couch(3, 0.6, 0.17, 0.94, 0.11, 0.6, 0.8, "sofa fabric", "sofa cushion fabric")
ARMCHAIR = Couch(1, 0.6, 0.12, 0.84, 0.15, 0.58, 0.82, "armchair fabric",
                 "armchair cushion fabric")
BACK_THICKNESS = 0.2


def _frame(couch: Couch) -> list[Solid]:
    """Base, back and arms, 2 mm apart so that they share no face."""
    w, back = couch.half_inner, -couch.depth / 2
    front, low = couch.depth / 2, couch.foot_height
    parts = [
        rounded_box((-w, low, back + 0.02), (w, couch.seat_height, front - 0.03), 0.03,
                    couch.fabric),
        rounded_box((-w, couch.seat_height + 0.002, back), (w, couch.back_height,
                    back + BACK_THICKNESS), 0.05, couch.fabric),
    ]
    for side in (-1, 1):
        x0, x1 = sorted((side * (w + 0.002), side * (w + couch.arm_width)))
        parts.append(rounded_box((x0, low, back + 0.01), (x1, couch.arm_height, front), 0.045,
                                 couch.fabric))
    return parts


def _cushions(couch: Couch) -> list[Solid]:
    parts = []
    rear, front = -couch.depth / 2 + BACK_THICKNESS + 0.002, couch.depth / 2 - 0.005
    seat_top = couch.seat_height + 0.002 + 0.155
    for i in range(couch.seats):
        x = (i - (couch.seats - 1) / 2) * couch.seat_width
        seat = cushion((couch.seat_width - 0.008, 0.155, front - rear), 0.045, 0.02,
                       couch.cushion_fabric, divisions=2)
        parts.append(seat.moved(x, seat_top - 0.0775, (front + rear) / 2))
        rest = cushion((couch.seat_width - 0.016, 0.14, 0.4), 0.05, 0.035, couch.cushion_fabric,
                       divisions=2)
        rest = rest.turned("x", 90 - 10)
        parts.append(seated(rest, x, seat_top + 0.018, rear + 0.003))
    return parts


def _feet(couch: Couch) -> list[Solid]:
    x, z = couch.half_inner + couch.arm_width - 0.09, couch.depth / 2 - 0.09
    return [leg((sx * (x + 0.015), GAP, sz * (z + 0.015)),
                (sx * x, couch.foot_height - GAP, sz * z), 0.028, 0.045, "walnut") for sx in (-1, 1) for sz in (-1, 1)]


def _pillow(size: float, fabric: str, x: float, turn: float, couch: Couch) -> Solid:
    """Scatter cushion that leans against the back cushions."""
    solid = cushion((size, 0.05, size), 0.02, 0.05, fabric, both_sides=True, divisions=2)
    solid = solid.turned("x", 90 - 22).turned("y", turn)
    rear = -couch.depth / 2 + BACK_THICKNESS + 0.21
    return seated(solid, x, couch.seat_height + 0.182, rear)


def _throw(couch: Couch) -> Solid:
    """Blanket over the right arm: down the outside, over the top, and inside onto the seat."""
    x0 = couch.half_inner
    x1, top = x0 + couch.arm_width, couch.arm_height
    r, gap = 0.045, 0.007
    section = [(x1 + gap, top - 0.34), (x1 + gap, top - r)]
    section += [(x1 - r + (r + gap) * math.cos(a), top - r + (r + gap) * math.sin(a))
                for a in (math.pi / 6, math.pi / 3, math.pi / 2)]
    section += [(x0 + r + (r + gap) * math.cos(a), top - r + (r + gap) * math.sin(a))
                for a in (math.pi / 2, 2 * math.pi / 3, 5 * math.pi / 6)]
    section += [(x0 - gap + 0.002, top - r)]
    across = [0.02 + 0.11 * k for k in range(4)]
    grid = [[(x + 0.003 * math.sin(9 * k + 4 * y), y, z) for k, z in enumerate(across)]
            for x, y in section]
    return sheet(grid, 0.006, "mustard wool")


def sofa() -> SceneObject:
    pillows = [_pillow(0.44, "rust wool", -0.66, 14, SOFA),
               _pillow(0.42, "mustard wool", -0.18, -10, SOFA),
               _pillow(0.44, "cream wool", 0.62, -14, SOFA)]
    return SceneObject("sofa", [*_frame(SOFA), *_cushions(SOFA), *_feet(SOFA), *pillows,
                                _throw(SOFA)])


def armchair() -> SceneObject:
    pillow = _pillow(0.4, "cream wool", 0.02, 6, ARMCHAIR)
    return SceneObject("armchair", [*_frame(ARMCHAIR), *_cushions(ARMCHAIR), *_feet(ARMCHAIR),
                                    pillow])


def _back_post(x: float) -> Solid:
    """Rear leg that goes on upward, leaning back, to hold the back rest."""
    stations = [(GAP, -0.235, 0.024), (0.43, -0.19, 0.034), (0.62, -0.2, 0.03),
                (0.86, -0.255, 0.022)]
    rings = [[add((x, y, z), (dx * s / 2, 0.0, dz * s / 2))
              for dx, dz in ((-1, -1), (1, -1), (1, 1), (-1, 1))] for y, z, s in stations]
    return loft(rings, "walnut", crease=30.0)


def _back_slat(low: float, high: float) -> Solid:
    """Curved rail between the posts."""
    grid = []
    for i in range(6):
        t = i / 5 * 2 - 1
        lean = [-0.19 - 0.24 * (y - 0.55) * 0.8 for y in (low, high)]
        grid.append([(0.18 * t, y, z - 0.03 * (1 - t * t) + 0.002)
                     for y, z in zip((low, high), lean)])
    return sheet(grid, 0.016, "walnut")


def dining_chair(number: int) -> SceneObject:
    legs = [leg((side * 0.195, GAP, 0.19), (side * 0.19, 0.429, 0.185), 0.024, 0.034, "walnut")
            for side in (-1, 1)]
    posts = [_back_post(side * 0.2) for side in (-1, 1)]
    seat = rounded_box((-0.215, 0.43, -0.165), (0.215, 0.48, 0.235), 0.018, "chair upholstery")
    return SceneObject(f"dining chair {number}", [
        *legs, *posts, seat, _back_slat(0.56, 0.63), _back_slat(0.7, 0.82)])


def bench() -> SceneObject:
    """Slatted bench with a seat pad."""
    parts = [box((-0.55, 0.405, z - 0.05), (0.55, 0.43, z + 0.05), "oak")
             for z in (-0.11, 0.0, 0.11)]
    for sx in (-1, 1):
        parts.append(box((sx * 0.42 - 0.02, 0.37, -0.15), (sx * 0.42 + 0.02, 0.404, 0.15), "oak"))
        for sz in (-1, 1):
            parts.append(leg((sx * 0.46, GAP, sz * 0.14), (sx * 0.42, 0.369, sz * 0.12), 0.028,
                             0.04, "oak"))
    parts.append(rounded_box((-0.53, 0.431, -0.155), (0.3, 0.475, 0.155), 0.018,
                             "armchair cushion fabric"))
    return SceneObject("bench", parts)
