// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "reference/spot_check.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "scheduling/clock.h"
#include "stream/viewer_id.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Measures the true error of viewers' pictures at rest by path tracing some of their pixels. It
/// has a thread of its own, takes one picture at a time, and pauses, so that it uses a small share
/// of one core. For a few viewers it keeps the traced paths while scene, camera and size stay the
/// same. Its methods are for one thread; only set_scene() takes long, for a copy.
class ErrorChecker {
  public:
    struct Picture {
        ViewerId viewer = 0;
        TimePoint shown_since;  ///< names what the picture shows, beside the viewer
        Camera camera;
        glm::uvec2 size{0};
        std::vector<glm::vec4> radiance;  ///< cd/m², row 0 at the top
        ImageStatistics by_samples;       ///< what its samples said of it then
    };
    struct Result {
        ViewerId viewer = 0;
        TimePoint shown_since;
        ImageStatistics by_samples;
        SquaredError square;
    };

    /// rest: after each picture, times the work on it. The clock is read on the checker's thread,
    /// too.
    ErrorChecker(const Clock& clock, double rest);
    ~ErrorChecker();
    ErrorChecker(const ErrorChecker&) = delete;
    ErrorChecker& operator=(const ErrorChecker&) = delete;

    /// Whether it takes another picture now: it works on none, and does not pause.
    [[nodiscard]] bool idle();
    /// Whether it has this state of the scene. It forgets all other states.
    [[nodiscard]] bool has_scene(std::uint32_t epoch) const { return scene_ && epoch_ == epoch; }
    void set_scene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh);
    /// Requires idle() and a scene.
    void check(Picture picture);
    /// What was found since the last call.
    [[nodiscard]] std::optional<Result> take();

  private:
    struct OwnScene;
    struct Job {
        Picture picture;
        std::shared_ptr<const OwnScene> scene;
    };
    struct Begun {  ///< paths of one viewer's picture
        TimePoint shown_since;
        std::shared_ptr<const OwnScene> scene;
        std::unique_ptr<SpotCheck> check;
    };

    void run();
    Result work(const Job& job);
    SpotCheck& paths_for(const Job& job);

    const Clock& clock_;
    const double rest_;
    std::shared_ptr<const OwnScene> scene_;
    std::uint32_t epoch_ = 0;

    std::map<ViewerId, Begun> begun_;  // of the thread alone

    std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    bool busy_ = false;
    std::optional<Job> job_;
    std::optional<Result> result_;
    TimePoint rests_until_;
    std::thread thread_;
};

}  // namespace raybundle
