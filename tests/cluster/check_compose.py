#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The password of compose.yaml is a file that only programs read: check_compose.py ROOT"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

CLUSTER = Path(sys.argv[1]) / "deploy/cluster"
PASSWORD = "0a1b2c"
SHOW = "#!/bin/sh\necho \"$0 $*\"\necho \"RAYBUNDLE_REDIS_PASSWORD=${RAYBUNDLE_REDIS_PASSWORD-}\"\ncat\n"


def started(folder, *arguments):
    """What a program that is started so gets: its command line, the password in its environment, its standard input."""
    said = subprocess.run([CLUSTER / "with_password.sh", *arguments], check=True, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=20,
                          env={"PATH": f"{folder}:{os.environ['PATH']}", "PASSWORD_FILE": f"{folder}/password"})
    command, environment, *standard_input = said.stdout.splitlines()
    return command, environment, standard_input


def main():
    text = (CLUSTER / "compose.yaml").read_text()
    failures = []
    if re.search(r"^\s*(environment:|\S*PASSWORD\S*:)", text, re.M) or "requirepass" in text:
        failures.append("compose.yaml hands a password on by environment or command line")
    if not re.search(r"^secrets:\n  redis_password:\n    file: \$\{REDIS_PASSWORD_FILE:\?", text, re.M):
        failures.append("compose.yaml names no file that holds the password")
    if text.count("/with_password.sh:ro") != 2 or text.count("secrets: [redis_password]") != 2:
        failures.append("Redis and the servers do not both get it")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("redis-server", "raybundle"):
            path = Path(folder) / name
            path.write_text(SHOW)
            path.chmod(0o755)
        (Path(folder) / "password").write_text(PASSWORD + "\n")
        command, environment, given = started(folder, "redis", CLUSTER / "redis.conf")
        if PASSWORD in command + environment or given[-1] != f'requirepass "{PASSWORD}"' or "appendonly yes" not in given:
            failures.append(f"Redis is started as {command}, {environment}, {given}")
        command, environment, _ = started(folder, "serve", "scene.gltf", "--listen=0.0.0.0:8080")
        if not command.endswith("raybundle serve scene.gltf --listen=0.0.0.0:8080") or PASSWORD not in environment:
            failures.append(f"a server is started as {command}, {environment}")
        command, environment, _ = started(folder, "work", "scene.gltf")
        if not command.endswith("raybundle work scene.gltf") or PASSWORD not in environment:
            failures.append(f"a worker is started as {command}, {environment}")
    print("\n".join(failures), file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
