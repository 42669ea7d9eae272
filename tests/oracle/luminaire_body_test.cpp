// SPDX-License-Identifier: Apache-2.0
// Bodies of luminaires in pictures: luminance by the file's intensity, mirrors, walls before them,
// changes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "../reference/luminous_panel.h"
#include "changed_room.h"
#include "growing_room.h"
#include "reference/camera_rays.h"
#include "reference/path_tracer.h"
#include "scene/photometry/luminaire_body.h"
#include "view/shown_luminaires.h"

namespace raybundle::luminaire_body_test {
namespace {

constexpr glm::uvec2 odd_size(33, 33);  // with a pixel in the middle
constexpr std::size_t middle_pixel = 33 * 16 + 16;
constexpr double along_x = 0.6;
constexpr double along_y = 0.3;
const glm::vec3 panel_place(2.0F, 2.5F, 2.0F);

Camera towards(const glm::vec3& eye, const glm::vec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.up =
        std::abs(glm::normalize(target - eye).y) > 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    camera.vertical_fov = 0.3F;
    return camera;
}

/// A grey room of 4 x 3 x 4 m with a panel that shines down.
SceneBuilder room_with_panel(double width = along_y) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 3, b.add_material(glm::vec3(0.5F)));
    b.scene.punctual_lights.push_back(
        panel_light({panel_place, {0, -1, 0}, 25.0F}, along_x, width));
    return b;
}

/// Pictures of a scene without bundles: what is not lit by lamps straight is black.
class Eye {
  public:
    explicit Eye(const SceneBuilder& b, glm::uvec2 size = odd_size)
        : solver_(b.scene, b.mesh),
          programs_(solver_.scene()),
          image(solver_.scene(), solver_.store(), programs_, size) {}

    /// Luminance of the pixel in the middle.
    double look(const glm::vec3& eye, const glm::vec3& target) {
        image.set_camera(towards(eye, target));
        return static_cast<double>(luminance(glm::vec3(image.read_radiance()[middle_pixel])));
    }

  private:
    Solver solver_;
    ViewPrograms programs_;

  public:
    ViewerImage image;
};

/// I / A of the panel in a direction away from it, cd/m².
double exact_luminance(const PunctualLight& light, const glm::vec3& from, const glm::vec3& to,
                       double area = along_x * along_y) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(to - from)) * glm::dmat3(light.axes);
    return panel_candela(direction) / (area * std::abs(direction.z));
}

const glm::vec3 eyes[] = {{2.0F, 0.4F, 2.0F}, {0.6F, 1.2F, 1.1F}, {3.6F, 1.8F, 3.0F}};

TEST(LuminaireBody, IsSeenWithItsFilesLuminance) {
    for (const double width : {along_y, 0.0}) {
        const SceneBuilder b = room_with_panel(width);
        const double area =
            width > 0.0 ? along_x * width : 0.25 * std::numbers::pi * along_x * along_x;
        Eye eye(b);
        for (const glm::vec3& from : eyes) {
            const double exact =
                exact_luminance(b.scene.punctual_lights[0], panel_place, from, area);
            EXPECT_GT(exact, 100.0);
            EXPECT_NEAR(eye.look(from, panel_place), exact, 0.01 * exact);
        }
        EXPECT_EQ(eye.look({2.3F, 2.95F, 2.1F}, panel_place), 0.0) << "from behind";
    }
}

TEST(LuminaireBody, ProbesAndFalseColourShowIt) {
    const SceneBuilder b = room_with_panel();
    Eye eye(b);
    ViewerImage& image = eye.image;
    image.set_camera(towards(eyes[1], panel_place));
    const auto probe = image.probe({16, 16});
    ASSERT_TRUE(probe);
    const double exact = exact_luminance(b.scene.punctual_lights[0], panel_place, eyes[1]);
    EXPECT_NEAR(static_cast<double>(luminance(probe->radiance)), exact, 0.01 * exact);
    EXPECT_GT(glm::distance(probe->position, eyes[1]), glm::distance(panel_place, eyes[1]))
        << "place and illuminance are those of what is behind it";
    // From behind, the floor that it lights is behind it.
    image.set_camera(towards({2.3F, 2.95F, 2.1F}, panel_place));
    const auto below = image.probe({16, 16});
    ASSERT_TRUE(below);
    EXPECT_EQ(below->radiance, glm::vec3(0.0F));
    EXPECT_NEAR(below->position.y, 0.0F, 1e-3F);
    EXPECT_GT(luminance(below->irradiance), 0.0F);
    image.set_camera(towards(eyes[1], panel_place));
    // Above the scale, which ends below its luminance, it is white.
    image.compose(DisplayMode::false_luminance, 0.0F, odd_size,
                  {static_cast<float>(0.5 * exact), 0.0F, true});
    while (!image.finished()) {
    }
    const auto frame = image.take();
    EXPECT_EQ(frame[4 * middle_pixel], 255);
    EXPECT_EQ(frame[4 * middle_pixel + 1], 255);
}

TEST(LuminaireBody, AWallBeforeItHidesIt) {
    SceneBuilder b = room_with_panel();
    b.add_quad({0, 1.8F, 0}, {4, 0, 0}, {0, 0, 4}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(5.0F)));
    Eye eye(b);
    EXPECT_NEAR(eye.look(eyes[0], panel_place), 5.0, 0.01);
    EXPECT_GT(eye.look({1.0F, 2.0F, 1.5F}, panel_place), 100.0);
}

TEST(LuminaireBody, MirrorsShowIt) {
    SceneBuilder b = room_with_panel();
    Material mirror;
    mirror.base_colour = glm::vec3(1.0F);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    b.add_quad({0.1F, 0, 0}, {0, 3, 0}, {0, 0, 4}, 1, 1, b.add_material(mirror));
    const glm::vec3 image(0.2F - panel_place.x, panel_place.y, panel_place.z);
    const glm::vec3 from(1.2F, 1.2F, 1.8F);
    const glm::vec3 eye_behind(0.2F - from.x, from.y, from.z);
    const double exact = exact_luminance(b.scene.punctual_lights[0], panel_place, eye_behind);
    Eye eye(b);
    EXPECT_NEAR(eye.look(from, image), exact, 0.01 * exact);
    EXPECT_EQ(eye.look({1.2F, 2.9F, 1.8F}, image), 0.0) << "from behind";
}

TEST(LuminaireBody, ChangesShowAtOnce) {
    Solved room(room_with_panel());
    room.image.set_camera(towards(eyes[0], panel_place));
    const auto found = [&] {
        return static_cast<double>(luminance(glm::vec3(room.image.read_radiance()[40 * 15 + 20])));
    };
    const double before = found();
    EXPECT_GT(before, 100.0);
    LightEdit dimmed;
    dimmed.light = 1;
    dimmed.dim = 0.25F;
    room.change(dimmed);
    EXPECT_NEAR(found(), 0.25 * before, 2e-3 * before);
    LightEdit away;
    away.light = 1;
    away.position = panel_place + glm::vec3(1.0F, 0.0F, 0.0F);
    room.change(away);
    EXPECT_LT(found(), 0.1 * before);
    away.position = panel_place;
    room.change(away);
    EXPECT_NEAR(found(), 0.25 * before, 2e-3 * before);
}

/// A luminaire comes with its body, which is that of the file that it shines by, darkens with the
/// light while it fades, and goes and comes back with it.
TEST(LuminaireBody, ComesGoesFadesAndIsExchanged) {
    const PhotometryFolder files;
    SceneBuilder b = room_to_furnish(false);
    b.scene.folder = files.open();
    GrowingRoom room(std::move(b));
    const glm::vec3 place(4.5F, 2.0F, 1.0F);
    const auto seen = [&] {  // from straight below it
        room.image->set_camera(towards(place - glm::vec3(0.0F, 1.2F, 0.0F), place));
        return static_cast<double>(luminance(glm::vec3(room.image->read_radiance()[40 * 15 + 20])));
    };
    const double panel = 100.0 / (0.3 * 0.6);
    const double disc = 500.0 / (std::numbers::pi * 0.2 * 0.2);
    constexpr double ceiling = 60.0;  // more than it has by the room's own lamps
    EXPECT_LT(seen(), ceiling);
    const std::uint32_t light = room.add_light("panel.ies", place);
    EXPECT_NEAR(seen(), panel, 0.01 * panel);
    room.set_photometry(light, "disc.ies");
    EXPECT_NEAR(seen(), disc, 0.01 * disc);

    const glm::vec3 full = lamp_output(room.b.scene, light);
    for (const float share : {0.7F, 0.2F, 0.0F, 1.0F}) {
        set_lamp_output(room.b.scene, light, share * full);
        room.change_lights();
        EXPECT_NEAR(seen(), static_cast<double>(share) * disc, 0.01 * disc) << share;
    }
    room.set_photometry(light, "narrow.ies");
    EXPECT_LT(seen(), ceiling) << "a file without a size";
    room.set_photometry(light, "panel.ies");
    EXPECT_NEAR(seen(), panel, 0.01 * panel);
    room.remove_light(light);
    EXPECT_LT(seen(), ceiling);
    room.remove_light(light, false);
    EXPECT_NEAR(seen(), panel, 0.01 * panel);
}

// Bodies with luminous sides.

/// A box or a cylinder that shines to all sides alike, 0.4 m long, 0.2 m wide, 0.1 m high.
PunctualLight shining_body(bool round) {
    const std::string sizes = round ? "-0.4 -0.4 0.1" : "0.2 0.4 0.1";
    PunctualLight light;
    light.intensity = glm::vec3(1.0F);
    light.profile = std::make_shared<const IesProfile>(
        parse_ies("body.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 5 1 1 2 " + sizes +
                                  "\n1 1 10\n0 45 90 135 180\n0\n100 120 80 40 20\n"));
    set_place({{2.0F, 1.5F, 2.0F}, glm::normalize(glm::vec3(0.2F, -1.0F, 0.1F)), 10.0F}, light);
    return light;
}

/// Luminance over the area that a direction sees is the intensity of that direction.
TEST(LuminaireBody, SendsWhatItsFileSays) {
    for (const bool round : {false, true}) {
        const PunctualLight light = shining_body(round);
        const PlacedLight placed = place_light(light, glm::mat4(1.0F));
        const auto body = body_of(placed);
        ASSERT_TRUE(body);
        for (const glm::dvec3 away : {glm::dvec3(0.3, -0.9, 0.2), glm::dvec3(0.7, -0.1, 0.6),
                                      glm::dvec3(-0.6, -0.4, 0.1)}) {
            const glm::dvec3 direction = glm::normalize(away);
            const glm::dvec3 u = glm::normalize(glm::cross(direction, {0.1, 0.2, 0.9}));
            const glm::dvec3 v = glm::cross(direction, u);
            constexpr int n = 400;
            constexpr double width = 0.8;
            double sum = 0.0;
            for (int i = 0; i < n * n; ++i) {
                const glm::dvec2 at = width * ((glm::dvec2(i % n, i / n) + 0.5) / double{n} - 0.5);
                const auto met =
                    meet(*body, body->position + 3.0 * direction + at.x * u + at.y * v, -direction);
                sum += met ? met->luminance.g * width * width / (n * n) : 0.0;
            }
            const double exact = placed.towards(direction).g;
            EXPECT_NEAR(sum, exact, 0.01 * exact) << round << " " << away.x;
        }
    }
}

/// Pictures and paths see the same.
TEST(LuminaireBody, PathsSeeWhatPicturesDo) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 2, b.add_material(glm::vec3(0.0F)));
    b.scene.punctual_lights.push_back(shining_body(false));
    b.scene.punctual_lights.push_back(shining_body(true));
    b.scene.punctual_lights.back().position = glm::vec3(1.4F, 1.6F, 2.3F);
    const Camera camera = [] {
        Camera c = towards({0.3F, 1.0F, 0.2F}, {1.8F, 1.55F, 2.1F});
        c.vertical_fov = 0.3F;
        return c;
    }();
    constexpr glm::uvec2 size(60, 40);
    Eye eye(b, size);
    eye.image.set_camera(camera);
    const auto picture = eye.image.read_radiance();
    const RayScene rays(b.scene, b.mesh);
    const LightSampling lights(rays);
    const PathTracer paths(rays, lights);
    const CameraRays from(rays, camera, size);
    int lit = 0;
    int different = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) {
            RandomStream random(1, i);
            const glm::dvec2 at = from.corner(i) + 0.25 + 0.5 * glm::dvec2(k % 2, k / 2);
            sum += 0.25 * paths.radiance(from.origin(), from.direction(at), random).g;
        }
        lit += sum > 0.0 ? 1 : 0;
        different += std::abs(static_cast<double>(picture[i].g) - sum) > 0.01 * sum ? 1 : 0;
    }
    EXPECT_GT(lit, 200);
    EXPECT_LE(different, 4) << "rays that pass an edge to rounding";
}

/// Of more than are shown: the nearest, in groups.
TEST(LuminaireBody, EachOfManyIsSeen) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {12, 3, 12}, true, 2, b.add_material(glm::vec3(0.0F)));
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 place(0.6F * static_cast<float>(i % 20) + 0.3F, 2.8F,
                              0.6F * static_cast<float>(i / 20) + 0.3F);
        b.scene.punctual_lights.push_back(panel_light({place, {0, -1, 0}, 0.0F}, 0.2, 0.2));
    }
    Eye eye(b);
    for (const std::size_t i : {0U, 57U, 133U, 222U, 299U}) {
        const PunctualLight& light = b.scene.punctual_lights[i];
        const glm::vec3 from = light.position + glm::vec3(0.1F, -1.5F, -0.2F);
        const double exact = exact_luminance(light, light.position, from, 0.04);
        EXPECT_NEAR(eye.look(from, light.position), exact, 0.01 * exact) << i;
    }
}

TEST(LuminaireBody, FilesWithoutSizeHaveNone) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 2, b.add_material(glm::vec3(0.5F)));
    EXPECT_FALSE(ShownLuminaires::possible(Solver(b.scene, b.mesh).scene()));
    PunctualLight light = shining_body(false);
    light.profile = nullptr;
    EXPECT_FALSE(body_of(place_light(light, glm::mat4(1.0F))));
}

}  // namespace
}  // namespace raybundle::luminaire_body_test
