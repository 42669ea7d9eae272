#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the shipped scenes, or with --check verifies that the committed files are current."""

from __future__ import annotations

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in the source tree

from generator.checks import check_files, check_model
from generator.cornell_box import cornell_box
from generator.effects import SCENES as EFFECTS
from generator.examples import SCENES as EXAMPLES
from generator.gltf import scene_files
from generator.living_room import living_room
from generator.overlaps import check_overlaps
from generator.surface_effects import SCENES as SURFACE_EFFECTS

SCENES = (cornell_box, living_room, *EFFECTS, *SURFACE_EFFECTS, *EXAMPLES)


def write_scene(files: dict[str, bytes], folder: pathlib.Path) -> None:
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        print(f"wrote {path} ({len(data)} bytes)")


def stale_files(files: dict[str, bytes], folder: pathlib.Path) -> list[str]:
    """What differs between the files on disk and the generated ones."""
    problems = []
    for name, data in files.items():
        path = folder / name
        if not path.is_file():
            problems.append(f"{path}: missing")
        elif path.read_bytes() != data:
            problems.append(f"{path}: differs from what scenes/generate.py writes")
    return problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if a file is stale or a scene is unsound")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent,
                        help="folder of the scene files (default: beside this script)")
    arguments = parser.parse_args()
    problems: list[str] = []
    for build in SCENES:
        model = build()
        files = scene_files(model)
        found = check_model(model) + check_overlaps(model) + check_files(model, files)
        problems += [f"{model.name}: {problem}" for problem in found]
        if arguments.check:
            problems += stale_files(files, arguments.out)
        else:
            write_scene(files, arguments.out)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"scenes: {len(SCENES)} scenes, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
