// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Rec. 709 luminance of a linear RGB flux.
inline double luminance_of(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// Fluxes of a zone as the iterate has them, radiance units m².
struct ZoneFlux {
    glm::dvec3 incident{0.0};
    glm::dvec3 reflected{0.0};  ///< what leaves of it
    glm::dvec3 emitted{0.0};
    glm::dvec3 albedo{0.0};  ///< area mean, where nothing is incident yet
    double area = 0.0;       ///< m²
    bool loose = false;      ///< has no level of its own: stays as it is
};

/// What rays say of the light that goes from one zone to another, radiance units m².
struct ZoneExchange {
    unsigned from = 0;
    unsigned to = 0;  ///< number of zones: lost
    glm::dvec3 reflected{0.0}, emitted{0.0};
    double squares = 0.0;  ///< sum over rays of the squared luminance of both
    double rays = 0.0;
};

/// Sky that enters a zone, radiance units m², luminance squared summed over rays.
struct ZoneSky {
    glm::dvec3 flux{0.0};
    double squares = 0.0;
};

/// How the iterate of a zone's patches is to be changed: irradiance = scale * irradiance + offset.
struct ZoneLevel {
    glm::dvec3 scale{1.0};
    glm::dvec3 offset{0.0};  ///< radiance units
};

/// Levels of the zones by energy conservation: with k_ts the share of the flux leaving zone s that
/// arrives at zone t, the incident fluxes X obey
///     X_t = sum_s k_ts (emitted_s + reflected_s) + sky_t + d_t,
/// where the reflected flux is proportional to the incident one. This is the coarse step of
/// iterative aggregation and disaggregation (Koury, McAllister, Stewart 1984): the slowest modes of
/// the transport, the levels of rooms, follow at once from the flux that enters them. Rays give k.
/// d is the flux that bundles have brought beyond the rays' prediction, a mean over groups of
/// iterations; it counts as far as its variance is below that of the rays.
class ZoneLevels {
  public:
    explicit ZoneLevels(unsigned zones);

    /// Forgets d, which belongs to another scene or another light.
    void forget();
    /// Forgets the running group: something else than levels has changed the iterate.
    void skip_group() { solved_ = false; }
    /// All light is multiplied by a factor.
    void scale(const glm::vec3& factor);
    /// After a group of iterations: share of each zone's iterate that is older than the group. No
    /// group has been counted where anything else has changed the iterate since.
    /// weight: of the group's samples in the mean.
    void note_group(std::span<const ZoneFlux> zones, std::span<const double> older_share,
                    double weight);
    /// New levels; zones as before they are applied.
    std::vector<ZoneLevel> solve(std::span<const ZoneFlux> zones,
                                 std::span<const ZoneExchange> exchange,
                                 std::span<const ZoneSky> sky);
    /// Incident flux of each zone by the last solve(), radiance units m².
    [[nodiscard]] const std::vector<glm::dvec3>& incident() const { return incident_; }
    /// Standard error of these, luminance.
    [[nodiscard]] const std::vector<double>& error() const { return error_; }
    /// Standard error of the mean over the groups so far of what bundles bring to a zone,
    /// luminance; 0 where there are too few.
    [[nodiscard]] double noise(unsigned zone) const;
    /// Whether there are enough groups for that.
    [[nodiscard]] bool known(unsigned zone) const;

  private:
    /// A running mean of fluxes, with the variance that their scatter lets expect of it.
    struct Mean {
        glm::dvec3 mean{0.0};
        double squares = 0.0;  // of the luminance's deviations, weighted
        double weight = 0.0, squared_weight = 0.0;

        void add(const glm::dvec3& value, double value_weight);
        /// Values of equal weight that would tell as much.
        [[nodiscard]] double count() const {
            return squared_weight > 0.0 ? weight * weight / squared_weight : 0.0;
        }
        [[nodiscard]] double error() const;
    };
    /// What bundles bring beyond the rays' prediction: by groups, and by batches of some groups,
    /// whose low-discrepancy points avoid each other.
    struct Beyond {
        Mean groups, batches;
        glm::dvec3 batch_sum{0.0};
        double batch_weight = 0.0;
        unsigned batch_groups = 0;
    };

    [[nodiscard]] glm::dvec3 beyond(unsigned zone, double variance) const;
    void conserve(std::span<const double> variance, std::span<const double> lost_variance,
                  std::span<const glm::dvec3> albedo, std::span<const ZoneFlux> zones,
                  std::span<const ZoneSky> sky, std::vector<glm::dvec3>& extra) const;

    unsigned zones_;
    std::vector<Beyond> beyond_;
    std::vector<glm::dvec3> incident_, present_, predicted_;
    std::vector<double> error_;
    bool solved_ = false;  // predicted_ is of the running group
};

}  // namespace raybundle
