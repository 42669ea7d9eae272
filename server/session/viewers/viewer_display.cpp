// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewer_display.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace raybundle {

namespace {

/// The next 1, 2 or 5 times a power of ten, so that a scale that follows the exposure keeps still.
float round_up_125(float value) {
    const float power = std::pow(10.0F, std::floor(std::log10(std::max(value, 1e-6F))));
    const float lead = value / power;
    return power * (lead <= 1.0F ? 1.0F : lead <= 2.0F ? 2.0F : lead <= 5.0F ? 5.0F : 10.0F);
}

}  // namespace

void ViewerDisplay::set(const v1::SetDisplay& message) {
    if (message.has_mode() && message.mode() != v1::SetDisplay::MODE_UNSPECIFIED) {
        mode_ = message.mode() == v1::SetDisplay::FALSE_LUMINANCE ? DisplayMode::false_luminance
                : message.mode() == v1::SetDisplay::FALSE_ILLUMINANCE
                    ? DisplayMode::false_illuminance
                    : DisplayMode::photo;
    }
    const float offset = exposure_offset_;
    const bool automatic = auto_exposure_;
    if (message.has_exposure()) {
        exposure_offset_ = message.exposure();
    }
    if (message.has_auto_exposure()) {
        auto_exposure_ = message.auto_exposure();
    }
    if (message.has_scale_maximum()) {
        scale_maximum_ = message.scale_maximum();
    }
    if (message.has_isolines()) {
        isolines_ = message.isolines();
    }
    if (message.has_scale_unit()) {
        scale_unit_ = message.scale_unit();
    }
    if (message.has_linear_scale()) {
        linear_scale_ = message.linear_scale();
    }
    shown_.set(automatic == auto_exposure_ ? exposure_offset_ - offset : 0.0F);
}

PictureLook ViewerDisplay::look(const ViewerImage* image) const {
    const float automatic = auto_exposure_ && image != nullptr ? image->automatic_exposure() : 0.0F;
    const bool known = !auto_exposure_ || (image != nullptr && image->brightness_known());
    const std::optional<float> shown = known ? shown_.ev() : shown_.last();
    const float exposure = shown.value_or(automatic + exposure_offset_);
    const bool unknown = auto_exposure_ && image == nullptr && !shown;
    return {mode_, exposure, colour_scale(exposure), unknown};
}

float ViewerDisplay::next_exposure(const ViewerImage& image, const ImageStatistics& statistics,
                                   double since_frame_s) {
    if (auto_exposure_ && !image.brightness_known()) {
        return shown_.next(std::nullopt, since_frame_s);
    }
    const float automatic =
        auto_exposure_ ? image.automatic_exposure(statistics.darker_than()) : 0.0F;
    return shown_.next(automatic + exposure_offset_, since_frame_s);
}

ColourScale ViewerDisplay::colour_scale(float exposure) const {
    const float isolines = isolines_ ? scale_unit_ : 0.0F;
    if (scale_maximum_ > 0.0F) {
        return {scale_maximum_, isolines, linear_scale_};
    }
    // Display white, in lx on a surface of albedo 0.5 where illuminance is shown.
    const float white = 1.0F / ViewerImage::display_factor(exposure);
    const bool lux = mode_ == DisplayMode::false_illuminance;
    const float top = lux ? 2.0F * std::numbers::pi_v<float> * white : white;
    return {round_up_125(top / scale_unit_) * scale_unit_, isolines, linear_scale_};
}

}  // namespace raybundle
