# SPDX-License-Identifier: Apache-2.0
"""Pictures of the living room: floor boards, a rug, a landscape painting and an abstract print."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

from ..png import Colour8, palette_png

SHADES = 16


def _ramp(dark: Colour8, light: Colour8, count: int = SHADES) -> list[Colour8]:
    return [tuple(round(d + (l - d) * i / (count - 1)) for d, l in zip(dark, light))
            for i in range(count)]


def _picture(width: int, height: int, palette: list[Colour8],
             pixel: Callable[[int, int], float]) -> bytes:
    """Picture whose pixels are palette indices, clamped to the palette."""
    last = len(palette) - 1
    rows = [[min(last, max(0, int(pixel(x, y)))) for x in range(width)] for y in range(height)]
    return palette_png(rows, palette)


def floor_boards() -> bytes:
    """Eight boards side by side (u), each two lengths (v), with grain along v; tiles in u and v."""
    size, boards = 256, 8
    rng = random.Random(7)
    tones = [[3.0 + 8.0 * rng.random() for _ in range(2)] for _ in range(boards)]
    joints = [int(size * rng.random()) for _ in range(boards)]
    grain = [[rng.random() for _ in range(size)] for _ in range(size)]
    streaks = [3 * rng.random() for _ in range(size)]

    def pixel(x: int, y: int) -> float:
        board, across = divmod(x, size // boards)
        along = (y - joints[board]) % size
        if across == 0 or along % (size // 2) == 0:
            return 0.0
        wave = math.sin(2 * math.pi * (y / size * 2 + streaks[x] / 9))
        return 1.5 + tones[board][along * 2 // size] + streaks[x] + 0.8 * wave + grain[y][x]

    return _picture(size, size, _ramp((92, 62, 38), (196, 152, 106)), pixel)


def rug() -> bytes:
    """Cream rug with a navy border, terracotta diamonds and a woven texture."""
    width, height = 256, 192
    rng = random.Random(11)
    noise = [[rng.random() for _ in range(width)] for _ in range(height)]
    bands = [_ramp((186, 172, 148), (226, 214, 192), 4), _ramp((34, 46, 72), (54, 68, 98), 4),
             _ramp((150, 74, 48), (178, 98, 66), 4), _ramp((176, 138, 72), (200, 164, 96), 4)]
    palette = [colour for band in bands for colour in band]

    def band(x: int, y: int) -> int:
        edge = min(x, y, width - 1 - x, height - 1 - y)
        if edge < 20:
            return 1 if 5 <= edge < 15 else 0
        u, v = (x - width / 2) / 36, (y - height / 2) / 36
        cell = abs((u + 0.5) % 1 - 0.5) + abs((v + 0.5) % 1 - 0.5)
        ring = int(cell * 12)
        odd = (math.floor(u + 0.5) + math.floor(v + 0.5)) % 2
        return {1: 3, 2: 2 if odd else 1, 4: 2 if odd else 1}.get(ring, 0)

    def pixel(x: int, y: int) -> float:
        return 4 * band(x, y) + int(2 * noise[y][x]) + (x + y) % 2

    return _picture(width, height, palette, pixel)


def landscape() -> bytes:
    """Painted hills under an evening sky, in brush strokes."""
    width, height = 192, 112
    rng = random.Random(5)
    strokes = [[rng.random() for _ in range(width)] for _ in range(height)]
    layers = [((236, 186, 120), (120, 152, 178)), ((112, 118, 140), (140, 142, 154)),
              ((72, 92, 98), (98, 116, 112)), ((50, 74, 56), (84, 104, 66)),
              ((38, 52, 36), (128, 112, 50))]
    palette = [colour for a, b in layers for colour in _ramp(a, b)]

    def ridge(layer: int, x: int) -> float:
        u = x / width * 2 * math.pi
        wave = math.sin(u * (0.7 + 0.35 * layer) + 2.1 * layer) + 0.4 * math.sin(u * 2.3 + layer)
        return height * (0.28 + 0.155 * layer) - height * 0.06 * wave

    def pixel(x: int, y: int) -> float:
        jitter = strokes[y][x // 5 * 5] - 0.5
        if math.dist((x, y), (132, 30)) < 9:
            return 0.0
        layer, top, bottom = 0, -20.0, ridge(1, x)
        while layer < 4 and y > ridge(layer + 1, x) + 2 * jitter:
            layer += 1
            top, bottom = ridge(layer, x), ridge(layer + 1, x) if layer < 4 else height
        depth = (y - top) / max(1.0, bottom - top)
        shade = SHADES * ((1 - depth) if layer == 0 else depth) + 3 * jitter
        return SHADES * layer + min(SHADES - 1, max(0, int(shade)))

    return _picture(width, height, palette, pixel)


def abstract_print() -> bytes:
    """Overlapping discs and bars on paper."""
    width, height = 96, 128
    palette = [(226, 218, 202), (196, 84, 52), (38, 62, 84), (214, 164, 70), (96, 40, 40),
               (20, 30, 40)]
    discs = ((40, 44, 26, 1), (60, 76, 22, 2), (34, 92, 14, 3))

    def pixel(x: int, y: int) -> float:
        inside = [ink for cx, cy, r, ink in discs if math.dist((x, y), (cx, cy)) < r]
        if len(inside) > 1:
            return 4 if 1 in inside else 5
        if inside:
            return inside[0]
        return 5 if 70 <= x < 73 and 14 <= y < 114 else 0

    return _picture(width, height, palette, pixel)


def textures() -> dict[str, bytes]:
    """File name -> PNG."""
    return {
        "living_room_floor.png": floor_boards(),
        "living_room_rug.png": rug(),
        "living_room_landscape.png": landscape(),
        "living_room_print.png": abstract_print(),
    }
