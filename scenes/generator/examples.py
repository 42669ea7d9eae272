# SPDX-License-Identifier: Apache-2.0
"""Empty rooms whose light is worked out by hand in docs/examples."""

from __future__ import annotations

import math

from .shapes import box
from .solid import Camera, Light, Material, SceneModel, SceneObject, Solid

PEAK = 1600  # cd, straight down; the flux of I = PEAK cos(angle) is pi PEAK
OPENING = (0.6, 0.6)  # of the luminaire, m
LUMINAIRES_AT = 2.75  # m above the floor: 2 m above a work plane at 0.75 m
MATERIALS = [Material("ceiling", (0.7, 0.7, 0.7)), Material("walls", (0.5, 0.5, 0.5)),
             Material("floor", (0.2, 0.2, 0.2))]


def _panel() -> bytes:
    """A panel that is equally bright from everywhere: I = PEAK cos(angle), in steps of a degree, between
    which a straight line is at most 0.004 % below the cosine."""
    angles = range(91)
    values = [round(PEAK * math.cos(math.radians(v)), 3) for v in angles]
    lines = ["IESNA:LM-63-2002", "[TEST] none: a computed distribution", "[MANUFAC] Raybundle",
             "[LUMINAIRE] panel, 0.6 m x 0.6 m, Lambertian, 5027 lm", "TILT=NONE",
             f"1 {math.pi * PEAK:.1f} 1 {len(angles)} 1 1 2 {OPENING[0]} {OPENING[1]} 0", "1 1 42",
             " ".join(str(v) for v in angles), "0", " ".join(f"{v:g}" for v in values)]
    return ("\n".join(lines) + "\n").encode("ascii")


def _room(length: float, height: float, width: float) -> list[SceneObject]:
    """Six sides that face inwards, each an object: x to length, z to width."""
    def side(name: str, material: str, *corners: tuple[int, int, int]) -> SceneObject:
        points = [(x * length, y * height, z * width) for x, y, z in corners]
        return SceneObject(name, [Solid(points, [(0, 1, 2, 3)], material)], movable=False)

    return [
        side("floor", "floor", (0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)),
        side("ceiling", "ceiling", (0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)),
        side("wall x=0", "walls", (0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)),
        side(f"wall x={length:g}", "walls", (1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)),
        side("wall z=0", "walls", (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)),
        side(f"wall z={width:g}", "walls", (0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)),
    ]


def _panels(xs: tuple[float, ...], zs: tuple[float, ...]) -> list[Light]:
    return [Light(f"panel {row + 1}.{column + 1}", "ies", (x, LUMINAIRES_AT, z), (0, -1, 0),
                  profile="panel.ies")
            for row, z in enumerate(zs) for column, x in enumerate(xs)]


def office() -> SceneModel:
    """6 m x 5 m x 2.8 m with six panels under the ceiling."""
    return SceneModel(
        name="examples/office", materials=MATERIALS, objects=_room(6.0, 2.8, 5.0),
        cameras=[Camera("door", (0.3, 1.7, 0.3), (3.8, 0.7, 3.4), 70.0, 4 / 3),
                 Camera("desk", (4.5, 1.2, 2.5), (0.0, 1.2, 2.5), 60.0, 4 / 3)],
        embed_buffer=True, files={"examples/panel.ies": _panel()},
        lights=_panels((1.0, 3.0, 5.0), (1.25, 3.75)))


def classroom() -> SceneModel:
    """9 m x 6 m x 3 m with nine pendant panels, and a board at the front wall, x = 0."""
    board = SceneObject("board", [box((0.0, 0.0, 0.0), (0.02, 1.2, 4.0), "walls")], (0.001, 0.9, 1.0),
                        movable=False)
    return SceneModel(
        name="examples/classroom", materials=MATERIALS, objects=[*_room(9.0, 3.0, 6.0), board],
        cameras=[Camera("back", (8.7, 1.8, 0.4), (3.2, 0.8, 3.4), 65.0, 4 / 3),
                 Camera("seat", (6.0, 1.2, 3.0), (0.0, 1.3, 3.0), 60.0, 4 / 3)],
        embed_buffer=True,
        lights=_panels((1.5, 4.5, 7.5), (1.0, 3.0, 5.0)))


SCENES = (office, classroom)
