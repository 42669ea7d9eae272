# SPDX-License-Identifier: Apache-2.0
"""Bookshelf with its books, and the sideboard below the television."""

from __future__ import annotations

import random
from dataclasses import dataclass

from ..rounded import lathe, rounded_box, sphere
from ..shapes import box, leg, tube
from ..solid import SceneObject, Solid
from .shell import GAP
from .tables import book_stack, bowl, vase

BOARD = 0.022
COLUMNS = 3
COLUMN_WIDTH = 0.6
SHELF_HEIGHTS = (0.08, 0.45, 0.82, 1.17, 1.50, 1.82)  # undersides; the last is the open top shelf
SHELF_TOP = 2.12
DEPTH = 0.3
BINDINGS = ("book navy", "book crimson", "book green", "book ochre", "book white", "book grey",
            "book teal", "terracotta")


@dataclass(frozen=True)
class Compartment:
    """Space between two uprights and two shelves; `floor` and `ceiling` are its limits in y."""

    left: float
    right: float
    floor: float
    ceiling: float

    @property
    def middle(self) -> float:
        return (self.left + self.right) / 2


def _carcass() -> list[Solid]:
    """Uprights, shelves and a back, 1 mm apart from each other."""
    half = COLUMNS * COLUMN_WIDTH / 2 + (COLUMNS + 1) * BOARD / 2
    parts = [box((-half, 0.005, -DEPTH / 2), (half, SHELF_TOP, -DEPTH / 2 + 0.008), "walnut")]
    z0, z1 = -DEPTH / 2 + 0.009, DEPTH / 2
    for i in range(COLUMNS + 1):
        x = -half + i * (COLUMN_WIDTH + BOARD)
        parts.append(box((x, GAP, z0), (x + BOARD, SHELF_TOP, z1), "walnut"))
        if i == COLUMNS:
            continue
        for y in (*SHELF_HEIGHTS, SHELF_TOP - BOARD):
            parts.append(box((x + BOARD + GAP, y, z0), (x + BOARD + COLUMN_WIDTH - GAP, y + BOARD,
                             z1 - 0.004), "walnut"))
        parts.append(box((x + BOARD + GAP, GAP, z1 - 0.05), (x + BOARD + COLUMN_WIDTH - GAP,
                         SHELF_HEIGHTS[0] - GAP, z1 - 0.03), "walnut"))
    return parts


def _compartments() -> list[Compartment]:
    half = COLUMNS * COLUMN_WIDTH / 2 + (COLUMNS + 1) * BOARD / 2
    levels = (*SHELF_HEIGHTS, SHELF_TOP - BOARD)
    return [Compartment(-half + i * (COLUMN_WIDTH + BOARD) + BOARD + 0.004,
                        -half + (i + 1) * (COLUMN_WIDTH + BOARD) - 0.004, low + BOARD + GAP, high)
            for low, high in zip(levels, levels[1:]) for i in range(COLUMNS)]


def _book(x: float, floor: float, width: float, height: float, depth: float,
          binding: str) -> Solid:
    """Standing book, spine to the front, 1 cm behind the shelf's edge."""
    front = DEPTH / 2 - 0.012
    book = box((x, floor, front - depth), (x + width, floor + height, front), binding)
    book.face_materials.update({3: "paper", 4: "paper"})
    return book


def _books(space: Compartment, fill: float, rng: random.Random) -> list[Solid]:
    """A row of books from the left up to the fraction `fill`, the last one leaning."""
    parts, x = [], space.left
    end = space.left + fill * (space.right - space.left)
    room = space.ceiling - space.floor
    binding = BINDINGS[int(rng.random() * len(BINDINGS))]
    while True:
        width = 0.026 + 0.042 * rng.random() ** 1.4
        height = min(room - 0.03, 0.19 + 0.12 * rng.random())
        if x + width > end:
            break
        if rng.random() < 0.65:
            binding = BINDINGS[int(rng.random() * len(BINDINGS))]
        parts.append(_book(x, space.floor, width, height, 0.15 + 0.07 * rng.random(), binding))
        x += width + 0.0015
    if fill < 0.9:
        parts.append(_leaning_book(x, space.floor, rng))
    return parts


def _leaning_book(x: float, floor: float, rng: random.Random) -> Solid:
    """Book tilted against the row that ends at x."""
    book = _book(0.0, 0.0, 0.028, 0.2, 0.17, BINDINGS[int(rng.random() * len(BINDINGS))])
    book = book.turned("z", 12)
    left = min(p[0] for p in book.points)
    return book.moved(x + 0.001 - left, floor)


def _ornaments(spaces: list[Compartment]) -> list[Solid]:
    """What stands on the shelves besides books."""
    def on(index: int, solid: Solid, share: float) -> Solid:
        space = spaces[index]
        return solid.moved(space.left + share * (space.right - space.left), space.floor, 0.02)

    parts = [on(1, vase(0.24, 0.08, 0.032, "terracotta", 12), 0.78),
             on(5, bowl(0.11, 0.09, "stoneware", 12), 0.76),
             on(9, sphere(0.07, 12, 7, "brass").moved(y=0.0701), 0.8),
             on(16, bowl(0.13, 0.1, "terracotta", 12), 0.5)]
    parts += [on(8, s, 0.7) for s in book_stack(["book navy", "book white", "book ochre"], 21)]
    for index, material in ((0, "oak"), (2, "oak")):
        space = spaces[index]
        crate = rounded_box((space.left + 0.02, space.floor, -0.11),
                            (space.right - 0.02, space.floor + 0.27, 0.12), 0.012, material)
        parts.append(crate)
    return parts


def bookshelf() -> SceneObject:
    """Three columns of shelves; crates at the bottom, books and ornaments above."""
    rng = random.Random(42)
    spaces = _compartments()
    fills = {1: 0.55, 3: 0.95, 4: 0.7, 5: 0.5, 6: 0.62, 7: 0.95, 8: 0.25, 9: 0.55, 10: 0.8,
             11: 0.95, 12: 0.95, 13: 0.85, 14: 0.75, 15: 0.6, 17: 0.55}
    parts = _carcass() + _ornaments(spaces)
    for index, fill in fills.items():
        parts += _books(spaces[index], fill, rng)
    return SceneObject("bookshelf", parts)


def _sideboard_lamp() -> list[Solid]:
    """Table lamp: a luminous globe on a turned foot."""
    foot = lathe([(0.0, 0.0), (0.06, 0.0), (0.06, 0.012), (0.022, 0.03), (0.018, 0.06),
                  (0.03, 0.075), (0.0, 0.075)], 12, "brass")
    return [foot, sphere(0.09, 14, 8, "table lamp").moved(y=0.166)]


def sideboard() -> SceneObject:
    """Low cabinet with four doors on splayed legs, a lamp, a vase and books on top."""
    x, low, top, z = 1.0, 0.16, 0.56, 0.21
    parts = [rounded_box((-x, low, -z), (x, top, z - 0.022), 0.006, "oak")]
    width = 2 * x / 4
    for i in range(4):
        x0 = -x + i * width
        parts.append(box((x0 + 0.003, low + 0.004, z - 0.021), (x0 + width - 0.003, top - 0.022,
                         z - 0.002), "white woodwork"))
        knob = x0 + (width - 0.05 if i % 2 == 0 else 0.05)
        parts.append(tube([(knob, 0.4, z - 0.001), (knob, 0.4, z + 0.02)], 0.009, 6, "brass"))
    for sx in (-1, 1):
        for sz in (-1, 1):
            parts.append(leg((sx * (x - 0.06), GAP, sz * (z - 0.03)),
                             (sx * (x - 0.12), low - GAP, sz * (z - 0.06)), 0.024, 0.04, "walnut"))
    parts += [s.moved(-0.8, top + GAP, 0.0) for s in _sideboard_lamp()]
    parts.append(vase(0.3, 0.09, 0.035, "stoneware").moved(0.82, top + GAP, -0.02))
    parts += [s.moved(0.5, top, 0.0) for s in book_stack(["book crimson", "book grey"], 5)]
    return SceneObject("sideboard", parts)
