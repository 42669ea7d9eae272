// SPDX-License-Identifier: Apache-2.0
#include "session/snapshots/snapshot_queue.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "gpu/egl_context.h"
#include "scheduling/elapsed.h"
#include "session/snapshots/snapshot_quota.h"
#include "session/viewers/picture_refusal.h"
#include "stream/image_encoder.h"
#include "view/image_file.h"

namespace raybundle {

namespace {

constexpr std::chrono::hours max_time(1);
constexpr std::chrono::milliseconds statistics_interval(100);
constexpr double earlier_slice_ms = 40.0;          // of iterations of an earlier scene at once
constexpr std::chrono::seconds earlier_kept(120);  // after its last picture

}  // namespace

/// A picture on its way from the GPU to a file.
struct SnapshotQueue::Finished {
    ClientEvent event;
    glm::uvec2 size{0};
    std::vector<glm::vec4> radiance;   ///< of EXR, row 0 at the top
    std::vector<std::uint8_t> pixels;  ///< of PNG, likewise, RGBA
    float relative_error = 1.0F;
    std::uint32_t epoch = 0;
    float exposure = 0.0F;
};

SnapshotQueue::SnapshotQueue(Server& server, MakeEarlier make_earlier)
    : server_(server), make_earlier_(std::move(make_earlier)) {}

SnapshotQueue::~SnapshotQueue() = default;

void SnapshotQueue::add(const ClientEvent& request, const Camera& camera, const PictureLook& look) {
    std::vector<WaitingSnapshot> waiting;
    for (const Request& other : requests_) {
        waiting.push_back({other.event.viewer, other.event.role});
    }
    const WaitingSnapshot next{request.viewer, request.role};
    if (const auto refusal = refuse_snapshot(waiting, next)) {
        server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED, *refusal);
        return;
    }
    Request added{request, camera, look};
    if (!request.message.snapshot().has_epoch()) {
        added.look = {DisplayMode::photo, look.exposure, {}};
    }
    const auto place = static_cast<std::ptrdiff_t>(place_of_snapshot(waiting, next));
    requests_.insert(requests_.begin() + place, std::move(added));
}

const ViewerImage* SnapshotQueue::picture_of(ViewerId viewer) const {
    return !requests_.empty() && requests_.front().event.viewer == viewer ? image_.get() : nullptr;
}

bool SnapshotQueue::is_making(ViewerId viewer, std::uint32_t request) const {
    return picture_of(viewer) != nullptr && requests_.front().event.message.has_id() &&
           requests_.front().event.message.id() == request;
}

void SnapshotQueue::cancel(const ClientEvent& request) {
    const std::uint32_t id = request.message.cancel_snapshot().request();
    const auto found = std::find_if(requests_.begin(), requests_.end(), [&](const Request& r) {
        return r.event.viewer == request.viewer && r.event.message.has_id() &&
               r.event.message.id() == id;
    });
    if (found == requests_.end()) {
        server_.reply_error(request, v1::Error::NOT_FOUND,
                            "cancelSnapshot.request: no snapshot " + std::to_string(id) +
                                " of this viewer is being made");
        return;
    }
    server_.reply_error(found->event, v1::Error::CANCELLED, "the snapshot was taken back");
    if (found == requests_.begin()) {
        drop_picture();
    }
    requests_.erase(found);
    server_.reply_ok(request);
}

void SnapshotQueue::forget(ViewerId viewer) {
    if (picture_of(viewer) != nullptr) {
        drop_picture();
    }
    std::erase_if(requests_, [viewer](const Request& r) { return r.event.viewer == viewer; });
}

void SnapshotQueue::restart() {
    if (!apart_) {
        drop_picture();
    }
}

void SnapshotQueue::drop_picture() {
    image_.reset();
    tiles_.reset();
    taking_part_ = false;
    apart_ = false;
}

void SnapshotQueue::refuse_all() {
    drop_picture();
    for (const Request& request : requests_) {
        server_.reply_error(request.event, v1::Error::INTERNAL, "the server is stopping");
    }
    requests_.clear();
}

/// False where there is no memory for it: the request is answered.
bool SnapshotQueue::begin(const GpuScene& scene, const RadianceStore& store,
                          const ViewPrograms& programs) {
    const v1::Snapshot& wanted = requests_.front().event.message.snapshot();
    try {
        if (!tiles_) {
            tiles_.emplace(glm::uvec2(wanted.width(), wanted.height()),
                           wanted.format() == v1::Snapshot::EXR ? PictureTiles::Content::radiance
                                                                : PictureTiles::Content::display);
        }
        image_ = std::make_unique<ViewerImage>(scene, store, programs, tiles_->drawn_size());
        image_->set_camera(tiles_->drawn_camera(requests_.front().camera));
        begun_ = Clock::now();
        return true;
    } catch (const GpuError& error) {
        drop(error);
        return false;
    }
}

/// The picture cannot be made.
void SnapshotQueue::drop(const GpuError& error) {
    const ClientEvent& event = requests_.front().event;
    spdlog::error("no snapshot for viewer {}: {}", event.viewer, error.what());
    const Refusal refusal = refusal_of(error);
    server_.reply_error(event, refusal.code, refusal.text);
    drop_picture();
    requests_.pop_front();
}

bool SnapshotQueue::done() {
    const Request& request = requests_.front();
    if (!image_->smoothed()) {
        return false;
    }
    const ImageStatistics& statistics = image_->statistics();
    const auto share =
        static_cast<double>(tiles_->done() + 1) / static_cast<double>(tiles_->count());
    return Clock::now() - request.since > share * max_time ||
           (image_->samples() >= min_samples && statistics.samples >= min_samples &&
            statistics.meets(request.error()));
}

ViewerImage* SnapshotQueue::next_receiver(const GpuScene& scene, const RadianceStore& store,
                                          const ViewPrograms& programs, std::uint32_t epoch,
                                          bool undisturbed) {
    taking_part_ = false;
    undisturbed_ = undisturbed;
    if (earlier_ && requests_.empty() && Clock::now() - earlier_used_ > earlier_kept) {
        earlier_.reset();
    }
    if (requests_.empty() || (!undisturbed && !share_.may())) {
        return nullptr;
    }
    if (wants_earlier(epoch)) {
        work_on_earlier();
        return nullptr;
    }
    const auto start = Clock::now();
    if (!image_ && !begin(scene, store, programs)) {
        return nullptr;
    }
    if (!image_->smoothed()) {
        image_->smooth_step();
        charge_since(start);
    } else if (done()) {
        if (!delivery_.busy()) {
            try {
                deliver(epoch);
            } catch (const GpuError& error) {
                drop(error);
            }
            charge_since(start);
        }
        return nullptr;
    }
    taking_part_ = true;
    return image_.get();
}

void SnapshotQueue::charge_since(Clock::time_point start) {
    if (!undisturbed_) {
        share_.charge(milliseconds_since(start));
    }
}

void SnapshotQueue::note_iteration(double cost_ms) {
    if (!undisturbed_) {
        share_.note_iteration(cost_ms, taking_part_);
    }
    if (taking_part_) {
        refresh_statistics();
    }
}

void SnapshotQueue::refresh_statistics() {
    const auto now = Clock::now();
    if (now - last_statistics_ >= statistics_interval) {
        last_statistics_ = now;
        image_->request_statistics();
    }
}

/// The next picture is not of the present scene, whose epoch this is.
bool SnapshotQueue::wants_earlier(std::uint32_t epoch) const {
    const v1::Snapshot& wanted = requests_.front().event.message.snapshot();
    return apart_ || (wanted.has_epoch() && wanted.epoch() != epoch);
}

/// False where it cannot be had: the request is answered. Others wait while shaders are compiled.
bool SnapshotQueue::prepare_earlier() {
    const std::uint32_t epoch = requests_.front().event.message.snapshot().epoch();
    if (earlier_ && earlier_->epoch() == epoch) {
        return true;
    }
    earlier_.reset();
    try {
        earlier_ = make_earlier_(epoch);
    } catch (const GpuError& error) {
        drop(error);
        return false;
    }
    if (!earlier_) {
        server_.reply_error(requests_.front().event, v1::Error::NOT_FOUND,
                            "snapshot.epoch: what was there is not known any more");
        drop_picture();
        requests_.pop_front();
    }
    return earlier_ != nullptr;
}

/// Some iterations of the earlier scene, as far as there is time for them.
void SnapshotQueue::work_on_earlier() {
    if (!image_) {
        if (!prepare_earlier() ||
            !begin(earlier_->solver().scene(), earlier_->solver().store(), earlier_->programs())) {
            return;
        }
        apart_ = true;
    }
    earlier_used_ = Clock::now();
    try {
        do {
            const auto start = Clock::now();
            if (!image_->smoothed()) {
                image_->smooth_step();
            }
            earlier_->step(*image_);
            refresh_statistics();
            charge_since(start);
            if (earlier_->between_groups() && finish_earlier()) {
                return;
            }
        } while ((undisturbed_ || share_.may()) &&
                 milliseconds_since(earlier_used_) < earlier_slice_ms);
    } catch (const GpuError& error) {
        drop(error);
    }
}

/// Delivers the picture where it is done. True if it has been.
bool SnapshotQueue::finish_earlier() {
    if (!done() || delivery_.busy()) {
        return false;
    }
    deliver(earlier_->epoch());
    return true;
}

/// Takes the tile that is done, and delivers the picture where it was the last one.
void SnapshotQueue::deliver(std::uint32_t epoch) {
    tiles_->take(*image_, requests_.front().look);
    image_.reset();
    taking_part_ = false;
    if (!tiles_->complete()) {
        return;
    }
    auto picture = std::make_unique<Finished>();
    picture->event = requests_.front().event;
    picture->size = tiles_->size();
    picture->epoch = epoch;
    picture->relative_error = static_cast<float>(tiles_->error_high());
    picture->radiance = tiles_->take_radiance();
    picture->pixels = tiles_->take_display();
    if (picture->radiance.empty()) {
        picture->exposure = requests_.front().look.exposure;
    }
    drop_picture();
    requests_.pop_front();
    delivery_.submit(std::move(picture));
}

void SnapshotQueue::encode(Finished& picture, Server& server) {
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
    answer.mutable_snapshot_ready()->set_exposure(picture.exposure);
    if (!picture.event.message.has_id()) {
        server.send(picture.event.viewer, answer);
    }
    server.reply(picture.event, answer);
}

SnapshotQueue::Delivery::Delivery(Server& server)
    : server_(server), thread_([this](const std::stop_token& token) { work(token); }) {}

SnapshotQueue::Delivery::~Delivery() = default;

void SnapshotQueue::Delivery::submit(std::unique_ptr<Finished> picture) {
    const std::lock_guard lock(mutex_);
    next_ = std::move(picture);
    changed_.notify_one();
}

bool SnapshotQueue::Delivery::busy() {
    const std::lock_guard lock(mutex_);
    return running_ || next_ != nullptr;
}

void SnapshotQueue::Delivery::work(const std::stop_token& token) {
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
