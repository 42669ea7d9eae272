// SPDX-License-Identifier: Apache-2.0
#include "app/scene_opener.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/photometry_files.h"
#include "scene/gltf/file/gltf_confinement.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {

namespace {

constexpr std::size_t max_jobs = 4;

using Clock = std::chrono::steady_clock;

double elapsed_s(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

/// The bytes go to a file of the library, which the opener checks.
class SceneOpener::SceneUpload : public Upload {
  public:
    SceneUpload(SceneOpener& opener, std::string name, std::shared_ptr<NewSceneFile> file)
        : opener_(opener), name_(std::move(name)), file_(std::move(file)) {}

    bool write(std::string_view bytes) override { return file_->write(bytes); }

    void finish(std::function<void(UploadResult)> done) override {
        const auto job = [&opener = opener_, name = name_, file = std::move(file_), done] {
            UploadResult result = opener.check(*file, name);
            file->discard();
            done(std::move(result));
        };
        if (!opener_.submit(job)) {
            done({503, "Other scenes are being read; try again later"});
        }
    }

  private:
    SceneOpener& opener_;
    std::string name_;
    std::shared_ptr<NewSceneFile> file_;
};

SceneOpener::SceneOpener(const Options& options, Server& server, const OpeningTimes& times,
                         std::function<void()> opened)
    : options_(options),
      server_(server),
      times_(times),
      library_(options.serve.scenes),
      folder_(std::make_shared<const SceneFolder>(options.serve.scenes)),
      opened_(std::move(opened)),
      shown_(options.scene.file) {
    server_.set_photometry_source([folder = folder_] { return photometry_json(*folder); });
    server_.set_upload_factory([this](const std::string& name) -> std::unique_ptr<Upload> {
        if (is_photometry_name(name)) {
            return photometry_upload(folder_, name, [this](Job job) { return submit(job); });
        }
        std::unique_ptr<NewSceneFile> file = library_.create();
        return file ? std::make_unique<SceneUpload>(*this, name, std::move(file)) : nullptr;
    });
    thread_ = std::jthread([this](const std::stop_token& token) { work(token); });
}

SceneOpener::~SceneOpener() {
    server_.set_upload_factory({});
    server_.set_photometry_source({});
}

bool SceneOpener::submit(Job job) {
    const std::lock_guard lock(mutex_);
    if (jobs_.size() >= max_jobs) {
        return false;
    }
    jobs_.push_back(std::move(job));
    changed_.notify_one();
    return true;
}

void SceneOpener::work(const std::stop_token& token) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, token, [this] { return !jobs_.empty(); }), !token.stop_requested()) {
        const Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        job();
        lock.lock();
    }
}

void SceneOpener::handle(const ClientEvent& request, const std::string& viewer_name) {
    if (request.message.has_open_scene()) {
        begin(request, viewer_name);
        return;
    }
    std::string shown;
    {
        const std::lock_guard lock(mutex_);
        shown = shown_;
    }
    v1::ServerMessage answer;
    library_.list(shown, answer.mutable_scene_list());
    answer.mutable_scene_list()->set_max_upload_bytes(
        static_cast<std::uint32_t>(options_.serve.max_upload_megabytes) * 1'000'000U);
    server_.reply(request, answer);
}

void SceneOpener::begin(const ClientEvent& request, const std::string& viewer_name) {
    const std::string& name = request.message.open_scene().name();
    const std::optional<std::string> file = library_.find(name);
    if (!file) {
        server_.reply_error(request, v1::Error::NOT_FOUND,
                            "openScene.name: there is no scene '" + name + "'");
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        if (opening_) {
            server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED,
                                "another scene is being opened");
            return;
        }
        opening_ = true;
    }
    auto scene = std::make_shared<OpenedScene>();
    scene->file = *file;
    scene->request = request;
    scene->progress.set_name(name);
    scene->progress.set_by(request.viewer);
    scene->progress.set_by_name(viewer_name);
    if (!submit([this, scene] { open(*scene); })) {
        reject(*scene, "other scenes are being read; try again later");
    }
}

void SceneOpener::open(OpenedScene& scene) {
    scene.begun = Clock::now();
    announce(scene, v1::SceneOpening::READING);
    try {
        Options options = options_;
        options.scene.file = scene.file;
        check_confined(scene.file);
        scene.loaded = load_scene(options, [&] { announce(scene, v1::SceneOpening::PREPARING); });
        {
            const std::lock_guard lock(mutex_);
            ready_ = std::move(scene);
        }
        opened_();
    } catch (const std::exception& error) {
        reject(scene, reason_of(error));
    }
}

std::optional<OpenedScene> SceneOpener::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(ready_, std::nullopt);
}

void SceneOpener::announce(OpenedScene& scene, v1::SceneOpening::Stage stage) {
    scene.progress.set_stage(stage);
    v1::ServerMessage message;
    v1::SceneOpening& progress = *message.mutable_scene_opening();
    progress = scene.progress;
    const auto expected = times_.expected(scene.file);
    if (expected && stage != v1::SceneOpening::REJECTED) {
        const double left = *expected - elapsed_s(scene.begun);
        progress.set_seconds_left(static_cast<float>(std::max(left, 0.0)));
    }
    server_.broadcast(message);
}

void SceneOpener::reject(OpenedScene& scene, const std::string& reason) {
    spdlog::error("the scene stays as it was, {} cannot be opened: {}", scene.file, reason);
    {
        const std::lock_guard lock(mutex_);
        opening_ = false;
    }
    scene.progress.set_reason(reason);
    announce(scene, v1::SceneOpening::REJECTED);
    server_.reply_error(scene.request, v1::Error::INVALID_ARGUMENT, "openScene: " + reason);
}

void SceneOpener::accept(OpenedScene& scene) {
    set_shown(scene.file);
    {
        const std::lock_guard lock(mutex_);
        opening_ = false;
    }
    announce(scene, v1::SceneOpening::READY);
    server_.reply_ok(scene.request);
}

void SceneOpener::set_shown(const std::string& file) {
    const std::lock_guard lock(mutex_);
    shown_ = file;
}

UploadResult SceneOpener::check(NewSceneFile& file, const std::string& name) {
    try {
        Options options = options_;
        options.scene.file = file.path();
        check_confined(options.scene.file);
        load_scene(options);
        const bool replaced = file.keep_as(name);
        spdlog::info("{} has been uploaded", name);
        return {replaced ? 200 : 201, (replaced ? "Replaced " : "Stored ") + name};
    } catch (const std::filesystem::filesystem_error& error) {
        spdlog::error("{} cannot be stored: {}", name, error.what());
        return {507, "The server cannot store it"};
    } catch (const std::exception& error) {
        spdlog::warn("the upload {} was rejected: {}", name, error.what());
        return {422, "Rejected: " + reason_of(error)};
    }
}

/// For clients: no paths.
std::string SceneOpener::reason_of(const std::exception& error) const {
    const auto* const scene = dynamic_cast<const SceneError*>(&error);
    if (scene == nullptr) {
        return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "out of memory"
                                                                      : "it cannot be read";
    }
    const std::string where = scene->json_path().empty() ? "" : scene->json_path() + ": ";
    return library_.without_paths(where + scene->reason());
}

}  // namespace raybundle
