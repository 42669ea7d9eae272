# SPDX-License-Identifier: Apache-2.0
"""Polygon solids: what the furniture is assembled from."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

Vec = tuple[float, float, float]
UvMap = Callable[[Vec, Vec], tuple[float, float]]  # (position, face normal) -> texture coordinates
ColourMap = Callable[[Vec], Vec]  # position -> factor of the base colour, linear


def add(a: Vec, b: Vec) -> Vec:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a: Vec, s: float) -> Vec:
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a: Vec, b: Vec) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a: Vec) -> float:
    return math.sqrt(dot(a, a))


def unit(a: Vec) -> Vec:
    return mul(a, 1.0 / length(a))


@dataclass
class Solid:
    """Polygons over shared points, counter-clockwise seen from outside.

    `material` names the material of every face that `face_materials` does not list by index.
    Edges whose faces meet at less than `crease` degrees are shaded smooth.
    `inward` marks a room: a closed surface that is looked at from inside.
    """

    points: list[Vec]
    faces: list[tuple[int, ...]]
    material: str
    crease: float = 40.0
    inward: bool = False
    face_materials: dict[int, str] = field(default_factory=dict)
    uv: UvMap | None = None
    colour: ColourMap | None = None

    def mapped(self, transform: Callable[[Vec], Vec]) -> Solid:
        """The solid with every point transformed (the transform must keep orientation)."""
        return replace(self, points=[transform(p) for p in self.points])

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
        return self.mapped(lambda p: (p[0] + x, p[1] + y, p[2] + z))

    def turned(self, axis: str, degrees: float) -> Solid:
        """Turned right-handedly about a coordinate axis through the origin."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        turns: dict[str, Callable[[Vec], Vec]] = {
            "x": lambda p: (p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]),
            "y": lambda p: (c * p[0] + s * p[2], p[1], -s * p[0] + c * p[2]),
            "z": lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]),
        }
        return self.mapped(turns[axis])

    def textured(self, uv: UvMap) -> Solid:
        return replace(self, uv=uv)

    def normal(self, face: tuple[int, ...]) -> Vec:
        """Normal of a face, as long as twice its area (Newell)."""
        total = (0.0, 0.0, 0.0)
        origin = self.points[face[0]]
        for a, b in zip(face[1:], face[2:]):
            total = add(total, cross(sub(self.points[a], origin), sub(self.points[b], origin)))
        return total

    def triangles(self) -> Iterable[tuple[int, tuple[int, int, int]]]:
        """(face index, corners); quads are cut along their shorter diagonal."""
        for index, face in enumerate(self.faces):
            if len(face) == 4 and self._second_diagonal_is_shorter(face):
                face = face[1:] + face[:1]
            for a, b in zip(face[1:], face[2:]):
                yield index, (face[0], a, b)

    def _second_diagonal_is_shorter(self, face: tuple[int, ...]) -> bool:
        a, b, c, d = (self.points[i] for i in face)
        return length(sub(d, b)) < length(sub(c, a)) - 1e-9

    def volume(self) -> float:
        """Signed volume, m³: positive if the faces look outward."""
        return sum(
            dot(self.points[a], cross(self.points[b], self.points[c])) / 6.0
            for _, (a, b, c) in self.triangles()
        )


@dataclass
class SceneObject:
    """A named node of the scene; its solids are relative to the node's own origin."""

    name: str
    solids: list[Solid]
    translation: Vec = (0.0, 0.0, 0.0)
    rotation_y: float = 0.0  # degrees
    movable: bool = True


@dataclass
class Camera:
    """Perspective camera; `vertical_fov` in degrees."""

    name: str
    eye: Vec
    target: Vec
    vertical_fov: float
    aspect_ratio: float


@dataclass
class Material:
    """glTF metallic-roughness material.

    `base_colour` is linear Rec. 709, a factor of `texture`. `roughness` None: pure Lambert
    (specularFactor 0). `reflectance_texture` holds factors of roughness (G) and `metallic` (B).
    `luminance` (cd/m²) or `flux` (lm, over all surfaces of the material) make it a luminaire of the
    given colour. `mirror`: a metal without roughness. `glass`: index of refraction; of a body whose
    light `attenuation` is left of after 1 m, or of a thin pane where that is None. `coat`: roughness
    of a clear coat.
    """

    name: str
    base_colour: Vec
    roughness: float | None = None
    mirror: bool = False
    glass: float | None = None
    attenuation: Vec | None = None
    coat: float | None = None
    texture: str | None = None
    luminance: float = 0.0
    flux: float = 0.0
    light_colour: Vec = (1.0, 1.0, 1.0)
    metallic: float = 0.0
    reflectance_texture: str | None = None
    normal_texture: str | None = None
    unlit: bool = False
    transmission: float = 0.0  # KHR_materials_diffuse_transmission: share of the diffuse part
    transmission_colour: Vec = (1.0, 1.0, 1.0)
    double_sided: bool = False

    def textures(self) -> list[str]:
        names = (self.texture, self.reflectance_texture, self.normal_texture)
        return [name for name in names if name]


@dataclass
class Light:
    """A light without extent: `kind` is point, spot or directional of KHR_lights_punctual (`intensity`
    in cd or lx, cones in degrees), or ies: then `profile` names a file of the model.
    """

    name: str
    kind: str
    position: Vec
    direction: Vec
    intensity: float = 1.0
    colour: Vec = (1.0, 1.0, 1.0)
    inner_cone: float = 0.0
    outer_cone: float = 45.0
    profile: str = ""


@dataclass
class SceneModel:
    """All that a scene file holds. `textures` maps a file name to PNG bytes."""

    name: str
    materials: list[Material]
    objects: list[SceneObject]
    cameras: list[Camera]
    textures: dict[str, bytes] = field(default_factory=dict)
    embed_buffer: bool = False
    lights: list[Light] = field(default_factory=list)
    files: dict[str, bytes] = field(default_factory=dict)  # that the scene refers to besides
    daylight: dict[str, object] = field(default_factory=dict)  # extras.raybundle.daylight
    position_step: float = 0.0  # positions are rounded to multiples of this, metres; 0: not at all
