# SPDX-License-Identifier: Apache-2.0
"""The messages of protocol/raybundle.proto, generated when the package is built."""
from .raybundle_pb2 import *  # noqa: F401,F403
