# SPDX-License-Identifier: Apache-2.0
"""The living room: a closed interior lit by a window and by six lamps in physical units.

The room spans x in [0, 7], y in [0, 2.8], z in [0, 5] metres. The window is in the wall x = 0, the
door in the wall z = 0. Every piece of furniture is modelled with its front towards +z and its
footprint round the origin; `plan.py` places it.
"""

from .plan import living_room

__all__ = ["living_room"]
