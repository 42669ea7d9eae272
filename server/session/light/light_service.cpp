// SPDX-License-Identifier: Apache-2.0
#include "session/light/light_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "gpu/egl_context.h"
#include "session/messages/scene_messages.h"
#include "walkthrough/surface_albedo.h"

namespace raybundle {

namespace {

/// Reflected light in radiance units, of which most is near 1, has room up to eight times this.
constexpr float bright_units = 64.0F;

template <typename T>
bool is_ready(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

bool same_look(const Material& a, const Material& b) {
    return a.base_colour == b.base_colour && a.roughness == b.roughness &&
           a.metallic == b.metallic && a.transmittance == b.transmittance;
}

glm::uvec3 size_of(const LiveScene& live) {
    return {live.mesh().triangle_count(), live.mesh().positions.size(),
            live.scene().objects.size()};
}

LightView view_of(const ViewerSession& session) {
    const Camera& camera = session.camera();
    const glm::vec2 size(session.size());
    const float half = std::tan(0.5F * camera.vertical_fov);
    return {camera.eye, glm::normalize(camera.target - camera.eye),
            std::atan(half * glm::length(size) / std::max(size.y, 1.0F))};
}

}  // namespace

void LightService::join(const ViewerSession& session) {
    viewers_.insert(session.id());
    if (!broadcaster_) {
        broadcaster_ = std::make_unique<LightBroadcaster>(
            parts_.server, parts_.clock,
            [&metrics = parts_.metrics](std::size_t bytes) { metrics.count_light(bytes); });
        make_geometry();
    } else if (made_) {
        announce(session.id());
    }
    parts_.metrics.set_light_viewers(viewers_.size());
}

void LightService::forget(ViewerId viewer) {
    if (viewers_.erase(viewer) > 0) {
        broadcaster_->remove(viewer);
        parts_.metrics.set_light_viewers(viewers_.size());
    }
}

HandlerResult LightService::set_drawing(ViewerSession& session, const ClientEvent& event) {
    if (!viewers_.contains(session.id())) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "setDrawing: hello has not asked for light");
        return HandlerResult::answered;
    }
    session.set_drawing(event.message.set_drawing().here());
    return HandlerResult::ok;
}

void LightService::look(const ViewerSession& session) {
    if (viewers_.contains(session.id())) {
        broadcaster_->look(session.id(), view_of(session));
    }
}

void LightService::step() {
    if (viewers_.empty()) {
        values_.reset();  // of a solver that may be gone when somebody comes
        read_of_ = nullptr;
        return;
    }
    follow_scene();
    take_geometry();
    take_sky();
    if (made_) {
        read_light();
    }
}

/// Takes note of changes since the last step.
void LightService::follow_scene() {
    const std::uint32_t epoch = parts_.scene.epoch();
    const std::uint64_t steps = parts_.scene.fades().steps();
    const bool shown_otherwise = epoch != epoch_ || steps != fade_steps_;
    if (size_of(parts_.scene) != size_) {
        make_geometry();
    } else if (shown_otherwise) {
        follow_materials();
        follow_sky();
        if (made_) {
            emission_ = emission_values(made_->geometry, parts_.scene.mesh().emission);
        }
    }
    if (shown_otherwise) {
        epoch_ = epoch;
        fade_steps_ = steps;
        last_change_ = parts_.clock.now();
    }
}

/// Of copies, on a thread: textures are encoded.
void LightService::make_geometry() {
    made_.reset();
    values_.reset();
    if (making_.valid() && !is_ready(making_)) {
        return;  // of an older scene; nothing waits for it, and this is asked for again
    }
    size_ = size_of(parts_.scene);
    epoch_ = parts_.scene.epoch();
    last_change_ = parts_.clock.now();
    const float brightest = bright_units * parts_.scene.solver().scene().radiance_unit();
    making_ = std::async(std::launch::async, [&server = parts_.server, epoch = epoch_, brightest,
                                              scene = parts_.scene.scene(),
                                              mesh = parts_.scene.mesh()] {
        Made made{
            make_live_geometry(scene, mesh, brightest, shader_files()), {}, epoch, scene.materials};
        made.url = server.keep_content("scene", std::exchange(made.geometry.files, {}));
        return made;
    });
    sky_ = sky_of(parts_.scene.scene());
    sky_message_.reset();
    sky_is_old_ = true;
}

void LightService::take_geometry() {
    if (!is_ready(making_)) {
        return;
    }
    try {
        made_ = making_.get();
    } catch (const std::exception& error) {
        spdlog::error("viewers that draw by themselves get no light: {}", error.what());
        return;
    }
    if (size_of(parts_.scene) != size_) {
        made_.reset();  // the scene has grown meanwhile
        return;
    }
    ++scenes_;
    read_of_ = nullptr;
    read_ = {};
    materials_.assign(made_->materials.size(), std::nullopt);
    follow_materials();
    emission_ = emission_values(made_->geometry, parts_.scene.mesh().emission);
    broadcaster_->begin(scenes_, made_->geometry.blocks);
    for (const ViewerId viewer : viewers_) {
        announce(viewer);
    }
    spdlog::info("light stream: {} values in {} blocks", made_->geometry.sources.size(),
                 made_->geometry.blocks.size());
}

/// Tells what is not as the geometry's files have it.
void LightService::follow_materials() {
    if (!made_) {
        return;
    }
    const std::vector<Material>& now = parts_.scene.scene().materials;
    for (std::size_t i = 0; i < std::min(now.size(), made_->materials.size()); ++i) {
        if (!same_look(now[i], made_->materials[i])) {
            made_->materials[i] = now[i];
            materials_[i] = material_message(i);
            tell_all(*materials_[i]);
        }
    }
}

v1::ServerMessage LightService::material_message(std::size_t material) const {
    const Scene& scene = parts_.scene.scene();
    v1::ServerMessage message;
    v1::LightMaterial& out = *message.mutable_light_material();
    out.set_material(static_cast<std::uint32_t>(material) + 1);
    to_message(scene.materials[material].base_colour, out.mutable_base_colour());
    if (const auto row = surface_albedo(scene, parts_.scene.mesh(), material)) {
        for (const glm::vec4& node : *row) {
            for (int k = 0; k < 4; ++k) {
                out.add_albedo(node[k]);
            }
        }
    }
    to_message(transparency(scene, material), out.mutable_transparency());
    to_message(scene.materials[material].transmittance, out.mutable_transmittance());
    return message;
}

void LightService::follow_sky() {
    const Sky now = sky_of(parts_.scene.scene());
    if (now.uniform != sky_.uniform || now.environment != sky_.environment) {
        sky_ = now;
        sky_is_old_ = true;
    }
}

/// On a thread: its texels take long.
void LightService::take_sky() {
    if (is_ready(making_sky_)) {
        MadeSky made;
        try {
            made = making_sky_.get();
        } catch (const std::exception& error) {
            spdlog::error("viewers that draw by themselves get no sky: {}", error.what());
            return;
        }
        v1::LightSky& out = *sky_message_.emplace().mutable_light_sky();
        to_message(made.sky.uniform, out.mutable_uniform());
        out.set_url(made.url);
        out.set_width(sky_width);
        out.set_height(sky_height);
        out.set_unit(made.sky.unit);
        if (made.sky.sun) {
            to_message(made.sky.sun->direction, out.mutable_sun()->mutable_direction());
            out.mutable_sun()->set_cosine(made.sky.sun->cosine);
            to_message(made.sky.sun->radiance, out.mutable_sun()->mutable_radiance());
        }
        if (made_) {
            tell_all(*sky_message_);
        }
    }
    if (sky_is_old_ && !making_sky_.valid()) {
        sky_is_old_ = false;
        making_sky_ = std::async(std::launch::async, [&server = parts_.server, sky = sky_] {
            MadeSky made{make_live_sky(sky), {}};
            if (!made.sky.texels.empty()) {
                made.url = server.keep_content("sky", {{"sky.bin", std::move(made.sky.texels)}}) +
                           "sky.bin";
            }
            return made;
        });
    }
}

/// All that a viewer has to know before light comes.
void LightService::announce(ViewerId viewer) {
    v1::ServerMessage message;
    v1::LightScene& out = *message.mutable_light_scene();
    out.set_scene(scenes_);
    out.set_url(made_->url);
    out.set_values(static_cast<std::uint32_t>(made_->geometry.sources.size() +
                                              made_->geometry.emission_triangles.size()));
    out.set_block_values(static_cast<std::uint32_t>(
        made_->geometry.blocks.empty() ? 0 : made_->geometry.blocks.front().count));
    parts_.server.send(viewer, message);
    for (const auto& material : materials_) {
        if (material) {
            parts_.server.send(viewer, *material);
        }
    }
    if (sky_message_) {
        parts_.server.send(viewer, *sky_message_);
    }
    broadcaster_->add(viewer);
}

void LightService::tell_all(const v1::ServerMessage& message) {
    for (const ViewerId viewer : viewers_) {
        parts_.server.send(viewer, message);
    }
}

/// As often as pictures that refine; at once after a change.
bool LightService::light_is_due() const {
    const Solver& solver = parts_.scene.solver();
    if (solver.correcting() || !solver.between_groups()) {
        return false;
    }
    const LightBroadcaster::Figures now{epoch_, static_cast<std::uint32_t>(solver.iterations())};
    const bool changed = now.epoch != read_.epoch || fade_steps_ != read_steps_;
    if (!changed && now.iterations == read_.iterations) {
        return false;
    }
    const double since_read = seconds(parts_.clock.now() - last_read_);
    const double age = seconds(last_read_ - last_change_);
    const double interval =
        changed ? parts_.pace.moving_interval_s
                : std::clamp(parts_.pace.refining_share * age, parts_.pace.min_refining_s,
                             parts_.pace.max_refining_s);
    return since_read >= interval;
}

void LightService::read_light() {
    const Solver& solver = parts_.scene.solver();
    if (read_of_ != &solver) {
        read_of_ = &solver;
        read_ = {};
        values_.reset();
        try {
            values_.emplace(solver.scene(), solver.store(), made_->geometry.sources,
                            made_->geometry.unit);
        } catch (const GpuError& error) {
            spdlog::error("no light for viewers that draw by themselves: {}", error.what());
        }
    }
    if (!values_) {
        return;
    }
    if (values_->ready()) {
        const std::span<const std::uint32_t> found = values_->take();
        std::vector<std::uint32_t> values(found.begin(), found.end());
        values.insert(values.end(), emission_.begin(), emission_.end());
        broadcaster_->publish(std::move(values), read_);
    }
    if (!values_->pending() && light_is_due()) {
        values_->request();
        last_read_ = parts_.clock.now();
        read_ = {epoch_, static_cast<std::uint32_t>(solver.iterations())};
        read_steps_ = fade_steps_;
    }
}

}  // namespace raybundle
