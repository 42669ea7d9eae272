// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "zones/exchange_rays.h"
#include "zones/first_reflection.h"
#include "zones/kept_light.h"
#include "zones/sky_openings.h"
#include "zones/zone_levels.h"
#include "zones/zone_partition.h"

namespace raybundle {

/// Keeps the levels of a scene's zones (zones/zone_levels.h): between groups of iterations the
/// iterate of each zone is put to what enters the zone, as rays between the surfaces and the
/// present solution say. Sums over patches and rays are made on the GPU; one small readback.
class ZoneBalance {
  public:
    /// The scene must outlive this.
    ZoneBalance(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                std::uint64_t seed);

    /// Objects are elsewhere: rays and zones are found anew when they are asked for next.
    void objects_moved() { stale_ = Stale::places; }
    /// Surfaces have other colours, or there is another sky: the same, where surfaces emit other
    /// shares of the light; else rays and zones are what they were, and lighting them is cheap.
    void surfaces_changed(const PatchMesh& mesh);
    /// The iterate has been changed by something else than iterations; what bundles have brought so
    /// far was another scene's.
    void interrupt();
    /// All light has been multiplied by a factor.
    void scale(const glm::vec3& factor) { levels_.scale(factor); }
    /// Samples that the iterate is worth before the next iteration.
    void set_iterate_age(float samples) { iterate_age_ = static_cast<double>(samples); }
    /// An iteration has moved the iterate, of this age in samples, towards its sample, which has a
    /// weight in the mean.
    void note_step(float iterate_age, float weight);
    /// That iteration turned out to have done nothing.
    void forget_step(float iterate_age, float weight);

    /// Finds rays and zones of the scene as it is, where they are not known.
    void refresh();
    /// Two means of the irradiance of patches, BINDING_KEPT and BINDING_SINCE.
    struct Means {
        const Buffer* kept = nullptr;
        const Buffer* since = nullptr;
    };
    /// Finds the levels of the iterate as it is, and judges what has been kept over the last
    /// change, where there is any. The store's buffers are bound; BINDING_ZONES is from now on.
    void balance(const Means& means);
    /// Where the scene is open to the sky as it is.
    [[nodiscard]] SkyOpenings find_openings();
    /// Of the light that bundles bring to surfaces of these areas in the zones, m²: the share that
    /// comes from the sky at once, root mean square; 1 before anything is known of it.
    [[nodiscard]] float sky_share(std::span<const double> areas) const;
    /// After the first group of iterations, whose bundles carried nothing but emission: irradiance
    /// of each patch that will be reflected light, radiance units.
    [[nodiscard]] std::vector<glm::vec4> complete_start();
    /// Whether complete_start() is worth while, until then.
    [[nodiscard]] bool start_lacks_light() const { return reflection_.matters(); }
    /// The iterate and what is kept shall stay as they are; BINDING_ZONES is bound.
    void keep();
    void bind() const { zones_buffer_.bind_storage(BINDING_ZONES); }
    /// See KeptLight::doubt().
    [[nodiscard]] double doubt() const { return kept_.doubt(); }
    [[nodiscard]] unsigned zones() const { return partition_.count; }
    [[nodiscard]] const std::vector<std::uint32_t>& zone_of_patches() const {
        return partition_.zone;
    }
    [[nodiscard]] std::size_t bytes() const;

  private:
    void upload(std::span<const ZoneLevel> levels, std::span<const KeptLevel> kept);
    void sum_by_zones(std::size_t first_sum);
    struct Segment {  ///< rays between two zones, in the order of the buffer
        unsigned from = 0, to = 0;
        std::uint32_t first = 0, end = 0;
    };

    /// What refresh() has to find anew, each with what is before it: the light of surfaces and of
    /// the sky that rays meet, the rays, the places of the objects.
    enum class Stale { nothing, light, rays, places };

    void find_rays();
    void find_light();
    void sort_patches();
    void sort_rays(std::vector<ExchangeRay> traced);
    [[nodiscard]] std::vector<glm::vec4> emitted();
    [[nodiscard]] std::vector<glm::mat4> present_places() const;
    [[nodiscard]] std::vector<ZoneFlux> read_fluxes(std::span<const glm::vec4> sums) const;
    [[nodiscard]] std::vector<ZoneExchange> read_exchange(std::span<const glm::vec4> sums) const;

    const Scene& scene_;
    const GpuScene& gpu_scene_;
    std::uint32_t patch_count_;
    ExchangeRays rays_;
    std::vector<glm::vec3> base_colour_;  // of patches
    ZonePartition partition_;
    ZoneLevels levels_;
    KeptLight kept_;
    std::vector<Segment> segments_;
    std::vector<ZoneSky> sky_;                // cd/m² m²
    std::vector<glm::dvec3> mean_albedo_;     // of zones
    std::vector<std::uint32_t> first_block_;  // of zones, and the end of the last
    std::vector<double> older_share_;  // of the zones' iterates: from before the running group
    std::vector<double> younger_;    // samples that zones' iterates are younger than that of others
    double group_weight_ = 0.0;      // of the running group's samples in the mean
    double iterate_age_ = 0.0;       // of those others
    std::vector<float> shooting_;    // of zones, see shooting_factors()
    std::vector<ExchangeRay> lost_;  // rays that meet no surface
    std::vector<double> sent_;       // area of all rays, of each cluster
    Stale stale_ = Stale::rays;
    bool started_ = false;        // some bundle has come in
    FirstReflection reflection_;  // until complete_start()
    Buffer zones_buffer_, order_, blocks_, block_sums_, ray_buffer_, segment_buffer_, sums_;
    std::unique_ptr<Readback> readback_;
    ShaderProgram flux_, flux_sum_, exchange_, means_, emitted_;
};

}  // namespace raybundle
