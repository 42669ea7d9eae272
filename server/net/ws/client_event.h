// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "raybundle.pb.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// What the render thread hears of a viewer. `joined` carries a valid Hello and comes first; answer
/// it with Welcome. Messages have been validated as far as that needs no scene. `left` comes last.
struct ClientEvent {
    enum class Kind { joined, message, left };

    ViewerId viewer = 0;
    Kind kind = Kind::message;
    v1::ClientMessage message;
    /// Ids of requests that `message` has replaced while it waited (see Inbox); they get its
    /// answer.
    std::vector<std::uint32_t> superseded;
    v1::Role role = v1::EDITOR;  ///< what the viewer's token allows
    /// It is no viewer but asks over HTTP: it sees no pictures, is told nothing unasked, not even
    /// `welcome` unless its Hello has an id, and nobody hears of it. Not said of `left`.
    bool caller = false;
    std::chrono::steady_clock::time_point received{};  ///< of a message: when it came

    /// Whose share of the time for requests it takes: all callers have one share together.
    [[nodiscard]] ViewerId payer() const { return caller ? 0 : viewer; }
};

}  // namespace raybundle
