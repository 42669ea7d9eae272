# SPDX-License-Identifier: Apache-2.0
"""A session as a file: who changed what and when, pins, viewpoints and where people looked. One JSON object a line: first
what the scene was like, then each message of the server with its time, at last what the scene is like."""
from __future__ import annotations

import asyncio
import json
import time
from datetime import datetime, timezone
from typing import Any, IO, Iterator, Mapping, Optional

from google.protobuf import json_format

from . import messages
from .client import Client
from .errors import RaybundleError

FORMAT = "raybundle session 1"
#: What is recorded, by the bodies of ServerMessage.
RECORDED = ("scene_changed", "pin_changed", "viewpoint_changed", "lighting_scene_changed", "presence", "pointed")


def _plain(message: Any) -> Any:
    return json_format.MessageToDict(message)


def state_of(scene: Any) -> dict[str, Any]:
    """What changes can change of a scene, for comparisons: messages.Scene to plain values."""
    objects = {str(thing.id): _plain(thing.transform) for thing in scene.objects}
    lights = {str(light.id): {key: value for key, value in _plain(light).items() if not key.startswith("loaded")}
              for light in scene.lights}
    materials = {str(material.id): _plain(material) for material in scene.materials}
    return {"objects": objects, "lights": lights, "materials": materials}


def differences(one: Any, other: Any, path: str = "", tolerance: float = 1e-5) -> list[str]:
    """Places where two states differ, numbers by more than a relative tolerance; absent and 0 are the same."""
    if isinstance(one, Mapping) or isinstance(other, Mapping):
        one, other = one or {}, other or {}
        return [difference for key in sorted({*one, *other})
                for difference in differences(one.get(key), other.get(key), f"{path}.{key}".lstrip("."), tolerance)]
    numbers = all(value is None or isinstance(value, (int, float)) for value in (one, other))
    if numbers and not isinstance(one, bool) and not isinstance(other, bool):
        same = abs((one or 0) - (other or 0)) <= tolerance * max(abs(one or 0), abs(other or 0), 1.0)
    else:
        same = (one or None) == (other or None)
    return [] if same else [f"{path}: {one} and {other}"]


async def record(client: Client, file: IO[str], until: Optional[asyncio.Event] = None) -> None:
    """Writes what the server tells, until `until` is set or the connection ends for good. Changes of `client` itself
    are answers, and so are not in it: use a client that only listens."""
    begin = time.monotonic()

    def write(kind: str, body: Any) -> None:
        json.dump({"s": round(time.monotonic() - begin, 3), kind: body}, file, ensure_ascii=False)
        file.write("\n")
        file.flush()

    write("begin", {"format": FORMAT, "at": datetime.now(timezone.utc).isoformat(timespec="seconds"),
                    "scene": client.scene.name, "epoch": client.epoch, "state": state_of(client.scene)})
    stream = client.messages()
    waiting = asyncio.ensure_future(until.wait()) if until is not None else None
    try:
        while True:
            following = asyncio.ensure_future(stream.__anext__())
            tasks = {following, waiting} if waiting is not None else {following}
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            if following not in done:
                following.cancel()
                await asyncio.gather(following, return_exceptions=True)
                break
            try:
                message = following.result()
            except StopAsyncIteration:
                break
            body = message.WhichOneof("body")
            if body in RECORDED:
                write(body, _plain(getattr(message, body)))
    finally:
        if waiting is not None:
            waiting.cancel()
        write("end", {"epoch": client.epoch, "state": state_of(client.scene)})


def read(file: IO[str]) -> Iterator[tuple[float, str, Any]]:
    """Seconds, kind and body of each entry; a message of RECORDED as such. Raises RaybundleError, with the line, for what
    is no recording; a last line that was not written whole is left out."""
    for number, line in enumerate(file, 1):
        try:
            entry = json.loads(line)
            seconds = float(entry.pop("s"))
            ((kind, body),) = entry.items()
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            if not line.endswith("\n"):
                return
            raise RaybundleError(f"line {number}: is no entry of a recording") from error
        if number == 1 and (kind != "begin" or body.get("format") != FORMAT):
            raise RaybundleError(f"line 1: is not the beginning of a '{FORMAT}'")
        if kind in RECORDED:
            message = messages.ServerMessage()
            json_format.ParseDict({_camel(kind): body}, message, ignore_unknown_fields=True)
            body = getattr(message, kind)
        yield seconds, kind, body


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(part.capitalize() for part in others)


async def replay(client: Client, file: IO[str], speed: float = 0.0) -> list[str]:
    """Makes the recorded changes, pins and viewpoints again, with the pauses between them divided by speed (0: without
    pauses). Returns where the scene then differs from how it was at the end of the recording; nothing: it does not.
    Raises RequestRefused where a change cannot be made."""
    last = 0.0
    found: list[str] = []
    for seconds, kind, body in read(file):
        if speed > 0.0:
            await asyncio.sleep(max(seconds - last, 0.0) / speed)
        last = seconds
        if kind == "scene_changed":
            change = body.WhichOneof("change")
            request = getattr(body, change)
            if change == "set_daylight":
                del request.lights[:]
            if change == "move_object":
                request.ClearField("final")
            await client.request(**{change: request})
        elif kind == "pin_changed" and not body.removed and not body.HasField("change"):
            if body.text not in [pin.text for pin in client.pins.values()]:
                await client.add_pin(body.text, (body.position.x, body.position.y, body.position.z))
        elif kind == "viewpoint_changed" and not body.removed:
            camera = body.camera
            await client.request(save_viewpoint=messages.SaveViewpoint(
                name=camera.name, eye=camera.eye, target=camera.target, up=camera.up,
                vertical_fov=camera.vertical_fov))
        elif kind == "end":
            found = differences(body["state"], state_of(client.scene))
    return found


_VERBS = {"move_object": "moved", "set_light": "changed", "set_material": "changed", "set_daylight": "set"}


def minutes(file: IO[str]) -> str:
    """What has happened, for people: Markdown."""
    lines: list[str] = []
    people: set[str] = set()
    for seconds, kind, body in read(file):
        clock = f"{int(seconds) // 60:3d}:{int(seconds) % 60:02d}"
        if kind == "begin":
            lines += [f"# {body['scene']}, {body['at']}", ""]
        elif kind == "presence":
            for viewer in body.viewers:
                if viewer.name not in people:
                    people.add(viewer.name)
                    lines.append(f"* {clock} {viewer.name or 'somebody'} is here")
        elif kind == "scene_changed":
            change = body.WhichOneof("change")
            subject = getattr(body, change)
            number = next((getattr(subject, name) for name in ("object", "light", "material")
                           if hasattr(subject, name)), "")
            noun = change.split("_")[1]
            lines.append(f"* {clock} {body.by_name or 'somebody'} {_VERBS.get(change, 'changed')} {noun} {number}".rstrip()
                         + f" (change {body.epoch})")
        elif kind == "pin_changed" and not body.removed and not body.HasField("change"):
            lines.append(f"* {clock} {body.by_name or 'somebody'}: {body.text} ({body.illuminance:.0f} lx)")
        elif kind == "viewpoint_changed" and not body.removed:
            lines.append(f"* {clock} viewpoint: {body.camera.name}")
        elif kind == "lighting_scene_changed" and not body.removed:
            lines.append(f"* {clock} {body.by_name or 'somebody'} saved the lighting scene {body.name}")
    return "\n".join(lines) + "\n"
