# SPDX-License-Identifier: Apache-2.0
"""The building round the furniture: floors, walls with windows, corridors, rooms with doors, stairs."""

from __future__ import annotations

from dataclasses import dataclass

from ..shapes import box
from ..solid import SceneObject, Solid

STOREY, CLEAR = 3.5, 3.2  # m: from floor to floor, from floor to ceiling
BAY = 5.4  # m: along the front
DEPTH = 24.0
CORRIDOR = (11.0, 13.0)  # m: between its walls
ROOM_DEPTH = 5.0
WALL = 0.12
STAIR = 3.2  # m: length of the stairwell beyond the end wall


@dataclass(frozen=True)
class Plan:
    """How large a floor is."""

    bays: int  # of BAY along the front

    @property
    def length(self) -> float:
        return BAY * self.bays

    @property
    def rooms(self) -> int:
        """Along the corridor, one a bay; half of it has open floor on both sides."""
        return (self.bays + 1) // 2


def _front(plan: Plan, z: float) -> list[Solid]:
    """A front with a window in each half bay, between z and the inside."""
    low, high = (z - 0.3, z) if z == 0.0 else (z, z + 0.3)
    solids = [box((0, 0, low), (plan.length, 0.9, high), "plaster"),
              box((0, 2.4, low), (plan.length, CLEAR, high), "plaster")]
    for k in range(2 * plan.bays + 1):
        x = min(max(BAY / 2 * k, 0.15), plan.length - 0.15)
        solids.append(box((x - 0.15, 0.9, low), (x + 0.15, 2.4, high), "plaster"))
        if k < 2 * plan.bays:
            # A frame of the window's bars.
            left, right = BAY / 2 * k + 0.15, BAY / 2 * (k + 1) - 0.15
            left, right = max(left, 0.3), min(right, plan.length - 0.3)
            middle = (low + high) / 2
            bar = 0.025
            for x0, x1, y0, y1 in ((left + 0.001, right - 0.001, 0.901, 0.95),
                                   (left + 0.001, right - 0.001, 2.35, 2.399),
                                   ((left + right) / 2 - bar, (left + right) / 2 + bar, 0.951,
                                    2.349)):
                solids.append(box((x0, y0, middle - bar), (x1, y1, middle + bar), "metal"))
    return solids


def shell(plan: Plan, floor: int) -> SceneObject:
    """Slab, fronts, end walls with the way to the stairs, columns."""
    solids = [box((-0.3, -0.3, -0.3), (plan.length + STAIR + 0.3, -0.0, DEPTH + 0.3), "carpet")
              if floor == 0 else
              box((-0.3, -0.3, -0.3), (plan.length + 0.3, -0.0, DEPTH + 0.3), "carpet")]
    solids += _front(plan, 0.0) + _front(plan, DEPTH)
    solids.append(box((-0.3, 0, 0), (0, CLEAR, DEPTH), "plaster"))
    end = plan.length
    for z0, z1, y0 in ((0.0, 11.4, 0.0), (12.6, DEPTH, 0.0), (11.4, 12.6, 2.2)):
        solids.append(box((end, y0, z0), (end + 0.3, CLEAR, z1), "plaster"))
    for k in range(1, plan.bays):
        for z in (5.0, 19.0):
            solids.append(box((BAY * k - 0.2, 0, z - 0.2), (BAY * k + 0.2, CLEAR, z + 0.2),
                              "concrete"))
    return SceneObject(f"shell {floor + 1}", solids, (0.0, STOREY * floor, 0.0), movable=False)


def partitions(plan: Plan, floor: int) -> SceneObject:
    """The corridor's walls and the rooms behind them, with gaps for doors of 0.9 x 2.1 m."""
    solids = []
    near, far = CORRIDOR[1], CORRIDOR[1] + WALL + ROOM_DEPTH
    for k in range(plan.rooms):
        left, right = BAY * k, BAY * (k + 1)
        gap = left + 0.5
        for x0, x1, y0 in ((left + 0.001, gap, 0.0), (gap + 0.9, right, 0.0),
                           (gap, gap + 0.9, 2.1)):
            solids.append(box((x0, y0, near), (x1, CLEAR - 0.001, near + WALL), "partition"))
        solids.append(box((right - WALL, 0, near + WALL + 0.001), (right, CLEAR - 0.001, far),
                          "partition"))
        solids.append(box((left + 0.001, 0, far + 0.001), (right, CLEAR - 0.001, far + WALL),
                          "partition"))
    # Along the other side a wall of half the length: open floor beyond it.
    solids.append(box((0.001, 0, CORRIDOR[0] - WALL), (plan.rooms * BAY, CLEAR - 0.001,
                                                       CORRIDOR[0]), "partition"))
    return SceneObject(f"partitions {floor + 1}", solids, (0.0, STOREY * floor, 0.0),
                       movable=False)


def stairs(plan: Plan, floor: int) -> SceneObject:
    """A flight up from this floor's landing in a shaft of its own."""
    left, right = plan.length + 0.3, plan.length + STAIR
    solids = [box((right, -0.3, 9.0), (right + 0.3, CLEAR, 15.0), "concrete"),
              box((left, -0.3, 8.7), (right + 0.3, CLEAR, 9.0), "concrete"),
              box((left, -0.3, 15.0), (right + 0.3, CLEAR, 15.3), "concrete")]
    if floor > 0:
        solids.append(box((left + 0.001, -0.3, 11.3), (left + 1.2, -0.0, 14.999), "concrete"))
    count = 20
    for k in range(count):
        z = 14.7 - 0.28 * k if k < 10 else 11.9 - 0.28 * (k - 10)
        solids.append(box((left + 1.3, STOREY / count * k, z - 0.279),
                          (left + 2.5, STOREY / count * (k + 1) - 0.001, z), "concrete"))
    rail = [box((left + 1.25, 0.01, 9.2 + 0.5 * k), (left + 1.28, 0.95, 9.23 + 0.5 * k), "metal")
            for k in range(11)]
    return SceneObject(f"stairs {floor + 1}", solids + rail, (0.0, STOREY * floor, 0.0),
                       movable=False)


def roof(plan: Plan, floors: int) -> SceneObject:
    return SceneObject("roof", [box((-0.3, -0.3, -0.3),
                                    (plan.length + STAIR + 0.3, 0.0, DEPTH + 0.3), "concrete")],
                       (0.0, STOREY * floors, 0.0), movable=False)
