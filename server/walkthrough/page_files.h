// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "embedded_file.h"

namespace raybundle {

/// The files of a walkthrough's page, of those of client_web: its page as index.html, its style,
/// and the modules that it imports, with what these import. Throws std::logic_error where one is
/// missing.
std::vector<EmbeddedFile> walkthrough_page(std::span<const EmbeddedFile> client);

/// The server's shader texts that the page draws with (tone curve, false colour), as
/// shaders/NAME.glsl. Their texts include nothing: what they include stands before them.
struct ShaderText {
    std::string name, text;
};
std::vector<ShaderText> walkthrough_shaders(std::span<const EmbeddedFile> shaders);

}  // namespace raybundle
