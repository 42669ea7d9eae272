// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/peer_viewers.h"

#include <algorithm>
#include <utility>

namespace raybundle {

ViewerId PeerViewers::number_in(Peer& peer, std::uint32_t viewer) {
    const auto [entry, fresh] = peer.numbers.try_emplace(viewer, 0);
    if (fresh) {
        do {  // comes round after two thousand million viewers
            last_ = std::max(last_ + 1, first_number);
        } while (!taken_.insert(last_).second);
        entry->second = last_;
    }
    return entry->second;
}

ViewerId PeerViewers::number_here(std::uint32_t server, std::uint32_t viewer, TimePoint now) {
    Peer& peer = peers_[server];
    peer.heard = now;
    return number_in(peer, viewer);
}

bool PeerViewers::note(std::uint32_t server, const v1::Presence& presence, TimePoint now) {
    Peer& peer = peers_[server];
    v1::Presence here;
    std::set<std::uint32_t> told;
    for (const v1::Viewer& viewer : presence.viewers()) {
        v1::Viewer& copy = *here.add_viewers();
        copy = viewer;
        copy.set_viewer(number_in(peer, viewer.viewer()));
        told.insert(viewer.viewer());
        if (viewer.following() != 0) {
            copy.set_following(number_in(peer, viewer.following()));
            told.insert(viewer.following());
        }
    }
    std::erase_if(peer.numbers, [&](const auto& entry) {
        const bool left = !told.contains(entry.first);
        return left && taken_.erase(entry.second) > 0;
    });
    const bool changed = peer.presence.SerializeAsString() != here.SerializeAsString();
    peer.heard = now;
    peer.presence = std::move(here);
    return changed;
}

bool PeerViewers::forget_silent(TimePoint now) {
    return std::erase_if(peers_, [&](const auto& peer) {
               const bool silent = seconds(now - peer.second.heard) > silence_s;
               for (const auto& [there, here] : peer.second.numbers) {
                   taken_.erase(silent ? here : 0);
               }
               return silent;
           }) > 0;
}

const v1::Viewer* PeerViewers::find(ViewerId viewer) const {
    for (const auto& [server, peer] : peers_) {
        for (const v1::Viewer& other : peer.presence.viewers()) {
            if (other.viewer() == viewer) {
                return &other;
            }
        }
    }
    return nullptr;
}

void PeerViewers::describe(v1::Presence* presence) const {
    for (const auto& [server, peer] : peers_) {
        presence->MergeFrom(peer.presence);
    }
}

}  // namespace raybundle
