// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "app/progress.h"
#include "research/accuracy/reference_cache.h"

namespace raybundle {

/// What a reference is made for.
struct ReferenceJob {
    const RayScene& scene;
    const LightSampling& lights;
    const CameraRays& camera;
    const std::vector<bool>& measured;
    ReferenceKey key;
    std::string file;  ///< where it is kept between runs
    std::uint64_t seed = 0;
    double seconds = 0.0;  ///< at most
    /// relRMSE of the most accurate picture against a reference, the reference's noise subtracted;
    /// 0 where nothing is left of it.
    std::function<double(const ReferencePicture&)> best_error;
};

/// The reference, taken from its file and made more accurate until it is `reference_margin` times
/// more so than the best picture, or the time is over; then kept in the file again. Throws
/// std::runtime_error where that cannot be read or written.
ReferencePicture make_reference(const ReferenceJob& job, Progress& progress);

}  // namespace raybundle
