// SPDX-License-Identifier: Apache-2.0
#include "net/access/wrong_tokens.h"

#include <algorithm>
#include <bit>

namespace raybundle {

WrongTokens::Answer WrongTokens::note(const std::string& peer, double now_ms) {
    const std::lock_guard lock(mutex_);
    ++total_;
    forget_old(now_ms);
    Peer& known = peers_[peer];
    ++known.count;
    known.last_ms = now_ms;
    Answer answer;
    answer.of_this_peer = known.count;
    answer.worth_a_line = std::has_single_bit(known.count);
    for (std::uint64_t i = free_tries; i < known.count && answer.delay_ms < last_delay_ms; ++i) {
        answer.delay_ms = std::clamp(2.0 * answer.delay_ms, first_delay_ms, last_delay_ms);
    }
    if (peers_.size() > max_peers) {
        forget_oldest();
    }
    return answer;
}

void WrongTokens::forget_old(double now_ms) {
    std::erase_if(peers_, [now_ms](const auto& entry) {
        return now_ms - entry.second.last_ms > forgotten_ms;
    });
}

void WrongTokens::forget_oldest() {
    peers_.erase(std::min_element(peers_.begin(), peers_.end(), [](const auto& a, const auto& b) {
        return a.second.last_ms < b.second.last_ms;
    }));
}

std::uint64_t WrongTokens::total() const {
    const std::lock_guard lock(mutex_);
    return total_;
}

}  // namespace raybundle
