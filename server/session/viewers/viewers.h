// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "scheduling/frame_policy.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// All who watch, by their numbers; and, apart from them, those who only ask (ClientEvent::caller).
class Viewers {
  public:
    explicit Viewers(const FramePolicy& policy) : policy_(policy) {}

    ViewerSession& add(ViewerId viewer, const v1::Hello& hello, const Camera& camera);
    /// One who asks: found by its number, but not counted, and not met on the way through all.
    ViewerSession& add_caller(ViewerId viewer, const v1::Hello& hello, const Camera& camera);
    void erase(ViewerId viewer);
    /// Null where nobody has this number.
    [[nodiscard]] ViewerSession* find(ViewerId viewer) const;
    /// Requires that somebody has it.
    [[nodiscard]] ViewerSession& at(ViewerId viewer) const { return *find(viewer); }

    [[nodiscard]] std::size_t size() const { return sessions_.size(); }
    [[nodiscard]] bool empty() const { return sessions_.empty(); }
    /// Pairs of number and session, by number.
    [[nodiscard]] auto begin() const { return sessions_.begin(); }
    [[nodiscard]] auto end() const { return sessions_.end(); }

    /// What scheduling has to know of each of them, now.
    [[nodiscard]] std::vector<ViewerLoad> loads() const;

  private:
    const FramePolicy& policy_;
    using Sessions = std::map<ViewerId, std::unique_ptr<ViewerSession>>;
    ViewerSession& add_to(Sessions& sessions, ViewerId viewer, const v1::Hello& hello,
                          const Camera& camera) const;

    Sessions sessions_;
    Sessions callers_;
};

}  // namespace raybundle
