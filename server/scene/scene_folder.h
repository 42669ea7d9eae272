// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/photometry/ies_profile.h"

namespace raybundle {

/// The folder of what can be added to a scene while it is shown: its GLB files, and below
/// `photometry` IES and EULUMDAT files. A photometric file never changes once it is there, so that
/// what has been added is the same after a restart. Any thread.
class SceneFolder {
  public:
    static constexpr std::size_t max_photometric_files = 1000;

    explicit SceneFolder(std::filesystem::path folder);

    /// Where photometric files are; the folder need not exist.
    [[nodiscard]] std::filesystem::path photometry_folder() const;
    /// Names of the photometric files, rising, at most max_photometric_files.
    [[nodiscard]] std::vector<std::string> photometry_names() const;
    /// A photometric file, read once, also where it is none. Throws SceneError with its name and
    /// the reason. Nobody waits for a file that another thread reads.
    [[nodiscard]] std::shared_ptr<const IesProfile> photometry(const std::string& name) const;
    /// Bytes that photometry() would have to read; 0: it is known, or there is no such file.
    [[nodiscard]] std::uint64_t unread_bytes(const std::string& name) const;
    /// Path of a GLB or glTF file; throws SceneError where there is none of that name.
    [[nodiscard]] std::string scene_file(const std::string& name) const;

  private:
    std::filesystem::path folder_;
    mutable std::mutex mutex_;
    /// What a file is, or why it is none, which counts as long as the file stays as it is.
    struct Known {
        std::shared_ptr<const IesProfile> profile;
        std::string json_path, reason;
        std::uint64_t bytes = 0;
        std::filesystem::file_time_type changed;
    };
    [[nodiscard]] std::optional<Known> known(const std::string& name) const;

    mutable std::map<std::string, Known> files_;
};

/// Whether a name is that of a photometric file: .ies or .ldt, in any case.
bool is_photometry_name(std::string_view name);

}  // namespace raybundle
