#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the client's wheel, installs it in a new virtual environment without a network, and runs client_test.py there:
run_in_environment.py RAYBUNDLE REPOSITORY [UNITTEST_ARGUMENT...]"""
import os
import subprocess
import sys
import tempfile
import venv
from pathlib import Path


def main() -> int:
    executable, root, *arguments = sys.argv[1:]
    here = Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        environment = {**os.environ, "PYTHON": sys.executable, "PIP_NO_CACHE_DIR": "1"}
        wheel = subprocess.run([f"{root}/deploy/python_wheel.sh", folder / "wheels"], check=True, text=True,
                               stdout=subprocess.PIPE, env=environment).stdout.strip()
        # numpy, protobuf, websockets and Pillow are Debian's.
        venv.create(folder / "environment", system_site_packages=True, with_pip=True)
        python = folder / "environment/bin/python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-warn-script-location", wheel],
                       check=True, env=environment, cwd=folder)
        environment |= {"RAYBUNDLE": executable, "RAYBUNDLE_ROOT": root,
                        "RAYBUNDLE_CLIENT": str(folder / "environment/bin/raybundle-client")}
        return subprocess.run([python, here / "client_test.py", *arguments], env=environment,
                              cwd=folder).returncode


if __name__ == "__main__":
    sys.exit(main())
