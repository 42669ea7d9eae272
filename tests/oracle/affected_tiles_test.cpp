// SPDX-License-Identifier: Apache-2.0
// Transferring the difference of a move to the pixels that it can reach must come to the same as
// transferring it to all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "moved_box.h"
#include "view/viewer_image.h"

namespace raybundle::affected_tiles_test {
namespace {

constexpr glm::uvec2 size(101, 75);  // not whole tiles
const glm::vec3 first_place(1.2F, 0.0F, 1.5F);
const glm::vec3 second_place(2.0F, 0.0F, 2.1F);

Camera camera_in_the_room() {
    Camera camera;
    camera.eye = {0.3F, 1.9F, 0.3F};
    camera.target = {2.2F, 0.4F, 2.4F};
    camera.vertical_fov = 1.1F;
    return camera;
}

/// The room with the box, walls and box glossy or not.
SceneBuilder room(bool glossy) {
    SceneBuilder b = room_with_box(first_place);
    if (glossy) {
        Material& material = b.scene.materials.front();
        material.specular = 1.0F;
        material.roughness = 0.35F;
    }
    return b;
}

/// A viewer in the room whose box has just moved.
struct MovedView {
    MovedView(const SceneBuilder& builder, bool scissored, unsigned bundles) {
        SolverSettings settings = quick_settings(7, {128, 200});
        settings.special = interactive_special();
        settings.special.bundles = settings.special.most_bundles = bundles;
        settings.special.scissored = scissored;
        solver = std::make_unique<Solver>(builder.scene, builder.mesh, settings);
        programs = std::make_unique<ViewPrograms>(solver->scene());
        image = std::make_unique<ViewerImage>(solver->scene(), solver->store(), *programs, size);
        image->set_camera(camera_in_the_room());
        BundleReceiver* const receivers[] = {image.get()};
        for (int i = 0; i < 96; ++i) {
            solver->step(receivers);
        }
        before = image->read_irradiance();
        radiance_before = image->read_radiance();
        Transform transform;
        transform.translation = second_place;
        solver->move_object(box_object, transform.matrix(), receivers);
        while (solver->correcting()) {
            solver->step(receivers);
        }
        after = image->read_irradiance();
        radiance_after = image->read_radiance();
    }

    std::unique_ptr<Solver> solver;
    std::unique_ptr<ViewPrograms> programs;
    std::unique_ptr<ViewerImage> image;
    std::vector<glm::vec4> before, after;  // mean irradiance and weight
    std::vector<glm::vec4> radiance_before, radiance_after;
};

struct Differences {
    double largest = 0.0;       // between both ways, relative to the mean of the picture
    double change = 0.0;        // root mean square of what the move has changed, likewise
    std::size_t kept = 0;       // pixels whose bits neither way has changed
    std::size_t disturbed = 0;  // pixels that keep their bits where all receive, and not here
};

Differences compare(const MovedView& some, const MovedView& all) {
    Differences d;
    double mean = 0.0;
    for (const glm::vec4& pixel : all.after) {
        mean += static_cast<double>(pixel.g) / static_cast<double>(all.after.size());
    }
    for (std::size_t i = 0; i < all.after.size(); ++i) {
        const glm::vec3 error = glm::abs(glm::vec3(some.after[i]) - glm::vec3(all.after[i]));
        const double largest = static_cast<double>(std::max({error.r, error.g, error.b}));
        d.largest = std::max(d.largest, largest / mean);
        const double change = static_cast<double>(all.after[i].g - all.before[i].g) / mean;
        d.change += change * change / static_cast<double>(all.after.size());
        const bool kept = all.after[i] == all.before[i];
        d.kept += kept && some.after[i] == some.before[i] ? 1 : 0;
        d.disturbed += kept && some.after[i] != some.before[i] ? 1 : 0;
    }
    d.change = std::sqrt(d.change);
    return d;
}

/// Root mean square difference of what is shown, over that of what the move has changed.
double shown_difference(const MovedView& some, const MovedView& all) {
    double difference = 0.0;
    double change = 0.0;
    for (std::size_t i = 0; i < all.radiance_after.size(); ++i) {
        const glm::vec4 d = some.radiance_after[i] - all.radiance_after[i];
        const glm::vec4 c = all.radiance_after[i] - all.radiance_before[i];
        difference += static_cast<double>(glm::dot(d, d));
        change += static_cast<double>(glm::dot(c, c));
    }
    return std::sqrt(difference / change);
}

class AffectedTiles : public testing::TestWithParam<bool> {};

/// 16 bundles are planned in two lots; a quarter of them are parallel ones.
TEST_P(AffectedTiles, LeaveOutNothingButWhatCancels) {
    const bool glossy = GetParam();
    const SceneBuilder builder = room(glossy);
    for (const unsigned bundles : glossy ? std::vector{16U} : std::vector{8U, 16U}) {
        const MovedView some(builder, true, bundles);
        const MovedView all(builder, false, bundles);
        EXPECT_EQ(some.solver->scene().reflectance().any_glossy(), glossy);
        EXPECT_EQ(some.before, all.before);
        const Differences d = compare(some, all);
        EXPECT_LT(d.largest, 1e-4);
        EXPECT_GT(d.change, 0.05);  // the test would show nothing otherwise
        EXPECT_EQ(d.disturbed, 0U);
        EXPECT_LT(shown_difference(some, all), 1e-3);
        EXPECT_GT(d.kept, std::size_t{size.x} * size.y / 20);
    }
}

INSTANTIATE_TEST_SUITE_P(Gloss, AffectedTiles, testing::Values(false, true));

/// Whoever looks into another room sees the same picture, to the bit, and goes on with the same
/// weights.
TEST(AffectedTiles, PixelsOutOfReachKeepTheirBits) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 6, wall);
    b.add_quad({1.5F, 2.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_box({10, 0, 0}, {13, 3, 3}, true, 6, wall);  // another room, dark
    b.add_object("box");
    b.add_box({11, 1, 1}, {11.5F, 1.5F, 1.5F}, false, 2, wall);
    Solver solver(b.scene, b.mesh, quick_settings(3, {128, 200}));
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(camera_in_the_room());
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 64; ++i) {
        solver.step(receivers);
    }
    const auto before = image.read_irradiance();
    Transform transform;
    transform.translation = {1.0F, 0.0F, 1.0F};
    solver.move_object(box_object, transform.matrix(), receivers);
    while (solver.correcting()) {
        solver.step(receivers);
    }
    EXPECT_EQ(image.read_irradiance(), before);
}

/// The pixels of a moved box and of what it uncovers, and their weights, are those of a picture
/// whose geometry is all made anew.
TEST(MovedPicture, ShowsTheSameAsOneMadeAnew) {
    const SceneBuilder builder = room(false);
    const MovedView moved(builder, true, 8);
    ViewerImage fresh(moved.solver->scene(), moved.solver->store(), *moved.programs, size);
    fresh.set_camera(camera_in_the_room());
    std::size_t hits = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const auto a = moved.image->probe({x, y});
            const auto b = fresh.probe({x, y});
            ASSERT_EQ(a.has_value(), b.has_value());
            hits += a && a->object == box_object ? 1 : 0;
            EXPECT_TRUE(!a || (a->position == b->position && a->patch == b->patch &&
                               a->normal == b->normal));
        }
    }
    EXPECT_GT(hits, 100U);
}

}  // namespace
}  // namespace raybundle::affected_tiles_test
