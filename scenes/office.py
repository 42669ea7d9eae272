#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes an office building: floors of open-plan offices, rooms with doors, corridors, stairs, furniture with small parts and
600 luminaires a floor. The files are large, so none of them is shipped."""

from __future__ import annotations

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in the source tree

from generator.office.scene import office


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floors", type=int, default=1,
                        help="floors of about 300 000 triangles and 600 luminaires each "
                             "(default: 1); 0: a small building of one floor for tests")
    parser.add_argument("-o", "--out", type=pathlib.Path, required=True,
                        help="the .gltf to write; .bin and .ies come beside it")
    parser.add_argument("--dark", action="store_true",
                        help="no daylight through the windows")
    arguments = parser.parse_args()
    if arguments.floors < 0 or arguments.floors > 100:
        parser.error("--floors must be from 0 to 100")
    if arguments.out.suffix != ".gltf":
        parser.error("--out must end in .gltf")
    files, counts = office(arguments.floors, arguments.out.stem, not arguments.dark)
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    for name, data in files.items():
        (arguments.out.parent / name).write_bytes(data)
    print(f"wrote {arguments.out}: {counts['triangles']} triangles, {counts['objects']} objects, "
          f"{counts['lamps']} lamps of IES files, {counts['panels']} panels")
    return 0


if __name__ == "__main__":
    sys.exit(main())
