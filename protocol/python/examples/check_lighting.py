#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Regression check of a lighting model in CI: measures work planes, and compares them with what is required.

requirements.json: [{"name": "desk", "plane": [[x,y,z],[x,y,z],[x,y,z]], "mean": 500, "uniformity": 0.6}, ...]
(lx; corner and two edges in metres). A requirement is met where the whole 95 % interval is above it, missed where it is
below; where the interval holds it, more accuracy is asked for, down to --error. Exit status: 0 all met, 1 some missed,
2 some not known well enough, 3 no server.
"""
import argparse
import asyncio
import json
import sys

import raybundle

MET, MISSED, UNKNOWN = 0, 1, 2


def judge(low, high, required):
    return MET if low >= required else MISSED if high < required else UNKNOWN


async def check(client, wanted, finest):
    error = 0.1
    while True:
        found = await client.measure(area=wanted["plane"], grid=wanted.get("grid"), relative_error=error)
        verdicts = {}
        for quantity in ("mean", "uniformity"):
            if quantity in wanted:
                low, high = getattr(found, f"{quantity}_low"), getattr(found, f"{quantity}_high")
                verdicts[quantity] = judge(low, high, wanted[quantity])
                word = ("met", "missed", "not known")[verdicts[quantity]]
                line = f"{quantity} {getattr(found, quantity):.3g} [{low:.3g}, {high:.3g}], required {wanted[quantity]}"
                if UNKNOWN not in verdicts.values() or error <= finest:
                    print(f"{wanted['name']}: {line}: {word}", flush=True)
        worst = MISSED if MISSED in verdicts.values() else max(verdicts.values(), default=MET)
        if worst != UNKNOWN or error <= finest:
            return worst
        error = max(error / 2, finest)


async def run(options):
    with open(options.requirements, encoding="utf-8") as file:
        requirements = json.load(file)
    async with await raybundle.connect(options.server, name="lighting check", viewport=(64, 48)) as client:
        results = [await check(client, wanted, options.error) for wanted in requirements]
    return MISSED if MISSED in results else max(results, default=MET)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server")
    parser.add_argument("requirements")
    parser.add_argument("--error", type=float, default=0.02, help="finest relative error that is waited for")
    try:
        return asyncio.run(run(parser.parse_args()))
    except OSError as error:
        print(f"no server: {error}", file=sys.stderr)
        return 3


if __name__ == "__main__":
    sys.exit(main())
