// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace raybundle {

/// A file compiled into the executable by embed_files() (deploy/cmake/EmbedFiles.cmake).
struct EmbeddedFile {
    std::string_view name;      ///< path relative to the embedded folder, e.g. "view_resolve.comp"
    std::string_view contents;  ///< bytes, unchanged
};

std::span<const EmbeddedFile> shader_files();    ///< server/shaders
std::span<const EmbeddedFile> client_files();    ///< client_web
std::span<const EmbeddedFile> protocol_files();  ///< FileDescriptorSet of the .proto

}  // namespace raybundle
