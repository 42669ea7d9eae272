// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/direct/shadow_maps.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

class ManyLamps;

/// The incoming first shot (ch. 4.3.1) of punctual lights, which no random line can hit: their
/// irradiance per patch, found once and kept apart from the random iteration, whose source is its
/// first reflection. Deterministic. Exists only where a scene has such lights; viewers find the
/// same irradiance at their pixels.
class FirstShot {
  public:
    explicit FirstShot(const GpuScene& scene);
    ~FirstShot();
    FirstShot(FirstShot&&) noexcept;

    /// Anew for the present lights and the present place of the objects. The patches' radiance
    /// takes on the change, unless ChangeStore::set_source() shall do that (`radiance_follows`).
    /// The solution's buffers are bound.
    void update(bool radiance_follows = true);
    /// Keeps what `other`, of the same patches, has found, as what was before a change.
    void remember(const FirstShot& other);
    /// The same where there were no such lights.
    void remember_darkness();
    /// For change_source.comp.
    void bind_remembered() const { remembered_.bind_storage(BINDING_OLD_FIRST_SHOT); }
    void bind() const;
    /// Sets the uniforms of shaders/solution/first_shot.glsl.
    void set_uniforms(const ShaderProgram& program) const;
    /// Where there are more lights than shadow maps, else null. The light of those is found little
    /// by little, see ManyLamps.
    [[nodiscard]] ManyLamps* many() const { return many_.get(); }
    /// Binds the lamps, or others in their place.
    void bind_lights(const Buffer& lights) const { lights.bind_storage(BINDING_PUNCTUAL); }
    [[nodiscard]] const Buffer& lights() const { return lights_; }
    [[nodiscard]] unsigned patch_count() const { return scene_.patch_count(); }
    /// Runs a program of one invocation a thread that adds the light of some of the lights.
    void dispatch(const ShaderProgram& program, std::size_t threads) const;
    /// Irradiance per patch, radiance units. Synchronous.
    [[nodiscard]] std::vector<glm::vec3> read_irradiance() const;
    [[nodiscard]] glm::vec3 read_irradiance(std::uint32_t patch) const;
    /// Main part of the radiance that it makes (radiance units), w = area, m². Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_reflected() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    void dispatch(const ShaderProgram& program, std::size_t threads, unsigned most_lights) const;

    const GpuScene& scene_;
    IesProfiles ies_;
    std::optional<ShadowMaps> maps_;   // of few lights
    std::unique_ptr<ManyLamps> many_;  // else
    Buffer lights_, patches_;
    Buffer profiles_;      // only where some light has one
    Buffer remembered_;    // once the scene has changed
    ShaderProgram shoot_;  // by maps
};

}  // namespace raybundle
