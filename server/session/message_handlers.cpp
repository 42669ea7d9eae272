// SPDX-License-Identifier: Apache-2.0
#include "session/message_handlers.h"

#include <algorithm>

namespace raybundle {

namespace {

/// Calls a method of one of the services.
template <auto service, auto method>
HandlerResult call(SessionServices& services, ViewerSession& session, const ClientEvent& event) {
    return ((services.*service).*method)(session, event);
}

using S = SessionServices;
using Body = v1::ClientMessage;

constexpr MessageHandler handlers[] = {
    {Body::kSetCamera, call<&S::views, &ViewService::set_camera>},
    {Body::kSetViewport, call<&S::admission, &ViewerAdmission::set_viewport>},
    {Body::kSetDisplay, call<&S::views, &ViewService::set_display>},
    {Body::kSetDepths, call<&S::views, &ViewService::set_depths>},
    {Body::kSetHidden, call<&S::views, &ViewService::set_hidden>},
    {Body::kSetDrawing, call<&S::light, &LightService::set_drawing>},
    {Body::kSetTarget, call<&S::views, &ViewService::set_target>},
    {Body::kGetWalkMap, call<&S::views, &ViewService::get_walk_map>},
    {Body::kFollow, call<&S::presence, &PresenceService::follow>},

    {Body::kMoveObject, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kSetLight, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kSetMaterial, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kSetDaylight, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kUndo, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kAddObject, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kRemoveObject, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kAddLuminaire, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kRemoveLight, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kSetGroup, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kApplyLightingScene, call<&S::changes, &ChangeCoordinator::request>},
    {Body::kSaveLightingScene, call<&S::lighting, &LightingService::save>},
    {Body::kPlayAnimation, call<&S::animations, &AnimationService::play>},
    {Body::kRemoveLightingScene, call<&S::lighting, &LightingService::remove>},

    {Body::kProbe, call<&S::probes, &ProbeService::probe>},
    {Body::kProbeGrid, call<&S::probes, &ProbeService::probe_grid>},
    {Body::kMeasure, call<&S::measurements, &MeasureService::measure>},
    {Body::kRemoveMeasurement, call<&S::measurements, &MeasureService::remove>},
    {Body::kSetZone, call<&S::measurements, &MeasureService::set_zone>},
    {Body::kSetRequirement, call<&S::measurements, &MeasureService::set_requirement>},
    {Body::kRemoveRequirement, call<&S::measurements, &MeasureService::remove_requirement>},

    {Body::kSnapshot, call<&S::snapshots, &SnapshotService::add>},
    {Body::kCancelSnapshot, call<&S::snapshots, &SnapshotService::cancel>},

    {Body::kAddPin, call<&S::review, &ReviewService::add_pin>},
    {Body::kRemovePin, call<&S::review, &ReviewService::remove_pin>},
    {Body::kReplyToPin, call<&S::review, &ReviewService::reply_to_pin>},
    {Body::kSetPin, call<&S::review, &ReviewService::set_pin>},
    {Body::kSaveViewpoint, call<&S::review, &ReviewService::save_viewpoint>},
    {Body::kRemoveViewpoint, call<&S::review, &ReviewService::remove_viewpoint>},
    {Body::kPointAt, call<&S::review, &ReviewService::point_at>},
    {Body::kListChanges, call<&S::review, &ReviewService::list_changes>},

    {Body::kListScenes, call<&S::scenes, &SceneService::request_scene>},
    {Body::kOpenScene, call<&S::scenes, &SceneService::request_scene>},
    {Body::kMeasureEffects, call<&S::scenes, &SceneService::measure_effects>},
};

}  // namespace

std::span<const MessageHandler> message_handlers() {
    return handlers;
}

HandleMessage handler_of(v1::ClientMessage::BodyCase body) {
    const auto* const found =
        std::find_if(std::begin(handlers), std::end(handlers),
                     [body](const MessageHandler& handler) { return handler.body == body; });
    return found == std::end(handlers) ? nullptr : found->handle;
}

}  // namespace raybundle
