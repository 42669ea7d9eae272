# SPDX-License-Identifier: Apache-2.0
"""Soundness of a scene: closed outward solids before writing, finite numbers and flux after."""

from __future__ import annotations

import base64
import json
import math
import struct
from collections import Counter, defaultdict

from .solid import SceneModel, Solid, cross, dot, length, sub
from .surfaces import luminance, material_areas

MIN_AREA = 1e-9  # m²
MAX_FILE_BYTES = 2_000_000


def _open_edges(solid: Solid) -> int:
    """Number of edges that do not have exactly one face on either side."""
    position = {}
    ids = [position.setdefault(tuple(round(c, 7) for c in p), i) for i, p in
           enumerate(solid.points)]
    edges: Counter[tuple[int, int]] = Counter()
    for face in solid.faces:
        edges.update((ids[a], ids[b]) for a, b in zip(face, face[1:] + face[:1]))
    return sum(1 for (a, b), count in edges.items() if count != 1 or edges[(b, a)] != 1)


def check_model(model: SceneModel) -> list[str]:
    """Every solid of more than one face must be closed, and look outward (a room: inward); every
    material must be used."""
    problems = [f"material {name} is not used" for name, area in material_areas(model).items()
                if area == 0.0]
    for thing in model.objects:
        for index, solid in enumerate(thing.solids):
            if len(solid.faces) == 1:
                continue
            where = f"{thing.name}, solid {index} ({solid.material})"
            if count := _open_edges(solid):
                problems.append(f"{where}: {count} open edges")
            if solid.volume() * (-1 if solid.inward else 1) <= 0:
                problems.append(f"{where}: inside out")
    return problems


class _Reader:
    """Reads back what was written, independently of the writer."""

    def __init__(self, model: SceneModel, files: dict[str, bytes]) -> None:
        self.json = json.loads(files[f"{model.name}.gltf"])
        uri = self.json["buffers"][0]["uri"]
        self.data = base64.b64decode(uri.split(",")[1]) if uri.startswith("data:") else files[uri]

    def accessor(self, index: int) -> list[tuple[float, ...]]:
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        code = {5126: "f", 5123: "H", 5125: "I"}[accessor["componentType"]]
        part = self.data[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        return list(struct.iter_unpack(f"<{width}{code}", part))


def _check_primitive(reader: _Reader, primitive: dict, areas: dict[int, float]) -> list[str]:
    positions = reader.accessor(primitive["attributes"]["POSITION"])
    normals = reader.accessor(primitive["attributes"]["NORMAL"])
    indices = [i for (i,) in reader.accessor(primitive["indices"])]
    problems = []
    if not all(math.isfinite(c) for p in positions + normals for c in p):
        problems.append("a coordinate is not finite")
    if len(normals) != len(positions) or max(indices) >= len(positions):
        problems.append("accessors disagree")
    if any(abs(length(n) - 1) > 1e-3 for n in normals):
        problems.append("a normal is not of unit length")
    for i in range(0, len(indices), 3):
        a, b, c = (positions[k] for k in indices[i:i + 3])
        normal = cross(sub(b, a), sub(c, a))
        area = 0.5 * length(normal)
        areas[primitive["material"]] += area
        if area < MIN_AREA:
            problems.append(f"triangle {i // 3} has no area")
        elif min(dot(normals[k], normal) for k in indices[i:i + 3]) <= 0:
            problems.append(f"triangle {i // 3}: a shading normal looks away from its face")
    return problems


def _check_fluxes(reader: _Reader, areas: dict[int, float]) -> list[str]:
    problems = []
    for index, material in enumerate(reader.json["materials"]):
        stated = material.get("extras", {}).get("fluxLumens")
        if stated is None:
            continue
        strength = material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"]
        flux = math.pi * areas[index] * strength * luminance(material["emissiveFactor"])
        if abs(flux - stated) > 1e-3 * stated:
            problems.append(f"{material['name']} emits {flux:.1f} lm, not {stated:g} lm")
    return problems


def check_files(model: SceneModel, files: dict[str, bytes]) -> list[str]:
    """Finite positions, no degenerate triangles, consistent normals, stated flux, file sizes."""
    reader = _Reader(model, files)
    areas: dict[int, float] = defaultdict(float)
    problems = []
    for mesh in reader.json["meshes"]:
        for number, primitive in enumerate(mesh["primitives"]):
            found = _check_primitive(reader, primitive, areas)
            problems += [f"{mesh['name']}, primitive {number}: {text}" for text in found]
    problems += _check_fluxes(reader, areas)
    problems += [f"{name}: larger than {MAX_FILE_BYTES} bytes" for name, data in files.items()
                 if len(data) > MAX_FILE_BYTES]
    return problems
