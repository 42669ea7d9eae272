# SPDX-License-Identifier: Apache-2.0
"""The scene as a client knows it: what the welcome said, with every change since."""
from __future__ import annotations

from typing import Any, Iterable, Union

from . import messages

Key = Union[int, str]

_LIGHT_FIELDS = ("intensity", "on", "rotation", "maintenance_factor", "group", "dim", "inner_cone", "outer_cone")
_LIGHT_MESSAGES = ("colour", "position", "aim")


def find(entries: Iterable[Any], key: Key, kind: str) -> Any:
    """The entry with that number, or that name. Raises KeyError where there is none, or several of the name."""
    entries = list(entries)
    found = [entry for entry in entries if key == (entry.id if isinstance(key, int) else entry.name)]
    if len(found) == 1:
        return found[0]
    if found:
        raise KeyError(f"{len(found)} {kind}s have the name {key!r}: use a number, "
                       f"one of {', '.join(str(entry.id) for entry in found)}")
    known = ", ".join(f"{entry.id} {entry.name!r}" for entry in entries[:20])
    raise KeyError(f"no {kind} {key!r}; there are {known}")


def _put(entries: Any, news: Iterable[Any]) -> None:
    """Takes in entries as they are now: in the place of those of their numbers, else at the end."""
    for new in news:
        known = [entry for entry in entries if entry.id == new.id]
        (known[0] if known else entries.add()).CopyFrom(new)


def _drop(entries: Any, number: int) -> None:
    for place, entry in enumerate(entries):
        if entry.id == number:
            del entries[place]
            return


class SceneState:
    """Follows SceneChanged messages. `scene` is the message of the welcome, brought up to date."""

    def __init__(self, welcome: messages.Welcome) -> None:
        self.scene: Any = messages.Scene()
        self.scene.CopyFrom(welcome.scene)
        self.epoch = welcome.epoch

    def object(self, key: Key) -> Any:
        return find(self.scene.objects, key, "object")

    def light(self, key: Key) -> Any:
        return find(self.scene.lights, key, "light")

    def material(self, key: Key) -> Any:
        return find(self.scene.materials, key, "material")

    def apply(self, changed: messages.SceneChanged) -> None:
        """Takes in a change; one of a number that is known already changes nothing."""
        if changed.epoch <= self.epoch:
            return
        self.epoch = changed.epoch
        kind = changed.WhichOneof("change")
        if kind is not None and hasattr(self, f"_{kind}"):
            getattr(self, f"_{kind}")(getattr(changed, kind))
        for name in ("objects", "lights", "materials"):
            _put(getattr(self.scene, name), getattr(changed, name))

    def _remove_object(self, removal: Any) -> None:
        _drop(self.scene.objects, removal.object)

    def _remove_light(self, removal: Any) -> None:
        _drop(self.scene.lights, removal.light)
        self._group_lights()

    def _move_object(self, move: Any) -> None:
        for entry in self.scene.objects:
            if entry.id == move.object:
                entry.transform.CopyFrom(move.transform)

    def _set_light(self, change: Any) -> None:
        for light in self.scene.lights:
            if light.id == change.light:
                for name in _LIGHT_FIELDS:
                    if change.HasField(name):
                        setattr(light, name, getattr(change, name))
                for name in _LIGHT_MESSAGES:
                    if change.HasField(name):
                        getattr(light, name).CopyFrom(getattr(change, name))
        self._group_lights()

    def _set_material(self, change: Any) -> None:
        for material in self.scene.materials:
            if material.id == change.material:
                if change.HasField("base_colour"):
                    material.base_colour.CopyFrom(change.base_colour)
                for name in ("roughness", "metallic"):
                    if change.HasField(name):
                        setattr(material, name, getattr(change, name))

    def _set_daylight(self, daylight: Any) -> None:
        self.scene.daylight.CopyFrom(daylight)
        del self.scene.daylight.lights[:]
        if daylight.lights:
            kept = [light for light in self.scene.lights if light.id < daylight.lights[0].id]
            lights = [*kept, *daylight.lights]
            copies = [messages.Light() for _ in lights]
            for copy, light in zip(copies, lights):
                copy.CopyFrom(light)
            del self.scene.lights[:]
            self.scene.lights.extend(copies)

    def _group_lights(self) -> None:
        groups: dict[str, list[int]] = {}
        for light in self.scene.lights:
            if light.group:
                groups.setdefault(light.group, []).append(light.id)
        del self.scene.groups[:]
        for name in sorted(groups):
            self.scene.groups.add(name=name, lights=groups[name])
