// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene/scene.h"

namespace raybundle {

/// What becomes of alpha BLEND, where alpha is coverage (glTF 2.0, 3.9.4): `alpha` of the light
/// that meets the surface meets its material, and the rest goes on. Light is carried by what the
/// transport knows:
///  * where the alpha of the base colour texture is nearer to holes with edges than to its mean
///    (leaves, lace), the surface is cut out at half coverage, as by alpha MASK; else (films of one
///    alpha) the mean is the coverage:
///  * what covers less than half is a thin pane that lets 1 - alpha straight through and reflects
///    nothing: the share of the material is left out;
///  * what covers more (veils, blinds) reflects alpha times its base colour and sends 1 - alpha
///    diffusely from its other side, without gloss.
/// Materials that are unlit, max-Phong, or transmit by an extension are opaque to this. Returns a
/// notice for the user where something was left out or changed.
std::optional<std::string> read_alpha_blend(std::span<const Texture> textures, Material& material);

}  // namespace raybundle
