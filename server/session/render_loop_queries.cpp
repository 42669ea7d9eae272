// SPDX-License-Identifier: Apache-2.0
// What viewers ask the render loop about the scene, and what they do not want to see of it.
#include "scene/walk/walk_map.h"
#include "session/render_loop.h"
#include "session/scene_messages.h"

namespace raybundle {

/// False: there is no such object, as has been answered.
bool RenderLoop::set_hidden(ViewerSession& session, const ClientEvent& event) {
    std::vector<std::uint32_t> objects;
    for (const std::uint32_t id : event.message.set_hidden().objects()) {
        if (id < 1 || id > scene_.objects.size()) {
            server_.reply_error(event, v1::Error::NOT_FOUND,
                                "setHidden.objects: no object " + std::to_string(id));
            return false;
        }
        objects.push_back(id - 1);
    }
    session.set_hidden(std::move(objects));
    return true;
}

void RenderLoop::answer_walk_map(const ClientEvent& event, const std::optional<WalkMap>& map,
                                 std::uint32_t epoch) const {
    if (!map) {
        server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED,
                            "getWalkMap: a newer one has come before its turn");
        return;
    }
    v1::ServerMessage answer;
    v1::WalkMap& out = *answer.mutable_walk_map();
    to_message(map->origin, out.mutable_origin());
    out.set_cell(WalkMap::cell);
    out.set_layer(WalkMap::layer);
    out.set_columns(WalkMap::columns);
    out.set_layers(WalkMap::layers);
    std::string& bytes = *out.mutable_occupied();
    for (const std::uint64_t column : map->occupied) {
        for (int byte = 0; byte < 8; ++byte) {
            bytes.push_back(static_cast<char>(column >> (8 * byte) & 0xffU));
        }
    }
    if (map->floor) {
        out.set_floor(*map->floor);
    }
    out.set_epoch(epoch);
    server_.reply(event, answer);
}

}  // namespace raybundle
