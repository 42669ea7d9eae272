// SPDX-License-Identifier: Apache-2.0
#include "net/http/content_store.h"

#include <algorithm>

#include "net/access/access_tokens.h"
#include "net/http/encoded_files.h"

namespace raybundle {
namespace {

constexpr int kLevel = 6;  // of zlib: the highest takes three times as long for a hundredth

/// Names and contents, each after its length: no two folders are joined to the same text.
std::string hash_of(const ContentStore::Files& files) {
    std::string digests;
    for (const auto& [name, contents] : files) {
        digests += std::to_string(name.size()) + ':' + name + to_hex(token_digest(contents));
    }
    return to_hex(token_digest(digests));
}

}  // namespace

std::string ContentStore::add(std::string_view kind, Files files) {
    Folder folder{std::string(kFolder) + hash_of(files) + '/', std::string(kind), {}};
    for (auto& [name, contents] : files) {
        std::string packed = gzip(contents, kLevel);
        const bool saves = !packed.empty() && packed.size() < contents.size();
        folder.files.push_back(std::make_shared<const ContentFile>(
            ContentFile{name, std::make_shared<const std::string>(std::move(contents)),
                        saves ? std::make_shared<const std::string>(std::move(packed)) : nullptr}));
    }
    std::string path = folder.path;
    const std::lock_guard lock(mutex_);
    std::erase_if(folders_, [&](const Folder& other) { return other.path == path; });
    folders_.push_back(std::move(folder));
    const auto same = [kind](const Folder& other) { return other.kind == kind; };
    const auto count =
        static_cast<std::size_t>(std::count_if(folders_.begin(), folders_.end(), same));
    if (count > kKept) {
        folders_.erase(std::find_if(folders_.begin(), folders_.end(), same));
    }
    return path;
}

std::shared_ptr<const ContentFile> ContentStore::find(std::string_view path) const {
    const std::lock_guard lock(mutex_);
    for (const Folder& folder : folders_) {
        if (!path.starts_with(folder.path)) {
            continue;
        }
        const std::string_view name = path.substr(folder.path.size());
        const auto file = std::find_if(folder.files.begin(), folder.files.end(),
                                       [name](const auto& f) { return f->name == name; });
        return file == folder.files.end() ? nullptr : *file;
    }
    return nullptr;
}

}  // namespace raybundle
