# SPDX-License-Identifier: Apache-2.0
"""Pictures as they come from the server."""
from __future__ import annotations

import io
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from google.protobuf import json_format

from . import messages
from .errors import RaybundleError


@dataclass(frozen=True)
class Frame:
    """One picture: its header, and the image as it is encoded."""

    header: messages.FrameHeader
    encoded: bytes

    @property
    def codec(self) -> str:
        return messages.Codec.Name(self.header.codec)

    def image(self) -> npt.NDArray[np.uint8]:
        """height x width x 3, sRGB, row 0 at the top. Needs Pillow."""
        return decode_image(self.encoded)


def decode_image(encoded: bytes) -> npt.NDArray[np.uint8]:
    """JPEG or PNG to height x width x 3. Raises RaybundleError without Pillow."""
    try:
        from PIL import Image
    except ImportError as error:
        raise RaybundleError("pictures as arrays need Pillow: pip install raybundle[images], "
                             "or Debian's python3-pil") from error
    with Image.open(io.BytesIO(encoded)) as picture:
        return np.asarray(picture.convert("RGB"))


def read_frame(message: bytes) -> Frame:
    """Splits one binary message (protocol/README.md, "Frames"). Raises RaybundleError where it is none."""
    length = int.from_bytes(message[:4], "little")
    if len(message) < 4 or length > len(message) - 4:
        raise RaybundleError(f"a frame of {len(message)} bytes says that its header has {length}")
    header: Any = messages.FrameHeader()
    json_format.Parse(message[4:4 + length].decode("utf-8"), header, ignore_unknown_fields=True)
    end = len(message) - header.depth_bytes
    return Frame(header, message[4 + length:end])
