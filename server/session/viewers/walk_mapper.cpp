// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/walk_mapper.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "scheduling/clock.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

WalkMapper::WalkMapper(const Scene& scene, double rest, Answer answer, std::mutex* geometry)
    : scene_(scene), rest_(rest), answer_(std::move(answer)), geometry_(geometry) {
    thread_ = std::jthread([this](const std::stop_token& token) { run(token); });
}

void WalkMapper::ask(const ClientEvent& request, std::uint32_t epoch) {
    Job job{request, object_places(scene_), epoch};
    std::optional<ClientEvent> replaced;
    {
        const std::lock_guard lock(mutex_);
        const auto same = std::find_if(jobs_.begin(), jobs_.end(), [&](const Job& other) {
            return other.request.viewer == request.viewer;
        });
        if (same != jobs_.end()) {
            replaced = std::move(same->request);
            *same = std::move(job);
        } else {
            jobs_.push_back(std::move(job));
        }
    }
    changed_.notify_all();
    if (replaced) {
        answer_(*replaced, std::nullopt, epoch);
    }
}

WalkMap WalkMapper::map_of(const std::vector<glm::mat4>& worlds, const glm::vec3& eye) const {
    const std::unique_lock lock =
        geometry_ != nullptr ? std::unique_lock(*geometry_) : std::unique_lock<std::mutex>();
    return make_walk_map(scene_, worlds, eye);
}

void WalkMapper::run(const std::stop_token& token) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, token, [this] { return !jobs_.empty(); })) {
        const Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        const SteadyClock clock;
        const TimePoint begun = clock.now();
        const glm::vec3 eye = from_message(job.request.message.get_walk_map().eye());
        answer_(job.request, map_of(job.worlds, eye), job.epoch);
        const std::chrono::duration<double, std::milli> pause(rest_ * clock.ms_since(begun));
        lock.lock();
        changed_.wait_for(lock, token, pause, [] { return false; });
    }
}

}  // namespace raybundle
