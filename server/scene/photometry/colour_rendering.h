// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raybundle {

/// The general colour rendering index Ra (CIE 13.3) as somebody states it: two values where a
/// group, or a limit, is all that is said.
struct ColourRendering {
    float least = 0.0F;
    float most = 0.0F;
};

/// From what a photometric file says: a number ("83", "Ra > 80", "80-89"), a group of DIN 5035
/// ("1B") or a light colour ("840"). Nothing where it says none of these.
std::optional<ColourRendering> read_colour_rendering(std::string_view text);

/// From a line "[KEYWORD] text" of an IES file, whose keywords for it are users' own: LM-63 has
/// none. Nothing of other lines.
std::optional<ColourRendering> keyword_colour_rendering(std::string_view line);

/// "83" or "80 to 89"; "" of nothing.
std::string text_of(const std::optional<ColourRendering>& known);

}  // namespace raybundle
