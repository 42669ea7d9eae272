# SPDX-License-Identifier: Apache-2.0
"""What goes wrong between client and server."""
from __future__ import annotations


class RaybundleError(Exception):
    """Base of all errors of this package."""


class RequestRefused(RaybundleError):
    """The server has answered a request by an error; nothing has changed."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(f"{code}: {message}")
        self.code = code        #: as Error.Code has it, e.g. "INVALID_ARGUMENT"
        self.message = message  #: names the field and the reason


class ConnectionClosed(RaybundleError):
    """The connection ended before the answer came: whether a change was made is not known."""
