# SPDX-License-Identifier: Apache-2.0
"""Scenes of what textures and vertices do to a surface, each lit by a lamp below the ceiling."""

from __future__ import annotations

import math

from .png import Colour8, rgb_png
from .rounded import sphere
from .shapes import box
from .solid import Camera, Material, SceneModel, SceneObject, Solid, Vec

WIDTH, HEIGHT, DEPTH = 4.0, 3.0, 4.0  # of the room, m; its front, z = 0, is open
CAMERAS = [Camera("front", (2.0, 1.6, -3.5), (2.0, 1.35, 2.0), 43.0, 4 / 3)]
SIZE = 64  # texels along a texture
WALLS = [Material("white", (0.7, 0.7, 0.7)), Material("red", (0.6, 0.2, 0.2)),
         Material("blue", (0.2, 0.3, 0.6)),
         Material("lamp", (0.7, 0.7, 0.7), luminance=900.0)]


def _flat(position: Vec, normal: Vec) -> tuple[float, float]:
    """A texture 2 m wide on every face; up in the image is up, or away from the viewer."""
    if abs(normal[1]) > 0.5:
        return (0.5 * position[0], -0.5 * position[2])
    along = position[0] if abs(normal[2]) > 0.5 else position[2]
    return (0.5 * along, -0.5 * position[1])


def _room(floor: str, back: str) -> SceneObject:
    def face(corners: list[Vec], material: str) -> Solid:
        points = [(x * WIDTH, y * HEIGHT, z * DEPTH) for x, y, z in corners]
        return Solid(points, [(0, 1, 2, 3)], material, uv=_flat)

    lamp = [(1.4, 2.99, 1.6), (2.6, 2.99, 1.6), (2.6, 2.99, 2.6), (1.4, 2.99, 2.6)]
    return SceneObject("room", movable=False, solids=[
        face([(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)], floor),
        face([(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)], "white"),
        face([(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)], back),
        face([(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], "red"),
        face([(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)], "blue"),
        Solid(lamp, [(0, 1, 2, 3)], "lamp"),
    ])


def _model(name: str, materials: list[Material], objects: list[SceneObject],
           textures: dict[str, bytes] | None = None) -> SceneModel:
    return SceneModel(name=f"effects/{name}", materials=WALLS + materials, objects=objects,
                      cameras=CAMERAS, embed_buffer=True,
                      textures={f"effects/{key}.png": data for key, data in (textures or {}).items()})


def _image(texel: object) -> bytes:
    """texel(x, y) -> RGB, 0 to 1; x to the right, y up, in 0..1."""
    def byte(value: float) -> int:
        return max(0, min(255, round(255.0 * value)))

    rows: list[list[Colour8]] = []
    for row in range(SIZE):
        rows.append([tuple(byte(c) for c in texel((column + 0.5) / SIZE, 1 - (row + 0.5) / SIZE))
                     for column in range(SIZE)])
    return rgb_png(rows)


def _tiles(x: float, y: float) -> Vec:
    """Roughness 0.35 to 1 in waves; every other quarter is metal."""
    wave = 0.5 + 0.5 * math.sin(2 * math.pi * x) * math.cos(2 * math.pi * y)
    return (0.0, 0.35 + 0.65 * wave, float((x < 0.5) == (y < 0.5)))


def roughness_texture() -> SceneModel:
    """Floor and a block whose roughness waves, and which are metal here and there."""
    block = box((-0.6, 0.0, -0.5), (0.6, 1.1, 0.5), "plates")
    return _model("roughness_texture", [
        Material("plates", (0.75, 0.6, 0.4), roughness=1.0, metallic=1.0,
                 reflectance_texture="effects/roughness.png")],
        [_room("plates", "white"), SceneObject("block", [block.textured(_flat)], (1.8, 0.0, 2.2))],
        {"roughness": _image(_tiles)})


def _pyramids(x: float, y: float) -> Vec:
    """Normals of round studs, four along the image."""
    u, v = (4 * x) % 1.0 - 0.5, (4 * y) % 1.0 - 0.5
    radius = math.hypot(u, v)
    slope = 1.6 * math.sin(math.pi * radius / 0.45) if 0.0 < radius < 0.45 else 0.0
    nx, ny = (slope * u / radius, slope * v / radius) if slope else (0.0, 0.0)
    size = math.sqrt(nx * nx + ny * ny + 1.0)
    return (0.5 + 0.5 * nx / size, 0.5 + 0.5 * ny / size, 0.5 + 0.5 / size)


def normal_map() -> SceneModel:
    """Studs on the back wall, matt, and on a block, glossy: their upper sides catch the lamp."""
    block = box((-0.6, 0.0, -0.5), (0.6, 1.1, 0.5), "glossy studs")
    return _model("normal_map", [
        Material("studs", (0.6, 0.6, 0.6), normal_texture="effects/studs.png"),
        Material("glossy studs", (0.35, 0.4, 0.3), roughness=0.4, normal_texture="effects/studs.png")],
        [_room("white", "studs"), SceneObject("block", [block.textured(_flat)], (1.8, 0.0, 2.2))],
        {"studs": _image(_pyramids)})


def vertex_colours() -> SceneModel:
    """A block whose eight corners have a colour each."""
    def colour(p: Vec) -> Vec:
        return (0.1 if p[0] < 0 else 0.9, 0.2 if p[1] < 0.5 else 1.0, 0.15 if p[2] < 0 else 0.85)

    block = box((-0.6, 0.0, -0.5), (0.6, 1.1, 0.5), "painted")
    block.colour = colour
    return _model("vertex_colours", [Material("painted", (0.9, 0.9, 0.9))],
                  [_room("white", "white"), SceneObject("block", [block], (1.8, 0.0, 2.2))])


def unlit() -> SceneModel:
    """A sign of one even colour, which neither shadow nor lamp changes."""
    sign = box((-0.6, 0.0, -0.05), (0.6, 1.1, 0.05), "sign")
    return _model("unlit", [Material("sign", (0.05, 0.45, 0.2), unlit=True)],
                  [_room("white", "white"), SceneObject("sign", [sign], (1.8, 0.001, 2.2))])


def diffuse_transmission() -> SceneModel:
    """A curtain of orange cloth between the lamp and the viewer: without it its front is dark."""
    points = [(-1.3, 0.0, 0.0), (1.3, 0.0, 0.0), (1.3, 2.2, 0.0), (-1.3, 2.2, 0.0)]
    curtain = Solid(points, [(0, 3, 2, 1)], "cloth")
    return _model("diffuse_transmission", [
        Material("cloth", (0.6, 0.6, 0.6), transmission=0.6, transmission_colour=(0.9, 0.5, 0.2),
                 double_sided=True)],
        [_room("white", "white"), SceneObject("curtain", [curtain], (2.0, 0.001, 1.0))])


def clear_coat() -> SceneModel:
    """Lacquered boards, a car's red metal below a smooth coat, and cork below a satin one."""
    ball = sphere(0.45, 48, 24, "paint")
    return _model("clear_coat", [
        Material("boards", (0.45, 0.26, 0.12), coat=0.0),
        Material("paint", (0.6, 0.05, 0.04), roughness=0.55, metallic=1.0, coat=0.0),
        Material("cork", (0.3, 0.34, 0.2), coat=0.3)],
        [_room("boards", "white"),
         SceneObject("block", [box((-0.5, 0.0, -0.4), (0.5, 0.9, 0.4), "cork")], (1.2, 0.0, 2.4), 20.0),
         SceneObject("ball", [ball], (2.7, 0.451, 1.9))])


def polished() -> SceneModel:
    """Dark polished stone, a porcelain ball and a lacquered block: dielectrics that mirror."""
    return _model("polished", [
        Material("stone", (0.06, 0.06, 0.07), roughness=0.03),
        Material("porcelain", (0.85, 0.84, 0.8), roughness=0.05),
        Material("lacquer", (0.1, 0.25, 0.12), roughness=0.08)],
        [_room("stone", "white"),
         SceneObject("block", [box((-0.5, 0.0, -0.4), (0.5, 0.9, 0.4), "lacquer")], (1.2, 0.0, 2.4), 20.0),
         SceneObject("ball", [sphere(0.45, 48, 24, "porcelain")], (2.7, 0.451, 1.9))])


SCENES = (clear_coat, polished, roughness_texture, normal_map, vertex_colours, unlit, diffuse_transmission)
