# SPDX-License-Identifier: Apache-2.0
"""Puts the building together: meshes that many nodes use, lamps of IES files, panels that emit."""

from __future__ import annotations

import math

from .. import gltf
from ..effects import _downlight
from ..normals import Primitive, append_solid
from ..shapes import box
from ..solid import Camera, Light, Material, SceneModel, SceneObject, Vec
from .building import BAY, CLEAR, CORRIDOR, DEPTH, STOREY, WALL, Plan, partitions, roof, shell, stairs
from .furniture import chair, desk, door, shelf, table

PANEL = 0.3  # m: half of a panel's edge
MATERIALS = [
    Material("plaster", (0.75, 0.74, 0.72)), Material("concrete", (0.45, 0.45, 0.44)),
    Material("carpet", (0.16, 0.18, 0.22)), Material("partition", (0.7, 0.7, 0.68)),
    Material("desk", (0.55, 0.42, 0.28)), Material("cabinet", (0.6, 0.6, 0.6)),
    Material("door", (0.35, 0.22, 0.12)), Material("metal", (0.35, 0.35, 0.36)),
    Material("plastic", (0.05, 0.05, 0.055)), Material("keys", (0.12, 0.12, 0.12)),
    Material("screen", (0.02, 0.02, 0.025)), Material("paper", (0.8, 0.8, 0.78)),
    Material("mug", (0.6, 0.12, 0.1)), Material("fabric", (0.1, 0.14, 0.25)),
    Material("folder blue", (0.08, 0.15, 0.4)), Material("folder red", (0.45, 0.08, 0.07)),
]
PANEL_FLUX = 3600.0  # lm
LAMP_STEP, PANEL_STEP = 1.8, 2.7  # m: between lamps, between panels


class _Building:
    """The document while it grows."""

    def __init__(self, name: str, materials: list[Material]) -> None:
        self.model = SceneModel(name=name, materials=materials, objects=[], cameras=[])
        self.document = gltf._Document(self.model)
        self.sizes: dict[int, int] = {}  # triangles of the meshes
        self.triangles = self.objects = 0

    def mesh(self, thing: SceneObject) -> int:
        primitives: dict[str, Primitive] = {}
        for solid in thing.solids:
            append_solid(primitives, solid, 0.0)
        ordered = sorted(primitives, key=self.document.material_index.__getitem__)
        mesh = self.document.append("meshes", {
            "name": thing.name, "primitives": [
                gltf._primitive_json(self.document, name, primitives[name]) for name in ordered]})
        self.sizes[mesh] = sum(len(p.indices) // 3 for p in primitives.values())
        return mesh

    def node(self, mesh: int, name: str, at: Vec, turn: float = 0.0, movable: bool = False) -> int:
        """turn: degrees about Y."""
        node: dict[str, object] = {"name": name, "mesh": mesh, "translation": list(at),
                                   "extras": {"movable": movable}}
        if turn:
            half = math.radians(turn) / 2
            node["rotation"] = [0.0, round(math.sin(half), 9), 0.0, round(math.cos(half), 9)]
        self.triangles += self.sizes[mesh]
        self.objects += 1
        return self.document.append("nodes", node)


def _steps(begin: float, end: float, step: float) -> list[float]:
    """Places in the middle of parts of about `step`."""
    count = max(1, round((end - begin) / step))
    return [begin + (end - begin) * (k + 0.5) / count for k in range(count)]


def _workplaces(plan: Plan) -> list[tuple[float, float, float]]:
    """x, z and turn of the desks: pairs of rows face each other."""
    result = []
    for x in _steps(0.6, plan.length - 0.6, 1.85):
        for z, turn in ((1.6, 180.0), (2.45, 0.0), (5.9, 180.0), (6.75, 0.0), (20.2, 180.0),
                        (21.05, 0.0)):
            near_column = abs(z - 5.0) < 1.0 or abs(z - 19.0) < 1.0
            if near_column and abs(x / BAY - round(x / BAY)) < 0.22:
                continue
            result.append((x, z, turn))
    return result


def _furnish(building: _Building, plan: Plan, floor: int, meshes: dict[str, int]) -> list[int]:
    y = STOREY * floor
    nodes = []
    for k, (x, z, turn) in enumerate(_workplaces(plan)):
        away = 0.85 if turn == 0.0 else -0.85
        number = f"{floor + 1}.{k + 1}"
        nodes.append(building.node(meshes["desk"], f"desk {number}", (x, y, z), turn))
        nodes.append(building.node(meshes["chair"], f"chair {number}", (x, y, z + away),
                                   turn + 17.0 * (k % 5 - 2), True))
    for k in range(plan.rooms):
        left = BAY * k
        number = f"{floor + 1}.{k + 1}"
        nodes.append(building.node(meshes["door"], f"door {number}",
                                   (left + 0.5, y, CORRIDOR[1] + WALL / 2),
                                   0.0 if k % 2 else -80.0, True))
        nodes.append(building.node(meshes["table"], f"table {number}",
                                   (left + BAY / 2, y, CORRIDOR[1] + 2.6)))
        for n in range(4):
            angle = math.pi / 2 * n + 0.4
            nodes.append(building.node(
                meshes["chair"], f"chair {number} at the table {n + 1}",
                (left + BAY / 2 + 0.95 * math.cos(angle), y,
                 CORRIDOR[1] + 2.6 + 0.95 * math.sin(angle)),
                90.0 - math.degrees(angle), True))
    for k, x in enumerate(_steps(0.3, plan.length - 0.3, 3.6)):
        if x < plan.rooms * BAY - 0.6:  # along the corridor's wall
            nodes.append(building.node(meshes["shelf"], f"shelf {floor + 1}.{k + 1}",
                                       (x, y, CORRIDOR[0] - WALL - 0.19), 180.0))
    return nodes


def _light(building: _Building, plan: Plan, floor: int, lamps: list[dict[str, object]]) -> list[int]:
    """Downlights in rows; panels in rows between them, of one material for each quarter of the floor."""
    y = STOREY * floor
    nodes = []
    count = 0
    columns = [(x, z) for x in _steps(0, plan.length, LAMP_STEP)
               for z in _steps(0, DEPTH, DEPTH / 13)]
    for x, z in columns:
        count += 1
        at = [round(x, 4), round(y + CLEAR - 0.12, 4), round(z, 4)]
        nodes.append(building.document.append("nodes", {
            "name": f"downlight {floor + 1}.{count}", "translation": at,
            "rotation": gltf._rotation_along((0.0, -1.0, 0.0)),
            "extensions": {"EXT_lights_ies": {"light": 0, "multiplier": 1.0}}}))
        lamps.append({})
    places = [(x, z) for x in _steps(0, plan.length, PANEL_STEP)
              for z in _steps(0, DEPTH, DEPTH / 10)]
    for quarter in range(4):
        own = [(x, z) for x, z in places
               if (2 * x > plan.length) + 2 * (2 * z > DEPTH) == quarter]
        name = f"panels {floor + 1}.{quarter + 1}"
        solids = []
        for x, z in own:
            solid = box((x - PANEL, CLEAR - 0.05, z - PANEL), (x + PANEL, CLEAR - 0.005, z + PANEL),
                        "metal")
            solid.face_materials = {2: name}
            solids.append(solid)
        mesh = building.mesh(SceneObject(name, solids))
        nodes.append(building.node(mesh, name, (0.0, y, 0.0)))
    return nodes


def office(floors: int, name: str, daylight: bool) -> tuple[dict[str, bytes], dict[str, int]]:
    """Files of the building, and what is in it. floors 0: a small one."""
    plan = Plan(bays=1 if floors == 0 else 10)
    floors = max(floors, 1)
    panels_of = {f"panels {f + 1}.{q + 1}": 0 for f in range(floors) for q in range(4)}
    luminance = PANEL_FLUX / (math.pi * (2 * PANEL) ** 2)
    materials = MATERIALS + [Material(panel, (0.0, 0.0, 0.0), luminance=luminance)
                             for panel in panels_of]
    building = _Building(name, materials)
    document = building.document
    for material in materials:
        document.append("materials", gltf._material_json(document, material, 1.0))
    meshes = {thing.name: building.mesh(thing)
              for thing in (desk(), chair(), shelf(), table(), door())}
    nodes: list[int] = []
    lamps: list[dict[str, object]] = []
    for floor in range(floors):
        for thing in (shell(plan, floor), partitions(plan, floor), stairs(plan, floor)):
            nodes.append(building.node(building.mesh(thing), thing.name, thing.translation))
        nodes += _furnish(building, plan, floor, meshes)
        nodes += _light(building, plan, floor, lamps)
    top = roof(plan, floors)
    nodes.append(building.node(building.mesh(top), top.name, top.translation))
    for camera in (
            Camera("open plan", (0.8, 1.65, 9.5), (plan.length * 0.6, 1.0, 2.0), 60.0, 16 / 9),
            Camera("corridor", (0.6, 1.65, 12.0), (plan.length, 1.4, 12.0), 60.0, 16 / 9),
            Camera("room", (BAY - 0.6, 1.65, CORRIDOR[1] + WALL + 0.5),
                   (0.5, 0.8, CORRIDOR[1] + 3.5), 70.0, 16 / 9)):
        nodes.append(gltf._add_camera(document, camera))
    document.extensions.add("EXT_lights_ies")
    document.json["extensions"] = {
        "EXT_lights_ies": {"lights": [{"name": "downlight", "uri": f"{name}.ies"}]}}
    scene: dict[str, object] = {"name": name, "nodes": nodes}
    if daylight:
        scene["extras"] = {"raybundle": {"daylight": {"sky": "overcast",
                                                      "zenithLuminance": 4092.6}}}
    document.append("scenes", scene)
    document.append("buffers", {"uri": f"{name}.bin", "byteLength": len(document.binary)})
    files = {f"{name}.bin": bytes(document.binary), f"{name}.ies": _downlight(),
             f"{name}.gltf": gltf._json_text(document).encode("utf-8")}
    panels = floors * len(_steps(0, plan.length, PANEL_STEP)) * 10
    return files, {"triangles": building.triangles, "objects": building.objects,
                   "lamps": len(lamps), "panels": panels}
