// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace raybundle {
namespace {

constexpr double drawn_every = 0.2;    // s
constexpr double logged_every = 60.0;  // s
constexpr int bar_width = 24;

std::string time_left(double seconds) {
    constexpr double longest = 1e6;
    if (!(seconds < longest)) {
        return "time left unknown";
    }
    constexpr double minute = 60.0;
    return seconds < 5.0 * minute ? fmt::format("{:.0f} s left", std::max(seconds, 0.0))
                                  : fmt::format("{:.0f} min left", seconds / minute);
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    clear();
}

void Progress::clear() const {
    if (terminal_) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
    }
}

void Progress::begin(const std::string& stage, const std::string& logged) {
    clear();
    stage_ = stage;
    last_.reset();
    if (!terminal_) {
        last_.emplace();
        if (!logged.empty()) {
            spdlog::info("{}", logged);
        }
    }
}

bool Progress::due() const {
    return !last_ || last_->seconds() >= (terminal_ ? drawn_every : logged_every);
}

void Progress::show(double share, double seconds_left, const std::string& detail) {
    if (!due()) {
        return;
    }
    last_.emplace();
    const double bounded = std::clamp(share, 0.0, 1.0);
    const std::string left = time_left(seconds_left);
    if (!terminal_) {
        spdlog::info("{}: {:.0f} %, {}, {}", stage_, 100.0 * bounded, detail, left);
        return;
    }
    const auto filled = static_cast<std::size_t>(std::lround(bar_width * bounded));
    fmt::print(stderr, "\r\033[K[{}{}] {}, {}, {}", std::string(filled, '='),
               std::string(bar_width - filled, ' '), stage_, detail, left);
    std::fflush(stderr);
}

}  // namespace raybundle
