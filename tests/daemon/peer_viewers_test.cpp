// SPDX-License-Identifier: Apache-2.0
// Numbers of viewers of other servers, without any server.
#include "session/viewers/peer_viewers.h"

#include <gtest/gtest.h>

#include <set>

namespace raybundle {
namespace {

v1::Presence presence_of(std::initializer_list<std::uint32_t> viewers) {
    v1::Presence presence;
    for (const std::uint32_t viewer : viewers) {
        presence.add_viewers()->set_viewer(viewer);
    }
    return presence;
}

std::vector<std::uint32_t> numbers_in(const PeerViewers& peers) {
    v1::Presence all;
    peers.describe(&all);
    std::vector<std::uint32_t> numbers;
    for (const v1::Viewer& viewer : all.viewers()) {
        numbers.push_back(viewer.viewer());
    }
    return numbers;
}

/// A server gets another number each time that it finds Redis again, and counts its viewers on and
/// on.
TEST(PeerViewers, GivesNoNumberTwiceHoweverLargeThoseThereAre) {
    PeerViewers peers;
    const TimePoint now{};
    constexpr std::uint32_t bits = 1U << 20U;
    peers.note(1, presence_of({1, 1 + bits, 0xffffffffU}), now);
    peers.note(4096, presence_of({1}), now);
    peers.note(4097, presence_of({1, 2}), now);
    const std::vector<std::uint32_t> numbers = numbers_in(peers);
    const std::set<std::uint32_t> different(numbers.begin(), numbers.end());
    EXPECT_EQ(numbers.size(), 6U);
    EXPECT_EQ(different.size(), numbers.size());
    EXPECT_GE(*different.begin(), PeerViewers::first_number) << "own viewers have those below";
}

TEST(PeerViewers, KeepANumberAsLongAsTheyAreThere) {
    PeerViewers peers;
    const TimePoint now{};
    EXPECT_TRUE(peers.note(7, presence_of({3}), now));
    const std::vector<std::uint32_t> before = numbers_in(peers);
    EXPECT_FALSE(peers.note(7, presence_of({3}), now)) << "nothing has changed";
    EXPECT_EQ(numbers_in(peers), before);
    EXPECT_EQ(peers.number_here(7, 3, now), before.front()) << "who points is who is there";
    EXPECT_TRUE(peers.note(7, presence_of({4}), now));
    EXPECT_NE(numbers_in(peers), before);
    EXPECT_EQ(peers.find(before.front()), nullptr);
}

/// A server that was killed says no goodbye.
TEST(PeerViewers, OfASilentServerAreForgotten) {
    PeerViewers peers;
    const TimePoint now{};
    const auto after = [now](double seconds) {
        return now + std::chrono::duration_cast<TimePoint::duration>(
                         std::chrono::duration<double>(seconds));
    };
    peers.note(7, presence_of({3}), now);
    peers.note(8, presence_of({3}), after(1.0));
    EXPECT_FALSE(peers.forget_silent(after(PeerViewers::silence_s - 0.1)));
    EXPECT_TRUE(peers.forget_silent(after(PeerViewers::silence_s + 0.1)));
    EXPECT_EQ(numbers_in(peers).size(), 1U) << "who has been heard since stays";
}

}  // namespace
}  // namespace raybundle
