// SPDX-License-Identifier: Apache-2.0
#include "app/photometry_files.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "app/scene_library.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

/// Bytes of files that one list reads, one file at least: it is made between other answers. A
/// folder of a hundred usual files is read at once.
constexpr std::uint64_t most_read_at_once = 4U << 20U;

OrderedJson entry_of(const SceneFolder& folder, const std::string& name) {
    OrderedJson entry{{"name", name}};
    try {
        const auto profile = folder.photometry(name);
        const IesProfile::Data& data = profile->data();
        const IesProfile::Opening& opening = data.opening;
        const auto [shorter, longer] = std::minmax(opening.width, opening.length);
        entry["flux"] = profile->flux();
        entry["power"] = data.input_watts;
        entry["size"] = {
            {"length", longer},
            {"width", opening.round ? 0.0 : shorter},
            {"height", *std::max_element(opening.heights.begin(), opening.heights.end())}};
        entry["opening"] = {{"x", opening.length}, {"y", opening.width}, {"round", opening.round}};
        if (data.colour_rendering) {
            entry["colourRendering"] = data.colour_rendering->least;
        }
        entry["problems"] = data.notes;
    } catch (const SceneError& error) {
        entry["problems"] = {error.json_path().empty() ? error.reason()
                                                       : error.json_path() + ": " + error.reason()};
    }
    return entry;
}

bool same_file(const fs::path& path, const std::string& bytes) {
    std::ifstream in(path, std::ios::binary);
    std::string there(bytes.size() + 1, '\0');
    in.read(there.data(), static_cast<std::streamsize>(there.size()));
    there.resize(static_cast<std::size_t>(in.gcount()));
    return there == bytes;
}

class PhotometryUpload : public Upload {
  public:
    PhotometryUpload(std::shared_ptr<const SceneFolder> folder, std::string name,
                     std::function<bool(std::function<void()>)> submit)
        : folder_(std::move(folder)), name_(std::move(name)), submit_(std::move(submit)) {}

    bool write(std::string_view bytes) override {
        constexpr std::size_t most_bytes = std::size_t{16} << 20U;  // as the parsers take
        bytes_ += bytes;
        return bytes_.size() <= most_bytes;
    }

    void finish(std::function<void(UploadResult)> done) override {
        const auto job = [folder = folder_, name = name_, bytes = std::move(bytes_), done] {
            done(store_photometry(*folder, name, bytes));
        };
        if (!submit_(job)) {
            done({503, "Other files are being read; try again later"});
        }
    }

  private:
    std::shared_ptr<const SceneFolder> folder_;
    std::string name_;
    std::function<bool(std::function<void()>)> submit_;
    std::string bytes_;
};

}  // namespace

std::string photometry_json(const SceneFolder& folder) {
    OrderedJson list = OrderedJson::array();
    std::uint64_t left = most_read_at_once;
    for (const std::string& name : folder.photometry_names()) {
        const std::uint64_t bytes = folder.unread_bytes(name);
        if (bytes > left && left < most_read_at_once) {
            list.push_back({{"name", name}, {"problems", {"not read yet: ask again"}}});
            continue;
        }
        left -= std::min(bytes, left);
        list.push_back(entry_of(folder, name));
    }
    return list.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

UploadResult store_photometry(const SceneFolder& folder, const std::string& name,
                              const std::string& bytes) {
    const fs::path target = folder.photometry_folder() / name;
    std::error_code error;
    try {
        const IesProfile profile = parse_photometry(name, bytes);
        if (!(profile.flux() > 0.0)) {
            return {422, "Rejected: it is dark"};
        }
        if (fs::exists(fs::symlink_status(target, error))) {
            return same_file(target, bytes)
                       ? UploadResult{200, "Stored already: " + name}
                       : UploadResult{409, "Another file has the name " + name +
                                               ", and luminaires may shine by it: choose another"};
        }
        if (folder.photometry_names().size() >= SceneFolder::max_photometric_files) {
            return {507, fmt::format("There are {} photometric files already",
                                     SceneFolder::max_photometric_files)};
        }
        fs::create_directories(folder.photometry_folder(), error);
        const std::unique_ptr<NewSceneFile> file = new_file(folder.photometry_folder(), ".tmp");
        if (!file || !file->write(bytes)) {
            return {507, "The server cannot store it"};
        }
        file->keep_as(name);
        spdlog::info("{} has been uploaded", name);
        return {201, fmt::format("Stored {}: {:.0f} lm", name, profile.flux())};
    } catch (const SceneError& wrong) {
        return {422, "Rejected: " + (wrong.json_path().empty() ? "" : wrong.json_path() + ": ") +
                         wrong.reason()};
    } catch (const fs::filesystem_error& wrong) {
        spdlog::error("{} cannot be stored: {}", name, wrong.what());
        return {507, "The server cannot store it"};
    }
}

std::unique_ptr<Upload> photometry_upload(std::shared_ptr<const SceneFolder> folder,
                                          std::string name,
                                          std::function<bool(std::function<void()>)> submit) {
    return std::make_unique<PhotometryUpload>(std::move(folder), std::move(name),
                                              std::move(submit));
}

}  // namespace raybundle
