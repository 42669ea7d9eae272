# SPDX-License-Identifier: Apache-2.0
"""What the room is built of: walls, floor, ceiling, door, skirting boards, beams."""

from __future__ import annotations

from itertools import product

from ..rounded import disc
from ..shapes import Point2, box, frame, moulding, prism, tube
from ..solid import SceneObject, Solid, Vec

SIZE = (7.0, 2.8, 5.0)
WINDOW_Y = (0.8, 2.35)
WINDOW_Z = (1.15, 3.85)
DOOR_X = (5.75, 6.65)
DOOR_HEIGHT = 2.08
WALL_THICKNESS = 0.32
DOOR_RECESS = 0.12
GAP = 0.001  # between things that would otherwise share a face

LINES = ((0.0, *DOOR_X, SIZE[0]), (0.0, WINDOW_Y[0], DOOR_HEIGHT, WINDOW_Y[1], SIZE[1]),
         (0.0, *WINDOW_Z, SIZE[2]))


class _ShellBuilder:
    """Collects inward-facing quads that share their corners exactly."""

    def __init__(self) -> None:
        self.points: dict[Vec, int] = {}
        self.faces: list[tuple[int, ...]] = []
        self.materials: dict[int, str] = {}

    def quad(self, corners: list[Vec], inside: Vec, material: str) -> None:
        """Adds a quad facing the side on which the point `inside` lies."""
        solid = Solid(corners, [(0, 1, 2, 3)], material)
        n = solid.normal((0, 1, 2, 3))
        if sum(n[k] * (inside[k] - corners[0][k]) for k in range(3)) < 0:
            corners = corners[::-1]
        self.materials[len(self.faces)] = material
        self.faces.append(tuple(self.points.setdefault(p, len(self.points)) for p in corners))

    def panels(self, axis: int, value: float, lines: tuple[tuple[float, ...], ...], inside: Vec,
               material: str, hole: tuple[Point2, Point2] | None = None) -> None:
        """A plane rectangle at coordinate `value` of `axis`, cut at `lines` of the other axes."""
        u, v = (k for k in range(3) if k != axis)
        for (u0, u1), (v0, v1) in product(zip(lines[u], lines[u][1:]), zip(lines[v], lines[v][1:])):
            middle = ((u0 + u1) / 2, (v0 + v1) / 2)
            if hole and all(low < m < high for m, (low, high) in zip(middle, hole)):
                continue
            corners = []
            for a, b in ((u0, v0), (u1, v0), (u1, v1), (u0, v1)):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = value, a, b
                corners.append(tuple(p))
            self.quad(corners, inside, material)


def _between(lines: tuple[float, ...], low: float, high: float) -> tuple[float, ...]:
    return tuple(t for t in lines if low <= t <= high)


def _recess(shell: _ShellBuilder, axis: int, depth: float, hole: dict[int, Point2],
            sides: str, back: str, floor: str) -> None:
    """Lines a hole in the wall at coordinate 0 of `axis`: its sides, and its back at -depth."""
    lines = [_between(LINES[k], *hole[k]) if k in hole else (-depth, 0.0) for k in range(3)]
    centre = tuple((line[0] + line[-1]) / 2 for line in lines)
    shell.panels(axis, -depth, tuple(lines), centre, back)
    for k in hole:
        for value in hole[k]:
            material = floor if k == 1 and value == hole[k][0] else sides
            shell.panels(k, value, tuple(lines), centre, material)


def room() -> SceneObject:
    """Floor, walls and ceiling; the recess of the window ends in the luminous sky."""
    shell = _ShellBuilder()
    centre = tuple(s / 2 for s in SIZE)
    window, door = (WINDOW_Y, WINDOW_Z), (DOOR_X, (0.0, DOOR_HEIGHT))
    shell.panels(0, 0.0, LINES, centre, "wall paint", window)
    shell.panels(0, SIZE[0], LINES, centre, "wall paint")
    shell.panels(1, 0.0, LINES, centre, "floor boards")
    shell.panels(1, SIZE[1], LINES, centre, "ceiling paint")
    shell.panels(2, 0.0, LINES, centre, "wall paint", door)
    shell.panels(2, SIZE[2], LINES, centre, "accent wall paint")
    _recess(shell, 0, WALL_THICKNESS, {1: WINDOW_Y, 2: WINDOW_Z}, "wall paint", "daylight",
            "wall paint")
    _recess(shell, 2, DOOR_RECESS, {0: DOOR_X, 1: (0.0, DOOR_HEIGHT)}, "white woodwork",
            "wall paint", "floor boards")
    solid = Solid(list(shell.points), shell.faces, "wall paint", inward=True,
                  face_materials=shell.materials)
    return SceneObject("room", [solid.textured(lambda p, _: (p[2] / 1.6, p[0] / 2.4))],
                       movable=False)


def skirting() -> SceneObject:
    """Boards along all walls, from one side of the door round to the other."""
    casing = 0.09
    path = [(DOOR_X[1] + casing, 0.0), (SIZE[0], 0.0), (SIZE[0], SIZE[2]), (0.0, SIZE[2]),
            (0.0, 0.0), (DOOR_X[0] - casing, 0.0)]
    profile = [(GAP, GAP), (0.016, GAP), (0.016, 0.075), (0.008, 0.09), (GAP, 0.09)]
    board = moulding(path, profile, "white woodwork", lambda x, z, h: (x, h, z))
    return SceneObject("skirting", [board], movable=False)


def beams() -> SceneObject:
    """Five oak beams across the ceiling, their lower edges chamfered."""
    w, low, high = 0.06, SIZE[1] - 0.15, SIZE[1] - GAP
    outline = [(-w, low + 0.015), (-w + 0.015, low), (w - 0.015, low), (w, low + 0.015), (w, high),
               (-w, high)]
    beam = prism(outline, GAP, SIZE[2] - GAP, "oak", axis="z")
    return SceneObject("ceiling beams", [beam.moved(x=1.0 + 1.25 * i) for i in range(5)],
                       movable=False)


def _door_leaf() -> list[Solid]:
    """Leaf with two framed panels; its face lies at z = -0.03."""
    low = (DOOR_X[0] + 0.003, 0.004)
    high = (DOOR_X[1] - 0.003, DOOR_HEIGHT - 0.003)
    parts = [box((*low, -0.07), (*high, -0.03), "white woodwork")]
    profile = [(0.0, 0.0), (0.03, 0.0), (0.022, 0.012), (0.008, 0.012)]
    for y0, y1 in ((0.25, 0.92), (1.12, 1.9)):
        parts.append(frame((low[0] + 0.13, y0), (high[0] - 0.13, y1), profile, "white woodwork",
                           lambda x, y, h: (x, y, -0.03 + GAP + h)))
    return parts


def _door_handle() -> list[Solid]:
    x, y, z = DOOR_X[0] + 0.065, 1.02, -0.03 + GAP
    rose = disc(0.026, 0.0, 0.008, 12, "brass").turned("x", 90).moved(x, y, z)
    lever = tube([(x, y, z + 0.009), (x, y, z + 0.045), (x + 0.02, y, z + 0.055),
                  (x + 0.115, y, z + 0.055)], 0.008, 6, "brass")
    return [rose, lever]


def door() -> SceneObject:
    casing = [(GAP, GAP), (0.085, GAP), (0.085, 0.012), (0.07, 0.018), (GAP, 0.018)]
    path = [(DOOR_X[0], GAP), (DOOR_X[0], DOOR_HEIGHT), (DOOR_X[1], DOOR_HEIGHT), (DOOR_X[1], GAP)]
    surround = moulding(path, casing, "white woodwork", lambda x, y, h: (x, y, h))
    switch = box((-0.04, -0.04, 0.0), (0.04, 0.04, 0.008), "white woodwork")
    rocker = box((-0.028, -0.028, 0.009), (0.028, 0.028, 0.012), "white woodwork")
    fittings = [s.moved(DOOR_X[0] - 0.22, 1.1, GAP) for s in (switch, rocker)]
    return SceneObject("door", [*_door_leaf(), *_door_handle(), surround, *fittings], movable=False)
