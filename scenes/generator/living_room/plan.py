# SPDX-License-Identifier: Apache-2.0
"""Where everything in the living room stands, and from where it is looked at."""

from __future__ import annotations

from dataclasses import replace

from ..solid import Camera, SceneModel, SceneObject
from . import decor, lamps, seating, storage, tables
from .materials import materials
from .shell import GAP, beams, door, room, skirting
from .textures import textures
from .window import curtains, pelmet, radiator, window

BACK_WALL = 5.0
ON_RUG = GAP + decor.RUG_SIZE[1]


def _at(thing: SceneObject, x: float, z: float, turn: float = 0.0, y: float = 0.0) -> SceneObject:
    """Placed on the floor (or at height y), turned by `turn` degrees about the vertical."""
    return replace(thing, translation=(x, y, z), rotation_y=turn)


def _built_in() -> list[SceneObject]:
    return [
        room(), skirting(), beams(), door(), window(), radiator(), pelmet(), curtains(),
        _at(decor.television(), 2.1, 0.0, y=1.24),
        _at(decor.picture("landscape", "landscape painting", 1.2, 0.7, 0.0, "walnut"), 2.2,
            BACK_WALL, 180, 1.62),
        _at(decor.picture("print left", "abstract print", 0.36, 0.48, 0.07, "black metal"), 3.85,
            0.0, y=1.55),
        _at(decor.picture("print right", "abstract print", 0.36, 0.48, 0.07, "oak"), 4.5, 0.0,
            y=1.55),
        _at(decor.picture("print by the door", "abstract print", 0.6, 0.8, 0.08, "walnut"), 7.0,
            1.45, -90, 1.5),
        _at(lamps.wall_sconce(1), 1.2, BACK_WALL, 180, 1.68),
        _at(lamps.wall_sconce(2), 3.2, BACK_WALL, 180, 1.68),
    ]


def _living_area() -> list[SceneObject]:
    return [
        _at(seating.sofa(), 2.2, 4.45, 180),
        _at(seating.armchair(), 0.82, 1.5, 50),
        _at(decor.rug(), 2.35, 2.9),
        _at(tables.coffee_table(), 2.3, 2.92, y=ON_RUG),
        _at(storage.sideboard(), 2.1, 0.24),
        _at(lamps.floor_lamp(), 3.68, 4.6),
        _at(decor.plant(), 0.62, 4.4),
    ]


def _dining_area() -> list[SceneObject]:
    x, z = 5.35, 3.3
    return [
        _at(tables.dining_table(), x, z),
        _at(seating.dining_chair(1), x - 0.4, z + 0.62, 180),
        _at(seating.dining_chair(2), x + 0.4, z + 0.62, 176),
        _at(seating.dining_chair(3), x - 0.4, z - 0.66, 0),
        _at(seating.dining_chair(4), x + 0.42, z - 0.74, -14),
        _at(lamps.pendant_lamp(1), x - 0.32, z),
        _at(lamps.pendant_lamp(2), x + 0.32, z),
        _at(storage.bookshelf(), 6.82, 3.3, -90),
        _at(seating.bench(), 6.76, 1.45, -90),
    ]


def living_room() -> SceneModel:
    wide = 16 / 9
    return SceneModel(
        name="living_room",
        materials=materials(),
        objects=_built_in() + _living_area() + _dining_area(),
        cameras=[
            Camera("entrance", (6.45, 1.55, 0.35), (2.3, 0.95, 3.3), 48.0, wide),
            Camera("sofa", (1.25, 1.4, 4.65), (3.2, 0.8, 1.0), 55.0, wide),
            Camera("window", (0.3, 1.5, 2.15), (4.8, 0.85, 2.75), 48.0, wide),
        ],
        textures=textures(),
        position_step=1e-5,
    )
