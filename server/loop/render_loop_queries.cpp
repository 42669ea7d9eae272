// SPDX-License-Identifier: Apache-2.0
// What viewers ask the render loop about the scene, and what they do not want to see of it.
#include "loop/render_loop.h"
#include "loop/scene_messages.h"
#include "scene/walk_map.h"

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

void RenderLoop::answer_walk_map(const ClientEvent& event) {
    const WalkMap map = make_walk_map(scene_, from_message(event.message.get_walk_map().eye()));
    v1::ServerMessage answer;
    v1::WalkMap& out = *answer.mutable_walk_map();
    to_message(map.origin, out.mutable_origin());
    out.set_cell(WalkMap::cell);
    out.set_layer(WalkMap::layer);
    out.set_columns(WalkMap::columns);
    out.set_layers(WalkMap::layers);
    std::string& bytes = *out.mutable_occupied();
    for (const std::uint64_t column : map.occupied) {
        for (int byte = 0; byte < 8; ++byte) {
            bytes.push_back(static_cast<char>(column >> (8 * byte) & 0xffU));
        }
    }
    out.set_epoch(epoch_);
    server_.reply(event, answer);
}

void RenderLoop::answer_probe(ViewerSession& session, const ClientEvent& event) {
    const v1::Probe& probe = event.message.probe();
    if (!probe.has_pixel()) {
        server_.reply_error(event, v1::Error::UNIMPLEMENTED,
                            "probe.ray: only pixels can be probed");
        return;
    }
    const glm::uvec2 size = session.size();
    const glm::vec2 pixel(probe.pixel().x(), probe.pixel().y());
    if (!(pixel.x >= 0.0F && pixel.y >= 0.0F && pixel.x < static_cast<float>(size.x) &&
          pixel.y < static_cast<float>(size.y))) {
        server_.reply_error(event, v1::Error::INVALID_ARGUMENT, "probe.pixel: outside the picture");
        return;
    }
    prepare_image(session);
    const std::optional<PixelProbe> hit = session.probe(glm::uvec2(pixel));
    v1::ServerMessage message;
    v1::ProbeResult* result = message.mutable_probe_result();
    result->set_hit(hit.has_value());
    result->set_epoch(epoch_);
    if (hit) {
        to_message(hit->position, result->mutable_position());
        to_message(hit->normal, result->mutable_normal());
        result->set_object(scene_.objects[hit->object].id);
        result->set_patch(hit->patch);
        result->set_material(mesh_.triangle_material[mesh_.patch_triangle[hit->patch]] + 1);
        result->set_illuminance(luminance(hit->irradiance));
        result->set_luminance(luminance(hit->radiance));
        if (hit->relative_error) {
            result->set_relative_error(static_cast<float>(*hit->relative_error));
        }
    }
    server_.reply(event, message);
}

}  // namespace raybundle
