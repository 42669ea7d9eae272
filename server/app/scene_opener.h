// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/load_scene.h"
#include "app/opening_times.h"
#include "app/scene_library.h"
#include "net/server.h"
#include "scene/scene_folder.h"

namespace raybundle {

/// A scene that somebody has opened, ready to be served.
struct OpenedScene {
    LoadedScene loaded;
    std::string file;
    ClientEvent request;
    v1::SceneOpening progress;
    std::chrono::steady_clock::time_point begun;
};

/// Opens scenes of the library and checks uploads, one after the other on a thread of its own,
/// while the present scene goes on. Answers the requests; viewers hear of the progress.
class SceneOpener {
  public:
    /// `opened` is called when take() has something. Throws UsageError where the folder of
    /// options.serve.scenes is none.
    SceneOpener(const Options& options, Server& server, const OpeningTimes& times,
                std::function<void()> opened);
    ~SceneOpener();
    SceneOpener(const SceneOpener&) = delete;
    SceneOpener& operator=(const SceneOpener&) = delete;

    /// Answers listScenes; begins openScene, which ends in take() or in an error. Any thread.
    void handle(const ClientEvent& request, const std::string& viewer_name);

    /// The scene that has been opened and not been taken yet.
    std::optional<OpenedScene> take();

    /// Tells everybody how far a scene is, and how long it will take still where that is foreseen.
    void announce(OpenedScene& scene, v1::SceneOpening::Stage stage);
    /// Tells everybody that nothing has changed, and why; answers the request.
    void reject(OpenedScene& scene, const std::string& reason);
    /// The scene is shown: answers the request.
    void accept(OpenedScene& scene);

    /// The file of the scene that is shown.
    void set_shown(const std::string& file);

    [[nodiscard]] const SceneLibrary& library() const { return library_; }
    /// What scenes that are served can be given from the folder.
    [[nodiscard]] const std::shared_ptr<const SceneFolder>& folder() const { return folder_; }

  private:
    class SceneUpload;
    using Job = std::function<void()>;

    bool submit(Job job);
    void work(const std::stop_token& token);
    void begin(const ClientEvent& request, const std::string& viewer_name);
    void open(OpenedScene& scene);
    UploadResult check(NewSceneFile& file, const std::string& name);
    [[nodiscard]] std::string reason_of(const std::exception& error) const;

    const Options options_;
    Server& server_;
    const OpeningTimes& times_;
    const SceneLibrary library_;
    const std::shared_ptr<const SceneFolder> folder_;
    std::function<void()> opened_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Job> jobs_;
    std::string shown_;
    bool opening_ = false;
    std::optional<OpenedScene> ready_;
    std::jthread thread_;
};

}  // namespace raybundle
