// SPDX-License-Identifier: Apache-2.0
// The first shot of punctual lights after changes, of which it finds anew only what they reach,
// against one of the changed scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "scene/light/light_place.h"

namespace raybundle::lamp_changes_test {
namespace {

constexpr unsigned lamps = 20;
constexpr std::uint32_t box = 1, lamp_stand = 2;  // objects
constexpr std::uint32_t floor_material = 0;

struct Kind {
    const char* name;
    bool glossy;
    bool sun;
};

/// A hall of 8 x 3 x 6 m with two movable objects, 20 lamps of three kinds under its ceiling, one
/// on the second object, and maybe a sun through its open front.
SceneBuilder lit_hall(const Kind& kind) {
    SceneBuilder b;
    Material floor;
    floor.base_colour = glm::vec3(0.5F);
    floor.roughness = 0.4F;
    floor.specular = kind.glossy ? 1.0F : 0.0F;
    const auto ground = b.add_material(floor);
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    b.add_quad({0, 0, 0}, {0, 0, 6}, {8, 0, 0}, 8, 8, ground);
    b.add_quad({0, 3, 0}, {8, 0, 0}, {0, 0, 6}, 8, 8, wall);
    b.add_quad({0, 0, 6}, {0, 3, 0}, {8, 0, 0}, 8, 8, wall);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 6}, 8, 8, wall);
    b.add_quad({8, 0, 0}, {0, 0, 6}, {0, 3, 0}, 8, 8, wall);
    b.add_object("box");
    b.add_box({2, 0.2F, 2}, {3, 1.1F, 2.6F}, false, 2, wall);
    b.add_object("lamp stand");
    b.add_box({5, 0.1F, 3}, {5.3F, 1, 3.3F}, false, 1, wall);
    const auto profile = std::make_shared<const IesProfile>(
        parse_ies("wide.ies",
                  "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0 0 0\n1 1 10\n0 30 60 90\n0\n"
                  "100 90 50 0\n"));
    for (unsigned k = 0; k < lamps; ++k) {
        const glm::vec3 place(0.8F + 1.6F * static_cast<float>(k % 5), 2.9F,
                              0.75F + 1.5F * static_cast<float>(k / 5));
        add_punctual_light(b, glm::mat4(1.0F),
                           k % 3 == 1 ? PunctualKind::spot : PunctualKind::point, place,
                           {0.1F, -1, 0.1F}, glm::vec3(10.0F + static_cast<float>(k)));
        if (k % 3 == 2) {
            b.scene.punctual_lights.back().profile = profile;
            b.scene.punctual_lights.back().intensity *= 0.02F;
        }
    }
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {5.15F, 1.2F, 3.15F}, {0, -1, 0},
                       glm::vec3(15.0F));
    b.scene.punctual_lights.back().object = static_cast<int>(lamp_stand);
    if (kind.sun) {
        add_punctual_light(b, glm::mat4(1.0F), PunctualKind::directional, {0, 0, 0},
                           {0.3F, -0.6F, 1.0F}, glm::vec3(20'000.0F));
    }
    return b;
}

Camera into_the_hall() {
    Camera camera;
    camera.eye = {4.0F, 1.6F, 0.1F};
    camera.target = {3.5F, 0.6F, 4.0F};
    camera.vertical_fov = 1.3F;
    return camera;
}

struct Hall {
    explicit Hall(SceneBuilder builder)
        : b(std::move(builder)),
          solver(b.scene, b.mesh),
          programs(solver.scene()),
          image(solver.scene(), solver.store(), programs, {40, 30}) {
        image.set_camera(into_the_hall());
    }

    void move(std::uint32_t object, const glm::vec3& offset) {
        BundleReceiver* const receivers[] = {&image};
        b.scene.objects[object].transform.translation = offset;
        solver.move_object(object, glm::translate(glm::mat4(1.0F), offset), receivers);
    }

    [[nodiscard]] FirstShot::Reach reach() const { return solver.store().first_shot()->reach(); }

    /// factor: of the intensity of a lamp, as it is.
    void dim(std::size_t lamp, float factor) {
        BundleReceiver* const receivers[] = {&image};
        b.scene.punctual_lights[lamp].intensity *= factor;
        solver.change_surfaces(b.scene, b.mesh, {}, {}, receivers);
    }

    /// A lamp somewhere else, aimed elsewhere.
    void place(std::size_t lamp, const LightPlace& place) {
        BundleReceiver* const receivers[] = {&image};
        set_place(place, b.scene.punctual_lights[lamp]);
        solver.change_surfaces(b.scene, b.mesh, {}, {}, receivers);
    }

    void paint(std::uint32_t material, const glm::vec3& colour) {
        BundleReceiver* const receivers[] = {&image};
        b.scene.materials[material].base_colour = colour;
        const std::uint32_t materials[] = {material};
        solver.change_surfaces(b.scene, b.mesh, materials, materials, receivers);
    }

    SceneBuilder b;
    Solver solver;
    ViewPrograms programs;
    ViewerImage image;
};

/// Irradiance and main part of the reflected radiance of patches, then irradiance of pixels;
/// green, physical units.
std::vector<double> light_of(Hall& hall) {
    const FirstShot& shot = *hall.solver.store().first_shot();
    const auto unit = static_cast<double>(hall.solver.scene().radiance_unit());
    std::vector<double> result;
    for (const glm::vec3& value : shot.read_irradiance()) {
        result.push_back(unit * static_cast<double>(value.g));
    }
    for (const glm::vec4& value : shot.read_reflected()) {
        result.push_back(unit * static_cast<double>(value.g));
    }
    for (unsigned i = 0; i < 1200; ++i) {
        const auto probe = hall.image.probe({i % 40, i / 40});
        result.push_back(probe ? static_cast<double>(probe->irradiance.g) : -1.0);
    }
    return result;
}

/// Everywhere, but for the last bits of sums of floats.
void expect_as_fresh(Hall& hall, const char* what) {
    Hall fresh(hall.b);
    const std::vector<double> found = light_of(hall);
    const std::vector<double> truth = light_of(fresh);
    ASSERT_EQ(found.size(), truth.size());
    std::size_t off = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = std::abs(found[i] - truth[i]);
        off += difference > 1e-6 * std::abs(truth[i]) ? 1 : 0;
        worst = std::max(worst, truth[i] > 0.0 ? difference / truth[i] : difference);
    }
    EXPECT_EQ(off, 0U) << what << ": of " << truth.size() << ", worst " << worst;
}

class LampChanges : public testing::TestWithParam<Kind> {};
class PlacedLamps : public testing::TestWithParam<Kind> {};

TEST_P(LampChanges, EqualAFreshFirstShot) {
    Hall hall(lit_hall(GetParam()));
    const std::vector<double> before = light_of(hall);
    EXPECT_EQ(hall.reach(), FirstShot::Reach::everything);
    hall.move(box, {1.5F, 0.3F, 0.7F});
    EXPECT_EQ(hall.reach(), FirstShot::Reach::moves);
    expect_as_fresh(hall, "a box moved");
    hall.move(box, glm::vec3(0.0F));
    EXPECT_EQ(light_of(hall), before) << "and back";
    hall.dim(7, 0.0F);
    EXPECT_EQ(hall.reach(), FirstShot::Reach::lamps);
    expect_as_fresh(hall, "a lamp switched off");
    hall.dim(3, 4.0F);
    hall.dim(12, 0.5F);
    expect_as_fresh(hall, "and others dimmed");
    hall.paint(floor_material, {0.3F, 0.6F, 0.2F});
    EXPECT_EQ(hall.reach(), FirstShot::Reach::lamps);
    expect_as_fresh(hall, "the floor painted");
    hall.move(lamp_stand, {-1.0F, 0.2F, 1.2F});
    EXPECT_EQ(hall.reach(), FirstShot::Reach::moves);
    expect_as_fresh(hall, "a lamp carried elsewhere");
}

/// Light is taken back by the maps of where lamps were, and added by those of where they are: only
/// these are drawn.
TEST_P(PlacedLamps, AloneAreShotAnew) {
    Hall hall(lit_hall(GetParam()));
    const std::vector<double> before = light_of(hall);
    const auto home_of = [&hall](std::size_t lamp) {
        return place_of(hall.b.scene.punctual_lights[lamp]);
    };
    // A point light, a spot and a luminaire.
    const LightPlace homes[] = {home_of(0), home_of(1), home_of(2)};
    for (std::size_t lamp = 0; lamp < 3; ++lamp) {
        const LightPlace elsewhere{
            {6.1F, 1.3F, 4.2F}, glm::normalize(glm::vec3(-1, -0.4F, 0.2F)), 30.0F};
        hall.place(lamp, elsewhere);
        EXPECT_EQ(hall.reach(), FirstShot::Reach::lamps);
        expect_as_fresh(hall, "placed elsewhere");
    }
    hall.move(box, {1.5F, 0.3F, 0.7F});  // its shadow is found in their new maps
    EXPECT_EQ(hall.reach(), FirstShot::Reach::moves);
    expect_as_fresh(hall, "the box moved among them");
    hall.move(box, glm::vec3(0.0F));
    for (std::size_t lamp = 0; lamp < 3; ++lamp) {
        hall.place(lamp, homes[lamp]);
    }
    const std::vector<double> after = light_of(hall);
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i], before[i], 1e-5 * std::abs(before[i]) + 1e-6) << i;
    }
}

/// Of more than half of the lights all light is found anew, by new maps of these.
TEST_P(PlacedLamps, ManyAtOnceAreFoundAnew) {
    Hall hall(lit_hall(GetParam()));
    for (std::size_t lamp = 1; lamp < lamps; ++lamp) {
        LightPlace place = place_of(hall.b.scene.punctual_lights[lamp]);
        place.position.x = 8.0F - place.position.x;
        place.position.y = 2.0F;
        set_place(place, hall.b.scene.punctual_lights[lamp]);
    }
    hall.dim(0, 1.5F);
    EXPECT_EQ(hall.reach(), FirstShot::Reach::everything);
    expect_as_fresh(hall, "all elsewhere");
}

std::string case_name(const testing::TestParamInfo<Kind>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Halls, LampChanges,
                         testing::Values(Kind{"Glossy", true, false}, Kind{"Sun", false, true}),
                         case_name);
INSTANTIATE_TEST_SUITE_P(HeavyHalls, LampChanges, testing::Values(Kind{"Lambert", false, false}),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Halls, PlacedLamps, testing::Values(Kind{"Sun", false, true}), case_name);
INSTANTIATE_TEST_SUITE_P(HeavyHalls, PlacedLamps,
                         testing::Values(Kind{"Glossy", true, false},
                                         Kind{"Lambert", false, false}),
                         case_name);

/// What a light of a million times the others leaves behind where it goes out is nothing.
TEST(LampChanges, NothingStaysOfABrightLight) {
    SceneBuilder b = lit_hall({"", false, true});
    for (PunctualLight& light : b.scene.punctual_lights) {
        if (light.kind != PunctualKind::directional) {
            light.intensity *= 1e-5F;
        }
    }
    // Within the box it lights nothing, and keeps the unit of radiance.
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {2.5F, 0.6F, 2.3F}, {0, -1, 0},
                       glm::vec3(20'000.0F));
    Hall hall(std::move(b));
    const std::size_t sun = lamps + 1;
    hall.dim(sun, 0.3F);
    hall.dim(sun, 0.3F);
    hall.dim(sun, 0.0F);
    EXPECT_EQ(hall.reach(), FirstShot::Reach::lamps);
    expect_as_fresh(hall, "the sun has gone");
}

}  // namespace
}  // namespace raybundle::lamp_changes_test
