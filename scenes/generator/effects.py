# SPDX-License-Identifier: Apache-2.0
"""One small scene for each effect, in which nothing else lights the picture."""

from __future__ import annotations

import math

from .rounded import sphere
from .shapes import box
from .solid import Camera, Light, Material, SceneModel, SceneObject, Solid

WIDTH, HEIGHT, DEPTH = 4.0, 3.0, 4.0  # of the room, m; its front, z = 0, is open
CAMERAS = [Camera("front", (2.0, 1.6, -3.5), (2.0, 1.4, 2.0), 43.0, 4 / 3)]
MATERIALS = [Material("white", (0.7, 0.7, 0.7)), Material("red", (0.6, 0.2, 0.2)),
             Material("blue", (0.2, 0.3, 0.6))]


def _room() -> SceneObject:
    def at(x: float, y: float, z: float) -> tuple[float, float, float]:
        return (x * WIDTH, y * HEIGHT, z * DEPTH)

    def face(corners: list[tuple[float, float, float]], material: str) -> Solid:
        return Solid([at(*c) for c in corners], [(0, 1, 2, 3)], material)

    return SceneObject("room", movable=False, solids=[
        face([(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)], "white"),
        face([(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)], "white"),
        face([(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)], "white"),
        face([(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], "red"),
        face([(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)], "blue"),
    ])


def _box() -> SceneObject:
    return SceneObject("box", [box((-0.6, 0.0, -0.5), (0.6, 1.1, 0.5), "white")], (1.8, 0.0, 2.1))


def punctual_lights() -> SceneModel:
    """A bare lamp, a spot on the box, and sunlight through the open front."""
    return SceneModel(
        name="effects/punctual_lights", materials=MATERIALS, objects=[_room(), _box()],
        cameras=CAMERAS, embed_buffer=True,
        lights=[
            Light("lamp", "point", (3.1, 2.2, 2.9), (0, -1, 0), 90.0, (1.0, 0.85, 0.65)),
            Light("spot", "spot", (0.6, 2.7, 1.0), (1.2, -1.8, 1.0), 600.0, (0.9, 0.9, 1.0),
                  20.0, 35.0),
            Light("sun", "directional", (0, 0, 0), (0.35, -0.6, 1.0), 120.0, (1.0, 0.9, 0.75)),
        ])


def _downlight() -> bytes:
    """A narrow downlight of 800 lm, type C, symmetric about its axis."""
    angles = list(range(0, 95, 5))
    shape = [math.exp(-((v / 22.0) ** 2)) if v < 90 else 0.0 for v in angles]
    # Flux of the table, linear between its angles.
    flux = 0.0
    steps = 1000
    for i, (low, high) in enumerate(zip(angles, angles[1:])):
        for k in range(steps):
            share = (k + 0.5) / steps
            v = math.radians(low + (high - low) * share)
            flux += (2 * math.pi * math.sin(v) * (shape[i] * (1 - share) + shape[i + 1] * share)
                     * math.radians(high - low) / steps)
    values = [round(800.0 / flux * s, 3) for s in shape]
    lines = ["IESNA:LM-63-2002", "[TEST] none: a computed distribution", "[MANUFAC] Raybundle",
             "[LUMINAIRE] narrow downlight, 800 lm", "TILT=NONE",
             f"1 800 1 {len(angles)} 1 1 2 -0.1 0 0", "1 1 9",
             " ".join(str(v) for v in angles), "0", " ".join(str(v) for v in values)]
    return ("\n".join(lines) + "\n").encode("ascii")


def ies_profile() -> SceneModel:
    """Two downlights whose cones draw arcs on the back wall."""
    return SceneModel(
        name="effects/ies_profile", materials=MATERIALS, objects=[_room(), _box()],
        cameras=CAMERAS, embed_buffer=True, files={"effects/downlight.ies": _downlight()},
        lights=[Light(f"downlight {i + 1}", "ies", (x, 2.95, 3.4), (0, -1, 0),
                      profile="downlight.ies") for i, x in enumerate((1.0, 3.0))])


def _daylight(name: str, daylight: dict[str, object], **more: object) -> SceneModel:
    return SceneModel(
        name=f"effects/{name}", materials=MATERIALS, objects=[_room(), _box()],
        cameras=CAMERAS, embed_buffer=True, daylight=daylight, **more)


def overcast_sky() -> SceneModel:
    """A room lit through its open front by an overcast sky of 10 000 lx."""
    return _daylight("overcast_sky", {"sky": "overcast", "zenithLuminance": 4092.6})


def clear_sky() -> SceneModel:
    """Sun and clear sky through the open front, which looks north."""
    return _daylight("clear_sky", {"sky": "clear", "sunElevation": 32.0, "sunAzimuth": 20.0})


SURROUNDINGS_WIDTH, SURROUNDINGS_HEIGHT = 128, 64


def _surroundings() -> bytes:
    """An evening: orange in the west, blue in the east, dark ground, and a small bright sun in the
    north-west."""
    pixels = bytearray()
    for y in range(SURROUNDINGS_HEIGHT):
        elevation = 90.0 - 180.0 * (y + 0.5) / SURROUNDINGS_HEIGHT
        for x in range(SURROUNDINGS_WIDTH):
            azimuth = 360.0 * (x + 0.5) / SURROUNDINGS_WIDTH - 180.0
            west = 0.5 - 0.5 * math.sin(math.radians(azimuth))
            colour = [1.0 + 5.0 * west, 1.2 + 2.0 * west, 2.5 - 1.0 * west]
            if elevation < 0.0:
                colour = [0.3, 0.35, 0.2]
            if abs(elevation - 24.0) < 3.0 and abs(azimuth + 30.0) < 3.0:
                colour = [900.0, 600.0, 300.0]
            mantissa, exponent = math.frexp(max(colour))
            scale = mantissa * 256.0 / max(colour)
            pixels += bytes([*(int(c * scale) for c in colour), exponent + 128])
    header = (f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
              f"-Y {SURROUNDINGS_HEIGHT} +X {SURROUNDINGS_WIDTH}\n")
    return header.encode("ascii") + bytes(pixels)


def environment() -> SceneModel:
    """An image of an evening sky lights the room through its open front."""
    return _daylight("environment", {"environment": "surroundings.hdr", "environmentScale": 500.0},
                     files={"effects/surroundings.hdr": _surroundings()})


LAMP = Material("lamp", (0.7, 0.7, 0.7), luminance=900.0, light_colour=(1.0, 0.9, 0.75))


def _lamp() -> SceneObject:
    """A square lamp under the ceiling, facing down."""
    corners = [(1.4, 2.98, 1.6), (2.6, 2.98, 1.6), (2.6, 2.98, 2.8), (1.4, 2.98, 2.8)]
    return SceneObject("lamp", [Solid(corners, [(0, 1, 2, 3)], "lamp")], movable=False)


def _lit_room(name: str, materials: list[Material], objects: list[SceneObject]) -> SceneModel:
    return SceneModel(name=f"effects/{name}", materials=[*MATERIALS, LAMP, *materials],
                      objects=[_room(), _lamp(), *objects], cameras=CAMERAS, embed_buffer=True)


def mirror() -> SceneModel:
    """A mirror on the back wall, and a golden ball before it."""
    glass = Solid([(0.5, 0.4, 3.98), (0.5, 2.6, 3.98), (3.5, 2.6, 3.98), (3.5, 0.4, 3.98)],
                  [(0, 1, 2, 3)], "mirror")
    return _lit_room("mirror", [
        Material("mirror", (0.92, 0.94, 0.93), mirror=True),
        Material("gold", (1.0, 0.78, 0.34), mirror=True),
    ], [
        SceneObject("mirror", [glass], movable=False),
        SceneObject("box", [box((-0.4, 0.0, -0.4), (0.4, 0.9, 0.4), "white")], (1.1, 0.0, 2.2), 25.0),
        SceneObject("ball", [sphere(0.45, 48, 24, "gold")], (2.7, 0.46, 2.4)),
    ])


def glass() -> SceneModel:
    """A pane, a glass ball and a block of amber glass before coloured walls."""
    pane = Solid([(-0.55, 0.0, 0.0), (-0.55, 1.9, 0.0), (0.55, 1.9, 0.0), (0.55, 0.0, 0.0)],
                 [(0, 1, 2, 3)], "pane")
    return _lit_room("glass", [
        Material("pane", (0.9, 0.97, 0.93), glass=1.5),
        Material("crystal", (1.0, 1.0, 1.0), glass=1.5, attenuation=(0.9, 0.95, 0.92)),
        Material("amber", (1.0, 1.0, 1.0), glass=1.55, attenuation=(0.6, 0.2, 0.02)),
    ], [
        SceneObject("pane", [pane], (0.9, 0.001, 1.6), 20.0),
        SceneObject("ball", [sphere(0.45, 64, 32, "crystal")], (2.2, 0.46, 1.5)),
        SceneObject("block", [box((-0.35, 0.0, -0.35), (0.35, 1.1, 0.35), "amber")], (3.2, 0.001, 2.3),
                    30.0),
        SceneObject("box", [box((-0.4, 0.0, -0.4), (0.4, 0.9, 0.4), "white")], (1.2, 0.0, 3.0)),
    ])


def _ring(inner: float, outer: float, height: float, sides: int, material: str) -> Solid:
    """A ring on the floor about the y axis; its walls are smooth where the metal curves."""
    corners, faces = [], []
    for i in range(sides):
        turn = 2 * math.pi * i / sides
        for radius, y in ((inner, 0.0), (inner, height), (outer, height), (outer, 0.0)):
            corners.append((radius * math.cos(turn), y, radius * math.sin(turn)))
    for i in range(sides):
        here, there = 4 * i, 4 * ((i + 1) % sides)
        for k in range(4):
            faces.append((here + k, there + k, there + (k + 1) % 4, here + (k + 1) % 4))
    return Solid(corners, faces, material)


def caustics() -> SceneModel:
    """A spot through a glass ball and red glass, and into a golden ring."""
    return SceneModel(
        name="effects/caustics", embed_buffer=True, cameras=[
            Camera("front", (2.0, 2.2, -1.2), (2.0, 0.3, 1.9), 43.0, 4 / 3)],
        materials=[*MATERIALS,
                   Material("crystal", (1.0, 1.0, 1.0), glass=1.5, attenuation=(0.95, 0.97, 0.96)),
                   Material("ruby", (1.0, 1.0, 1.0), glass=1.55, attenuation=(0.7, 0.01, 0.02)),
                   Material("gold", (1.0, 0.78, 0.34), mirror=True)],
        objects=[
            _room(),
            SceneObject("ball", [sphere(0.4, 64, 32, "crystal")], (1.2, 0.55, 1.6)),
            SceneObject("block", [box((-0.25, 0.0, -0.25), (0.25, 0.7, 0.25), "ruby")],
                        (2.1, 0.001, 2.2), 30.0),
            SceneObject("ring", [_ring(0.45, 0.5, 0.35, 64, "gold")], (3.0, 0.001, 1.5)),
        ],
        lights=[Light("spot", "spot", (3.3, 2.9, 3.2), (-1.2, -2.7, -1.4), 1500.0,
                      (1.0, 0.95, 0.85), 40.0, 50.0)])


SCENES = (punctual_lights, ies_profile, overcast_sky, clear_sky, environment, mirror, glass, caustics)
