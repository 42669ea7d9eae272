// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_progress.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace raybundle {
namespace {

constexpr double interval = 0.2;  // s
constexpr int bar_width = 24;

}  // namespace

AccuracyProgress::AccuracyProgress() : terminal_(isatty(STDERR_FILENO) != 0) {}

AccuracyProgress::~AccuracyProgress() {
    clear();
}

void AccuracyProgress::clear() const {
    if (terminal_) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
    }
}

void AccuracyProgress::begin(const std::string& stage) {
    clear();
    stage_ = stage;
    last_.reset();
    if (!terminal_) {
        spdlog::info("{}", stage);
    }
}

void AccuracyProgress::show(double share, double seconds_left, const std::string& detail) {
    if (!terminal_ || (last_ && last_->seconds() < interval)) {
        return;
    }
    last_.emplace();
    const auto filled =
        static_cast<std::size_t>(std::lround(bar_width * std::clamp(share, 0.0, 1.0)));
    fmt::print(stderr, "\r\033[K[{}{}] {}, {}, {:.0f} s left", std::string(filled, '='),
               std::string(bar_width - filled, ' '), stage_, detail, std::max(seconds_left, 0.0));
    std::fflush(stderr);
}

}  // namespace raybundle
