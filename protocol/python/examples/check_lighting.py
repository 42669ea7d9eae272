#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Regression check of a lighting model in CI: measures work planes, and compares them with what is required.

requirements.json: [{"name": "desk", "plane": [[x,y,z],[x,y,z],[x,y,z]], "mean": 500, "uniformity": 0.6}, ...]
(lx; corner and two edges in metres). A requirement is met where the whole 95 % interval is above it, missed where it is
below; where the interval holds it, more accuracy is asked for, down to --error. Exit status as of `raybundle measure`:
0 all met, 1 failed (no server, no answer), 2 bad usage, 5 some missed, 6 none missed, some not known well enough.
"""
import argparse
import asyncio
import json
import sys

import raybundle

MET, FAILED, MISSED, UNKNOWN = 0, 1, 5, 6  # exit statuses


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
                word = {MET: "met", MISSED: "missed", UNKNOWN: "not known"}[verdicts[quantity]]
                line = f"{quantity} {getattr(found, quantity):.3g} [{low:.3g}, {high:.3g}], required {wanted[quantity]}"
                if UNKNOWN not in verdicts.values() or error <= finest:
                    print(f"{wanted['name']}: {line}: {word}", flush=True)
        worst = MISSED if MISSED in verdicts.values() else max(verdicts.values(), default=MET)
        if worst != UNKNOWN or error <= finest:
            return worst
        error = max(error / 2, finest)


async def run(options, requirements):
    async with await raybundle.connect(options.server, name="lighting check", viewport=(64, 48)) as client:
        results = [await check(client, wanted, options.error) for wanted in requirements]
    return MISSED if MISSED in results else max(results, default=MET)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server")
    parser.add_argument("requirements")
    parser.add_argument("--error", type=float, default=0.02, help="finest relative error that is waited for")
    options = parser.parse_args()
    try:
        with open(options.requirements, encoding="utf-8") as file:
            requirements = json.load(file)
    except (OSError, ValueError) as error:
        parser.error(f"{options.requirements}: {error}")
    try:
        return asyncio.run(run(options, requirements))
    except (OSError, raybundle.RaybundleError) as error:
        print(f"failed: {error}", file=sys.stderr)
        return FAILED


if __name__ == "__main__":
    sys.exit(main())
