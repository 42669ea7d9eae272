// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raybundle {

/// A file as it is served.
struct ContentFile {
    std::string name;  ///< path in its folder
    std::shared_ptr<const std::string> bytes;
    std::shared_ptr<const std::string> gzip;  ///< null where it would save nothing
};

/// Folders of files in memory, each under a path that is a hash of its contents: caches may keep
/// them for ever, and who has not been told the path cannot guess it. The newest two of each kind
/// are kept, so that who has just been told of one still finds it. Any thread.
class ContentStore {
  public:
    static constexpr std::string_view kFolder = "/light/";
    static constexpr std::size_t kKept = 2;

    using Files = std::vector<std::pair<std::string, std::string>>;  ///< name, contents

    /// Its path, e.g. "/light/9f...e1/". kind: what makes room for it. Compresses, which takes
    /// long.
    std::string add(std::string_view kind, Files files);

    /// The file, or null. Valid as long as the caller holds it.
    [[nodiscard]] std::shared_ptr<const ContentFile> find(std::string_view path) const;

  private:
    struct Folder {
        std::string path, kind;
        std::vector<std::shared_ptr<const ContentFile>> files;
    };

    mutable std::mutex mutex_;
    std::list<Folder> folders_;  ///< oldest first
};

}  // namespace raybundle
