// SPDX-License-Identifier: Apache-2.0
#include "net/ws/light_acks.h"

#include <algorithm>

namespace raybundle {

void LightAcks::acknowledge(ViewerId viewer, std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    std::uint32_t& newest = numbers_[viewer];
    newest = std::max(newest, number);
    changed_.notify_all();
}

void LightAcks::forget(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    numbers_.erase(viewer);
}

LightAcks::Numbers LightAcks::take(const std::function<bool(ViewerId)>& own,
                                   std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [&] {
        return interrupted_ || std::any_of(numbers_.begin(), numbers_.end(),
                                           [&](const auto& entry) { return own(entry.first); });
    });
    interrupted_ = false;
    Numbers taken;
    std::erase_if(numbers_, [&](const auto& entry) {
        return own(entry.first) && taken.insert(entry).second;
    });
    return taken;
}

void LightAcks::interrupt() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
}

}  // namespace raybundle
