# SPDX-License-Identifier: Apache-2.0
"""What one can ask of a server, each by a method with types."""
from __future__ import annotations

import asyncio
from datetime import datetime
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from . import messages
from .frames import Frame
from .snapshots import Snapshot, fetch
from .scene_state import Key, SceneState
from .vectors import Numbers, optional_vec3, transform, vec3


# Seconds without another picture, after which the last one is the best that there is.
_PICTURE_PAUSE = 2.0


class Requests:
    """Mixed into Client. Objects, lights and materials are named by their number or their name (KeyError where there
    is none). All methods raise RequestRefused where the server refuses, ConnectionClosed where the answer is lost."""

    request: Callable[..., Any]
    begin_request: Callable[..., Any]
    wait_for: Callable[..., Any]
    state: SceneState
    scene: Any
    epoch: int
    frame: Optional[Frame]
    solution: Any
    address: str
    token: str
    ssl: Any

    # ------------------------------------------------------------------ camera and pictures

    async def set_camera(self, eye: Numbers, target: Numbers, up: Numbers = (0, 1, 0),
                         vertical_fov: Optional[float] = None, near: Optional[float] = None) -> None:
        """Metres; vertical_fov in radians (absent: unchanged); near: what is nearer is cut away, metres."""
        await self.request(set_camera=messages.SetCamera(eye=vec3(eye), target=vec3(target), up=vec3(up),
                                                         vertical_fov=vertical_fov, near=near))

    async def use_camera(self, name: str) -> None:
        """Goes to a camera of the scene. Raises KeyError."""
        for camera in self.scene.cameras:
            if camera.name == name:
                await self.request(set_camera=messages.SetCamera(eye=camera.eye, target=camera.target, up=camera.up,
                                                                 vertical_fov=camera.vertical_fov))
                return
        raise KeyError(f"no camera {name!r}; there are {', '.join(c.name for c in self.scene.cameras)}")

    async def set_viewport(self, width: int, height: int) -> tuple[int, int]:
        """Pixels; returns the size that is served."""
        answer = await self.request(set_viewport=messages.SetViewport(width=width, height=height))
        served = answer.ok.viewport
        return (served.width, served.height) if answer.ok.HasField("viewport") else (width, height)

    async def set_display(self, mode: Optional[str] = None, **fields: Any) -> None:
        """mode: PHOTO, FALSE_LUMINANCE, FALSE_ILLUMINANCE; fields as in messages.SetDisplay (exposure, isolines ...)."""
        value = None if mode is None else messages.SetDisplay.Mode.Value(mode)
        await self.request(set_display=messages.SetDisplay(mode=value, **fields))

    async def picture(self, timeout: Optional[float] = None) -> Frame:
        """The next picture that shows the present camera and all changes made so far; the last one where none
        comes for two seconds, since a server that has nothing better sends none. Raises asyncio.TimeoutError."""
        known, epoch = self.frame, self.epoch

        def fits() -> Optional[Frame]:
            frame = self.frame
            return frame if frame is not None and frame is not known and frame.header.epoch >= epoch else None
        pause = _PICTURE_PAUSE if timeout is None else min(timeout, _PICTURE_PAUSE)
        try:
            frame: Frame = await self.wait_for(fits, pause)
        except asyncio.TimeoutError:
            if known is not None and known.header.epoch >= epoch:
                return known
            frame = await self.wait_for(fits, None if timeout is None else timeout - pause)
        return frame

    async def settled(self, relative_error: float = 0.05, timeout: Optional[float] = None) -> Any:
        """Solves until the upper end of the 95 % interval of this viewer's picture is at most `relative_error`
        (of 1), for the scene with all changes so far. Returns messages.Solution; at once where next to no light arrives
        (darker_than), and where more samples would bring nothing more (target_out_of_reach). Raises
        asyncio.TimeoutError."""
        await self.request(set_target=messages.SetTarget(relative_error=relative_error))
        earlier, epoch = self.solution, self.epoch

        def reached() -> Any:
            solution = self.solution
            if solution is None or solution is earlier or solution.epoch < epoch:
                return None
            accurate = solution.HasField("error_high") and solution.error_high <= np.float32(relative_error)
            ends = accurate or solution.target_out_of_reach or solution.HasField("darker_than")
            return solution if ends else None
        return await self.wait_for(reached, timeout)

    async def snapshot(self, width: int = 1920, height: int = 1080, relative_error: float = 0.02,
                       format: str = "EXR", epoch: Optional[int] = None) -> Snapshot:
        """Renders the present camera off-screen until it is so accurate, and fetches it. format: EXR (linear, cd/m²)
        or PNG. epoch: the scene as it was after that change. Cancelling the task takes the request back."""
        body = messages.Snapshot(width=width, height=height, relative_error=relative_error,
                                 format=messages.Snapshot.Format.Value(format), epoch=epoch)
        number, answer = await self.begin_request(snapshot=body)
        try:
            ready = (await answer).snapshot_ready
        except asyncio.CancelledError:
            await self.request(cancel_snapshot=messages.CancelSnapshot(request=number))
            raise
        encoded = await asyncio.to_thread(fetch, self.address + ready.url, self.token, self.ssl)
        return Snapshot(ready, encoded)

    async def save_scene(self) -> bytes:
        """The scene as it is now, a GLB file with lights, photometry, groups and daylight in it."""
        return await asyncio.to_thread(fetch, self.address + "/scene.glb", self.token, self.ssl)

    # ------------------------------------------------------------------ changes

    async def move(self, thing: Key, translation: Optional[Numbers] = None, rotation: Optional[Numbers] = None,
                   scale: Optional[Union[Numbers, float]] = None) -> Any:
        """Places an object in its parent's space; what is absent stays. rotation: quaternion (x, y, z, w).
        Returns messages.SceneChanged."""
        known = self.state.object(thing)
        new, given = messages.Transform(), transform(translation, rotation, scale)
        new.CopyFrom(known.transform)
        for field, _ in given.ListFields():
            getattr(new, field.name).CopyFrom(getattr(given, field.name))
        body = messages.MoveObject(object=known.id, transform=new)
        return (await self.request(move_object=body)).scene_changed

    async def set_light(self, light: Key, *, intensity: Optional[float] = None, on: Optional[bool] = None,
                        colour: Optional[Numbers] = None, position: Optional[Numbers] = None,
                        aim: Optional[Numbers] = None, **fields: Any) -> Any:
        """intensity in the light's unit; position in metres; aim: direction; further fields as in messages.SetLight
        (flux lm, dim 0..1, rotation and cones in degrees, colour_temperature K, group; fade_seconds: its light takes so
        long to change, 0..60). Returns SceneChanged."""
        body = messages.SetLight(light=self.state.light(light).id, intensity=intensity, on=on,
                                 colour=optional_vec3(colour), position=optional_vec3(position),
                                 aim=optional_vec3(aim), **fields)
        return (await self.request(set_light=body)).scene_changed

    async def set_group(self, group: str, *, dim: Optional[float] = None, on: Optional[bool] = None,
                        lights: Sequence[Key] = (), fade_seconds: Optional[float] = None) -> None:
        """Dims or switches all lights of a group; `lights` belong to it from now on. fade_seconds: their light takes so
        long to change, 0..60. Returns when they are set, not when they are faded."""
        await self.request(set_group=messages.SetGroup(group=group, dim=dim, on=on, fade_seconds=fade_seconds,
                                                       lights=[self.state.light(key).id for key in lights]))

    async def save_lighting_scene(self, name: str) -> None:
        await self.request(save_lighting_scene=messages.SaveLightingScene(name=name))

    async def apply_lighting_scene(self, name: str, *, fade_seconds: Optional[float] = None) -> None:
        """fade_seconds: as of set_group."""
        await self.request(apply_lighting_scene=messages.ApplyLightingScene(name=name, fade_seconds=fade_seconds))

    async def set_material(self, material: Key, *, base_colour: Optional[Numbers] = None,
                           roughness: Optional[float] = None, metallic: Optional[float] = None) -> Any:
        """base_colour: linear Rec. 709, 0..1. Returns SceneChanged."""
        body = messages.SetMaterial(material=self.state.material(material).id, base_colour=optional_vec3(base_colour),
                                    roughness=roughness, metallic=metallic)
        return (await self.request(set_material=body)).scene_changed

    async def set_daylight(self, sky: Optional[str] = None, *, time: Union[str, datetime, None] = None,
                           place: Optional[tuple[float, float]] = None, sun_elevation: Optional[float] = None,
                           sun_azimuth: Optional[float] = None, **fields: Any) -> Any:
        """sky: overcast, intermediate, clear, cie-1 to cie-15, none, loaded. Either time (with its zone) and place
        (latitude, longitude in degrees), or the sun's angles in degrees. Returns SceneChanged."""
        if isinstance(time, datetime):
            if time.tzinfo is None:
                raise ValueError("time has no zone: datetime(..., tzinfo=...)")
            time = time.isoformat(timespec="seconds")
        where = None if place is None else messages.SetDaylight.Place(latitude=place[0], longitude=place[1])
        body = messages.SetDaylight(sky=sky, time=time, place=where, sun_elevation=sun_elevation,
                                    sun_azimuth=sun_azimuth, **fields)
        return (await self.request(set_daylight=body)).scene_changed

    async def undo(self, epoch: int) -> None:
        """Brings the scene back to what it was right after that change; 0: as loaded."""
        await self.request(undo=messages.Undo(epoch=epoch))

    async def changes(self) -> Sequence[Any]:
        """The last 1000 changes (SceneChanged), oldest first."""
        answer = await self.request(list_changes=messages.ListChanges())
        return list(answer.change_history.changes)

    # ------------------------------------------------------------------ measurements

    async def probe(self, origin: Numbers, direction: Numbers) -> Any:
        """Light where a ray meets the first surface: messages.ProbeResult."""
        ray = messages.Probe.Ray(origin=vec3(origin), direction=vec3(direction))
        return (await self.request(probe=messages.Probe(ray=ray))).probe_result

    async def measure(self, quantity: str = "HORIZONTAL", *, area: Optional[tuple[Numbers, Numbers, Numbers]] = None,
                      points: Sequence[Numbers] = (), grid: Optional[tuple[int, int]] = None,
                      direction: Optional[Numbers] = None, relative_error: Optional[float] = None,
                      **fields: Any) -> Any:
        """Light at points in the air: on an area (corner and two edges, metres) or at single points. grid: columns and
        rows; absent: as EN 12464-1 asks for. fields as in messages.Measure (direct, maintained, margin).
        Returns messages.Measured."""
        if (area is None) == (not points):
            raise ValueError("either an area or points")
        body = messages.Measure(quantity=messages.Measure.Quantity.Value(quantity), relative_error=relative_error,
                                direction=optional_vec3(direction),
                                points=[messages.Measure.Point(position=vec3(point)) for point in points], **fields)
        if area is not None:
            corner, u, v = area
            body.area.CopyFrom(messages.Measure.Area(origin=vec3(corner), u=vec3(u), v=vec3(v)))
            if grid is None:
                body.grid = messages.Measure.EN12464
            else:
                body.columns, body.rows = grid
        return (await self.request(measure=body)).measured

    # ------------------------------------------------------------------ reviews and scenes

    async def add_pin(self, text: str, position: Numbers, patch: int = 0) -> Any:
        """A note at a point; returns messages.PinChanged."""
        body = messages.AddPin(text=text, position=vec3(position), patch=patch)
        return (await self.request(add_pin=body)).pin_changed

    async def remove_pin(self, pin: int) -> None:
        await self.request(remove_pin=messages.RemovePin(pin=pin))

    async def scenes(self) -> Any:
        """messages.SceneList of the server's folder."""
        return (await self.request(list_scenes=messages.ListScenes())).scene_list

    async def open_scene(self, name: str) -> None:
        """Shows another scene to everybody; returns once this client has come back to it."""
        connections = getattr(self, "connections")
        await self.request(open_scene=messages.OpenScene(name=name))
        await self.wait_for(lambda: getattr(self, "connections") > connections)
