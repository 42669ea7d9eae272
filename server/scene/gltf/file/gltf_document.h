// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_buffers.h"
#include "scene/gltf/file/gltf_model.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/light/daylight.h"
#include "scene/medium.h"

namespace raybundle {

struct GltfContainer;

/// A glTF file that has been checked: its JSON by check_schema(), its buffers in memory, its
/// accessors inside of their views, its images not missing. tinygltf reads it, behind these checks
/// and without files: by itself it drops members of a wrong type without a word, opens whatever a
/// URI names, and refuses valid files whose index accessors have no view (Draco) or whose buffers
/// have no bytes of their own (meshopt).
class GltfDocument {
  public:
    /// Throws SceneError.
    explicit GltfDocument(const std::string& path);
    /// The same of a container that has been read from there.
    GltfDocument(const std::string& path, GltfContainer container);

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Its buffers and images hold no bytes: see view_bytes() and decode_image().
    [[nodiscard]] const tinygltf::Model& model() const { return model_; }
    /// The extension of that name of the whole file, an object, or nullptr.
    [[nodiscard]] const Json* extension(const char* name) const {
        return find_member(extensions_, name);
    }
    /// "animations" as the file has it, unchecked.
    [[nodiscard]] const Json& animations() const { return animations_; }
    [[nodiscard]] std::span<const std::uint8_t> view_bytes(int view) const {
        return buffers_.view(view);
    }

    /// Daylight as the file asks for it.
    [[nodiscard]] const Daylight& daylight() const { return daylight_; }
    [[nodiscard]] const std::optional<Medium>& air() const { return air_; }
    /// What a saved scene says beside glTF.
    [[nodiscard]] const SavedState& saved() const { return saved_; }

    /// Adds a notice for the user, once.
    void note(const std::string& text);
    [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }

    // What the loader has done for this file: a few bytes can ask for any amount of it. Each throws
    // SceneError where the sum since the file was opened passes its limit.

    /// Counts numbers that are read from accessors.
    void charge_components(std::size_t count, const std::string& json_path) const;
    /// Counts bytes of decoded images.
    void charge_image(std::size_t bytes, const std::string& json_path) const;
    /// Throws as charge_image() would for so many bytes in all.
    void check_image_sum(std::size_t bytes, const std::string& json_path) const;

    [[noreturn]] void fail(const std::string& json_path, const std::string& reason) const;

  private:
    void note_spelling(const Json& json);

    std::string path_;
    Daylight daylight_;
    std::optional<Medium> air_;
    SavedState saved_;
    tinygltf::Model model_;
    Json extensions_;
    Json animations_;
    GltfBuffers buffers_;
    std::vector<std::string> notices_;
    mutable std::size_t components_ = 0;   ///< read so far
    mutable std::size_t image_bytes_ = 0;  ///< decoded so far
};

}  // namespace raybundle
