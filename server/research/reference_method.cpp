// SPDX-License-Identifier: Apache-2.0
#include "research/reference_method.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reference/measures/emitter_pixels.h"
#include "reference/path_reuse.h"
#include "reference/path_tracer.h"
#include "reference/ray_caster.h"
#include "reference/solution_picture.h"
#include "reference/specular_walk.h"
#include "research/bidirectional.h"
#include "research/light_tracer.h"
#include "research/metropolis.h"
#include "research/photon_mapper.h"
#include "research/single_ray_picture.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

/// Pixels whose error is estimated: those that are measured against references, or where a picture
/// shows nothing but lamps and what is beside them, that.
std::vector<bool> pixels_for_error(const RayScene& scene, const CameraRays& camera) {
    std::vector<bool> measured = measured_pixels(scene, camera);
    const bool any = std::find(measured.begin(), measured.end(), true) != measured.end();
    return any ? measured : reflecting_pixels(scene, camera);
}

/// Methods whose picture is the mean of samples of its pixels.
class SampledMethod : public ReferenceMethod {
  public:
    SampledMethod(const RayScene& scene, const Camera& view, glm::uvec2 size, std::uint64_t seed)
        : lights_(scene),
          camera_(scene, view, size),
          measured_(pixels_for_error(scene, camera_)),
          image_(size, seed) {}

    [[nodiscard]] std::uint64_t iterations() const override { return image_.passes(); }
    [[nodiscard]] std::vector<glm::dvec3> picture() const override { return image_.means(); }
    [[nodiscard]] ImageError error() const override { return image_.error(measured_); }
    [[nodiscard]] std::uint64_t non_finite() const override { return image_.non_finite(); }
    [[nodiscard]] std::size_t bytes() const override { return image_.bytes(); }

  protected:
    [[nodiscard]] const LightSampling& lights() const { return lights_; }
    [[nodiscard]] const CameraRays& camera() const { return camera_; }
    ImageEstimate& image() { return image_; }

  private:
    LightSampling lights_;
    CameraRays camera_;
    std::vector<bool> measured_;
    ImageEstimate image_;
};

/// Methods that estimate each pixel for itself.
template <typename Estimator>
class PixelMethod : public SampledMethod {
  public:
    template <typename... Settings>
    PixelMethod(const RayScene& scene, const Camera& view, glm::uvec2 size, std::uint64_t seed,
                const Settings&... settings)
        : SampledMethod(scene, view, size, seed), estimator_(scene, lights(), settings...) {}

    void iterate() override {
        image().add_pass(camera(), [this](const glm::dvec3& origin, const glm::dvec3& direction,
                                          PixelSampler& sampler) {
            return estimator_.radiance(origin, direction, sampler);
        });
    }

  private:
    Estimator estimator_;
};

/// Methods whose samples add to other pixels too.
template <typename Estimator>
class SplattingMethod : public SampledMethod {
  public:
    SplattingMethod(const RayScene& scene, const Camera& view, glm::uvec2 size, std::uint64_t seed)
        : SampledMethod(scene, view, size, seed), estimator_(scene, lights(), camera()) {}

    void iterate() override {
        image().add_splatting_pass(
            camera(), [this](const glm::dvec3&, const glm::dvec3& direction, PixelSampler& sampler,
                             std::vector<Splat>& splats) {
                return estimator_.radiance(direction, sampler, splats);
            });
    }

  private:
    Estimator estimator_;
};

class PathReuseMethod : public SampledMethod {
  public:
    PathReuseMethod(const RayScene& scene, const Camera& view, glm::uvec2 size, std::uint64_t seed,
                    const PathSettings& settings)
        : SampledMethod(scene, view, size, seed), paths_(scene, lights(), settings) {}

    void iterate() override { paths_.add_pass(image(), camera()); }

  private:
    PathReuse paths_;
};

class MetropolisMethod : public ReferenceMethod {
  public:
    MetropolisMethod(const RayScene& scene, const Camera& camera, glm::uvec2 size,
                     std::uint64_t seed)
        : lights_(scene),
          tracer_(scene, lights_),
          measured_(pixels_for_error(scene, CameraRays(scene, camera, size))),
          metropolis_(tracer_, CameraRays(scene, camera, size), seed) {}

    void iterate() override { metropolis_.iterate(); }
    [[nodiscard]] std::uint64_t iterations() const override { return metropolis_.iterations(); }
    [[nodiscard]] std::vector<glm::dvec3> picture() const override { return metropolis_.picture(); }
    [[nodiscard]] ImageError error() const override { return metropolis_.error(measured_); }
    [[nodiscard]] std::uint64_t non_finite() const override { return metropolis_.non_finite(); }
    [[nodiscard]] std::size_t bytes() const override { return metropolis_.bytes(); }

  private:
    LightSampling lights_;
    PathTracer tracer_;
    std::vector<bool> measured_;
    Metropolis metropolis_;
};

class PhotonMethod : public SampledMethod {
  public:
    PhotonMethod(const RayScene& scene, const Camera& view, glm::uvec2 size, std::uint64_t seed)
        : SampledMethod(scene, view, size, seed),
          scene_(scene),
          seed_(seed),
          mapper_(scene, lights(), settings_) {}

    void iterate() override {
        const PhotonMaps maps =
            trace_photons(scene_, lights(), settings_, mixed_bits(seed_), image().passes());
        image().add_pass(camera(), [&](const glm::dvec3& origin, const glm::dvec3& direction,
                                       PixelSampler& sampler) {
            return mapper_.radiance(maps, origin, direction, sampler);
        });
        map_bytes_ = (maps.global.size() + maps.caustic.size()) * sizeof(Photon);
    }
    [[nodiscard]] std::size_t bytes() const override { return SampledMethod::bytes() + map_bytes_; }

  private:
    const RayScene& scene_;
    std::uint64_t seed_;
    PhotonSettings settings_;
    PhotonMapper mapper_;
    std::size_t map_bytes_ = 0;  // of the latest maps
};

class SingleRayMethod : public ReferenceMethod {
  public:
    SingleRayMethod(const RayScene& scene, const Camera& camera, glm::uvec2 size,
                    std::uint64_t seed)
        : lights_(scene),
          solution_(scene, lights_, seed),
          measured_(pixels_for_error(scene, CameraRays(scene, camera, size))),
          view_(scene, CameraRays(scene, camera, size), seed) {}

    void iterate() override {
        solution_.iterate();
        view_.follow(solution_);
    }
    [[nodiscard]] std::uint64_t iterations() const override { return solution_.iterations(); }
    [[nodiscard]] std::vector<glm::dvec3> picture() const override {
        return view_.picture(solution_);
    }
    [[nodiscard]] ImageError error() const override { return view_.error(solution_, measured_); }
    [[nodiscard]] std::uint64_t non_finite() const override { return 0; }
    [[nodiscard]] std::size_t bytes() const override { return solution_.bytes() + view_.bytes(); }

  private:
    LightSampling lights_;
    SingleRay solution_;
    std::vector<bool> measured_;
    SingleRayPicture view_;
};

bool shows_deflecting(const RayScene& scene, const CameraRays& camera) {
    const auto centres = pixel_centres(scene, camera);
    return std::any_of(centres.begin(), centres.end(),
                       [&scene](const auto& hit) { return hit && is_deflecting(scene, *hit); });
}

}  // namespace

std::string reason_against(ReferenceKind kind, const RayScene& scene) {
    if (kind == ReferenceKind::path || kind == ReferenceKind::path_reuse) {
        return {};
    }
    if (scene.scene().medium) {
        return "the air of the scene scatters light, which of the methods on the CPU only path "
               "and path-reuse follow";
    }
    if (kind == ReferenceKind::single_ray && has_glass(scene.scene())) {
        return "single rays keep light on patches and show what is on them, not what is behind "
               "glass, which " +
               scene.scene().name + " has";
    }
    if (scene.transmitting()) {
        return "the scene transmits light diffusely, which of the methods on the CPU only path "
               "and path-reuse follow";
    }
    return {};
}

std::string light_missed(ReferenceKind kind, const RayScene& scene, const Camera& camera,
                         glm::uvec2 size) {
    if (kind == ReferenceKind::light && shows_deflecting(scene, CameraRays(scene, camera, size))) {
        return "particles from lights do not find what the eye sees in mirrors and through glass";
    }
    if (!has_glass(scene.scene()) || scene.scene().punctual_lights.empty()) {
        return {};
    }
    switch (kind) {
        case ReferenceKind::path:
        case ReferenceKind::path_reuse:
        case ReferenceKind::metropolis:
            return "paths from the eye do not find the light of punctual lights by way of glass; "
                   "bidirectional paths and photon maps do";
        case ReferenceKind::bidirectional:
            return "paths do not find what punctual lights light by way of glass and the eye sees "
                   "through glass again; photon maps do";
        case ReferenceKind::photon_map:
            return "photons are kept on dull surfaces only: on glossy ones the light of punctual "
                   "lights by way of glass is missing";
        default:
            return {};
    }
}

std::unique_ptr<ReferenceMethod> make_reference_method(ReferenceKind kind, const RayScene& scene,
                                                       const Camera& camera, glm::uvec2 size,
                                                       std::uint64_t seed,
                                                       const PathSettings& paths) {
    if (const std::string reason = reason_against(kind, scene); !reason.empty()) {
        throw std::runtime_error(reason);
    }
    switch (kind) {
        case ReferenceKind::path_reuse:
            return std::make_unique<PathReuseMethod>(scene, camera, size, seed, paths);
        case ReferenceKind::single_ray:
            return std::make_unique<SingleRayMethod>(scene, camera, size, seed);
        case ReferenceKind::ray_cast:
            return std::make_unique<PixelMethod<RayCaster>>(scene, camera, size, seed);
        case ReferenceKind::light:
            return std::make_unique<SplattingMethod<LightTracer>>(scene, camera, size, seed);
        case ReferenceKind::bidirectional:
            return std::make_unique<SplattingMethod<Bidirectional>>(scene, camera, size, seed);
        case ReferenceKind::metropolis:
            return std::make_unique<MetropolisMethod>(scene, camera, size, seed);
        case ReferenceKind::photon_map:
            return std::make_unique<PhotonMethod>(scene, camera, size, seed);
        default:
            return std::make_unique<PixelMethod<PathTracer>>(scene, camera, size, seed, paths);
    }
}

}  // namespace raybundle
