// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

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

    /// Number here of a viewer of another server.
    [[nodiscard]] static ViewerId number_here(std::uint32_t server, std::uint32_t viewer);

  private:
    struct Peer {
        TimePoint heard;
        v1::Presence presence;
    };
    std::map<std::uint32_t, Peer> peers_;
};

}  // namespace raybundle
