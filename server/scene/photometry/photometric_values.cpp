// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/photometric_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace raybundle {
namespace {

/// Values below zero are noise of the measurement where reading them as 0 adds no more than this
/// share of the flux: a tenth of the percent that photometers differ by.
constexpr double max_noise_share = 1e-3;

IesProfile without_noise(const IesReader& reader, IesProfile::Data data, int lowest_line) {
    const double lowest = *std::min_element(data.candela.begin(), data.candela.end());
    if (lowest >= 0.0) {
        return IesProfile(std::move(data));
    }
    const double raw = IesProfile(data).flux();
    for (double& candela : data.candela) {
        candela = std::max(candela, 0.0);
    }
    data.notes.push_back(
        fmt::format("it has negative candela values, down to {}, which are read as 0", lowest));
    IesProfile profile(std::move(data));
    if (profile.flux() - raw > max_noise_share * profile.flux()) {
        reader.fail(lowest_line, fmt::format("a candela value is {}: more than noise", lowest));
    }
    return profile;
}

}  // namespace

IesProfile checked_profile(const IesReader& reader, IesProfile::Data data, int lowest_line) {
    IesProfile profile = without_noise(reader, std::move(data), lowest_line);
    if (!(profile.flux() > 0.0) || !std::isfinite(profile.flux())) {
        reader.fail("the luminaire gives no light");
    }
    return profile;
}

}  // namespace raybundle
