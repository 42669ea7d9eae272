#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the data members of each class of server/: what has more than 15 does too much, or says why not.

usage: tools/check_classes.py [--all] [SERVER_FOLDER]; prints the classes with more, or with --all every class, the
largest first; exit status 1 where one is not in `larger`."""
import re
import sys
from pathlib import Path

most = 15

# Still to be taken apart by who writes what and how long it lives. No class joins them without a reason beside it here.
larger = {
    *("GpuScene", "ManyLamps", "ZoneBalance", "ViewPrograms", "Caustics", "Solver", "ExchangeRays", "ChangeStore"),
    *("FirstShot", "ScatteredLight", "RadianceStore", "SpecularRays", "SpecialPhase", "AirScene", "PatchMesh"),
    *("RedisLog", "NetworkState", "NetworkThread", "LightService", "ViewerSession", "SnapshotQueue"),
    *("CongestionWindow", "ViewerLink"),  # 16 since they also tell what a frame of video may take
    # Tables of values that one text describes: the file's material, scene and lights, settings, metrics, services.
    *("Material", "Scene", "PunctualLight", "ServerSettings", "Options", "SolverSettings", "LoopMetrics"),
    "SessionServices",
}


def without_comments(text):
    """The text with comments, strings and preprocessor lines blanked."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)
    text = re.sub(r"'(?:[^'\\\n]|\\.)'", "0", text)
    return re.sub(r"(?m)^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", " ", text)


def block_end(text, start):
    """Index after the brace that closes the one at `start`."""
    depth = 0
    for at in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at + 1
    return len(text)


def without_templates(statement):
    """The statement without template arguments, innermost first."""
    while True:
        shorter = re.sub(r"<[^<>;]*>", "", statement)
        if shorter == statement:
            return statement
        statement = shorter


def statements_of(body):
    """Statements of a class body, blocks as {}; a function's ends with its block."""
    statement, at = "", 0
    while at < len(body):
        if body[at] == "{":
            end = block_end(body, at)
            statement += "{}"
            at = end
            is_type = re.match(r"\s*(?:class|struct|union|enum)\b", statement)
            is_function = "(" in without_templates(statement.split("=")[0])
            if is_function and not is_type and not re.match(r"\s*[;,]", body[at:]):
                yield statement
                statement = ""
            continue
        if body[at] == ";":
            yield statement
            statement = ""
        else:
            statement += body[at]
        at += 1


def members_in(statement):
    """Number of data members that a statement declares."""
    statement = re.sub(r"\b(?:public|private|protected)\s*:(?!:)", " ", statement).strip()
    if re.match(r"(?:using|typedef|friend|static|template|enum\b[^}]*$|class\b[^}]*$|explicit|virtual)\b", statement):
        return 0
    if re.match(r"(?:class|struct|union|enum)\b", statement):
        return len(re.findall(r"\w+", statement.split("}")[-1]))  # names behind a type of its own
    statement = without_templates(statement).replace("[[nodiscard]]", "")
    statement = re.sub(r"\{\}", "", statement)
    if re.match(r"[^=]*\(", statement) or "operator" in statement:
        return 0
    statement = re.sub(r"\([^()]*\)", "", statement)
    declarators = statement.split(",")
    named = re.match(r"[\w:&*\s]+[\s&*]\w+\s*(?:\[[^\]]*\]\s*)*(?:=|:|$)", declarators[0].strip())
    return len(declarators) if named else 0


def count_members(text):
    """Data members of each class in a header, by name; nested ones as Outer::Inner."""
    found = {}

    def scan(text, prefix):
        pattern = r"\b(?:class|struct)\s+(?:alignas\([^)]*\)\s*)?(\w+)\s*(?:final\s*)?(?::[^;{()]*)?\{"
        at = 0
        while match := re.compile(pattern).search(text, at):
            end = block_end(text, match.end() - 1)
            if not re.search(r"\benum\s*$", text[: match.start()]):
                body = text[match.end() : end - 1]
                name = prefix + match[1]
                found[name] = sum(members_in(statement) for statement in statements_of(body))
                scan(body, name + "::")
            at = end

    scan(without_comments(text), "")
    return found


def count_all(server):
    """(members, "file: class") of every class of the headers below a folder."""
    counts = []
    for header in sorted(server.rglob("*.h")):
        for name, members in count_members(header.read_text()).items():
            counts.append((members, f"{header.relative_to(server).as_posix()}: {name}"))
    return sorted(counts, key=lambda count: (-count[0], count[1]))


def find_violations(counts, known):
    """Lines of what has more members than it may, and of what is known to and has not."""
    too_many = {name: members for members, name in counts if members > most}
    lines = [
        f"{name}: {members} data members, {most} are enough"
        for name, members in too_many.items()
        if name.split(": ")[1] not in known
    ]
    found = {name.split(": ")[1] for name in too_many}
    return lines + [f"{name}: is small enough, take it off the list" for name in sorted(known - found)]


def main(arguments):
    folders = [argument for argument in arguments if argument != "--all"]
    server = Path(folders[0]) if folders else Path(__file__).resolve().parent.parent / "server"
    counts = count_all(server)
    for members, name in counts:
        if "--all" in arguments or members > most:
            print(f"{members:4} {name}")
    violations = find_violations(counts, larger)
    print("\n".join([*violations, f"classes: {len(violations)} to look at"]))
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
