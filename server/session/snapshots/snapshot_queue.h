// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "gpu/egl_context.h"
#include "net/server.h"
#include "scheduling/clock.h"
#include "scheduling/scheduling_settings.h"
#include "scheduling/time_share.h"
#include "session/changes/earlier_scene.h"
#include "view/tiles/picture_tiles.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Renders the pictures that viewers have asked for, off-screen, one after the other. A picture
/// takes part in whole groups of iterations, a large one tile by tile (PictureTiles). While anybody
/// moves, it takes part only as often as its share of the time allows. A picture of an earlier
/// epoch has iterations of its own: in the same share while somebody moves, in turns with the
/// present scene while all rest, and all of the time while nobody needs the present scene. Thread
/// of the GL context.
class SnapshotQueue {
  public:
    static constexpr std::uint64_t min_samples = 32;  ///< before an error is believed

    /// Makes the scene as it was after a change; null where that is not known any more.
    using MakeEarlier = std::function<std::unique_ptr<EarlierScene>(std::uint32_t epoch)>;

    SnapshotQueue(Server& server, const Clock& clock, const SnapshotPaceSettings& pace,
                  MakeEarlier make_earlier);
    ~SnapshotQueue();
    SnapshotQueue(const SnapshotQueue&) = delete;
    SnapshotQueue& operator=(const SnapshotQueue&) = delete;

    /// Takes a request for what `camera` sees, or refuses it. look: of PNG.
    void add(const ClientEvent& request, const Camera& camera, const PictureLook& look);
    /// Whether picture_of() a viewer is that of its request with this id.
    [[nodiscard]] bool is_making(ViewerId viewer, std::uint32_t request) const;
    /// Takes a viewer's request back; its picture is destroyed if is_making() it.
    void cancel(const ClientEvent& request);
    /// Drops the requests of a viewer that has left.
    void forget(ViewerId viewer);
    /// The picture that is being made for a viewer, null where there is none. forget() destroys it.
    [[nodiscard]] const ViewerImage* picture_of(ViewerId viewer) const;
    /// Pictures of the present scene wait while it is not as it is set: lamps fade.
    void hold(bool fading) { held_ = fading; }
    /// Begins the picture anew: the scene has changed, or another solver has taken over.
    void restart();
    /// Answers all that waits: the server is stopping.
    void refuse_all();

    [[nodiscard]] bool waiting() const { return !requests_.empty(); }
    /// What is rendered now needs no iterations of the present solution.
    [[nodiscard]] bool apart() const { return picture_.apart; }

    /// Between two groups of iterations: delivers the picture if it is done. Returns the picture if
    /// it takes part in the next group, else null. undisturbed: nobody moves.
    ViewerImage* next_receiver(const GpuScene& scene, const RadianceStore& store,
                               const ViewPrograms& programs, std::uint32_t epoch, bool undisturbed);
    /// Tells those who wait how far their pictures are, once a second.
    void report();
    /// Notes the cost of an iteration, ms.
    void note_iteration(double cost_ms);

  private:
    struct Request {
        ClientEvent event;
        Camera camera;
        PictureLook look;
        TimePoint since;

        [[nodiscard]] double error() const {
            return static_cast<double>(event.message.snapshot().relative_error());
        }
    };
    /// The picture that is being made.
    struct Picture {
        std::optional<PictureTiles> tiles;
        std::unique_ptr<ViewerImage> image;  ///< its next tile
        TimePoint begun;                     ///< the image
        bool apart = false;                  ///< it is, or will be, of earlier_
        bool taking_part = false;            ///< in the running group of iterations
    };
    struct Finished;

    /// Encodes and delivers on a thread of its own; one picture at a time.
    class Delivery {
      public:
        explicit Delivery(Server& server);
        ~Delivery();
        Delivery(const Delivery&) = delete;
        Delivery& operator=(const Delivery&) = delete;
        void submit(std::unique_ptr<Finished> picture);
        [[nodiscard]] bool busy();

      private:
        void work(const std::stop_token& token);

        Server& server_;
        std::mutex mutex_;
        std::condition_variable_any changed_;
        std::unique_ptr<Finished> next_;
        bool running_ = false;
        std::jthread thread_;
    };

    bool begin(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs);
    [[nodiscard]] bool wants_earlier(std::uint32_t epoch) const;
    bool prepare_earlier();
    [[nodiscard]] double earlier_turn_ms() const;
    void work_on_earlier();
    bool finish_earlier();
    void refresh_statistics();
    void charge_since(TimePoint start);
    [[nodiscard]] v1::SnapshotProgress progress_of_first() const;
    void drop_picture();
    [[nodiscard]] bool done();
    void deliver(std::uint32_t epoch);
    void drop(const GpuError& error);
    static void encode(Finished& picture, Server& server);

    Server& server_;
    const Clock& clock_;
    const SnapshotPaceSettings pace_;
    MakeEarlier make_earlier_;
    std::deque<Request> requests_;           ///< the first one is being rendered
    std::unique_ptr<EarlierScene> earlier_;  ///< kept for a while: who compares looks around
    TimePoint earlier_used_;                 ///< end of its last turn
    Picture picture_;
    bool held_ = false;
    bool undisturbed_ = true;  ///< time is nobody's loss, and not counted
    TimePoint last_report_;
    TimePoint last_statistics_;
    TimeShare share_;
    Delivery delivery_{server_};
};

}  // namespace raybundle
