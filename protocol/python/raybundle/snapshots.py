# SPDX-License-Identifier: Apache-2.0
"""Pictures that are rendered off-screen and fetched over HTTP."""
from __future__ import annotations

import ssl
import urllib.request
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import messages
from .exr import read_exr
from .frames import decode_image

_MOST_BYTES = 1 << 30


@dataclass(frozen=True)
class Snapshot:
    """A picture and how accurate it is."""

    ready: messages.SnapshotReady
    encoded: bytes  #: the file

    @property
    def is_exr(self) -> bool:
        return self.encoded[:4] == b"\x76\x2f\x31\x01"

    @property
    def relative_error(self) -> float:
        """Upper end of the 95 % interval of the relative root-mean-square error."""
        return self.ready.relative_error

    def image(self) -> npt.NDArray[Any]:
        """height x width x 3: of EXR float32 radiance, cd/m²; of PNG uint8 sRGB."""
        return read_exr(self.encoded) if self.is_exr else decode_image(self.encoded)

    def luminance(self) -> npt.NDArray[np.float32]:
        """height x width, cd/m². Raises ValueError for a PNG."""
        if not self.is_exr:
            raise ValueError("a PNG has no luminance: ask for EXR")
        weights = np.array([0.2126, 0.7152, 0.0722], np.float32)
        result: npt.NDArray[np.float32] = read_exr(self.encoded) @ weights
        return result


def fetch(url: str, token: str = "", context: Optional[ssl.SSLContext] = None) -> bytes:
    """GET, blocking. Raises urllib.error.URLError."""
    request = urllib.request.Request(url)
    if token:
        request.add_header("Authorization", f"Bearer {token}")
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}),
                                         urllib.request.HTTPSHandler(context=context))
    with opener.open(request, timeout=60) as answer:
        body: bytes = answer.read(_MOST_BYTES)
        return body
