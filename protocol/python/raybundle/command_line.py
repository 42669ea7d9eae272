# SPDX-License-Identifier: Apache-2.0
"""raybundle-client: one request to a server from a shell. Answers are JSON on the standard output."""
from __future__ import annotations

import argparse
import asyncio
import json
import os
import sys
from pathlib import Path
from typing import Any, Awaitable, Callable, Optional, Sequence

from google.protobuf import json_format

from . import messages, recording
from .client import Client, connect
from .errors import RaybundleError

TOKEN_VARIABLE = "RAYBUNDLE_TOKEN"
EXIT_REFUSED, EXIT_USAGE, EXIT_NO_SERVER, EXIT_TIMEOUT = 1, 2, 3, 4

Command = Callable[[Client, argparse.Namespace], Awaitable[None]]


def _print(message: Any) -> None:
    print(json_format.MessageToJson(message, indent=2, ensure_ascii=False))


def _numbers(text: str) -> tuple[float, float, float]:
    x, y, z = (float(part) for part in text.split(","))
    return x, y, z


def _key(text: str) -> int | str:
    return int(text) if text.isdigit() else text


def _size(text: str) -> tuple[int, int]:
    width, height = (int(part) for part in text.split("x"))
    return width, height


async def _look(client: Client, wanted: argparse.Namespace) -> None:
    if wanted.camera is not None:
        await client.use_camera(wanted.camera)
    elif wanted.eye is not None and wanted.target is not None:
        await client.set_camera(wanted.eye, wanted.target)


async def _info(client: Client, _: argparse.Namespace) -> None:
    _print(client.welcome)


async def _picture(client: Client, wanted: argparse.Namespace) -> None:
    await _look(client, wanted)
    if wanted.error is not None:
        await client.settled(wanted.error, wanted.timeout)
    frame = await client.picture(wanted.timeout)
    Path(wanted.output).write_bytes(frame.encoded)
    _print(frame.header)


async def _snapshot(client: Client, wanted: argparse.Namespace) -> None:
    await _look(client, wanted)
    width, height = wanted.size
    kind = "EXR" if wanted.output.endswith(".exr") else "PNG"
    shot = await asyncio.wait_for(client.snapshot(width, height, wanted.error or 0.05, kind), wanted.timeout)
    Path(wanted.output).write_bytes(shot.encoded)
    _print(shot.ready)


async def _save(client: Client, wanted: argparse.Namespace) -> None:
    Path(wanted.output).write_bytes(await client.save_scene())


async def _settle(client: Client, wanted: argparse.Namespace) -> None:
    await _look(client, wanted)
    _print(await client.settled(wanted.error or 0.05, wanted.timeout))


async def _move(client: Client, wanted: argparse.Namespace) -> None:
    _print(await client.move(wanted.object, wanted.to))


async def _light(client: Client, wanted: argparse.Namespace) -> None:
    on = None if wanted.on is None else wanted.on == "on"
    fields = {name: getattr(wanted, name) for name in ("flux", "dim", "rotation", "colour_temperature", "group")}
    _print(await client.set_light(wanted.light, on=on, intensity=wanted.intensity, position=wanted.position,
                                  aim=wanted.aim, **fields))


async def _daylight(client: Client, wanted: argparse.Namespace) -> None:
    place = None if wanted.place is None else tuple(float(part) for part in wanted.place.split(","))
    _print(await client.set_daylight(wanted.sky, time=wanted.time, place=place,  # type: ignore[arg-type]
                                     sun_elevation=wanted.elevation, sun_azimuth=wanted.azimuth))


async def _measure(client: Client, wanted: argparse.Namespace) -> None:
    area = None if wanted.plane is None else tuple(_numbers(part) for part in wanted.plane)
    grid = None if wanted.grid is None else _size(wanted.grid)
    _print(await client.measure(wanted.quantity, area=area, points=wanted.point or (),  # type: ignore[arg-type]
                                grid=grid, relative_error=wanted.error, direction=wanted.direction))


async def _send(client: Client, wanted: argparse.Namespace) -> None:
    message = json_format.Parse(wanted.message, messages.ClientMessage())
    name = message.WhichOneof("body")
    if name is None:
        raise ValueError("the message has no body")
    _print(await client.request(**{name: getattr(message, name)}))


async def _undo(client: Client, wanted: argparse.Namespace) -> None:
    await client.undo(wanted.epoch)
    print(json.dumps({"epoch": client.epoch}))


async def _changes(client: Client, _: argparse.Namespace) -> None:
    _print((await client.request(list_changes=messages.ListChanges())).change_history)


async def _watch(client: Client, _: argparse.Namespace) -> None:
    async for message in client.messages():
        print(json_format.MessageToJson(message, indent=None, ensure_ascii=False), flush=True)


async def _record(client: Client, wanted: argparse.Namespace) -> None:
    with open(wanted.file, "x", encoding="utf-8") as file:
        await recording.record(client, file)


async def _replay(client: Client, wanted: argparse.Namespace) -> None:
    with open(wanted.file, encoding="utf-8") as file:
        found = await recording.replay(client, file, wanted.speed)
    for difference in found:
        print(difference)
    if found:
        raise RaybundleError(f"the scene differs from the recorded one in {len(found)} places")


def _minutes(wanted: argparse.Namespace) -> None:
    with open(wanted.file, encoding="utf-8") as file:
        print(recording.minutes(file), end="")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="raybundle-client", description=__doc__,
        epilog=f"The token comes from the environment variable {TOKEN_VARIABLE}. Exit status: {EXIT_REFUSED} the "
        f"server refused, {EXIT_USAGE} wrong use, {EXIT_NO_SERVER} no server, {EXIT_TIMEOUT} not in time.")
    parser.add_argument("--server", action="append", metavar="ADDRESS",
                        help="HOST:PORT or address of the page; several: the first that answers "
                        "(default: 127.0.0.1:8080)")
    parser.add_argument("--name", default="raybundle-client", help="shown to others")
    parser.add_argument("--size", type=_size, default=(800, 600), metavar="WxH", help="of pictures, pixels")
    parser.add_argument("--timeout", type=float, default=None, metavar="S", help="how long to wait for light, s")
    commands = parser.add_subparsers(dest="command", required=True)

    def add(name: str, run: Command, text: str) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=text, description=text)
        command.set_defaults(run=run)
        return command

    def add_view(command: argparse.ArgumentParser) -> None:
        command.add_argument("--camera", help="name of a camera of the scene")
        command.add_argument("--eye", type=_numbers, metavar="X,Y,Z", help="m")
        command.add_argument("--target", type=_numbers, metavar="X,Y,Z", help="m")
        command.add_argument("--error", type=float, help="relative error to wait for, e.g. 0.02")

    add("info", _info, "what the server shows: objects, lights, materials, cameras")
    for name, run, text in (("picture", _picture, "saves the viewer's picture (JPEG or PNG)"),
                            ("snapshot", _snapshot, "renders off-screen and saves .exr or .png"),
                            ("settle", _settle, "waits until the light is as accurate as asked")):
        command = add(name, run, text)
        add_view(command)
        if name != "settle":
            command.add_argument("-o", "--output", required=True, metavar="FILE")
    save = add("save", _save, "saves the scene as it is now as a .glb file")
    save.add_argument("-o", "--output", required=True, metavar="FILE")
    move = add("move", _move, "moves an object")
    move.add_argument("object", type=_key, help="number or name")
    move.add_argument("to", type=_numbers, help="X,Y,Z in its parent's space, m")
    light = add("light", _light, "changes a light")
    light.add_argument("light", type=_key, help="number or name")
    light.add_argument("--on", choices=("on", "off"))
    for flag, text in (("--intensity", "in the light's unit"), ("--flux", "lm"), ("--dim", "0..1"),
                       ("--rotation", "degrees"), ("--colour-temperature", "K")):
        light.add_argument(flag, type=float, help=text)
    light.add_argument("--group")
    light.add_argument("--position", type=_numbers, metavar="X,Y,Z", help="m")
    light.add_argument("--aim", type=_numbers, metavar="X,Y,Z", help="direction")
    daylight = add("daylight", _daylight, "sets sky and sun")
    daylight.add_argument("sky", nargs="?", help="overcast, intermediate, clear, cie-1 to cie-15, none, loaded")
    daylight.add_argument("--time", help="2026-06-21T15:00:00+02:00")
    daylight.add_argument("--place", metavar="LAT,LON", help="degrees")
    daylight.add_argument("--elevation", type=float, help="of the sun, degrees")
    daylight.add_argument("--azimuth", type=float, help="of the sun, degrees from north over east")
    measure = add("measure", _measure, "measures light at points in the air")
    measure.add_argument("--quantity", default="HORIZONTAL")
    measure.add_argument("--plane", nargs=3, metavar="X,Y,Z", help="corner and two edges, m")
    measure.add_argument("--point", action="append", type=_numbers, metavar="X,Y,Z", help="m; may be repeated")
    measure.add_argument("--grid", metavar="COLUMNSxROWS", help="instead of EN 12464-1's")
    measure.add_argument("--direction", type=_numbers, metavar="X,Y,Z")
    measure.add_argument("--error", type=float, help="half of the 95 %% interval over the mean, e.g. 0.05")
    undo = add("undo", _undo, "brings the scene back to what it was after a change")
    undo.add_argument("epoch", type=int)
    add("changes", _changes, "who has changed what, and when")
    add("watch", _watch, "prints what the server tells, one line each, until interrupted")
    record = add("record", _record, "records the session to a file until interrupted")
    record.add_argument("file", help="must not exist")
    replay = add("replay", _replay, "makes what was recorded again; fails where the scene then differs from the recorded one")
    replay.add_argument("file")
    replay.add_argument("--speed", type=float, default=0.0, help="of the pauses between changes (default: without them)")
    text = commands.add_parser("minutes", help="prints what was recorded for people (needs no server)")
    text.add_argument("file")
    send = add("send", _send, "sends any message of the protocol, as JSON")
    send.add_argument("message", help='e.g. \'{"setTarget":{"seconds":10}}\'')
    return parser


async def _run(wanted: argparse.Namespace) -> None:
    token = os.environ.get(TOKEN_VARIABLE, "")
    async with await connect(wanted.server or "127.0.0.1:8080", name=wanted.name, token=token,
                             viewport=wanted.size) as client:
        await wanted.run(client, wanted)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    wanted = _parser().parse_args(arguments)
    try:
        if wanted.command == "minutes":
            _minutes(wanted)
        else:
            asyncio.run(_run(wanted))
    except RaybundleError as error:
        print(f"raybundle-client: {error}", file=sys.stderr)
        return EXIT_REFUSED
    except asyncio.TimeoutError:
        print("raybundle-client: not in time", file=sys.stderr)
        return EXIT_TIMEOUT
    except (FileExistsError, FileNotFoundError) as error:
        print(f"raybundle-client: {error.filename}: {error.strerror}", file=sys.stderr)
        return EXIT_USAGE
    except OSError as error:
        print(f"raybundle-client: no server: {error}", file=sys.stderr)
        return EXIT_NO_SERVER
    except (KeyError, ValueError, json_format.ParseError) as error:
        print(f"raybundle-client: {error.args[0] if error.args else error}", file=sys.stderr)
        return EXIT_USAGE
    except KeyboardInterrupt:
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
