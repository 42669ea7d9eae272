# SPDX-License-Identifier: Apache-2.0
"""Client of the Raybundle global-illumination server.

    async with await raybundle.connect("ws://127.0.0.1:8080/ws") as client:
        await client.set_light("ceiling", dim=0.5)
        solution = await client.settled(relative_error=0.02)
        picture = await client.picture()

Lengths in metres, Y up; photometric units; `raybundle.messages` has every message of the protocol with its types.
"""
from . import messages
from .client import Client, connect
from .errors import ConnectionClosed, RaybundleError, RequestRefused
from .exr import read_exr
from .frames import Frame
from .snapshots import Snapshot

__all__ = ["Client", "ConnectionClosed", "Frame", "RaybundleError", "RequestRefused", "Snapshot", "connect",
           "messages", "read_exr"]
__version__ = "0.1.0"
