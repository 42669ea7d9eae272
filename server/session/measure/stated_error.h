// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/viewer_image.h"

namespace raybundle {

/// Says in a message, v1::Solution or v1::FrameHeader, how well a picture is known: its relative
/// error, or where next to no light arrives how much that may be. Nothing where nothing is known.
template <typename Message>
void state_error(const ImageStatistics& statistics, bool measured, Message& message) {
    if (!statistics.known) {
        return;
    }
    message.set_error_measured(measured);
    if (const auto darker_than = statistics.darker_than()) {
        message.set_darker_than(static_cast<float>(*darker_than));
        return;
    }
    message.set_relative_error(static_cast<float>(statistics.relative_error));
    message.set_error_low(static_cast<float>(statistics.error_low));
    message.set_error_high(static_cast<float>(statistics.error_high));
}

}  // namespace raybundle
