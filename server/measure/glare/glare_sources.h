// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measure/point_paths.h"

namespace raybundle {

/// A luminaire: emitting surfaces of one material and object that touch each other, or a punctual
/// light, whose luminous part its photometric file states.
struct GlareSource {
    std::string name;
    std::uint32_t light = 0;           ///< number of the light on the wire
    std::vector<std::uint32_t> sides;  ///< of the mesh, that emit; empty: a punctual light
    std::vector<double> area_up_to;    ///< sums of their areas, own space
    std::optional<PlacedLight> lamp;   ///< the punctual light
    glm::dvec3 middle{0.0};            ///< own space
};

/// All that shine; not the sky and its suns.
std::vector<GlareSource> find_glare_sources(const MeasuredScene& scene);

/// What an eye sees of a source, by samples in batches.
struct SeenSource {
    static constexpr std::size_t batches = 16;

    std::uint32_t source = 0;   ///< index
    glm::dvec3 direction{0.0};  ///< from the eye to the middle of what is seen, unit
    double distance = 0.0;      ///< to the source's middle, m
    double area = 0.0;          ///< projected luminous area that is seen, m²
    /// Of the batches: solid angle that is seen, sr, and luminance integrated over it, lx of a
    /// surface that faces the source.
    std::array<double, batches> solid_angle{}, illuminance{};
    std::array<glm::vec3, batches> weighted{};  ///< sums of directions to what is seen

    [[nodiscard]] double mean_solid_angle() const;
    [[nodiscard]] double mean_illuminance() const;
    [[nodiscard]] bool has_size() const { return mean_solid_angle() > 0.0; }
    /// Without one of the batches.
    [[nodiscard]] double solid_angle_without(std::size_t batch) const;
    [[nodiscard]] double illuminance_without(std::size_t batch) const;
    [[nodiscard]] glm::dvec3 direction_without(std::size_t batch) const;
};

/// position: own space. Samples are added until the square of the luminance times the solid angle
/// is known within 2 %, which is less than a tenth of UGR. Nothing where none of it is seen.
std::optional<SeenSource> look_at(const MeasuredScene& scene, const GlareSource& source,
                                  const glm::dvec3& position, std::uint64_t seed);

}  // namespace raybundle
