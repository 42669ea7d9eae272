// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "research/accuracy/reference_picture.h"
#include "scene/scene.h"

namespace raybundle {

/// What a reference is a picture of. Equal keys: the same picture.
struct ReferenceKey {
    std::string scene;  ///< scene_fingerprint()
    Camera camera;
    glm::uvec2 size{0};
    PixelFilter filter = PixelFilter::centre;
};

/// The JSON file beside a reference's EXR file.
std::string sidecar_of(const std::string& exr);

/// A reference from a file that an earlier run wrote; nothing where there is none, or one of
/// something else. Throws std::runtime_error where a file of the right key cannot be read.
std::optional<ReferencePicture> load_cached_reference(const std::string& exr,
                                                      const ReferenceKey& key);

/// A reference that the user names. Where a JSON file of ours lies beside it, it must be of this
/// key but for the filter, which is its own; else nothing but the size can be checked, and its
/// noise is unknown. Throws std::runtime_error naming the file and what is wrong.
ReferencePicture load_named_reference(const std::string& exr, const ReferenceKey& key);

/// Writes EXR and JSON, whole or not at all. Throws std::runtime_error.
void save_reference(const std::string& exr, const ReferenceKey& key,
                    const ReferencePicture& reference);

}  // namespace raybundle
