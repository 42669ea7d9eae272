// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "raybundle.pb.h"
#include "scheduling/clock.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// Who looks at the project on its other servers, as these tell. Their viewers get numbers that no
/// viewer of this server has.
class PeerViewers {
  public:
    /// A server that has been silent for so long is not there any more.
    static constexpr double silence_s = 5.0;

    /// What a server tells of its viewers. False: nothing has changed.
    bool note(std::uint32_t server, const v1::Presence& presence, TimePoint now);
    /// Forgets servers that are silent. False: there is none.
    bool forget_silent(TimePoint now);

    /// Null where there is no such viewer.
    [[nodiscard]] const v1::Viewer* find(ViewerId viewer) const;
    void describe(v1::Presence* presence) const;

    /// Number here of a viewer of another server: it keeps it as long as that server tells of it.
    ViewerId number_here(std::uint32_t server, std::uint32_t viewer, TimePoint now);

    /// This server's own viewers, which count up from 1, have numbers below.
    static constexpr ViewerId first_number = 1U << 31U;

  private:
    struct Peer {
        TimePoint heard;
        v1::Presence presence;
        std::map<std::uint32_t, ViewerId> numbers;  ///< here, by those there
    };
    ViewerId number_in(Peer& peer, std::uint32_t viewer);

    std::map<std::uint32_t, Peer> peers_;
    std::set<ViewerId> taken_;
    ViewerId last_ = first_number - 1;
};

}  // namespace raybundle
