// SPDX-License-Identifier: Apache-2.0
#include "reference/reference_method.h"

#include <utility>

#include "reference/path_tracer.h"
#include "reference/ray_caster.h"
#include "reference/single_ray_picture.h"
#include "reference/solution_picture.h"

namespace raybundle {
namespace {

/// Methods that estimate each pixel for itself.
template <typename Estimator>
class PixelMethod : public ReferenceMethod {
  public:
    PixelMethod(const RayScene& scene, const Camera& camera, glm::uvec2 size, std::uint64_t seed)
        : lights_(scene),
          estimator_(scene, lights_),
          camera_(scene, camera, size),
          reflecting_(raybundle::reflecting_pixels(scene, camera, size)),
          image_(size, seed) {}

    void iterate() override {
        image_.add_pass(camera_, [this](const glm::dvec3& origin, const glm::dvec3& direction,
                                        PixelSampler& sampler) {
            return estimator_.radiance(origin, direction, sampler);
        });
    }
    [[nodiscard]] std::uint64_t iterations() const override { return image_.passes(); }
    [[nodiscard]] std::vector<glm::dvec3> picture() const override { return image_.means(); }
    [[nodiscard]] ImageError error() const override { return image_.error(reflecting_); }
    [[nodiscard]] std::uint64_t non_finite() const override { return image_.non_finite(); }
    [[nodiscard]] std::size_t bytes() const override { return image_.bytes(); }

  private:
    LightSampling lights_;
    Estimator estimator_;
    CameraRays camera_;
    std::vector<bool> reflecting_;
    ImageEstimate image_;
};

class SingleRayMethod : public ReferenceMethod {
  public:
    SingleRayMethod(const RayScene& scene, const Camera& camera, glm::uvec2 size,
                    std::uint64_t seed)
        : lights_(scene),
          solution_(scene, lights_, seed),
          view_(scene, CameraRays(scene, camera, size), seed) {}

    void iterate() override {
        solution_.iterate();
        view_.follow(solution_);
    }
    [[nodiscard]] std::uint64_t iterations() const override { return solution_.iterations(); }
    [[nodiscard]] std::vector<glm::dvec3> picture() const override {
        return view_.picture(solution_);
    }
    [[nodiscard]] ImageError error() const override { return view_.error(solution_); }
    [[nodiscard]] std::uint64_t non_finite() const override { return 0; }
    [[nodiscard]] std::size_t bytes() const override { return solution_.bytes() + view_.bytes(); }

  private:
    LightSampling lights_;
    SingleRay solution_;
    SingleRayPicture view_;
};

}  // namespace

std::unique_ptr<ReferenceMethod> make_reference_method(ReferenceKind kind, const RayScene& scene,
                                                       const Camera& camera, glm::uvec2 size,
                                                       std::uint64_t seed) {
    switch (kind) {
        case ReferenceKind::single_ray:
            return std::make_unique<SingleRayMethod>(scene, camera, size, seed);
        case ReferenceKind::ray_cast:
            return std::make_unique<PixelMethod<RayCaster>>(scene, camera, size, seed);
        default:
            return std::make_unique<PixelMethod<PathTracer>>(scene, camera, size, seed);
    }
}

std::vector<bool> reflecting_pixels(const RayScene& scene, const Camera& camera, glm::uvec2 size) {
    std::vector<bool> result;
    for (const auto& hit : pixel_centres(scene, CameraRays(scene, camera, size))) {
        result.push_back(hit && !hit->absorbs() && scene.emission(*hit) == glm::dvec3(0.0));
    }
    return result;
}

}  // namespace raybundle
