# SPDX-License-Identifier: Apache-2.0
"""Addresses of servers, and one connection after the other to them."""
from __future__ import annotations

import asyncio
import random
import ssl as ssl_module
from typing import Optional, Sequence, Union
from urllib.parse import urlsplit, urlunsplit

import websockets
from websockets.client import WebSocketClientProtocol, connect as open_socket

SUBPROTOCOL = websockets.Subprotocol("raybundle.v1")
MAX_MESSAGE_BYTES = 1 << 28
FIRST_RETRY_S = 0.25
LAST_RETRY_S = 5.0

Addresses = Union[str, Sequence[str]]


def socket_address(address: str) -> str:
    """ws://HOST:PORT/ws for HOST:PORT, and for the address of a server's page. Raises ValueError for others."""
    parts = urlsplit(address if "://" in address else f"ws://{address}")
    scheme = {"http": "ws", "https": "wss"}.get(parts.scheme, parts.scheme)
    if scheme not in ("ws", "wss") or not parts.hostname:
        raise ValueError(f"{address!r} is not an address such as 127.0.0.1:8080 or https://example.org/")
    path = parts.path if parts.path.endswith("/ws") else parts.path.rstrip("/") + "/ws"
    return urlunsplit((scheme, parts.netloc, path, parts.query, ""))


def page_address(socket: str) -> str:
    """Address that paths of the server are appended to, without a slash at its end."""
    parts = urlsplit(socket)
    return urlunsplit(({"ws": "http", "wss": "https"}[parts.scheme], parts.netloc, parts.path[:-len("/ws")], "", ""))


class Link:
    """The servers of one project, in order of preference. `current`: the one that the socket belongs to."""

    def __init__(self, addresses: Addresses, ssl: Optional[ssl_module.SSLContext]) -> None:
        listed = [addresses] if isinstance(addresses, str) else list(addresses)
        if not listed:
            raise ValueError("no address of a server")
        self._addresses = [socket_address(address) for address in listed]
        self.ssl = ssl
        self.current = self._addresses[0]

    async def open(self) -> WebSocketClientProtocol:
        """Connects to the first server that answers, beginning with the current one. Raises OSError or
        websockets.WebSocketException, of the last one tried."""
        begin = self._addresses.index(self.current)
        failure: Exception = OSError("no server")
        for address in self._addresses[begin:] + self._addresses[:begin]:
            secure = {"ssl": self.ssl} if self.ssl is not None and address.startswith("wss:") else {}
            try:
                socket = await open_socket(address, subprotocols=[SUBPROTOCOL], max_size=MAX_MESSAGE_BYTES,
                                           max_queue=64, ping_interval=20, ping_timeout=60,
                                           compression=None, **secure)  # type: ignore[arg-type]
                self.current = address
                return socket
            except (OSError, asyncio.TimeoutError, websockets.WebSocketException) as error:
                failure = error
        raise failure

    def prefer_next(self) -> None:
        """The next attempt begins with another server, where there is one."""
        place = self._addresses.index(self.current)
        self.current = self._addresses[(place + 1) % len(self._addresses)]

    @property
    def page(self) -> str:
        return page_address(self.current)


def retry_delay(attempt: int) -> float:
    """Seconds before a further attempt: doubles, and varies so that not all clients return at once."""
    return min(FIRST_RETRY_S * float(2 ** min(attempt, 10)), LAST_RETRY_S) * (0.75 + 0.5 * random.random())
