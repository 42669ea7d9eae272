// SPDX-License-Identifier: Apache-2.0
#include "session/measure/probe_service.h"

#include <algorithm>
#include <string>
#include <vector>

#include "session/measure/probed_pixel.h"
#include "session/messages/scene_messages.h"
#include "view/camera_matrices.h"
#include "view/point_probe.h"

namespace raybundle {

namespace {

constexpr float on_surface_m = 0.01F;       // of a grid, besides what the distance allows
constexpr float on_surface_share = 0.002F;  // of the distance to the eye
constexpr float half_a_step = 0.5F;         // as far may a measured point lie from the one wanted

/// The points of a grid and the surface that they lie on.
struct Grid {
    glm::vec3 origin, step_x, step_y;
    std::uint32_t columns, rows;

    explicit Grid(const v1::ProbeGrid& message)
        : origin(from_message(message.origin())),
          step_x(from_message(message.step_x())),
          step_y(from_message(message.step_y())),
          columns(message.columns()),
          rows(message.rows()) {}

    [[nodiscard]] std::vector<glm::vec3> points() const {
        std::vector<glm::vec3> result;
        result.reserve(std::size_t{columns} * rows);
        for (std::uint32_t row = 0; row < rows; ++row) {
            for (std::uint32_t column = 0; column < columns; ++column) {
                result.push_back(origin + static_cast<float>(column) * step_x +
                                 static_cast<float>(row) * step_y);
            }
        }
        return result;
    }

    /// Whether what a pixel shows is the surface at a point of the grid, not something before it.
    [[nodiscard]] bool shows(const glm::vec3& found, const glm::vec3& wanted,
                             const glm::vec3& eye) const {
        const glm::vec3 normal = glm::normalize(glm::cross(step_x, step_y));
        const glm::vec3 offset = found - wanted;
        const float off_plane = std::abs(glm::dot(offset, normal));
        const float step = std::min(glm::length(step_x), glm::length(step_y));
        return off_plane <= on_surface_m + on_surface_share * glm::distance(eye, wanted) &&
               glm::length(offset) <= half_a_step * step + off_plane;
    }
};

}  // namespace

std::optional<glm::uvec2> pixel_of(const Camera& camera, glm::uvec2 size, const glm::vec3& point) {
    const layout::ViewParameters view = make_view_parameters(camera, glm::vec3(0.0F), size, 0.01F);
    const glm::vec4 clip = view.clip_from_world * glm::vec4(point, 1.0F);
    if (clip.w <= 0.0F) {
        return std::nullopt;
    }
    const glm::vec2 ndc = glm::vec2(clip) / clip.w;
    const glm::vec2 at = (glm::vec2(ndc.x, -ndc.y) * 0.5F + 0.5F) * glm::vec2(size);
    if (!(at.x >= 0.0F && at.y >= 0.0F && at.x < static_cast<float>(size.x) &&
          at.y < static_cast<float>(size.y))) {
        return std::nullopt;
    }
    return glm::uvec2(at);
}

HandlerResult ProbeService::probe(ViewerSession& session, const ClientEvent& event) {
    const v1::Probe& probe = event.message.probe();
    if (probe.has_ray()) {
        const LiveScene& live = parts_.scene;
        answer(event, probe_ray(live.solver().scene(), live.solver().store(), live.programs(),
                                from_message(probe.ray().origin()),
                                from_message(probe.ray().direction())));
        return HandlerResult::answered;
    }
    if (session.is_caller()) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "probe.pixel: needs a picture, which there is none of over "
                                  "HTTP; name a ray");
        return HandlerResult::answered;
    }
    const glm::uvec2 size = session.size();
    const glm::vec2 pixel(probe.pixel().x(), probe.pixel().y());
    if (!(pixel.x >= 0.0F && pixel.y >= 0.0F && pixel.x < static_cast<float>(size.x) &&
          pixel.y < static_cast<float>(size.y))) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "probe.pixel: outside the picture");
        return HandlerResult::answered;
    }
    parts_.pictures.prepare(session);
    answer(event, session.probe(glm::uvec2(pixel)));
    return HandlerResult::answered;
}

void ProbeService::answer(const ClientEvent& event, const std::optional<PixelProbe>& hit) {
    v1::ServerMessage message;
    v1::ProbeResult* result = message.mutable_probe_result();
    result->set_hit(hit.has_value());
    result->set_epoch(parts_.scene.epoch());
    if (hit) {
        fill_result(*hit, result);
    }
    parts_.server.reply(event, message);
}

void ProbeService::fill_result(const PixelProbe& hit, v1::ProbeResult* result) const {
    const PatchMesh& mesh = parts_.scene.mesh();
    to_message(hit.position, result->mutable_position());
    to_message(hit.normal, result->mutable_normal());
    result->set_object(parts_.scene.scene().objects[hit.object].id);
    result->set_patch(hit.patch);
    result->set_material(mesh.triangle_material[mesh.side_triangle[hit.patch]] + 1);
    result->set_illuminance(luminance(hit.irradiance));
    result->set_luminance(luminance(hit.radiance));
    if (hit.relative_error) {
        result->set_relative_error(static_cast<float>(*hit.relative_error));
    }
}

HandlerResult ProbeService::probe_grid(ViewerSession& session, const ClientEvent& event) {
    const Grid grid(event.message.probe_grid());
    const std::vector<glm::vec3> points = grid.points();
    const Camera& camera = session.camera();
    std::vector<glm::uvec2> pixels;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (const auto pixel = pixel_of(camera, session.size(), points[i])) {
            pixels.push_back(*pixel);
            indices.push_back(i);
        }
    }
    v1::ServerMessage answer;
    v1::ProbeGridResult& result = *answer.mutable_probe_grid_result();
    result.set_epoch(parts_.scene.epoch());
    result.mutable_illuminance()->Resize(static_cast<int>(points.size()), -1.0F);
    result.mutable_relative_error()->Resize(static_cast<int>(points.size()), -1.0F);
    parts_.pictures.prepare(session);
    const auto found = session.probe(pixels);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] && grid.shows(found[i]->position, points[indices[i]], camera.eye)) {
            const int at = static_cast<int>(indices[i]);
            result.set_illuminance(at, luminance(found[i]->irradiance));
            result.set_relative_error(at,
                                      static_cast<float>(found[i]->relative_error.value_or(-1.0)));
        }
    }
    parts_.server.reply(event, answer);
    return HandlerResult::answered;
}

}  // namespace raybundle
