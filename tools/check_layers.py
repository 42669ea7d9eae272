#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that layers point one way: a source of server/ includes headers of its own library and of those that this
one links, directly or not. What may be linked, the CMakeLists.txt say; here is no second table.

usage: tools/check_layers.py [SERVER_FOLDER]; prints what goes the wrong way, exit status 1 where anything does."""
import re
import sys
from pathlib import Path


def read_libraries(server):
    """Sources and links of the libraries and executables of a folder of CMake projects."""
    sources, links = {}, {}
    for cmake in sorted(server.rglob("CMakeLists.txt")):
        text = re.sub(r"#.*", "", cmake.read_text())
        for name, kind, body in re.findall(r"add_(?:library|executable)\((\w+)\s+(STATIC\s|INTERFACE)?([^)]*)\)", text):
            sources.setdefault(name, [])
            for source in re.findall(r"[\w/]+\.(?:cpp|h)\b", body):
                sources[name].append((cmake.parent / source).relative_to(server).as_posix())
            links.setdefault(name, set())
            if not sources[name]:
                sources[name].append((cmake.parent / "none.cpp").relative_to(server).as_posix())
        for name, body in re.findall(r"target_link_libraries\((\w+)\s([^)]*)\)", text):
            links.setdefault(name, set()).update(re.findall(r"\braybundle_\w+", body))
    return sources, links


def reachable(name, links):
    """A library with all that it links, directly or not."""
    seen, todo = set(), [name]
    while todo:
        library = todo.pop()
        if library not in seen:
            seen.add(library)
            todo += links.get(library, ())
    return seen


def owners_of_headers(server, sources):
    """Libraries of each header: that of the source of its name, else those of the nearest folder above with sources."""
    by_stem, by_folder = {}, {}
    for library, files in sources.items():
        for file in files:
            by_stem[file.rsplit(".", 1)[0]] = {library}
            by_folder.setdefault(Path(file).parent, set()).add(library)
    owners = {}
    for header in server.rglob("*.h"):
        file = header.relative_to(server)
        nearest = next((folder for folder in file.parents if folder in by_folder), None)
        owners[file.as_posix()] = by_stem.get(file.with_suffix("").as_posix()) or by_folder.get(nearest, set())
    return owners


def find_violations(server):
    """Lines "file: include (reason)" of includes that no link allows."""
    sources, links = read_libraries(server)
    owners = owners_of_headers(server, sources)
    source_owner = {file: {library} for library, files in sources.items() for file in files}
    violations = []
    for file in sorted([*server.rglob("*.h"), *server.rglob("*.cpp")]):
        name = file.relative_to(server).as_posix()
        own = owners.get(name) or source_owner.get(name)
        if not own:
            continue
        allowed = set().union(*(reachable(library, links) for library in own))
        for included in re.findall(r'^#include "([^"]+)"', file.read_text(), re.M):
            target = owners.get(included)
            if target is not None and not target & allowed:
                violations.append(f"{name}: includes {included} of {', '.join(sorted(target))}, which {', '.join(sorted(own))} does not link")
    return violations


def main():
    server = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "server"
    violations = find_violations(server)
    for line in violations:
        print(line)
    print(f"layers: {len(violations)} includes go the wrong way")
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
