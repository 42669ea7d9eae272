// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_similar_file.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "scene/file_name_key.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_candidates = 16;      // folders that differ in letter case
constexpr std::size_t max_entries = 1U << 20U;  // of folders that are looked at

/// Entries of the folders with a name like this one.
std::vector<fs::path> entries_like(const std::vector<fs::path>& folders, const std::string& name,
                                   std::size_t& looked_at) {
    const std::string key = file_name_key(name);
    std::vector<fs::path> found;
    for (const fs::path& folder : folders) {
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            if (++looked_at > max_entries || found.size() == max_candidates) {
                return found;
            }
            if (file_name_key(entry->path().filename().native()) == key) {
                found.push_back(entry->path());
            }
        }
    }
    return found;
}

bool is_below(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path inner = fs::canonical(file, error);
    const fs::path outer = error ? fs::path() : fs::canonical(folder, error);
    if (error) {
        return false;
    }
    const fs::path relative = inner.lexically_relative(outer);
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::optional<fs::path> similar_file(const fs::path& folder, const std::string& relative) {
    std::string slashed = relative;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const fs::path path = fs::path(slashed).lexically_normal();
    if (path.empty() || path.is_absolute() || *path.begin() == "..") {
        return std::nullopt;
    }
    const fs::path base = folder.empty() ? fs::path(".") : folder;
    std::vector<fs::path> candidates{base};
    std::size_t looked_at = 0;
    for (const fs::path& name : path) {
        candidates = entries_like(candidates, name.native(), looked_at);
    }
    std::erase_if(candidates, [](const fs::path& file) {
        std::error_code error;
        return !fs::is_regular_file(file, error);
    });
    if (candidates.size() != 1 || looked_at > max_entries || !is_below(candidates[0], base)) {
        return std::nullopt;
    }
    return folder.empty() ? candidates[0].lexically_relative(base) : candidates[0];
}

}  // namespace raybundle
