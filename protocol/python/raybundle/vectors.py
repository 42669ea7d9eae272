# SPDX-License-Identifier: Apache-2.0
"""Sequences of numbers to messages and back."""
from __future__ import annotations

from typing import Optional, Sequence

from . import messages

Numbers = Sequence[float]


def vec3(numbers: Numbers) -> messages.Vec3:
    """Three numbers as a message. Raises ValueError for any other count."""
    x, y, z = (float(number) for number in numbers)
    return messages.Vec3(x=x, y=y, z=z)


def optional_vec3(numbers: Optional[Numbers]) -> Optional[messages.Vec3]:
    return None if numbers is None else vec3(numbers)


def numbers(vector: messages.Vec3) -> tuple[float, float, float]:
    return (vector.x, vector.y, vector.z)


def transform(translation: Optional[Numbers] = None, rotation: Optional[Numbers] = None,
              scale: Optional[Numbers | float] = None) -> messages.Transform:
    """Local transform: metres, quaternion (x, y, z, w), factors. Raises ValueError for other counts."""
    result = messages.Transform()
    if translation is not None:
        result.translation.CopyFrom(vec3(translation))
    if rotation is not None:
        x, y, z, w = (float(number) for number in rotation)
        result.rotation.CopyFrom(messages.Quaternion(x=x, y=y, z=z, w=w))
    if scale is not None:
        result.scale.CopyFrom(vec3([scale] * 3 if isinstance(scale, (int, float)) else scale))
    return result
