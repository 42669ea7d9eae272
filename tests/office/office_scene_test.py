#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The smallest office building is written and read: office_scene_test.py RAYBUNDLE OFFICE.PY"""

import json
import pathlib
import subprocess
import sys
import tempfile


def main() -> int:
    executable, script = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "office.gltf"
        said = subprocess.run([sys.executable, script, "--floors", "0", "-o", scene], check=True,
                              capture_output=True, text=True).stdout
        found = json.loads(subprocess.run([executable, "inspect", "--json", scene], check=True,
                                          capture_output=True, text=True).stdout)
    print(said.strip())
    for wanted in (f"{found['triangles']} triangles", f"{len(found['objects'])} objects"):
        if wanted not in said:
            print(f"inspect finds {wanted}", file=sys.stderr)
            return 1
    wrong = [key for key in ("degenerateTriangles", "duplicateFaces", "solidInsides",
                             "boundaryEdges") if found[key] != 0]
    for key in wrong:
        print(f"{key}: {found[key]}", file=sys.stderr)
    # Lamps of the file, and four groups of panels.
    if f"{len(found['lights']) - 4} lamps of IES files" not in said:
        print(f"inspect finds {len(found['lights'])} lights", file=sys.stderr)
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
