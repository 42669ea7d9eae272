// SPDX-License-Identifier: Apache-2.0
#include "session/snapshots/snapshot_queue.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "gpu/egl_context.h"
#include "session/snapshots/snapshot_quota.h"
#include "session/viewers/picture_refusal.h"
#include "stream/image_encoder.h"
#include "view/image/image_file.h"

namespace raybundle {

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

SnapshotQueue::SnapshotQueue(Server& server, const Clock& clock, const SnapshotPaceSettings& pace,
                             MakeEarlier make_earlier)
    : server_(server),
      clock_(clock),
      pace_(pace),
      make_earlier_(std::move(make_earlier)),
      share_(pace.share, pace.max_credit_ms, pace.cost_smoothing) {}

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
    Request added{request, camera, look, clock_.now()};
    if (!request.message.snapshot().has_epoch()) {
        added.look = {DisplayMode::photo, look.exposure, {}, look.automatic};
    }
    const auto place = static_cast<std::ptrdiff_t>(place_of_snapshot(waiting, next));
    requests_.insert(requests_.begin() + place, std::move(added));
}

const ViewerImage* SnapshotQueue::picture_of(ViewerId viewer) const {
    return !requests_.empty() && requests_.front().event.viewer == viewer ? picture_.image.get()
                                                                          : nullptr;
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
    if (!picture_.apart) {
        drop_picture();
    }
}

void SnapshotQueue::drop_picture() {
    picture_ = Picture();
}

void SnapshotQueue::refuse_all() {
    drop_picture();
    for (const Request& request : requests_) {
        server_.reply_error(request.event, v1::Error::UNAVAILABLE, "the server is stopping");
    }
    requests_.clear();
}

/// False where there is no memory for it: the request is answered.
bool SnapshotQueue::begin(const GpuScene& scene, const RadianceStore& store,
                          const ViewPrograms& programs) {
    const v1::Snapshot& wanted = requests_.front().event.message.snapshot();
    try {
        if (!picture_.tiles) {
            picture_.tiles.emplace(glm::uvec2(wanted.width(), wanted.height()),
                                   wanted.format() == v1::Snapshot::EXR
                                       ? PictureTiles::Content::radiance
                                       : PictureTiles::Content::display);
        }
        picture_.image =
            std::make_unique<ViewerImage>(scene, store, programs, picture_.tiles->drawn_size());
        picture_.image->set_camera(picture_.tiles->drawn_camera(requests_.front().camera));
        picture_.begun = clock_.now();
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
    if (!picture_.image->smoothed()) {
        return false;
    }
    const ImageStatistics& statistics = picture_.image->statistics();
    const auto share = static_cast<double>(picture_.tiles->done() + 1) /
                       static_cast<double>(picture_.tiles->count());
    return seconds(clock_.now() - request.since) > share * pace_.max_time_s ||
           (picture_.image->samples() >= min_samples && statistics.samples >= min_samples &&
            statistics.meets(request.error()));
}

ViewerImage* SnapshotQueue::next_receiver(const GpuScene& scene, const RadianceStore& store,
                                          const ViewPrograms& programs, std::uint32_t epoch,
                                          bool undisturbed) {
    picture_.taking_part = false;
    undisturbed_ = undisturbed;
    if (earlier_ && requests_.empty() &&
        seconds(clock_.now() - earlier_used_) > pace_.earlier_kept_s) {
        earlier_.reset();
    }
    if (requests_.empty() || (!undisturbed && !share_.may())) {
        return nullptr;
    }
    if (wants_earlier(epoch)) {
        work_on_earlier();
        return nullptr;
    }
    if (held_) {
        return nullptr;
    }
    const auto start = clock_.now();
    if (!picture_.image && !begin(scene, store, programs)) {
        return nullptr;
    }
    if (!picture_.image->smoothed()) {
        picture_.image->smooth_step();
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
    picture_.taking_part = true;
    return picture_.image.get();
}

void SnapshotQueue::charge_since(TimePoint start) {
    if (!undisturbed_) {
        share_.charge(clock_.ms_since(start));
    }
}

void SnapshotQueue::note_iteration(double cost_ms) {
    if (!undisturbed_) {
        share_.note_iteration(cost_ms, picture_.taking_part);
    }
    if (picture_.taking_part) {
        refresh_statistics();
    }
}

void SnapshotQueue::refresh_statistics() {
    const auto now = clock_.now();
    if (seconds(now - last_statistics_) >= pace_.statistics_interval_s) {
        last_statistics_ = now;
        picture_.image->request_statistics();
    }
}

/// The next picture is not of the present scene, whose epoch this is.
bool SnapshotQueue::wants_earlier(std::uint32_t epoch) const {
    const v1::Snapshot& wanted = requests_.front().event.message.snapshot();
    return picture_.apart || (wanted.has_epoch() && wanted.epoch() != epoch);
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

/// How long the earlier scene may iterate at once, ms: where all rest, as long as the present one
/// has since. Who compares waits for it as others wait for their pictures to refine.
double SnapshotQueue::earlier_turn_ms() const {
    return undisturbed_ ? std::clamp(clock_.ms_since(earlier_used_), pace_.earlier_slice_ms,
                                     pace_.longest_turn_ms)
                        : pace_.earlier_slice_ms;
}

/// Some iterations of the earlier scene, as far as there is time for them. Whoever asks for
/// anything meanwhile does not wait longer than a slice.
void SnapshotQueue::work_on_earlier() {
    if (!picture_.image) {
        if (!prepare_earlier() ||
            !begin(earlier_->solver().scene(), earlier_->solver().store(), earlier_->programs())) {
            return;
        }
        picture_.apart = true;
    }
    const double turn_ms = earlier_turn_ms();
    const auto begun = clock_.now();
    try {
        double spent_ms = 0.0;
        do {
            const auto start = clock_.now();
            if (!picture_.image->smoothed()) {
                picture_.image->smooth_step();
            }
            earlier_->step(*picture_.image);
            refresh_statistics();
            charge_since(start);
            if (earlier_->between_groups() && finish_earlier()) {
                break;
            }
            spent_ms = clock_.ms_since(begun);
        } while ((undisturbed_ || share_.may()) && spent_ms < turn_ms &&
                 (spent_ms < pace_.earlier_slice_ms || server_.inbox().size() == 0));
    } catch (const GpuError& error) {
        drop(error);
    }
    earlier_used_ = clock_.now();
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
    PictureLook& look = requests_.front().look;
    if (std::exchange(look.automatic, false)) {  // by the first tile, for all of them
        look.exposure += picture_.image->automatic_exposure();
    }
    picture_.tiles->take(*picture_.image, look);
    picture_.image.reset();
    picture_.taking_part = false;
    if (!picture_.tiles->complete()) {
        return;
    }
    auto picture = std::make_unique<Finished>();
    picture->event = requests_.front().event;
    picture->size = picture_.tiles->size();
    picture->epoch = epoch;
    picture->relative_error = static_cast<float>(picture_.tiles->error_high());
    picture->radiance = picture_.tiles->take_radiance();
    picture->pixels = picture_.tiles->take_display();
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
