// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/peer_viewers.h"

#include <utility>

namespace raybundle {

namespace {

constexpr unsigned viewer_bits = 20;  // of a viewer's number; those above are the server's

}  // namespace

ViewerId PeerViewers::number_here(std::uint32_t server, std::uint32_t viewer) {
    return (server << viewer_bits) | (viewer & ((1U << viewer_bits) - 1));
}

bool PeerViewers::note(std::uint32_t server, const v1::Presence& presence, TimePoint now) {
    v1::Presence here;
    for (const v1::Viewer& viewer : presence.viewers()) {
        v1::Viewer& copy = *here.add_viewers();
        copy = viewer;
        copy.set_viewer(number_here(server, viewer.viewer()));
        if (viewer.following() != 0) {
            copy.set_following(number_here(server, viewer.following()));
        }
    }
    Peer& peer = peers_[server];
    const bool changed = peer.presence.SerializeAsString() != here.SerializeAsString();
    peer = {now, std::move(here)};
    return changed;
}

bool PeerViewers::forget_silent(TimePoint now) {
    return std::erase_if(peers_, [now](const auto& peer) {
               return seconds(now - peer.second.heard) > silence_s;
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
