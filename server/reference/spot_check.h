// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "reference/measures/image_estimate.h"
#include "reference/path_tracer.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"

namespace raybundle {

/// A picture's squared relRMSE (design.md, section 8) as it was measured. Unbiased, so that it may
/// come out below 0.
struct SquaredError {
    double value = 0.0;
    double standard_error = 0.0;
};

/// A scene as paths are traced in it; scene and mesh must outlive it. Light of punctual lights
/// comes through thin panes, as in pictures.
struct TracedScene {
    TracedScene(const Scene& scene, const PatchMesh& mesh)
        : rays(scene, mesh), lights(rays), paths(rays, lights, through_panes()) {}

    RayScene rays;
    LightSampling lights;
    PathTracer paths;

  private:
    static PathSettings through_panes() {
        PathSettings settings;
        settings.panes = Panes::pass;
        return settings;
    }
};

/// Measures the true error of a picture by path tracing some of its pixels: everything that is
/// wrong with them counts, whatever the reason, and not only what the picture's own samples know
/// of.
///
/// The squared difference of a pixel I from the mean of noisy estimates r is too large by their
/// variance. The product of the differences from two independent ones is not: its expectation is
/// (I - R)^2. Over all pairs of B batches that is (|sum D|^2 - sum |D|^2) / (B (B - 1)) with
/// D_b = I - r_b (a U-statistic, Hoeffding 1948). So few paths say enough: with so many pixels the
/// noise of each may be several times what is to be measured.
///
/// One pixel of each square of pixels takes part, chosen at random; of small pictures all do. Where
/// few pixels hold most of the error, sparks of rare samples, they seldom are among them: the
/// pixels that stand out from their neighbours most are all measured, apart from the others. Pixels
/// that see an emitter or the sky, and their neighbours, are left out.
class SpotCheck {
  public:
    SpotCheck(std::shared_ptr<const TracedScene> scene, const Camera& camera, glm::uvec2 size,
              std::uint64_t seed);

    /// Looks for more pixels that stand out, in this picture (cd/m², row 0 at the top), and traces
    /// the first round of their paths. What is measured stays unbiased in any picture, since no
    /// path has a say in which they are. Does nothing where all pixels are checked.
    void look_for_sparks(std::span<const glm::vec4> picture);
    /// One more path of each of its pixels for every batch.
    void add_round();
    [[nodiscard]] std::uint64_t rounds() const {
        return sample_.paths.passes() / ImageEstimate::batches;
    }
    [[nodiscard]] std::size_t pixels() const { return sample_.pixels.size() + spark_count_; }
    /// Of a picture, cd/m², row 0 at the top. Nothing is known before the first round, or where no
    /// pixel is left: an infinite standard error.
    [[nodiscard]] SquaredError measure(std::span<const glm::vec4> picture) const;

  private:
    struct Pixel {
        std::uint32_t number = 0;  ///< in the picture, row by row
        double weight = 0.0;       ///< pixels that it stands for
    };

    /// Some pixels and their paths.
    struct Part {
        Part(std::vector<Pixel> chosen, std::uint64_t seed);

        std::vector<Pixel> pixels;
        ImageEstimate paths;
    };
    enum class Known : std::uint8_t { nothing, measured, left_out, spark };

    [[nodiscard]] std::vector<Pixel> choose(glm::uvec2 size, std::uint64_t seed);
    [[nodiscard]] std::vector<Pixel> new_sparks(std::span<const glm::vec4> picture);
    void forget_sparks();
    void add_round(Part& part) const;

    std::shared_ptr<const TracedScene> scene_;
    CameraRays camera_;
    std::uint64_t seed_;
    double sampled_share_ = 1.0;  // of the picture's pixels
    Part sample_;
    std::vector<Part> sparks_;  // as they were found
    std::size_t spark_count_ = 0;
    std::uint64_t looks_ = 0;   // for them
    std::vector<Known> known_;  // of all pixels, once one has looked
};

}  // namespace raybundle
