# SPDX-License-Identifier: Apache-2.0
"""Writes a SceneModel as glTF 2.0: deterministic bytes, one JSON line per element."""

from __future__ import annotations

import base64
import json
import math
import struct

from .normals import Primitive, append_solid
from .solid import Camera, Light, Material, SceneModel, SceneObject, Vec, sub, unit
from .surfaces import material_areas, radiance

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LIST_KEYS = ("scenes", "nodes", "meshes", "materials", "textures", "images", "samplers", "cameras",
             "accessors", "bufferViews", "buffers")


class _Document:
    """The JSON tree and the binary buffer while they grow."""

    def __init__(self, model: SceneModel) -> None:
        self.model = model
        self.binary = bytearray()
        self.json: dict[str, object] = {
            "asset": {"version": "2.0", "generator": "raybundle scenes/generate.py"},
            "scene": 0,
        }
        self.lists: dict[str, list[dict[str, object]]] = {key: [] for key in LIST_KEYS}
        self.extensions: set[str] = set()
        self.material_index = {m.name: i for i, m in enumerate(model.materials)}

    def append(self, key: str, element: dict[str, object]) -> int:
        self.lists[key].append(element)
        return len(self.lists[key]) - 1

    def add_accessor(self, values: list[tuple[float, ...]], component: int, kind: str,
                     target: int, with_bounds: bool = False) -> int:
        code = {FLOAT: "f", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I"}[component]
        flat = [c for value in values for c in value]
        data = struct.pack(f"<{len(flat)}{code}", *flat)
        view = self.append("bufferViews", {"buffer": 0, "byteOffset": len(self.binary),
                                           "byteLength": len(data), "target": target})
        self.binary += data + bytes(-len(data) % 4)
        accessor = {"bufferView": view, "componentType": component, "count": len(values),
                    "type": kind}
        if with_bounds:
            stored = list(struct.iter_unpack("<3f", data))
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        return self.append("accessors", accessor)


def _material_json(document: _Document, material: Material, area: float) -> dict[str, object]:
    pbr: dict[str, object] = {"metallicFactor": material.metallic,
                              "roughnessFactor": material.roughness or 1.0}
    names = sorted(document.model.textures)
    if material.texture:
        pbr["baseColorTexture"] = {"index": names.index(material.texture)}
    else:
        pbr["baseColorFactor"] = [*material.base_colour, 1.0]
    if material.reflectance_texture:
        pbr["metallicRoughnessTexture"] = {"index": names.index(material.reflectance_texture)}
    result: dict[str, object] = {"name": material.name, "pbrMetallicRoughness": pbr}
    if material.normal_texture:
        result["normalTexture"] = {"index": names.index(material.normal_texture)}
    if material.double_sided:
        result["doubleSided"] = True
    extensions: dict[str, object] = {}
    if material.unlit:
        extensions["KHR_materials_unlit"] = {}
    if material.transmission:
        extensions["KHR_materials_diffuse_transmission"] = {
            "diffuseTransmissionFactor": material.transmission,
            "diffuseTransmissionColorFactor": list(material.transmission_colour)}
    if material.coat is not None:
        extensions["KHR_materials_clearcoat"] = {
            "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": material.coat}
    if material.mirror:
        pbr["metallicFactor"], pbr["roughnessFactor"] = 1.0, 0.0
    elif material.glass is not None:
        pbr["roughnessFactor"] = 0.0
        extensions["KHR_materials_ior"] = {"ior": material.glass}
        extensions["KHR_materials_transmission"] = {"transmissionFactor": 1.0}
        if material.attenuation is not None:
            extensions["KHR_materials_volume"] = {
                "thicknessFactor": 1.0, "attenuationDistance": 1.0,
                "attenuationColor": list(material.attenuation)}
    elif material.roughness is None and not material.unlit:
        extensions["KHR_materials_specular"] = {"specularFactor": 0.0}
    emitted = radiance(material, area)
    if max(emitted) > 0.0:
        strength = max(emitted)
        result["emissiveFactor"] = [c / strength for c in emitted]
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
        if material.flux:
            result["extras"] = {"fluxLumens": material.flux}
    if extensions:
        result["extensions"] = extensions
        document.extensions.update(extensions)
    return result


def _primitive_json(document: _Document, name: str, primitive: Primitive) -> dict[str, object]:
    material = document.model.materials[document.material_index[name]]
    attributes = {
        "POSITION": document.add_accessor(primitive.positions, FLOAT, "VEC3", ARRAY_BUFFER, True),
        "NORMAL": document.add_accessor(primitive.normals, FLOAT, "VEC3", ARRAY_BUFFER),
    }
    if material.textures():
        attributes["TEXCOORD_0"] = document.add_accessor(primitive.uvs, FLOAT, "VEC2", ARRAY_BUFFER)
    if any(colour != (1.0, 1.0, 1.0) for colour in primitive.colours):
        attributes["COLOR_0"] = document.add_accessor(primitive.colours, FLOAT, "VEC3",
                                                      ARRAY_BUFFER)
    wide = len(primitive.positions) > 65535
    indices = document.add_accessor([(i,) for i in primitive.indices],
                                    UNSIGNED_INT if wide else UNSIGNED_SHORT, "SCALAR",
                                    ELEMENT_ARRAY_BUFFER)
    return {"attributes": attributes, "indices": indices,
            "material": document.material_index[name]}


def _add_object(document: _Document, thing: SceneObject) -> int:
    primitives: dict[str, Primitive] = {}
    for solid in thing.solids:
        append_solid(primitives, solid, document.model.position_step)
    ordered = sorted(primitives, key=document.material_index.__getitem__)
    mesh = document.append("meshes", {
        "name": thing.name,
        "primitives": [_primitive_json(document, name, primitives[name]) for name in ordered]})
    node: dict[str, object] = {"name": thing.name, "mesh": mesh}
    if any(thing.translation):
        node["translation"] = list(thing.translation)
    if thing.rotation_y:
        half = math.radians(thing.rotation_y) / 2
        node["rotation"] = [0.0, round(math.sin(half), 9), 0.0, round(math.cos(half), 9)]
    node["extras"] = {"movable": thing.movable}
    return document.append("nodes", node)


def _rotation_along(forward: Vec) -> list[float]:
    """Quaternion (x, y, z, w) that turns -Z to a unit vector: about Y, then about X."""
    yaw, pitch = math.atan2(-forward[0], -forward[2]) / 2, math.asin(forward[1]) / 2
    rotation = [math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch),
                -math.sin(yaw) * math.sin(pitch), math.cos(yaw) * math.cos(pitch)]
    return [round(c, 9) + 0.0 for c in rotation]


def _light_json(light: Light) -> dict[str, object]:
    result: dict[str, object] = {"name": light.name, "type": light.kind,
                                 "intensity": light.intensity, "color": list(light.colour)}
    if light.kind == "spot":
        result["spot"] = {"innerConeAngle": math.radians(light.inner_cone),
                          "outerConeAngle": math.radians(light.outer_cone)}
    return result


def _add_lights(document: _Document) -> list[int]:
    """Nodes of the lights; they share their definitions with none."""
    definitions: dict[str, list[dict[str, object]]] = {}
    nodes = []
    for light in document.model.lights:
        name = "EXT_lights_ies" if light.profile else "KHR_lights_punctual"
        entries = definitions.setdefault(name, [])
        use: dict[str, object] = {"light": len(entries)}
        if light.profile:
            entries.append({"name": light.name, "uri": light.profile})
            use.update({"multiplier": light.intensity, "color": list(light.colour)})
        else:
            entries.append(_light_json(light))
        nodes.append(document.append("nodes", {
            "name": light.name, "translation": list(light.position),
            "rotation": _rotation_along(unit(light.direction)), "extensions": {name: use}}))
    if definitions:
        document.extensions.update(definitions)
        document.json["extensions"] = {name: {"lights": entries}
                                       for name, entries in sorted(definitions.items())}
    return nodes


def _add_camera(document: _Document, camera: Camera) -> int:
    """glTF cameras look along -Z of their node: a turn about Y, then one about X."""
    rotation = _rotation_along(unit(sub(camera.target, camera.eye)))
    lens = document.append("cameras", {
        "name": camera.name, "type": "perspective",
        "perspective": {"yfov": math.radians(camera.vertical_fov),
                        "aspectRatio": camera.aspect_ratio, "znear": 0.05, "zfar": 100.0}})
    return document.append("nodes", {
        "name": camera.name, "camera": lens, "translation": list(camera.eye),
        "rotation": rotation,
        "extras": {"target": list(camera.target)}})


def _add_textures(document: _Document) -> None:
    for index, name in enumerate(sorted(document.model.textures)):
        document.append("images", {"uri": name.rsplit("/", 1)[-1]})
        document.append("textures", {"source": index, "sampler": 0})
    if document.model.textures:
        document.append("samplers", {"magFilter": 9729, "minFilter": 9987,
                                     "wrapS": 10497, "wrapT": 10497})


def _json_text(document: _Document) -> str:
    """Top level spread over lines, each list element on a line of its own."""
    tree = dict(document.json)
    if document.extensions:
        tree["extensionsUsed"] = sorted(document.extensions)
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in tree.items()]
    for key in LIST_KEYS:
        if document.lists[key]:
            elements = ",\n    ".join(json.dumps(e) for e in document.lists[key])
            lines.append(f"{json.dumps(key)}: [\n    {elements}\n  ]")
    return "{\n  " + ",\n  ".join(lines) + "\n}\n"


def scene_files(model: SceneModel) -> dict[str, bytes]:
    """File name -> contents of everything that the scene consists of."""
    document = _Document(model)
    areas = material_areas(model)
    for material in model.materials:
        document.append("materials", _material_json(document, material, areas[material.name]))
    nodes = [_add_object(document, thing) for thing in model.objects]
    nodes += _add_lights(document)
    nodes += [_add_camera(document, camera) for camera in model.cameras]
    scene: dict[str, object] = {"name": model.name, "nodes": nodes}
    if model.daylight:
        scene["extras"] = {"raybundle": {"daylight": model.daylight}}
    document.append("scenes", scene)
    _add_textures(document)
    files = dict(model.textures) | model.files
    data = bytes(document.binary)
    if model.embed_buffer:
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode("ascii")
    else:
        uri = f"{model.name}.bin"
        files[uri] = data
    document.append("buffers", {"uri": uri, "byteLength": len(data)})
    files[f"{model.name}.gltf"] = _json_text(document).encode("utf-8")
    return files
