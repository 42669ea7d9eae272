// SPDX-License-Identifier: Apache-2.0
// The methods that find all light, against path tracing and closed forms. Each renders small
// pictures with several seeds; pixels are compared by Welch's t test with the scatter over the
// seeds. For 16 seeds and the fewer degrees of freedom (15) of two samples, 7.5 standard errors are
// passed by chance with a probability of 2e-6; over the 64 pixels, 3 colours, 44 pairs compared
// here the Sidak-corrected level is 1.7e-2. The mean of a picture is held to 5.5: 6e-5.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <string>

#include "agreement_views.h"
#include "lit_room.h"
#include "reference/specular_walk.h"
#include "research/reference_method.h"
#include "rooms.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 view_size(8, 8);
constexpr int seeds = 16;
constexpr double pixel_sigmas = 7.5;
constexpr double picture_sigmas = 5.5;

struct MethodCase {
    const char* name;
    ReferenceKind kind;
    int iterations;
    double bias = 0.0;  ///< relative, that the method may have in a picture's mean
};

constexpr MethodCase path_case{"path", ReferenceKind::path, 256};
constexpr MethodCase methods[] = {{"light", ReferenceKind::light, 2048},
                                  {"path_reuse", ReferenceKind::path_reuse, 256},
                                  {"bidirectional", ReferenceKind::bidirectional, 96},
                                  {"metropolis", ReferenceKind::metropolis, 512},
                                  {"photon_map", ReferenceKind::photon_map, 6, 0.04}};

constexpr std::size_t photon_map = std::size(methods) - 1;
constexpr std::size_t metropolis = photon_map - 1;

using Picture = std::vector<glm::dvec3>;

const std::vector<bool> all_pixels(std::size_t{view_size.x} * view_size.y, true);

/// Pixels that show no mirror or glass at any of 64 x 64 points.
std::vector<bool> without_mirrors(const RayScene& scene, const Camera& camera) {
    constexpr unsigned side = 64;
    const CameraRays rays(scene, camera, view_size * side);
    std::vector<bool> result = all_pixels;
    for (std::size_t i = 0; i < all_pixels.size() * side * side; ++i) {
        const glm::uvec2 at(i % (view_size.x * side), i / (view_size.x * side));
        const auto hit = scene.trace(rays.origin(), rays.direction(glm::dvec2(at) + 0.5));
        if (hit && is_deflecting(scene, *hit)) {
            result[std::size_t{at.y} / side * view_size.x + at.x / side] = false;
        }
    }
    return result;
}

Picture render(ReferenceKind kind, const RayScene& scene, const Camera& camera, int iterations,
               std::uint64_t seed) {
    const auto method = make_reference_method(kind, scene, camera, view_size, seed);
    for (int i = 0; i < iterations; ++i) {
        method->iterate();
    }
    EXPECT_EQ(method->non_finite(), 0U);
    return method->picture();
}

/// Pictures with independent seeds.
std::vector<Picture> replicates(const MethodCase& method, int iterations, const RayScene& scene,
                                const Camera& camera, std::uint64_t first_seed) {
    std::vector<Picture> pictures;
    for (int i = 0; i < seeds; ++i) {
        pictures.push_back(render(method.kind, scene, camera, iterations,
                                  first_seed + static_cast<std::uint64_t>(i)));
    }
    return pictures;
}

/// Path traced pictures of a view: made once for all methods that are compared with them.
const std::vector<Picture>& path_traced(int index) {
    static std::map<int, std::vector<Picture>> known;
    const auto [entry, is_new] = known.try_emplace(index);
    if (is_new) {
        const View view = agreement_view(index);
        const RayScene scene(view.builder.scene, view.builder.mesh);
        entry->second =
            replicates(path_case, view.effort * path_case.iterations, scene, view.camera, 100);
    }
    return entry->second;
}

/// Each picture with its mean over the pixels that count at its end.
std::vector<Picture> with_means(std::vector<Picture> pictures,
                                const std::vector<bool>& counts = all_pixels) {
    const auto count = static_cast<double>(std::count(counts.begin(), counts.end(), true));
    for (Picture& p : pictures) {
        glm::dvec3 mean(0.0);
        for (std::size_t pixel = 0; pixel < p.size(); ++pixel) {
            mean += counts[pixel] ? p[pixel] / count : glm::dvec3(0.0);
        }
        p.push_back(mean);
    }
    return pictures;
}

Estimate estimate_of(const std::vector<Picture>& pictures, std::size_t pixel, int channel) {
    Estimate e;
    for (const Picture& p : pictures) {
        e.mean += p[pixel][channel] / seeds;
    }
    for (const Picture& p : pictures) {
        e.standard_error += std::pow(p[pixel][channel] - e.mean, 2);
    }
    e.standard_error = std::sqrt(e.standard_error / (seeds * (seeds - 1.0)));
    return e;
}

class MethodAgreement : public testing::TestWithParam<std::tuple<MethodCase, int>> {};

TEST_P(MethodAgreement, WithPathTracingPixelByPixel) {
    const auto& [method, index] = GetParam();
    const View view = agreement_view(index);
    const RayScene scene(view.builder.scene, view.builder.mesh);
    // Particles from lights do not find a mirror that the eye sees.
    const std::vector<bool> counts =
        method.kind == ReferenceKind::light ? without_mirrors(scene, view.camera) : all_pixels;
    EXPECT_GE(std::count(counts.begin(), counts.end(), true), 16);
    const auto reference = with_means(path_traced(index), counts);
    const auto pictures = with_means(
        replicates(method, view.effort * method.iterations, scene, view.camera, 200), counts);
    const std::size_t pixels = counts.size();
    for (std::size_t pixel = 0; pixel <= pixels; ++pixel) {
        const bool whole = pixel == pixels;
        if (!whole && !counts[pixel]) {
            continue;
        }
        for (int channel = 0; channel < 3; ++channel) {
            const Estimate r = estimate_of(reference, pixel, channel);
            const Estimate e = estimate_of(pictures, pixel, channel);
            const double sigma = std::hypot(r.standard_error, e.standard_error);
            const double blur = method.bias * (whole ? 1.0 : 5.0) * r.mean;
            EXPECT_NEAR(e.mean, r.mean, (whole ? picture_sigmas : pixel_sigmas) * sigma + blur)
                << "pixel " << pixel << " channel " << channel;
            EXPECT_LE(e.standard_error, (whole ? 0.03 : 0.4) * r.mean)
                << "pixel " << pixel << " channel " << channel;
        }
    }
}

std::string case_name(const testing::TestParamInfo<std::tuple<MethodCase, int>>& test) {
    return std::string(std::get<0>(test.param).name) + "_" +
           std::to_string(std::get<1>(test.param));
}

// By way of mirrors and glass; photon maps, whose views cost ten times as much, by a glossy floor.
INSTANTIATE_TEST_SUITE_P(Methods, MethodAgreement,
                         testing::Combine(testing::ValuesIn(methods, methods + metropolis),
                                          testing::Values(5)),
                         case_name);
INSTANTIATE_TEST_SUITE_P(PhotonMaps, MethodAgreement,
                         testing::Combine(testing::Values(methods[photon_map]), testing::Values(1)),
                         case_name);
INSTANTIATE_TEST_SUITE_P(HeavyMethods, MethodAgreement,
                         testing::Combine(testing::ValuesIn(methods),
                                          testing::Values(0, 1, 2, 3, 4, 5, 6, 7)),
                         case_name);

/// Methods say which light they do not find, and nothing where they find all.
TEST(LightMissed, BehindMirrorsAndOfPunctualLightsByWayOfGlass) {
    View view = agreement_view(5);
    const auto missed = [&view](ReferenceKind kind, const Camera& camera) {
        const RayScene scene(view.builder.scene, view.builder.mesh);
        return light_missed(kind, scene, camera, view_size);
    };
    const Camera away = camera_at({0.3F, 1.6F, 0.3F}, {0.0F, 1.6F, 0.2F}, 0.5F);
    EXPECT_NE(missed(ReferenceKind::light, view.camera).find("mirrors"), std::string::npos);
    EXPECT_EQ(missed(ReferenceKind::light, away), "");
    EXPECT_EQ(missed(ReferenceKind::path, view.camera), "");
    add_punctual_light(view.builder, odd_rotation(), PunctualKind::point, {2, 3, 2}, {0, -1, 0},
                       glm::vec3(100.0F));
    EXPECT_NE(missed(ReferenceKind::path, view.camera).find("punctual"), std::string::npos);
    EXPECT_NE(missed(ReferenceKind::metropolis, away).find("punctual"), std::string::npos);
    EXPECT_NE(missed(ReferenceKind::bidirectional, away).find("again"), std::string::npos);
    EXPECT_NE(missed(ReferenceKind::photon_map, away).find("glossy"), std::string::npos);
    EXPECT_EQ(missed(ReferenceKind::light, away), "");
}

// All that is seen there is glass.
INSTANTIATE_TEST_SUITE_P(HeavyMethodsButLight, MethodAgreement,
                         testing::Combine(testing::ValuesIn(methods + 1, std::end(methods)),
                                          testing::Values(8)),
                         case_name);

class FullMethod : public testing::TestWithParam<MethodCase> {};

class FurnaceByMethod : public FullMethod {};

/// A closed furnace of emission Le is Le/(1 - albedo) bright everywhere.
TEST_P(FurnaceByMethod, IsAConstantPicture) {
    const SceneBuilder room = furnace_room(0.5F, 100.0F);
    const RayScene scene(room.scene, room.mesh);
    const Camera camera = camera_at({0.5F, 1.5F, 0.5F}, {3.0F, 1.2F, 1.5F}, 0.7F);
    const auto pictures =
        with_means(replicates(GetParam(), GetParam().iterations, scene, camera, 1));
    for (std::size_t pixel = 0; pixel <= std::size_t{view_size.x} * view_size.y; ++pixel) {
        const bool whole = pixel == std::size_t{view_size.x} * view_size.y;
        const Estimate e = estimate_of(pictures, pixel, 1);
        const double blur = 200.0 * GetParam().bias;
        EXPECT_NEAR(e.mean, 200.0,
                    (whole ? picture_sigmas : pixel_sigmas) * e.standard_error + 1e-4 + blur)
            << pixel;
        EXPECT_LT(e.standard_error, 20.0) << pixel;
    }
}

/// Behind a wall without thickness not a photon arrives; photon mapping alone blurs a little light
/// along floor and ceiling, which both rooms have in common (the lit one shows 132 cd/m²).
TEST_P(FullMethod, DarkRoomStaysExactlyDark) {
    const TwoRooms rooms = two_rooms(0.8F, 0.0F);
    const RayScene scene(rooms.builder.scene, rooms.builder.mesh);
    const Camera camera = camera_at({7.0F, 2.0F, 2.0F}, {4.0F, 2.2F, 1.8F}, 1.2F);
    for (const glm::dvec3& pixel : render(GetParam().kind, scene, camera, 8, 1)) {
        if (GetParam().bias > 0.0) {
            EXPECT_LT(pixel.g, 0.05 * 132.0);
        } else {
            EXPECT_EQ(pixel, glm::dvec3(0.0));
        }
    }
}

TEST_P(FullMethod, SameSeedGivesTheSameBitsWithAnyNumberOfThreads) {
    const View view = agreement_view(5);
    const RayScene scene(view.builder.scene, view.builder.mesh);
    const auto bits = [&](int threads, std::uint64_t seed) {
        tbb::task_arena arena(threads);
        std::vector<std::uint64_t> result;
        arena.execute([&] {
            for (const glm::dvec3& pixel : render(GetParam().kind, scene, view.camera, 4, seed)) {
                result.push_back(std::bit_cast<std::uint64_t>(pixel.g));
            }
        });
        return result;
    };
    const auto one = bits(1, 7);
    EXPECT_EQ(one, bits(3, 7));
    EXPECT_NE(one, bits(3, 8));
}

std::string method_name(const testing::TestParamInfo<MethodCase>& test) {
    return test.param.name;
}

INSTANTIATE_TEST_SUITE_P(Methods, FullMethod, testing::ValuesIn(methods), method_name);
INSTANTIATE_TEST_SUITE_P(Methods, FurnaceByMethod, testing::ValuesIn(methods, methods + metropolis),
                         method_name);
INSTANTIATE_TEST_SUITE_P(HeavyMethods, FurnaceByMethod,
                         testing::Values(methods[metropolis], methods[photon_map]), method_name);

/// What light tracing and bidirectional path tracing need of a camera: directions that the film
/// shows lead back to their pixel, and the importance is pixels per solid angle.
TEST(CameraRays, ProjectionIsTheInverseOfTheRays) {
    const SceneBuilder room = furnace_room(0.5F, 1.0F);
    const RayScene scene(room.scene, room.mesh);
    const CameraRays camera(scene, camera_at({1, 1, 1}, {2, 1.4F, 3}, 1.3F), {12, 7});
    RandomStream random(1, 0);
    double pixels = 0.0;
    constexpr int samples = 400'000;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 at = random.next_pair() * glm::dvec2(12, 7);
        const auto film = camera.project(camera.direction(at));
        ASSERT_TRUE(film.has_value());
        EXPECT_EQ(film->pixel,
                  12 * static_cast<std::size_t>(at.y) + static_cast<std::size_t>(at.x));
        EXPECT_NEAR(camera.density(camera.direction(at)) * 84.0, film->importance,
                    1e-9 * film->importance);
        // Even directions over the sphere.
        const double z = 1.0 - 2.0 * random.next();
        const double phi = 2.0 * glm::pi<double>() * random.next();
        const double sine = std::sqrt(1.0 - z * z);
        const auto shown = camera.project({sine * std::cos(phi), sine * std::sin(phi), z});
        pixels += shown ? shown->importance * 4.0 * glm::pi<double>() / samples : 0.0;
    }
    EXPECT_NEAR(pixels, 84.0, 1.0);  // 5 standard errors
}

}  // namespace
}  // namespace raybundle
