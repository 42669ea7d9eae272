#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes sources that are compiled together (CMake's unity build) as one file each.

usage: join_sources.py BUILD_DIR

For each generated source that includes others BUILD_DIR/tidy/joined gets a file with their text,
named like it with "_" for "/", and compile_commands.json says how to compile it; other sources keep
their commands.
"""
import json
import pathlib
import re
import shlex
import shutil
import sys

INCLUDE = re.compile(r'^#include "(.*)"$', re.MULTILINE)


def is_unity(source, build):
    return source.is_relative_to(build) and source.parent.name == "Unity"


def joined_text(sources):
    return "".join(f'#line 1 "{s}"\n{pathlib.Path(s).read_text(encoding="utf-8")}' for s in sources)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    target = build / "tidy" / "joined"
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    for entry in entries:
        source = pathlib.Path(entry["file"])
        if not is_unity(source, build):
            continue
        sources = INCLUDE.findall(source.read_text(encoding="utf-8"))
        joined = target / str(source.relative_to(build)).replace("/", "_")
        joined.write_text(joined_text(sources), encoding="utf-8")
        # Their own folders are where "..." is looked for first.
        folders = dict.fromkeys(str(pathlib.Path(s).parent) for s in sources)
        arguments = shlex.split(entry.pop("command"))
        arguments = [str(joined) if a == entry["file"] else a for a in arguments]
        for folder in folders:
            arguments[1:1] = ["-iquote", folder]
        entry["arguments"] = arguments
        entry["file"] = str(joined)
    (target / "compile_commands.json").write_text(json.dumps(entries, indent=1), encoding="utf-8")


main()
