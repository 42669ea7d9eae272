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
/// same irradiance at their pixels. After a change only that light is found anew which the change
/// can reach: it is taken back as it was and added as it is (shot_pass.glsl), with maps drawn
/// anew only where something has moved before them.
class FirstShot {
  public:
    /// What the last change, or the one that has begun, reaches.
    enum class Reach { everything, lamps, moves };

    explicit FirstShot(const GpuScene& scene);
    ~FirstShot();
    FirstShot(FirstShot&&) noexcept;

    /// Anew for the present lights and the present place of the objects. The patches' radiance
    /// takes on the change, unless ChangeStore::set_source() shall do that (`radiance_follows`).
    /// The solution's buffers are bound. reflecting: materials whose reflection is another.
    void update(bool radiance_follows = true, std::span<const std::uint32_t> reflecting = {});
    /// The scene's lights are others by now, and update() comes next: takes back what was there of
    /// those that differ, if that is less work. The solution's buffers are bound.
    void begin_lights();
    /// Objects will be moved thus, and update() comes next: takes back what that reaches. The
    /// solution's buffers are bound.
    void begin_moves(std::span<const ObjectMove> moves);
    [[nodiscard]] Reach reach() const { return reach_; }
    [[nodiscard]] std::span<const std::uint32_t> reflecting() const { return reflecting_; }
    /// Grows with every update().
    [[nodiscard]] std::uint64_t version() const { return version_; }
    /// Keeps what `other`, of the same patches, has found, as what was before a change.
    void remember(const FirstShot& other);
    /// The same where there were no such lights.
    void remember_darkness();
    /// For change_source.comp.
    void bind_remembered() const { remembered_.bind_storage(BINDING_OLD_FIRST_SHOT); }
    void bind() const;
    /// Number of a light's profile to shaders; nothing where it is not known yet.
    [[nodiscard]] std::optional<std::uint32_t> profile_number(const IesProfile* profile) const;
    /// Sets the uniforms of shaders/solution/first_shot.glsl.
    void set_uniforms(const ShaderProgram& program) const;
    /// Where there are more lights than shadow maps, else null. The light of those is found little
    /// by little, see ManyLamps.
    [[nodiscard]] ManyLamps* many() const { return many_.get(); }
    /// Binds the lamps, or others in their place.
    void bind_lights(const Buffer& lights) const { lights.bind_storage(BINDING_PUNCTUAL); }
    [[nodiscard]] const Buffer& lights() const { return lights_; }
    [[nodiscard]] unsigned patch_count() const { return scene_.patch_count(); }
    /// Runs a pass, SHOT_*, of a program of one invocation a thread (shot_pass.glsl).
    void shoot(const ShaderProgram& program, unsigned pass, std::size_t threads) const;
    /// Irradiance per patch, radiance units. Synchronous.
    [[nodiscard]] std::vector<glm::vec3> read_irradiance() const;
    [[nodiscard]] glm::vec3 read_irradiance(std::uint32_t patch) const;
    /// Main part of the radiance that it makes (radiance units), w = area, m². Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_reflected() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    using Lights = std::vector<layout::PunctualData>;
    void shoot(const ShaderProgram& program, unsigned pass, std::size_t threads,
               unsigned most_lights, bool ends) const;
    void shoot_patches(unsigned pass, bool ends);
    void draw_maps(bool all, const Lights& before);
    void upload_profiles();
    void add_profiles();
    void touch_moves(std::span<const ObjectMove> moves);
    [[nodiscard]] bool others_stay(const Lights& now) const;
    void end_change(bool radiance_follows);

    const GpuScene& scene_;
    IesProfiles ies_;
    Lights known_;
    float tie_ = 0.0F;   // m: see shadow_tie
    float unit_ = 0.0F;  // of radiance, at the last update()
    Reach reach_ = Reach::everything;
    bool begun_ = false;         // begin_moves() or begin_lights() has come
    bool begun_lights_ = false;  // the latter
    std::vector<std::uint32_t> reflecting_;
    std::uint64_t version_ = 0;
    std::optional<ShadowMaps> maps_;   // of few lights
    std::unique_ptr<ManyLamps> many_;  // else
    Buffer lights_, patches_;
    Buffer rest_, masks_;  // where there are maps
    Buffer profiles_;      // only where some light has one
    Buffer remembered_;    // once the scene has changed
    ShaderProgram shoot_;  // by maps
};

}  // namespace raybundle
