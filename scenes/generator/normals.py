# SPDX-License-Identifier: Apache-2.0
"""Solids to vertex arrays: triangulation, shading normals, texture coordinates."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass, field

from .solid import Solid, Vec, add, cross, dot, length, sub, unit


@dataclass
class Primitive:
    """Indexed triangles of one material."""

    positions: list[Vec] = field(default_factory=list)
    normals: list[Vec] = field(default_factory=list)
    uvs: list[tuple[float, float]] = field(default_factory=list)
    colours: list[Vec] = field(default_factory=list)
    indices: list[int] = field(default_factory=list)
    lookup: dict[tuple[object, ...], int] = field(default_factory=dict)

    def add_corner(self, position: Vec, normal: Vec, uv: tuple[float, float],
                   colour: Vec = (1.0, 1.0, 1.0)) -> None:
        normal = tuple(round(c, 4) + 0.0 for c in normal)
        uv = (round(uv[0], 5), round(uv[1], 5))
        key = (position, normal, uv, colour)
        if key not in self.lookup:
            self.lookup[key] = len(self.positions)
            self.positions.append(position)
            self.normals.append(normal)
            self.uvs.append(uv)
            self.colours.append(colour)
        self.indices.append(self.lookup[key])


def snap(point: Vec, step: float) -> Vec:
    """The point rounded to multiples of `step` (metres), so that output is the same everywhere."""
    if step == 0.0:
        return point
    return tuple(round(round(c / step) * step, 9) + 0.0 for c in point)


def _corner_normal(faces: list[int], own: int, normals: list[Vec], crease: float) -> Vec:
    """Area-weighted mean normal of the faces round a corner that are smooth with face `own`."""
    limit = math.cos(math.radians(crease))
    here = unit(normals[own])
    total = (0.0, 0.0, 0.0)
    for face in faces:
        if dot(unit(normals[face]), here) >= limit:
            total = add(total, normals[face])
    return unit(total)


def append_solid(primitives: dict[str, Primitive], solid: Solid, step: float) -> None:
    """Adds the triangles of a solid to the primitives of its materials."""
    normals = [solid.normal(face) for face in solid.faces]
    if any(length(n) < 1e-12 for n in normals):
        raise ValueError(f"a face of {solid.material} has no area")
    faces_round: dict[int, list[int]] = defaultdict(list)
    for index, face in enumerate(solid.faces):
        for corner in face:
            faces_round[corner].append(index)
    for index, corners in solid.triangles():
        name = solid.face_materials.get(index, solid.material)
        primitive = primitives.setdefault(name, Primitive())
        if _area(solid, corners) < 1e-9:
            raise ValueError(f"a triangle of {name} has no area")
        for corner in corners:
            position = snap(solid.points[corner], step)
            uv = solid.uv(solid.points[corner], unit(normals[index])) if solid.uv else (0.0, 0.0)
            smooth = _corner_normal(faces_round[corner], index, normals, solid.crease)
            colour = solid.colour(solid.points[corner]) if solid.colour else (1.0, 1.0, 1.0)
            primitive.add_corner(position, smooth, uv, colour)


def _area(solid: Solid, corners: tuple[int, int, int]) -> float:
    a, b, c = (solid.points[i] for i in corners)
    return 0.5 * length(cross(sub(b, a), sub(c, a)))
