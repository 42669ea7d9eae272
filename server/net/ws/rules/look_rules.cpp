// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/look_rules.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "net/ws/rules/camera_check.h"

namespace raybundle {
namespace {

constexpr float kMaxNear = 1e9F;         // m, as the coordinates of a Vec3
constexpr std::size_t kMaxToken = 8192;  ///< bytes; of a JWT
constexpr float kMaxExposure = 30.0F;    ///< EV
constexpr float kMaxSeconds = 86400.0F;
constexpr std::uint64_t kMaxGridPoints = 1024;
constexpr std::uint32_t kMaxDepthColumns = 512;

}  // namespace

void check_body(const v1::Hello& hello, MessageChecker& check) {
    check.require(!hello.protocol().empty(), "hello.protocol", "is missing");
    check.require(characters(hello.name()) <= kMaxName, "hello.name",
                  "must be at most 64 characters");
    check.require(hello.token().size() <= kMaxToken, "hello.token", "must be at most 8192 bytes");
    if (hello.has_viewport()) {
        check.size(hello.viewport(), true, "hello.viewport");
    }
}

void check_body(const v1::SetCamera& camera, MessageChecker& check) {
    check_view(camera, "setCamera", check);
    if (camera.has_vertical_fov()) {
        check_fov(camera.vertical_fov(), "setCamera.verticalFov", check);
    }
    if (camera.has_near()) {
        check.require(camera.near() >= 0.0F && camera.near() <= kMaxNear, "setCamera.near",
                      "must be 0..1e9 m");
    }
}

void check_body(const v1::GetWalkMap& map, MessageChecker& check) {
    check.require(map.has_eye(), "getWalkMap.eye", "is missing");
}

void check_body(const v1::SetViewport& viewport, MessageChecker& check) {
    check.size(viewport, true, "setViewport");
}

void check_body(const v1::SetTarget& target, MessageChecker& check) {
    if (target.has_relative_error()) {
        const float error = target.relative_error();
        check.require(error > 0.0F && error <= 1.0F, "setTarget.relativeError",
                      "must be above 0 and at most 1");
    }
    if (target.has_seconds()) {
        const float seconds = target.seconds();
        check.require(seconds > 0.0F && seconds <= kMaxSeconds, "setTarget.seconds",
                      "must be above 0 and at most 86400");
    }
}

void check_body(const v1::SetDisplay& display, MessageChecker& check) {
    check.require(display.ByteSizeLong() > 0, "setDisplay",
                  "changes nothing: needs mode, exposure, autoExposure, scaleMaximum, isolines, "
                  "scaleUnit or linearScale");
    if (display.has_mode()) {
        check.require(v1::SetDisplay::Mode_IsValid(display.mode()) &&
                          display.mode() != v1::SetDisplay::MODE_UNSPECIFIED,
                      "setDisplay.mode", "must be PHOTO, FALSE_LUMINANCE or FALSE_ILLUMINANCE");
    }
    check.require(std::abs(display.exposure()) <= kMaxExposure, "setDisplay.exposure",
                  "must be -30..30");
    check.require(display.scale_maximum() >= 0.0F, "setDisplay.scaleMaximum",
                  "must not be negative");
    check.require(!display.has_scale_unit() || display.scale_unit() > 0.0F, "setDisplay.scaleUnit",
                  "must be above 0");
}

void check_body(const v1::SetDepths& depths, MessageChecker& check) {
    const std::uint32_t columns = depths.columns();
    check.require(columns == 0 || (columns >= 2 && columns <= kMaxDepthColumns),
                  "setDepths.columns", "must be 0 or 2..512");
}

void check_body(const v1::Probe& probe, MessageChecker& check) {
    check.require(probe.where_case() != v1::Probe::WHERE_NOT_SET, "probe",
                  "needs a pixel or a ray");
    if (probe.has_pixel()) {
        check.require(probe.pixel().x() >= 0.0F && probe.pixel().y() >= 0.0F, "probe.pixel",
                      "must not be negative");
    }
    if (probe.has_ray()) {
        check.require(probe.ray().has_origin(), "probe.ray.origin", "is missing");
        check.require(glm::length(to_vector(probe.ray().direction())) >= kMinLength,
                      "probe.ray.direction", "must not be zero");
    }
}

void check_body(const v1::ProbeGrid& grid, MessageChecker& check) {
    check.require(grid.has_origin(), "probeGrid.origin", "is missing");
    const glm::dvec3 x = to_vector(grid.step_x());
    const glm::dvec3 y = to_vector(grid.step_y());
    check.require(glm::length(x) >= kMinLength, "probeGrid.stepX", "must not be zero");
    check.require(glm::length(y) >= kMinLength, "probeGrid.stepY", "must not be zero");
    const double sine = glm::length(glm::cross(glm::normalize(x), glm::normalize(y)));
    check.require(sine >= kMinLength, "probeGrid.stepY", "must not lie along stepX");
    const std::uint64_t points = std::uint64_t{grid.columns()} * grid.rows();
    check.require(points >= 1 && points <= kMaxGridPoints, "probeGrid.columns",
                  "columns times rows must be 1..1024");
}

void check_body(const v1::Ack& ack, MessageChecker& check) {
    check.require(ack.decode_ms() >= 0.0, "ack.decodeMs", "must not be negative");
}

void check_body(const v1::AckLight& ack, MessageChecker& check) {
    check.require(ack.light() >= 1, "ackLight.light", "is missing");
}

void check_body(const v1::Snapshot& snapshot, MessageChecker& check) {
    check.size(snapshot, false, "snapshot");
    check.require(snapshot.relative_error() > 0.0F && snapshot.relative_error() <= 1.0F,
                  "snapshot.relativeError", "must be above 0 and at most 1");
    check.require(snapshot.format() == v1::Snapshot::EXR || snapshot.format() == v1::Snapshot::PNG,
                  "snapshot.format", "must be EXR or PNG");
}

}  // namespace raybundle
