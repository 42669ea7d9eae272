#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Time-lapse of a day: one picture an hour, each once the light is accurate enough; numbered files for a film.

    day_time_lapse.py 127.0.0.1:8080 --place 52.52,13.4 --date 2026-06-21 --zone 2 -o lapse
    ffmpeg -framerate 12 -i lapse/%03d.jpg day.mp4
"""
import argparse
import asyncio
from datetime import date, datetime, time, timedelta, timezone
from pathlib import Path

import raybundle


async def record(options):
    options.output.mkdir(parents=True, exist_ok=True)
    zone = timezone(timedelta(hours=options.zone))
    place = tuple(float(part) for part in options.place.split(","))
    moment = datetime.combine(options.date, time(options.begin), zone)
    count = int((options.end - options.begin) * 60 / options.minutes) + 1
    async with await raybundle.connect(options.server, name="time-lapse", viewport=options.size,
                                       codecs=["JPEG"]) as client:
        before = client.epoch
        if options.camera:
            await client.use_camera(options.camera)
        try:
            for number in range(count):
                changed = await client.set_daylight(options.sky, time=moment, place=place)
                await client.settled(options.error)
                frame = await client.picture()
                (options.output / f"{number:03d}.jpg").write_bytes(frame.encoded)
                print(f"{moment:%H:%M} sun {changed.set_daylight.sun_elevation:.0f} degrees high, "
                      f"exposure {frame.header.exposure:.1f} EV", flush=True)
                moment += timedelta(minutes=options.minutes)
        finally:
            await client.undo(before)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server")
    parser.add_argument("--place", required=True, metavar="LAT,LON")
    parser.add_argument("--date", type=date.fromisoformat, default=date.today())
    parser.add_argument("--zone", type=float, default=0.0, help="hours ahead of UTC")
    parser.add_argument("--begin", type=int, default=5, help="hour")
    parser.add_argument("--end", type=int, default=22, help="hour")
    parser.add_argument("--minutes", type=float, default=60.0, help="between pictures")
    parser.add_argument("--sky", default="clear")
    parser.add_argument("--camera")
    parser.add_argument("--error", type=float, default=0.05)
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(800, 600))
    parser.add_argument("-o", "--output", type=Path, default=Path("lapse"))
    asyncio.run(record(parser.parse_args()))


if __name__ == "__main__":
    main()
