// SPDX-License-Identifier: Apache-2.0
#include "snapshot_desk.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "gpu/egl_context.h"
#include "stream/image_encoder.h"
#include "view/image_file.h"

namespace raybundle {

namespace {

constexpr std::uint64_t least_samples = 32;  // before an error is believed
constexpr std::chrono::hours most_time(1);
constexpr std::chrono::milliseconds statistics_interval(100);

double milliseconds_since(SnapshotDesk::Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(SnapshotDesk::Clock::now() - start).count();
}

}  // namespace

/// A picture on its way from the GPU to a file.
struct SnapshotDesk::Finished {
    ClientEvent event;
    glm::uvec2 size{0};
    std::vector<glm::vec4> radiance;   ///< of EXR, row 0 at the top
    std::vector<std::uint8_t> pixels;  ///< of PNG, likewise, RGBA
    float relative_error = 1.0F;
    std::uint32_t epoch = 0;
};

SnapshotDesk::SnapshotDesk(Server& server) : server_(server) {}

SnapshotDesk::~SnapshotDesk() = default;

void SnapshotDesk::add(const ClientEvent& request, const Camera& camera, float exposure) {
    if (requests_.size() >= max_waiting) {
        server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED,
                            "too many snapshots wait already");
        return;
    }
    requests_.push_back({request, camera, exposure});
}

void SnapshotDesk::forget(ViewerId viewer) {
    if (!requests_.empty() && requests_.front().event.viewer == viewer) {
        restart();
    }
    std::erase_if(requests_, [viewer](const Request& r) { return r.event.viewer == viewer; });
}

void SnapshotDesk::restart() {
    image_.reset();
    taking_part_ = false;
}

void SnapshotDesk::refuse_all() {
    restart();
    for (const Request& request : requests_) {
        server_.reply_error(request.event, v1::Error::INTERNAL, "the server is stopping");
    }
    requests_.clear();
}

/// False where there is no memory for it: the request is answered.
bool SnapshotDesk::begin(const GpuScene& scene, const RadianceStore& store,
                         const ViewPrograms& programs) {
    const v1::Snapshot& wanted = requests_.front().event.message.snapshot();
    try {
        image_ = std::make_unique<ViewerImage>(scene, store, programs,
                                               glm::uvec2(wanted.width(), wanted.height()));
        image_->set_camera(requests_.front().camera);
        return true;
    } catch (const GpuError& error) {
        drop(error);
        return false;
    }
}

/// The picture cannot be made.
void SnapshotDesk::drop(const GpuError& error) {
    const ClientEvent& event = requests_.front().event;
    spdlog::error("no snapshot for viewer {}: {}", event.viewer, error.what());
    server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED,
                        "the server has no memory for a picture of this size");
    restart();
    requests_.pop_front();
}

bool SnapshotDesk::done() {
    const Request& request = requests_.front();
    if (!image_->smoothed()) {
        return false;
    }
    const ImageStatistics& statistics = image_->statistics();
    const auto wanted = static_cast<double>(request.event.message.snapshot().relative_error());
    return Clock::now() - request.since > most_time ||
           (image_->samples() >= least_samples && statistics.samples >= least_samples &&
            statistics.meets(wanted));
}

ViewerImage* SnapshotDesk::next_receiver(const GpuScene& scene, const RadianceStore& store,
                                         const ViewPrograms& programs, std::uint32_t epoch,
                                         bool alone) {
    taking_part_ = false;
    if (requests_.empty() || (!alone && !share_.may())) {
        return nullptr;
    }
    const auto start = Clock::now();
    const auto charge = [&] { share_.charge(milliseconds_since(start)); };
    if (!image_ && !begin(scene, store, programs)) {
        return nullptr;
    }
    if (!image_->smoothed()) {
        image_->smooth_step();
        charge();
    } else if (done()) {
        if (!delivery_.busy()) {
            try {
                deliver(epoch);
            } catch (const GpuError& error) {
                drop(error);
            }
            charge();
        }
        return nullptr;
    }
    taking_part_ = true;
    return image_.get();
}

void SnapshotDesk::note_iteration(double cost_ms) {
    share_.note_iteration(cost_ms, taking_part_);
    const auto now = Clock::now();
    if (taking_part_ && now - last_statistics_ >= statistics_interval) {
        last_statistics_ = now;
        image_->request_statistics();
    }
}

void SnapshotDesk::deliver(std::uint32_t epoch) {
    auto picture = std::make_unique<Finished>();
    picture->event = requests_.front().event;
    picture->size = image_->size();
    picture->epoch = epoch;
    picture->relative_error = static_cast<float>(image_->statistics().error_high);
    if (picture->event.message.snapshot().format() == v1::Snapshot::EXR) {
        picture->radiance = image_->read_radiance();
    } else {
        image_->compose(DisplayMode::photo, requests_.front().exposure);
        const std::span<const std::uint8_t> pixels = image_->take();
        picture->pixels.assign(pixels.begin(), pixels.end());
    }
    restart();
    requests_.pop_front();
    delivery_.submit(std::move(picture));
}

void SnapshotDesk::encode(Finished& picture, Server& server) {
    const auto width = static_cast<int>(picture.size.x);
    const auto height = static_cast<int>(picture.size.y);
    std::optional<std::string> url;
    try {
        if (picture.radiance.empty()) {
            const std::vector<std::uint8_t> png =
                encode_png({picture.pixels, width, height, false});
            url = server.keep_snapshot({png.begin(), png.end()}, ".png");
        } else {
            url = server.keep_snapshot(exr_bytes(width, height, picture.radiance), ".exr");
        }
    } catch (const std::exception& error) {
        spdlog::error("a snapshot was lost: {}", error.what());
        server.reply_error(picture.event, v1::Error::INTERNAL, "the picture cannot be encoded");
        return;
    }
    if (!url) {
        server.reply_error(picture.event, v1::Error::RESOURCE_EXHAUSTED,
                           "the picture is larger than all that the server keeps");
        return;
    }
    v1::ServerMessage answer;
    answer.mutable_snapshot_ready()->set_url(*url);
    answer.mutable_snapshot_ready()->set_relative_error(picture.relative_error);
    answer.mutable_snapshot_ready()->set_epoch(picture.epoch);
    if (!picture.event.message.has_id()) {
        server.send(picture.event.viewer, answer);
    }
    server.reply(picture.event, answer);
}

SnapshotDesk::Delivery::Delivery(Server& server)
    : server_(server), thread_([this](const std::stop_token& token) { work(token); }) {}

SnapshotDesk::Delivery::~Delivery() = default;

void SnapshotDesk::Delivery::submit(std::unique_ptr<Finished> picture) {
    const std::lock_guard lock(mutex_);
    next_ = std::move(picture);
    changed_.notify_one();
}

bool SnapshotDesk::Delivery::busy() {
    const std::lock_guard lock(mutex_);
    return running_ || next_ != nullptr;
}

void SnapshotDesk::Delivery::work(const std::stop_token& token) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, token, [this] { return next_ != nullptr; }),
           next_ != nullptr && !token.stop_requested()) {
        const std::unique_ptr<Finished> picture = std::move(next_);
        running_ = true;
        lock.unlock();
        encode(*picture, server_);
        lock.lock();
        running_ = false;
    }
}

}  // namespace raybundle
