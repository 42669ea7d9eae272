// SPDX-License-Identifier: Apache-2.0
// Ownership of Embree's handles.
#pragma once

#include <embree3/rtcore.h>

#include <memory>

namespace raybundle {

struct EmbreeDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, EmbreeDeleter>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, EmbreeDeleter>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, EmbreeDeleter>;

}  // namespace raybundle
