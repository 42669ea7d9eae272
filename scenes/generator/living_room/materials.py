# SPDX-License-Identifier: Apache-2.0
"""Materials of the living room: linear albedos, lamps by flux, the sky by luminance."""

from __future__ import annotations

from ..solid import Material

WARM = (1.0, 0.77, 0.50)  # lamp light as a camera balanced for daylight indoors sees it
DAYLIGHT = (0.86, 0.94, 1.0)

LAMBERTIAN = {
    "wall paint": (0.78, 0.76, 0.72),
    "accent wall paint": (0.36, 0.45, 0.40),
    "ceiling paint": (0.80, 0.79, 0.77),
    "white woodwork": (0.76, 0.75, 0.72),
    "oak": (0.40, 0.26, 0.145),
    "walnut": (0.185, 0.105, 0.06),
    "brass": (0.46, 0.34, 0.14),
    "black metal": (0.035, 0.035, 0.037),
    "radiator enamel": (0.74, 0.74, 0.73),
    "sofa fabric": (0.44, 0.42, 0.38),
    "sofa cushion fabric": (0.50, 0.48, 0.44),
    "armchair fabric": (0.075, 0.17, 0.22),
    "armchair cushion fabric": (0.09, 0.20, 0.255),
    "mustard wool": (0.52, 0.33, 0.09),
    "rust wool": (0.36, 0.13, 0.075),
    "cream wool": (0.66, 0.60, 0.50),
    "curtain linen": (0.63, 0.58, 0.49),
    "chair upholstery": (0.30, 0.31, 0.30),
    "lamp shade": (0.74, 0.69, 0.60),
    "pendant enamel": (0.05, 0.10, 0.11),
    "pendant lining": (0.78, 0.74, 0.64),
    "paper": (0.72, 0.68, 0.59),
    "book navy": (0.03, 0.06, 0.16),
    "book crimson": (0.28, 0.045, 0.05),
    "book green": (0.06, 0.14, 0.085),
    "book ochre": (0.46, 0.31, 0.12),
    "book white": (0.68, 0.66, 0.62),
    "book grey": (0.17, 0.18, 0.20),
    "book teal": (0.08, 0.20, 0.21),
    "terracotta": (0.42, 0.17, 0.09),
    "soil": (0.06, 0.04, 0.03),
    "leaf": (0.06, 0.19, 0.045),
    "stem": (0.12, 0.14, 0.05),
    "stoneware": (0.55, 0.50, 0.43),
    "apple": (0.46, 0.10, 0.045),
    "pear": (0.40, 0.42, 0.09),
    "picture mount": (0.74, 0.73, 0.70),
}

GLOSSY = {
    "table lacquer": ((0.11, 0.042, 0.028), 0.25),
    "television glass": ((0.012, 0.012, 0.014), 0.2),
    "blue glaze": ((0.04, 0.12, 0.24), 0.3),
}

TEXTURED = {
    "floor boards": "living_room_floor.png",
    "rug": "living_room_rug.png",
    "landscape painting": "living_room_landscape.png",
    "abstract print": "living_room_print.png",
}

LAMPS = {
    "floor lamp": 1200.0,
    "pendant lamp 1": 900.0,
    "pendant lamp 2": 900.0,
    "wall sconce 1": 500.0,
    "wall sconce 2": 500.0,
    "table lamp": 450.0,
}


def materials() -> list[Material]:
    """All materials, in a fixed order."""
    result = [Material(name, colour) for name, colour in LAMBERTIAN.items()]
    result += [Material(name, colour, roughness) for name, (colour, roughness) in GLOSSY.items()]
    result += [Material(name, (1.0, 1.0, 1.0), texture=file) for name, file in TEXTURED.items()]
    result.append(Material("daylight", (0.1, 0.1, 0.1), luminance=4000.0, light_colour=DAYLIGHT))
    result += [Material(name, (0.7, 0.7, 0.7), flux=flux, light_colour=WARM)
               for name, flux in LAMPS.items()]
    return result
