# SPDX-License-Identifier: Apache-2.0
"""The Cornell box whose figures the project quotes: everything diffuse and one-sided."""

from __future__ import annotations

import math

from .solid import Camera, Material, SceneModel, SceneObject, Solid, Vec
from .shapes import box

ROOM = 5.5  # edge, m
LIGHT_RADIANCE = (1800.0, 1300.0, 600.0)  # cd/m²


def _quad(a: Vec, b: Vec, c: Vec, d: Vec, material: str) -> Solid:
    return Solid([a, b, c, d], [(0, 1, 2, 3)], material)


def _room() -> SceneObject:
    """Floor, ceiling and three walls, all facing inward; the front (z = 0) is open."""
    corner = {(x, y, z): (x * ROOM, y * ROOM, z * ROOM)
              for x in (0, 1) for y in (0, 1) for z in (0, 1)}

    def face(*keys: tuple[int, int, int], material: str) -> Solid:
        return _quad(*(corner[k] for k in keys), material=material)

    return SceneObject("room", movable=False, solids=[
        face((0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0), material="wall"),
        face((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), material="wall"),
        face((0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1), material="wall"),
        face((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1), material="green wall"),
        face((1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0), material="red wall"),
    ])


def _turned_box(name: str, size: Vec, centre: Vec, angle: float) -> SceneObject:
    """A box turned about the vertical: x' = c x + s z, z' = -s x + c z (`angle` in radians)."""
    half = tuple(s / 2 for s in size)
    solid = box(tuple(-h for h in half), half, "wall").turned("y", math.degrees(angle))
    return SceneObject(name, [solid.moved(*centre)])


def cornell_box() -> SceneModel:
    light = _quad((2.1, 5.49, 2.3), (3.4, 5.49, 2.3), (3.4, 5.49, 3.3), (2.1, 5.49, 3.3), "ceiling")
    luminance = 0.2126 * LIGHT_RADIANCE[0] + 0.7152 * LIGHT_RADIANCE[1] + 0.0722 * LIGHT_RADIANCE[2]
    return SceneModel(
        name="cornell_box",
        materials=[
            Material("wall", (0.73, 0.71, 0.68)),
            Material("green wall", (0.12, 0.45, 0.15)),
            Material("red wall", (0.61, 0.06, 0.06)),
            Material("ceiling", (0.78, 0.78, 0.78), luminance=luminance,
                     light_colour=LIGHT_RADIANCE),
        ],
        objects=[
            _room(),
            _turned_box("short box", (1.65, 1.65, 1.65), (1.85, 0.825, 1.7), -0.3),
            _turned_box("tall box", (1.65, 3.3, 1.65), (3.7, 1.65, 3.5), 0.31),
            SceneObject("ceiling", [light], movable=False),
        ],
        cameras=[Camera("front", (2.75, 2.75, -7.5), (2.75, 2.75, 2.75), 40.0, 1.0)],
        embed_buffer=True,
    )
