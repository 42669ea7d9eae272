# SPDX-License-Identifier: Apache-2.0
"""Minimal PNG writer for palette and true-colour images."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

Colour8 = tuple[int, int, int]
STORED_BLOCK = 65535


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _stored(data: bytes) -> bytes:
    """A zlib stream of stored blocks: the same bytes whichever zlib version is installed."""
    out = bytearray(b"\x78\x01")
    for start in range(0, len(data), STORED_BLOCK):
        part = data[start:start + STORED_BLOCK]
        final = start + STORED_BLOCK >= len(data)
        out += struct.pack("<BHH", final, len(part), len(part) ^ 0xFFFF) + part
    return bytes(out + struct.pack(">I", zlib.adler32(data)))


def palette_png(rows: Sequence[Sequence[int]], palette: Sequence[Colour8]) -> bytes:
    """PNG of palette indices, row 0 at the top; colours are sRGB-encoded."""
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 3, 0, 0, 0)
    pixels = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) +
            _chunk(b"PLTE", bytes(c for colour in palette for c in colour)) +
            _chunk(b"IDAT", _stored(pixels)) + _chunk(b"IEND", b""))


def rgb_png(rows: Sequence[Sequence[Colour8]]) -> bytes:
    """PNG of 8-bit RGB, row 0 at the top."""
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    pixels = b"".join(b"\0" + bytes(c for colour in row for c in colour) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", _stored(pixels)) +
            _chunk(b"IEND", b""))
