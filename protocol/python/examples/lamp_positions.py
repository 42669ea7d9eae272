#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Parameter study: where should a lamp hang? Moves it along a line, measures a work plane at each place, plots.

    lamp_positions.py 127.0.0.1:8080 lamp --from 1,2.4,2 --to 4,2.4,2 --steps 7 --plane 0.5,0.75,0.5 4,0,0 0,0,3
"""
import argparse
import asyncio

import numpy as np

import raybundle


def vector(text):
    return np.array([float(part) for part in text.split(",")])


async def study(options):
    async with await raybundle.connect(options.server, name="lamp positions", viewport=(64, 48)) as client:
        before = client.epoch
        rows = []
        try:
            for share in np.linspace(0.0, 1.0, options.steps):
                place = options.begin + share * (options.end - options.begin)
                await client.set_light(options.lamp, position=place)
                found = await client.measure(area=options.plane, relative_error=options.error)
                rows.append((np.linalg.norm(place - options.begin), found))
                print(f"{np.round(place, 2)} m: {found.mean:.0f} lx, uniformity {found.uniformity:.2f}", flush=True)
        finally:
            await client.undo(before)  # the scene is as it was
    return rows


def plot(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    place = [distance for distance, _ in rows]
    figure, (upper, lower) = pyplot.subplots(2, 1, sharex=True, layout="constrained")
    upper.plot(place, [found.mean for _, found in rows], marker="o")
    upper.fill_between(place, [found.mean_low for _, found in rows], [found.mean_high for _, found in rows], alpha=0.3)
    upper.set_ylabel("mean illuminance, lx")
    lower.plot(place, [found.uniformity for _, found in rows], marker="o")
    lower.set(ylabel="uniformity", xlabel="lamp along its line, m", ylim=(0, 1))
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server")
    parser.add_argument("lamp", type=lambda text: int(text) if text.isdigit() else text)
    parser.add_argument("--from", dest="begin", type=vector, required=True, metavar="X,Y,Z")
    parser.add_argument("--to", dest="end", type=vector, required=True, metavar="X,Y,Z")
    parser.add_argument("--steps", type=int, default=7)
    parser.add_argument("--plane", type=vector, nargs=3, required=True, metavar="X,Y,Z", help="corner and two edges")
    parser.add_argument("--error", type=float, default=0.05)
    parser.add_argument("-o", "--output", default="lamp_positions.svg")
    options = parser.parse_args()
    plot(asyncio.run(study(options)), options.output)


if __name__ == "__main__":
    main()
