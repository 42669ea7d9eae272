// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "net/ws/viewer_link.h"

namespace raybundle {

/// Links of all connected viewers. Any thread; a link outlives its removal while somebody holds it.
class ViewerTable {
  public:
    /// Makes the link of a new viewer, with a number never given before.
    std::shared_ptr<ViewerLink> add(std::size_t max_queued_bytes,
                                    const CongestionSettings& congestion) {
        const std::lock_guard lock(mutex_);
        const ViewerId viewer = ++last_;
        auto link = std::make_shared<ViewerLink>(viewer, max_queued_bytes, congestion);
        link->report_light_to(&light_acks_);
        links_.emplace(viewer, link);
        return link;
    }

    void remove(ViewerId viewer) {
        const std::lock_guard lock(mutex_);
        links_.erase(viewer);
        light_acks_.forget(viewer);
    }

    /// Null where the viewer has left.
    [[nodiscard]] std::shared_ptr<ViewerLink> find(ViewerId viewer) const {
        const std::lock_guard lock(mutex_);
        const auto found = links_.find(viewer);
        return found == links_.end() ? nullptr : found->second;
    }

    [[nodiscard]] std::vector<std::shared_ptr<ViewerLink>> all() const {
        const std::lock_guard lock(mutex_);
        std::vector<std::shared_ptr<ViewerLink>> links;
        links.reserve(links_.size());
        for (const auto& [viewer, link] : links_) {
            links.push_back(link);
        }
        return links;
    }

    [[nodiscard]] LightAcks& light_acks() { return light_acks_; }

    [[nodiscard]] std::size_t size() const {
        const std::lock_guard lock(mutex_);
        return links_.size();
    }

  private:
    mutable std::mutex mutex_;
    std::map<ViewerId, std::shared_ptr<ViewerLink>> links_;
    ViewerId last_ = 0;
    LightAcks light_acks_;
};

}  // namespace raybundle
