// SPDX-License-Identifier: Apache-2.0
// The incoming first shot of the solver: closed forms per patch and per pixel, and path tracing.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>

#include "../reference/lit_room.h"
#include "oracle/oracle_solve.h"
#include "pictures.h"
#include "view/viewer_image.h"

namespace raybundle::punctual_light_test {
namespace {

using std::numbers::pi;

double patch_area(const PatchMesh& mesh, std::size_t patch) {
    const glm::uvec3& t = mesh.triangles[patch];
    return 0.5 *
           static_cast<double>(glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                      mesh.positions[t.z] - mesh.positions[t.x])));
}

/// What a lamp sends into a black closed room, lm.
double received_flux(PunctualKind kind, const glm::vec3& intensity) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 12, b.add_material(glm::vec3(0.0F)));
    add_punctual_light(b, odd_rotation(), kind, {1.1F, 2.3F, 1.9F}, {0.3F, -1, 0.4F}, intensity);
    const Solver solver(b.scene, b.mesh);
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        flux += patch_area(b.mesh, i) * static_cast<double>(irradiance[i].g);
    }
    return flux;
}

/// 16 points a patch integrate the lamp's light to half a per cent.
TEST(FirstShot, LampOfThousandLumenGivesThousandLumen) {
    EXPECT_NEAR(received_flux(PunctualKind::point, glm::vec3(static_cast<float>(250.0 / pi))),
                1000.0, 5.0);
    const double cosines[] = {std::cos(glm::radians(20.0)), std::cos(glm::radians(35.0))};
    const double solid_angle = 2.0 * pi * (1.0 - cosines[0] + (cosines[0] - cosines[1]) / 3.0);
    EXPECT_NEAR(
        received_flux(PunctualKind::spot, glm::vec3(static_cast<float>(1000.0 / solid_angle))),
        1000.0, 5.0);
}

/// A luminaire of a file, whose axis is turned with the light: the flux of its table.
TEST(FirstShot, IesProfileGivesItsFlux) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 12, b.add_material(glm::vec3(0.0F)));
    add_punctual_light(b, odd_rotation(), PunctualKind::point, {1.1F, 2.3F, 1.9F}, {0.3F, -1, 0.4F},
                       glm::vec3(2.0F));
    b.scene.punctual_lights[0].profile = std::make_shared<const IesProfile>(
        parse_ies("f",
                  "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 5 1 2 0 0 0\n1 1 10\n0 30 60 90\n"
                  "0 90 180 270 360\n100 90 50 0\n100 60 20 0\n100 20 5 0\n100 60 20 0\n"
                  "100 90 50 0\n"));
    const double exact = 2.0 * b.scene.punctual_lights[0].profile->flux();
    const Solver solver(b.scene, b.mesh);
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        flux += patch_area(b.mesh, i) * static_cast<double>(irradiance[i].g);
    }
    EXPECT_NEAR(flux, exact, 5e-3 * exact);
}

/// Every pixel of a floor under a lamp: I h / d^3.
TEST(FirstShot, PixelsFollowInverseSquareAndCosine) {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 2, 2, b.add_material(glm::vec3(0.5F)));
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {0.3F, 2, -0.2F}, {0, -1, 0},
                       glm::vec3(100.0F));
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {40, 30});
    Camera camera;
    camera.eye = {0, 3, -5};
    camera.target = {0, 0, 0};
    image.set_camera(camera);
    int seen = 0;
    for (unsigned x = 0; x < 40; x += 3) {
        for (unsigned y = 0; y < 30; y += 3) {
            const auto probe = image.probe({x, y});
            if (!probe) {
                continue;
            }
            ++seen;
            const glm::dvec3 offset = glm::dvec3(probe->position) - glm::dvec3(0.3, 2.0, -0.2);
            const double exact = 200.0 / std::pow(glm::length(offset), 3);
            EXPECT_NEAR(static_cast<double>(probe->irradiance.g), exact, 2e-3 * exact);
            EXPECT_NEAR(static_cast<double>(probe->radiance.g), 0.5 * exact / pi, 0.01 * exact);
        }
    }
    EXPECT_GT(seen, 50);
}

struct Lit {
    explicit Lit(const glm::mat4& where, std::uint32_t n, glm::uvec2 size, std::uint64_t seed = 1,
                 bool glossy = false)
        : builder(lit_room(where, n)) {
        if (glossy) {  // walls and floor of polished plaster
            builder.scene.materials[0].specular = 1.0F;
            builder.scene.materials[0].roughness = 0.35F;
        }
        SolverSettings settings;
        settings.seed = seed;
        settings.coarse_iterations = 1'000'000;
        solver.emplace(builder.scene, builder.mesh, settings);
        programs.emplace(solver->scene());
        image.emplace(solver->scene(), solver->store(), *programs, size);
        image->set_camera(lit_room_camera(where));
    }

    void iterate(int count) {
        BundleReceiver* const receivers[] = {&*image};
        for (int i = 0; i < count; ++i) {
            solver->step(receivers);
        }
    }

    SceneBuilder builder;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    std::optional<ViewerImage> image;
};

std::vector<glm::dvec3> path_traced(const Lit& lit, const Camera& view, glm::uvec2 size) {
    constexpr std::uint32_t paths = 768;  // noise: below 1.7 %
    return path_traced_centres(lit.builder.scene, lit.builder.mesh, view, size, paths);
}

/// Relative RMS difference of two pictures without the 2 % of pixels that differ most: where an
/// edge runs through a pixel's centre the two may see either side of it.
double difference(const std::vector<glm::vec4>& picture, const std::vector<glm::dvec3>& truth) {
    std::vector<double> squares;
    double total = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(picture[i]) - truth[i];
        squares.push_back(glm::dot(d, d));
        total += glm::dot(truth[i], truth[i]);
    }
    std::sort(squares.begin(), squares.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < squares.size() * 98 / 100; ++i) {
        sum += squares[i];
    }
    return std::sqrt(sum / total);
}

TEST(FirstShot, RoomIsAsBrightAsByPathTracing) {
    const glm::mat4 where = odd_rotation();
    constexpr glm::uvec2 size(24, 18);
    Lit lit(where, 16, size);
    lit.iterate(768);
    const auto picture = lit.image->read_radiance();
    const auto truth = path_traced(lit, lit_room_camera(where), size);
    EXPECT_LT(difference(picture, truth), 0.03);
    glm::dvec3 mean(0.0);
    glm::dvec3 exact(0.0);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        mean += glm::dvec3(picture[i]);
        exact += truth[i];
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mean[c], exact[c], 0.02 * exact[c]) << c;
    }
}

/// The floor shines: the picture has the lights' highlights, and the wall behind what it reflects.
TEST(HeavyFirstShot, GlossyRoomIsAsBrightAsByPathTracing) {
    const glm::mat4 where = odd_rotation();
    constexpr glm::uvec2 size(24, 18);
    Lit lit(where, 16, size, 1, true);
    lit.iterate(1536);
    const auto picture = lit.image->read_radiance();
    const auto truth = path_traced(lit, lit_room_camera(where), size);
    EXPECT_LT(difference(picture, truth), 0.04);
    glm::dvec3 mean(0.0);
    glm::dvec3 exact(0.0);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        mean += glm::dvec3(picture[i]);
        exact += truth[i];
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mean[c], exact[c], 0.03 * exact[c]) << c;
    }
}

TEST(FirstShot, SameSeedGivesTheSameBits) {
    const auto bits = [](std::uint64_t seed) {
        Lit lit(odd_rotation(), 6, {16, 12}, seed);
        lit.iterate(32);
        std::vector<std::uint32_t> result;
        for (const glm::vec4& e : lit.solver->store().read_irradiance()) {
            result.push_back(std::bit_cast<std::uint32_t>(e.g));
        }
        for (const glm::vec4& pixel : lit.image->read_radiance()) {
            result.push_back(std::bit_cast<std::uint32_t>(pixel.g));
        }
        return result;
    };
    EXPECT_EQ(bits(3), bits(3));
    EXPECT_NE(bits(3), bits(4));
}

/// A box moves under a lamp: direct light is at once what a fresh start finds, bit by bit.
TEST(FirstShot, IsRedoneWhereAnObjectMoves) {
    const auto build = [](float x) {
        SceneBuilder b;
        const auto m = b.add_material(glm::vec3(0.0F));
        b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 16, 16, m);
        Transform transform;
        transform.translation.x = x;
        b.add_object("box", transform);
        b.add_box({-0.5F, 0.3F, -0.5F}, {0.5F, 0.9F, 0.5F}, false, 1, m);
        add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {0.2F, 2, 0.1F}, {0, -1, 0},
                           glm::vec3(100.0F));
        return b;
    };
    const SceneBuilder before = build(0.0F);
    const SceneBuilder after = build(1.0F);
    Solver moved(before.scene, before.mesh);
    const auto at_first = moved.store().read_irradiance();
    moved.move_object(1, glm::translate(glm::mat4(1.0F), glm::vec3(1, 0, 0)), {});
    const Solver fresh(after.scene, after.mesh);
    const auto there = moved.store().read_irradiance();
    const auto truth = fresh.store().read_irradiance();
    double change = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(there[i].g, truth[i].g, 1e-3F * truth[i].g + 1e-4F) << i;
        change += std::abs(static_cast<double>(there[i].g - at_first[i].g));
    }
    EXPECT_GT(change, 10.0);
}

/// A lamp that an object carries moves with it.
TEST(FirstShot, CarriedLampMoves) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.0F));
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 1, 1, m);
    b.add_object("lamp");
    b.add_box({-0.1F, 2.1F, -0.1F}, {0.1F, 2.3F, 0.1F}, false, 1, m);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {0, 2, 0}, {0, -1, 0},
                       glm::vec3(100.0F));
    b.scene.punctual_lights[0].object = 1;
    Solver solver(b.scene, b.mesh);
    solver.move_object(1, glm::translate(glm::mat4(1.0F), glm::vec3(0, 2, 0)), {});
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        flux += patch_area(b.mesh, i) * static_cast<double>(irradiance[i].g);
    }
    // A square of half-width a at height h below: Phi = 4 I atan(a^2 / (h sqrt(2 a^2 + h^2))).
    EXPECT_NEAR(flux, 400.0 * std::atan(16.0 / (4.0 * std::sqrt(48.0))), 8.0);
}

/// A lamp goes from one end of a white room to the other: the light that walls have sent each other
/// before is not the one of now. 256 iterations after 512 bring both means to a fresh start's.
TEST(HeavyFirstShot, IndirectLightFollowsALampThatMoves) {
    const auto build = [](float z) {
        SceneBuilder b;
        b.add_box({0, 0, 0}, {3, 3, 9}, true, 8, b.add_material(glm::vec3(0.7F)));
        Transform transform;
        transform.translation.z = z;
        b.add_object("lamp", transform);
        b.add_box({1.4F, 2.8F, -0.1F}, {1.6F, 2.9F, 0.1F}, false, 1,
                  b.add_material(glm::vec3(0.0F)));
        add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {1.5F, 2.7F, 0}, {0, -1, 0},
                           glm::vec3(100.0F));
        b.scene.punctual_lights[0].object = 1;
        return b;
    };
    const SceneBuilder at_one_end = build(1.5F);
    const SceneBuilder at_other_end = build(7.5F);
    const auto iterate = [](Solver& solver, std::uint64_t until) {
        while (solver.iterations() < until) {
            solver.step({});
        }
    };
    SolverSettings settings;
    settings.coarse_iterations = 1'000'000;
    Solver moved(at_one_end.scene, at_one_end.mesh, settings);
    iterate(moved, 512);
    moved.move_object(1, glm::translate(glm::mat4(1.0F), glm::vec3(0, 0, 7.5F)), {});
    iterate(moved, 768);
    settings.seed = 9;
    Solver fresh(at_other_end.scene, at_other_end.mesh, settings);
    iterate(fresh, 1024);
    const auto there = moved.store().read_irradiance();
    const auto truth = fresh.store().read_irradiance();
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        square += std::pow(static_cast<double>(there[i].g - truth[i].g), 2);
        total += std::pow(static_cast<double>(truth[i].g), 2);
    }
    EXPECT_LT(std::sqrt(square / total), 0.05);
}

/// Together with everything else that a scene can call for: finite, and bright.
TEST(FirstShot, GoesTogetherWithAllOtherEffects) {
    SceneBuilder b = lit_room(odd_rotation(), 4);
    b.scene.materials[0].specular = 1.0F;
    b.scene.materials[0].roughness = 0.5F;
    b.scene.materials[1].max_phong = MaxPhong{glm::vec3(0.3F), 10.0F};
    b.scene.textures.push_back({"white", 1, 1, true, true, {255, 255, 255, 255}});
    b.scene.materials[2].base_colour_texture.texture = 0;
    b.scene.materials[2].alpha_mode = AlphaMode::mask;
    b.scene.sky_radiance = glm::vec3(5.0F);
    b.mesh.coverage.assign(b.mesh.patch_count(), 1.0F);
    b.scene.punctual_lights[0].profile = std::make_shared<const IesProfile>(
        parse_ies("f", "TILT=NONE\n1 1 1 2 1 1 1 0 0 0\n1 1 1\n0 180\n0\n1 1\n"));
    SolverSettings settings;
    settings.probabilities = {0.3F, 0.2F, 0.5F};
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {32, 24});
    image.set_camera(lit_room_camera(odd_rotation()));
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 64; ++i) {
        solver.step(receivers);
    }
    EXPECT_EQ(solver.non_finite(), 0U);
    double mean = 0.0;
    for (const glm::vec4& pixel : image.read_radiance()) {
        ASSERT_TRUE(std::isfinite(pixel.r + pixel.g + pixel.b));
        mean += static_cast<double>(pixel.g) / (32.0 * 24.0);
    }
    EXPECT_GT(mean, 1.0);
    EXPECT_LT(mean, 200.0);
}

/// Nothing of it exists where no scene calls for it.
TEST(FirstShot, CostsNothingInOtherScenes) {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.5F), glm::vec3(1.0F)));
    const Solver solver(b.scene, b.mesh);
    EXPECT_EQ(solver.store().first_shot(), nullptr);
    const auto& defines = solver.scene().defines();
    EXPECT_EQ(std::find(defines.begin(), defines.end(), "FIRST_SHOT 1"), defines.end());
}

}  // namespace
}  // namespace raybundle::punctual_light_test
