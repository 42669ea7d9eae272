# SPDX-License-Identifier: Apache-2.0
"""Areas of materials, and the radiance that gives a luminaire its flux."""

from __future__ import annotations

import math

from .solid import Material, SceneModel, Vec, cross, length, mul, sub

REC709 = (0.2126, 0.7152, 0.0722)


def luminance(rgb: Vec) -> float:
    """Rec. 709 luminance of a linear colour."""
    return sum(weight * c for weight, c in zip(REC709, rgb))


def material_areas(model: SceneModel) -> dict[str, float]:
    """Area of every material in the scene, m² (nodes are never scaled)."""
    areas = {material.name: 0.0 for material in model.materials}
    for thing in model.objects:
        for solid in thing.solids:
            for index, (a, b, c) in solid.triangles():
                pa, pb, pc = solid.points[a], solid.points[b], solid.points[c]
                name = solid.face_materials.get(index, solid.material)
                areas[name] += 0.5 * length(cross(sub(pb, pa), sub(pc, pa)))
    return areas


def radiance(material: Material, area: float) -> Vec:
    """Emitted radiance, cd/m². A Lambertian emitter of flux F and area A has F / (pi A)."""
    wanted = material.flux / (math.pi * area) if material.flux else material.luminance
    emitted = mul(material.light_colour, wanted / luminance(material.light_colour))
    return tuple(float(f"{c:.9g}") for c in emitted)
