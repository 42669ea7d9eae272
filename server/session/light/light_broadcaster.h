// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <thread>
#include <vector>

#include "net/server.h"
#include "scheduling/clock.h"
#include "stream/light_window.h"
#include "walkthrough/live/light_stream.h"

namespace raybundle {

/// Sends the light of one scene to all who draw by themselves, as far as their acknowledgements let
/// it. It has a thread of its own: the render thread only hands over what it has read. What waits
/// there is the newest light, and one entry for each viewer.
class LightBroadcaster {
  public:
    /// What a message of light says of itself.
    struct Figures {
        std::uint32_t epoch = 0, iterations = 0;
    };
    /// Messages that have been sent, and their bytes; on the broadcaster's thread.
    using Sent = std::function<void(std::size_t bytes)>;

    LightBroadcaster(Server& server, const Clock& clock, Sent sent);
    LightBroadcaster(const LightBroadcaster&) = delete;
    LightBroadcaster& operator=(const LightBroadcaster&) = delete;
    ~LightBroadcaster();

    /// Another geometry, LightScene.scene: nobody has light of it.
    void begin(std::uint32_t scene, std::vector<LightBlock> blocks);
    /// A viewer has been told of that geometry.
    void add(ViewerId viewer);
    void remove(ViewerId viewer);
    /// Where a viewer is.
    void look(ViewerId viewer, const LightView& view);
    /// The light now; what nobody has begun to look at is replaced. As many values as in all
    /// blocks.
    void publish(std::vector<std::uint32_t> values, const Figures& figures);

  private:
    struct Published {
        std::vector<std::uint32_t> values;
        Figures figures;
    };
    struct Mail {
        std::optional<std::pair<std::uint32_t, std::vector<LightBlock>>> begun;
        std::optional<Published> published;
        std::map<ViewerId, LightView> views;
        std::set<ViewerId> added, removed;
    };
    struct Follower {
        LightFollower follower;
        LightWindow window;
        LightView view;
        bool waits = false;  ///< its queue is full: it gets the newest light once it is not
    };

    void run(const std::stop_token& token);
    /// True where all followers may have something to get.
    bool take_mail(Mail mail);
    void acknowledge(const LightAcks::Numbers& numbers);
    void serve(ViewerId viewer, Follower& follower);

    Server& server_;
    const Clock& clock_;
    const Sent sent_;
    std::mutex mutex_;
    Mail mail_;
    // Of the thread.
    std::optional<LightStream> stream_;
    std::uint32_t scene_ = 0;
    Figures figures_;
    std::map<ViewerId, Follower> followers_;
    std::jthread thread_;  // last: it uses the others
};

}  // namespace raybundle
