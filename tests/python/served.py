# SPDX-License-Identifier: Apache-2.0
"""Starts and ends the server under test."""
import os
import re
import signal
import subprocess
from pathlib import Path

ROOT = Path(os.environ["RAYBUNDLE_ROOT"])
EXECUTABLE = os.environ["RAYBUNDLE"]
LONGEST = 240  # seconds that a command of a test may take; what hangs is a failure that says where


class Daemon:
    """`raybundle serve` on a free port of this machine, without a journal."""

    def __init__(self, scene, *options, port=0):
        self.process = subprocess.Popen(
            [EXECUTABLE, "serve", scene, "--listen", f"127.0.0.1:{port}", "--journal", "none", "--log-level", "warn",
             *options], stdout=subprocess.PIPE, text=True)
        said = []
        for line in self.process.stdout:
            said.append(line)
            found = re.search(r"http://127\.0\.0\.1:(\d+)", line)
            if found:
                self.port = int(found[1])
                self.address = f"127.0.0.1:{self.port}"
                return
        raise RuntimeError(f"the server has ended: {''.join(said)}")

    def end(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        try:
            self.process.wait(LONGEST)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            raise
        finally:
            self.process.stdout.close()


def run(*command):
    """Runs a command to its end, and returns what it said."""
    return subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
