// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "bundle/face_choice.h"
#include "bundle/hemicube.h"
#include "bundle/layered_window.h"
#include "bundle/plane_window.h"
#include "solution/store/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "transport/iteration_schedule.h"
#include "zones/sky_openings.h"

namespace raybundle {

/// Pixels along the hemicube's top face and along the parallel window.
struct BundleResolution {
    int hemicube = 512;
    int window = 800;
};

/// What lines carry that meet nothing.
enum class SkyTransfer { whole, change, none };

/// One transfer of a bundle: its sign and weight, what receives it, at which place of the objects.
struct TransferSettings {
    StrategyProbabilities probabilities;
    float density_error = 1.0F;  ///< fault injection of tests
    float weight = 1.0F;         ///< factor of patch contributions; negative in a special phase
    double row_phase =
        0.0;            ///< which pixel rows are sampled, [0, 1), see row_stride in transfer.cpp
    unsigned slot = 0;  ///< of a layered iteration in its group, for take_overflow()
    /// Iterations M over which perspective bundles trade bias for noise (ch. 5.4); 0: never.
    float noise_horizon = 0.0F;
    bool coloured = false;  ///< patch sums carry the shooter's radiance (special phase)
    FaceWeights face_weights = all_faces;  ///< of a glossy shooter
    glm::vec3 constant{0.0F};              ///< constant radiance term, radiance units
    SkyTransfer sky = SkyTransfer::whole;
    BundleReceiver::Context context;
};

/// Builds random bundles and transfers radiance through them to patches and other receivers
/// (steps 2 and 3 of an iteration).
class Transfer {
  public:
    Transfer(const GpuScene& scene, const RadianceStore& store, const BundleResolution& resolution);

    /// Perspective bundle from a shooting point (ch. 5). frame.z is the shooter's normal.
    void perspective(const BundleFrame& frame, const layout::Shooter& shooter,
                     const Hemicube::FaceRectangles& rectangles, const TransferSettings& settings,
                     std::span<BundleReceiver* const> receivers);
    /// Layered parallel bundle (ch. 4.3). Does nothing where the lists overflow; see
    /// take_overflow().
    void layered(const ParallelWindow& window, const PixelRectangle& rectangle,
                 const TransferSettings& settings, std::span<BundleReceiver* const> receivers);
    /// Parallel bundle split by the window's plane (ch. 4.3.1).
    void plane(const ParallelWindow& window, const TransferSettings& settings,
               std::span<BundleReceiver* const> receivers);

    /// Openings whose bundles have a part in the light of the sky from now on, but in special
    /// phases; the probability of such bundles, and whether densities are wrong, are those of the
    /// settings.
    void set_openings(const SkyOpenings& found, const TransferSettings& settings);
    /// Light of the sky through a point of an opening. frame.z points inwards.
    void opening(const BundleFrame& frame, const TransferSettings& settings,
                 std::span<BundleReceiver* const> receivers);

    /// Reads and clears the counters. Bit s is set where the layered transfer in slot s found too
    /// little room: nothing of it was transferred; the lists are larger now, do it again.
    std::uint32_t take_overflow();

    [[nodiscard]] ParallelWindow parallel_window(const IterationSample& sample) const;
    [[nodiscard]] const Hemicube& hemicube() const { return hemicube_; }
    [[nodiscard]] std::uint64_t non_finite() const { return non_finite_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    layout::BundleParameters common_parameters(const BundleFrame& frame,
                                               const TransferSettings& settings) const;
    layout::BundleParameters parallel_parameters(const ParallelWindow& window,
                                                 const TransferSettings& settings) const;
    void set_bases(const ShaderProgram& program, Place place) const;
    void upload(const layout::BundleParameters& parameters, bool special = false);
    void transfer_rows(const ShaderProgram& patches, const PixelRectangle& rectangle, int first_row,
                       const TransferSettings& settings) const;

    const GpuScene& scene_;
    const RadianceStore& store_;
    Hemicube hemicube_;
    LayeredWindow layers_;
    Buffer parameters_;
    ShaderProgram hemicube_patches_, hemicube_patches_coloured_, hemicube_patches_glossy_;
    /// Layered bundles to patches; made anew where lists are longer than it has room for.
    struct LayeredPatches {
        std::uint32_t longest_list;
        unsigned run;  // pixels of a row that an invocation sorts and sums
        ShaderProgram program;
    };
    [[nodiscard]] LayeredPatches layered_patches(std::uint32_t longest_list) const;
    LayeredPatches layers_patches_;
    /// Exists from the first plane bundle on.
    struct Planes {
        PlaneWindow pictures;
        ShaderProgram patches;
    };
    std::optional<Planes> planes_;
    /// Exists from the first bundle from an opening on.
    struct Outside {
        Hemicube picture;  ///< what the lines of the other one meet in the opposite direction
        ShaderProgram patches;
    };
    std::optional<Outside> outside_;
    Buffer openings_, no_openings_, sheltered_;
    std::uint64_t non_finite_ = 0;
};

}  // namespace raybundle
