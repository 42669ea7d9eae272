// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "scene/light/lamp_reach.h"
#include "scene/scene.h"

namespace raybundle {

/// Where patches have to be small: where direct light changes within them, and surfaces close by
/// see how. What a patch sends changes linearly within it at most. From afar only its mean
/// matters; next to it, in the slot beside a window frame, at the foot of a lamp, light would come
/// from where there is none.
/// Hierarchical radiosity weighs what it refines likewise (Hanrahan, Salzman, Aupperle 1991, "A
/// Rapid Hierarchical Radiosity Algorithm"). At the objects' initial places; thread-safe.
class NearField {
  public:
    using Corners = std::array<glm::dvec3, 3>;  ///< world, m, counter-clockwise from the front

    /// A triangle of the scene, or a part of one.
    struct Face {
        Corners corners{};
        std::size_t material = 0;
        bool two_sided = false;
    };

    /// Takes the scene's triangles, lamps and sky; glass casts no shadow. The scene must outlive
    /// it.
    explicit NearField(const Scene& scene);
    ~NearField();

    /// Luminous flux (lm) that a face reflects onto surfaces nearer than its
    /// longest edge from other places than it should: standard deviation of its direct illuminance,
    /// times its area, its albedo, and the share of its light that these surfaces reflect. Of the
    /// worse of its sides. 0 where it cannot be as much as `least`.
    [[nodiscard]] double misplaced_flux(const Face& face, double least) const;
    /// Direct luminous flux (lm) on a face, from the illuminance in its middle.
    [[nodiscard]] double direct_flux(const Face& face) const;

  private:
    struct Hierarchy;
    /// A point of a lamp, for a share of it.
    struct EmitterPoint {
        glm::dvec3 position{0.0};  // m
        double area = 0.0;         // m²
    };
    /// A triangle of a lamp. Where a lamp has few of them their illuminance is exact but for their
    /// shadows; else it is that of points, which some of its triangles have.
    struct Emitter {
        Corners corners{};
        glm::dvec3 normal{0.0};
        double luminance = 0.0;  // cd/m²
        bool two_sided = false, exact = false;
        std::vector<EmitterPoint> points;
    };
    /// A point of one side of a surface.
    struct Place {
        glm::dvec3 position{0.0}, normal{0.0};
    };

    void place_emitters();
    [[nodiscard]] double from_emitter(const Emitter& emitter, const Place& place,
                                      bool shadows) const;
    [[nodiscard]] double from_emitters(const Place& place, bool shadows) const;
    [[nodiscard]] double from_light(const PlacedLight& light, const Place& place,
                                    bool shadows) const;
    [[nodiscard]] double from_punctual(const Place& place, bool shadows) const;
    [[nodiscard]] double from_sky(const Place& place, bool shadows) const;
    /// Direct illuminance, lx.
    [[nodiscard]] double illuminance(const Place& place) const;
    [[nodiscard]] double reflected_within(const Place& place, double distance) const;
    [[nodiscard]] double misplaced_on_side(const Corners& corners, const glm::dvec3& normal,
                                           double area, double least) const;

    const Scene& scene_;
    std::vector<Emitter> emitters_;
    std::vector<PlacedLight> punctual_;
    NearLamps near_lamps_;        // of many: the others bring light that changes slowly
    std::vector<double> albedo_;  // by material, luminance
    bool sky_;
    double offset_;  // m, of rays from surfaces
    std::unique_ptr<Hierarchy> hierarchy_;
};

}  // namespace raybundle
