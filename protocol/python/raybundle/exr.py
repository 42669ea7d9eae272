# SPDX-License-Identifier: Apache-2.0
"""Reads the OpenEXR files that the server writes: scan lines, R, G and B as floats, zip-compressed or not."""
from __future__ import annotations

import struct
import zlib
from typing import Mapping

import numpy as np
import numpy.typing as npt

from .errors import RaybundleError

_MAGIC = 20000630
_ROWS_OF_A_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, zips, zip
_DTYPES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}
_MOST_PIXELS = 1 << 28


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(0, at)
    return data[at:end].decode("latin-1"), end + 1


def _header(data: bytes) -> tuple[Mapping[str, bytes], int]:
    attributes: dict[str, bytes] = {}
    name, at = _text(data, 8)
    while name:
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        if size < 0:
            raise ValueError(f"{name} has {size} bytes")
        attributes[name] = data[at + 4:at + 4 + size]
        name, at = _text(data, at + 4 + size)
    return attributes, at


def _channels(attribute: bytes) -> list[tuple[str, np.dtype[np.floating]]]:
    channels = []
    name, at = _text(attribute, 0)
    while name:
        (kind,) = struct.unpack_from("<i", attribute, at)
        channels.append((name, _DTYPES[kind]))
        name, at = _text(attribute, at + 16)
    return channels


def _unzip(packed: bytes, size: int) -> bytes:
    """Undoes the predictor and the interleaving of OpenEXR's zip compression."""
    if len(packed) == size:
        return packed
    coded = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.uint32)
    coded[1:] += 128
    raw = np.cumsum(coded).astype(np.uint8)
    result = np.empty_like(raw)
    half = (len(raw) + 1) // 2
    result[0::2], result[1::2] = raw[:half], raw[half:]
    return result.tobytes()


def read_exr(data: bytes) -> npt.NDArray[np.float32]:
    """height x width x 3, linear Rec. 709 radiance in cd/m², row 0 at the top.

    Raises RaybundleError for what is no such file.
    """
    try:
        return _read(data)
    except (KeyError, IndexError, ValueError, struct.error, zlib.error) as error:
        raise RaybundleError(f"not an OpenEXR file of R, G and B as scan lines: {error}") from error


def _read(data: bytes) -> npt.NDArray[np.float32]:
    if struct.unpack_from("<i", data) != (_MAGIC,):
        raise ValueError("it begins with another number")
    attributes, offsets = _header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    if not 0 < width * height <= _MOST_PIXELS:
        raise ValueError(f"{width} x {height} pixels")
    rows_of_a_block = _ROWS_OF_A_BLOCK[attributes["compression"][0]]
    channels = _channels(attributes["channels"])
    columns = {name: "RGB".index(name) for name, _ in channels if name in ("R", "G", "B")}
    row_bytes = width * sum(dtype.itemsize for _, dtype in channels)
    result = np.zeros((height, width, 3), np.float32)
    for block, first in enumerate(range(0, height, rows_of_a_block)):
        (at,) = struct.unpack_from("<Q", data, offsets + 8 * block)
        (size,) = struct.unpack_from("<i", data, at + 4)
        rows = min(rows_of_a_block, height - first)
        raw = _unzip(data[at + 8:at + 8 + size], rows * row_bytes)
        position = 0
        for row in range(first, first + rows):
            for name, dtype in channels:
                if name in columns:
                    result[row, :, columns[name]] = np.frombuffer(raw, dtype, width, position)
                position += width * dtype.itemsize
    return result
