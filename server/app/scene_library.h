// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "raybundle.pb.h"

namespace raybundle {

/// A file that is being written in the library; it is removed unless it is kept.
class NewSceneFile {
  public:
    NewSceneFile(std::filesystem::path path, int descriptor)
        : path_(std::move(path)), descriptor_(descriptor) {}
    ~NewSceneFile() { discard(); }
    NewSceneFile(const NewSceneFile&) = delete;
    NewSceneFile& operator=(const NewSceneFile&) = delete;

    [[nodiscard]] std::string path() const { return path_.string(); }
    /// False: the disk is full, or something like that.
    bool write(std::string_view bytes);
    /// Puts it on disk under a name of its folder, in place of what had the name. True where there
    /// was something. Throws std::filesystem::filesystem_error.
    bool keep_as(const std::string& name);
    /// Removes it unless it is kept.
    void discard();

  private:
    std::filesystem::path path_;  ///< empty once kept
    int descriptor_ = -1;
};

/// A new, empty file of a folder, hidden until it is kept; null where the folder cannot be written.
std::unique_ptr<NewSceneFile> new_file(const std::filesystem::path& folder,
                                       std::string_view suffix);

/// The folder of --scenes: its .gltf and .glb files, by plain names. Nothing outside of it is ever
/// opened: names have no folders, and symbolic links do not count as files.
class SceneLibrary {
  public:
    static constexpr int max_scenes = 1000;

    /// Removes what interrupted uploads have left. Throws UsageError where there is no such folder.
    explicit SceneLibrary(const std::string& folder);

    /// Fills in the scenes by name, and which one `shown` is.
    void list(const std::string& shown, v1::SceneList* list) const;

    /// The file of a name; nothing where there is none.
    [[nodiscard]] std::optional<std::string> find(const std::string& name) const;

    /// A new, empty file; null where the folder cannot be written.
    [[nodiscard]] std::unique_ptr<NewSceneFile> create() const;

    /// A text for clients: without the folder's path.
    [[nodiscard]] std::string without_paths(std::string text) const;

  private:
    std::filesystem::path folder_;  ///< canonical
};

}  // namespace raybundle
