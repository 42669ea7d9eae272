# SPDX-License-Identifier: Apache-2.0
"""Coffee table and dining table, with what stands on them."""

from __future__ import annotations

import math
import random

from ..rounded import lathe, rounded_box, sphere
from ..shapes import box, leg, loft, tube
from ..solid import SceneObject, Solid
from .shell import GAP

COFFEE_TOP = 0.42  # height of the lacquered top, m
DINING_TOP = 0.745


def bowl(radius: float, height: float, material: str, segments: int = 16) -> Solid:
    """Open bowl on a foot, standing on y = 0."""
    outer = [(0.0, 0.0), (0.38 * radius, 0.0), (0.4 * radius, 0.06 * height),
             (0.68 * radius, 0.3 * height), (0.9 * radius, 0.65 * height), (radius, height)]
    inner = [(radius - 0.007, height), (0.9 * radius - 0.009, 0.66 * height),
             (0.66 * radius - 0.004, 0.35 * height), (0.35 * radius, 0.16 * height),
             (0.0, 0.13 * height)]
    return lathe(outer + inner, segments, material, crease=50.0)


def vase(height: float, belly: float, neck: float, material: str, segments: int = 14) -> Solid:
    """Bellied vase with an open neck, standing on y = 0."""
    outer = [(0.0, 0.0), (0.55 * belly, 0.0), (0.82 * belly, 0.12 * height), (belly, 0.34 * height),
             (0.86 * belly, 0.58 * height), (0.5 * belly + 0.5 * neck, 0.76 * height),
             (neck, 0.88 * height), (1.18 * neck, height)]
    inner = [(1.18 * neck - 0.005, height), (neck - 0.005, 0.88 * height),
             (0.6 * belly, 0.6 * height), (0.0, 0.5 * height)]
    return lathe(outer + inner, segments, material, crease=50.0)


def book_stack(materials: list[str], seed: int) -> list[Solid]:
    """Lying books, the largest at the bottom, each a little askew."""
    rng = random.Random(seed)
    y, parts = GAP, []
    for i, material in enumerate(materials):
        width, depth = 0.29 - 0.03 * i, 0.21 - 0.022 * i
        thick = 0.022 + 0.014 * rng.random()
        book = box((-width / 2, y, -depth / 2), (width / 2, y + thick, depth / 2), material)
        book.face_materials.update({0: "paper", 1: "paper", 5: "paper"})
        parts.append(book.turned("y", 24 * (rng.random() - 0.5)))
        y += thick + GAP
    return parts


def coffee_table() -> SceneObject:
    """Low table with a glossy lacquered top and a slatted shelf."""
    x, z = 0.6, 0.33
    parts = [rounded_box((-x, COFFEE_TOP - 0.04, -z), (x, COFFEE_TOP, z), 0.012, "table lacquer")]
    for sx in (-1, 1):
        for sz in (-1, 1):
            parts.append(leg((sx * (x - 0.05), GAP, sz * (z - 0.04)),
                             (sx * (x - 0.1), COFFEE_TOP - 0.041, sz * (z - 0.08)), 0.026, 0.042,
                             "walnut"))
    for k in range(5):
        slat_z = (k - 2) * 0.075
        parts.append(box((-0.44, 0.165, slat_z - 0.028), (0.44, 0.18, slat_z + 0.028), "walnut"))
    for sx in (-1, 1):
        parts.append(box((sx * 0.42 - 0.018, 0.14, -0.19), (sx * 0.42 + 0.018, 0.164, 0.19),
                         "walnut"))
    parts += [s.moved(-0.3, COFFEE_TOP, 0.03)
              for s in book_stack(["book white", "book teal", "book ochre"], 3)]
    parts.append(bowl(0.16, 0.085, "blue glaze").moved(0.26, COFFEE_TOP + GAP, -0.02))
    parts += [s.moved(-0.1, 0.181, 0.0) for s in book_stack(["book grey", "book crimson"], 8)]
    return SceneObject("coffee table", parts)


def _fruit() -> list[Solid]:
    """Apples and pears that lie in a bowl of 0.19 m radius."""
    places = [(0.07, 0.058, 0.0), (-0.03, 0.058, 0.066), (-0.04, 0.058, -0.058),
              (0.0, 0.112, 0.002)]
    fruits = []
    for i, (x, y, z) in enumerate(places):
        material = "pear" if i == 1 else "apple"
        fruit = sphere(0.039, 10, 6, material).mapped(lambda p: (p[0], p[1] * 0.92, p[2]))
        fruits.append(fruit.moved(x, y, z))
    return fruits


def _branches(base: float) -> list[Solid]:
    """Three bare twigs with a few leaves, in a vase whose neck is at height `base`."""
    parts = []
    for k in range(3):
        a = 2 * math.pi * k / 3 + 0.6
        spread = [0.008 + 0.016 * t * t for t in range(4)]
        path = [(r * math.cos(a), base - 0.1 + 0.15 * t, r * math.sin(a))
                for t, r in enumerate(spread)]
        parts.append(tube(path, [0.004, 0.0035, 0.003, 0.002], 5, "stem"))
        for j in (1.7, 2.4, 3.0):
            low = path[int(j)] if j == 3.0 else tuple(
                p + (q - p) * (j % 1) for p, q in zip(path[int(j)], path[int(j) + 1]))
            parts.append(_twig_leaf(low, a + 2.4 * j))
    return parts


def _twig_leaf(at: tuple[float, float, float], angle: float) -> Solid:
    c, s = math.cos(angle), math.sin(angle)
    rings = []
    for t, half in ((0.3, 0.018), (0.6, 0.02)):
        reach = 0.006 + 0.075 * t
        centre = (at[0] + c * reach, at[1] + 0.05 * t, at[2] + s * reach)
        rings.append([(centre[0] - s * d, centre[1] + h, centre[2] + c * d)
                      for d, h in ((-half, 0.0), (0.0, -0.002), (half, 0.0), (0.0, 0.003))])
    start = (at[0] + c * 0.006, at[1], at[2] + s * 0.006)
    end = (at[0] + c * 0.085, at[1] + 0.045, at[2] + s * 0.085)
    return loft(rings, "leaf", start, end)


def dining_table() -> SceneObject:
    """Oak table for four with a runner, a fruit bowl and a vase."""
    x, z = 0.85, 0.45
    parts = [rounded_box((-x, DINING_TOP - 0.035, -z), (x, DINING_TOP, z), 0.008, "oak")]
    for sx in (-1, 1):
        parts.append(box((sx * 0.72 - 0.011, 0.62, -0.33), (sx * 0.72 + 0.011, 0.709, 0.33), "oak"))
        for sz in (-1, 1):
            parts.append(leg((sx * (x - 0.05), GAP, sz * (z - 0.05)),
                             (sx * (x - 0.08), 0.709, sz * (z - 0.08)), 0.035, 0.06, "oak"))
    for sz in (-1, 1):
        parts.append(box((-0.7, 0.62, sz * 0.37 - 0.011), (0.7, 0.709, sz * 0.37 + 0.011), "oak"))
    parts.append(box((-0.62, DINING_TOP + GAP, -0.17), (0.62, DINING_TOP + 0.005, 0.17),
                     "cream wool"))
    on_cloth = DINING_TOP + 0.006
    parts.append(bowl(0.19, 0.09, "stoneware", 18).moved(0.22, on_cloth, 0.0))
    parts += [s.moved(0.22, on_cloth, 0.0) for s in _fruit()]
    parts.append(vase(0.26, 0.075, 0.03, "blue glaze").moved(-0.3, on_cloth, 0.02))
    parts += [s.moved(-0.3, on_cloth, 0.02) for s in _branches(0.26)]
    return SceneObject("dining table", parts)
