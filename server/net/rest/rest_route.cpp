// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_route.h"

namespace raybundle {
namespace {

using enum HttpMethod;
using enum RestBody;

const std::vector<RestRoute>& table() {
    static const std::vector<RestRoute> routes{
        {get,
         "/api/v1/scene",
         "getScene",
         "All that a newcomer is told.",
         {"hello"},
         none,
         {"welcome"}},
        {get,
         "/api/v1/objects",
         "listObjects",
         "The scene's objects.",
         {"hello"},
         none,
         {"welcome.scene.objects"}},
        {get,
         "/api/v1/objects/{object}",
         "getObject",
         "One object.",
         {"hello"},
         none,
         {"welcome.scene.objects"},
         "id"},
        {patch,
         "/api/v1/objects/{object}",
         "moveObject",
         "Moves an object.",
         {"moveObject"},
         message,
         {"sceneChanged"}},
        {get,
         "/api/v1/lights",
         "listLights",
         "The scene's lights.",
         {"hello"},
         none,
         {"welcome.scene.lights"}},
        {get,
         "/api/v1/lights/{light}",
         "getLight",
         "One light.",
         {"hello"},
         none,
         {"welcome.scene.lights"},
         "id"},
        {patch,
         "/api/v1/lights/{light}",
         "setLight",
         "Changes a light.",
         {"setLight"},
         message,
         {"sceneChanged", "ok"}},
        {get,
         "/api/v1/materials",
         "listMaterials",
         "The scene's materials.",
         {"hello"},
         none,
         {"welcome.scene.materials"}},
        {get,
         "/api/v1/materials/{material}",
         "getMaterial",
         "One material.",
         {"hello"},
         none,
         {"welcome.scene.materials"},
         "id"},
        {patch,
         "/api/v1/materials/{material}",
         "setMaterial",
         "Changes a material.",
         {"setMaterial"},
         message,
         {"sceneChanged"}},

        {get,
         "/api/v1/changes",
         "listChanges",
         "What has been changed, by whom and when.",
         {"listChanges"},
         none,
         {"changeHistory"}},
        {post,
         "/api/v1/changes",
         "change",
         "Changes the scene; one change a request.",
         {"moveObject", "setLight", "setMaterial", "setDaylight", "setGroup", "addObject",
          "removeObject", "addLuminaire", "removeLight", "saveLightingScene", "applyLightingScene",
          "removeLightingScene", "playAnimation"},
         one_of,
         {"sceneChanged", "ok", "lightingSceneChanged", "animationChanged"}},
        {post,
         "/api/v1/undo",
         "undo",
         "Brings the scene back to an earlier epoch.",
         {"undo"},
         message,
         {"ok"}},

        {get, "/api/v1/pins", "listPins", "All pins.", {"hello"}, none, {"welcome.pins"}},
        {post,
         "/api/v1/pins",
         "addPin",
         "Leaves a note at a point, with the light there.",
         {"addPin"},
         message,
         {"pinChanged"},
         "pin",
         201},
        {get,
         "/api/v1/pins/{pin}",
         "getPin",
         "One pin, with its thread.",
         {"hello"},
         none,
         {"welcome.pins"},
         "pin"},
        {patch,
         "/api/v1/pins/{pin}",
         "setPin",
         "Opens, resolves or assigns a pin.",
         {"setPin"},
         message,
         {"pinChanged"}},
        {remove,
         "/api/v1/pins/{pin}",
         "removePin",
         "Takes a pin away.",
         {"removePin"},
         none,
         {"pinChanged"}},
        {post,
         "/api/v1/pins/{pin}/replies",
         "replyToPin",
         "Adds to the thread of a pin.",
         {"replyToPin"},
         message,
         {"pinChanged"}},
        {get,
         "/api/v1/viewpoints",
         "listViewpoints",
         "All viewpoints that were saved.",
         {"hello"},
         none,
         {"welcome.viewpoints"}},
        {post,
         "/api/v1/viewpoints",
         "saveViewpoint",
         "Keeps a viewpoint for everybody.",
         {"saveViewpoint"},
         message,
         {"viewpointChanged"},
         "viewpoint",
         201},
        {get,
         "/api/v1/viewpoints/{viewpoint}",
         "getViewpoint",
         "One viewpoint.",
         {"hello"},
         none,
         {"welcome.viewpoints"},
         "viewpoint"},
        {remove,
         "/api/v1/viewpoints/{viewpoint}",
         "removeViewpoint",
         "Takes a viewpoint away.",
         {"removeViewpoint"},
         none,
         {"viewpointChanged"}},

        {post,
         "/api/v1/probes",
         "probe",
         "Measures the first surface along a ray.",
         {"probe"},
         message,
         {"probeResult"}},
        {post,
         "/api/v1/measurements",
         "measure",
         "Measures light at points in the air, each number with its interval.",
         {"measure"},
         message,
         {"measured"}},
        {get,
         "/api/v1/zones",
         "listZones",
         "Measurements that the project keeps.",
         {"hello"},
         none,
         {"welcome.zones"}},
        {get,
         "/api/v1/zones/{measurement}",
         "getZone",
         "One zone, as it was measured last.",
         {"hello"},
         none,
         {"welcome.zones"},
         "measurement"},
        {patch,
         "/api/v1/zones/{measurement}",
         "setZone",
         "Names a zone anew, or assigns it another requirement.",
         {"setZone"},
         message,
         {"ok"}},
        {remove,
         "/api/v1/zones/{measurement}",
         "removeZone",
         "Takes a zone away.",
         {"removeMeasurement"},
         none,
         {"ok"}},
        {get,
         "/api/v1/requirements",
         "listRequirements",
         "What zones may be asked to meet.",
         {"hello"},
         none,
         {"welcome.requirements"}},
        {post,
         "/api/v1/requirements",
         "setRequirement",
         "Adds a requirement, or replaces it.",
         {"setRequirement"},
         message,
         {"ok"}},
        {remove,
         "/api/v1/requirements/{name}",
         "removeRequirement",
         "Takes a requirement away.",
         {"removeRequirement"},
         none,
         {"ok"}},

        {post,
         "/api/v1/snapshots",
         "takeSnapshot",
         "Renders a picture apart; the answer names where it is.",
         {"setCamera", "setHidden", "setDisplay", "snapshot"},
         sequence,
         {"snapshotReady"},
         {},
         200,
         0.0},
        {post,
         "/api/v1/effects",
         "measureEffects",
         "Measures what each effect costs here.",
         {"measureEffects"},
         message,
         {"effectCosts"}},

        {get,
         "/api/v1/scenes",
         "listScenes",
         "Scenes that the server can open.",
         {"listScenes"},
         none,
         {"sceneList"}},
        {post,
         "/api/v1/scenes/open",
         "openScene",
         "Shows another scene to everybody.",
         {"openScene"},
         message,
         {"ok"}},
        {get,
         "/api/v1/photometry",
         "listPhotometry",
         "Photometric files that luminaires shine by.",
         {},
         none,
         {},
         {},
         200,
         0.0,
         RestSource::photometry},

        {get,
         "/api/v1/requests/{request}",
         "getRequest",
         "What an earlier request was answered, or 202 while there is no answer.",
         {},
         none,
         {"requestState"},
         {},
         200,
         0.0,
         RestSource::requests},
        {remove,
         "/api/v1/requests/{request}",
         "dropRequest",
         "Forgets an earlier request; a picture or a measurement ends.",
         {},
         none,
         {"requestState"},
         {},
         200,
         0.0,
         RestSource::requests},
    };
    return routes;
}

std::vector<std::string_view> parts_of(std::string_view path) {
    std::vector<std::string_view> parts;
    while (!path.empty()) {
        path.remove_prefix(1);  // the slash
        const std::size_t end = path.find('/');
        parts.push_back(path.substr(0, end));
        path = end == std::string_view::npos ? std::string_view() : path.substr(end);
    }
    return parts;
}

bool is_field(std::string_view part) {
    return part.starts_with('{');
}

std::string field_of(std::string_view part) {
    return std::string(part.substr(1, part.size() - 2));
}

/// What stands for the fields of a template; nothing where the path is not of that form.
std::optional<std::vector<std::pair<std::string, std::string>>> fields_of(std::string_view form,
                                                                          std::string_view path) {
    const auto forms = parts_of(form);
    const auto parts = parts_of(path);
    if (forms.size() != parts.size()) {
        return std::nullopt;
    }
    std::vector<std::pair<std::string, std::string>> fields;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (is_field(forms[i]) && !parts[i].empty()) {
            fields.emplace_back(field_of(forms[i]), parts[i]);
        } else if (forms[i] != parts[i]) {
            return std::nullopt;
        }
    }
    return fields;
}

}  // namespace

std::span<const RestRoute> rest_routes() {
    return table();
}

std::vector<std::string> path_fields(std::string_view path) {
    std::vector<std::string> fields;
    for (const std::string_view part : parts_of(path)) {
        if (is_field(part)) {
            fields.push_back(field_of(part));
        }
    }
    return fields;
}

RestMatch match_route(HttpMethod method, std::string_view path) {
    const HttpMethod wanted = method == HttpMethod::head ? HttpMethod::get : method;
    RestMatch match;
    for (const RestRoute& route : table()) {
        auto fields = fields_of(route.path, path);
        if (!fields) {
            continue;
        }
        match.allowed +=
            (match.allowed.empty() ? "" : ", ") + std::string(method_name(route.method));
        if (route.method == wanted) {
            match.route = &route;
            match.fields = std::move(*fields);
        }
    }
    return match;
}

std::string_view method_name(HttpMethod method) {
    switch (method) {
        case HttpMethod::get:
            return "GET";
        case HttpMethod::head:
            return "HEAD";
        case HttpMethod::put:
            return "PUT";
        case HttpMethod::post:
            return "POST";
        case HttpMethod::patch:
            return "PATCH";
        case HttpMethod::remove:
            return "DELETE";
        default:
            return "";
    }
}

}  // namespace raybundle
