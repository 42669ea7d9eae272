// SPDX-License-Identifier: Apache-2.0
#include "growing_room.h"

#include <gtest/gtest.h>

#include <fstream>
#include <utility>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "scene/edit/light_edit.h"
#include "scene/scene_folder.h"

namespace raybundle {

namespace {

SolverSettings quick(std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {96, 150};
    settings.coarse_iterations = 1'000'000;
    return settings;
}

Camera into_the_room() {
    Camera camera;
    camera.eye = {3.0F, 1.5F, 0.2F};
    camera.target = {2.5F, 1.0F, 4.0F};
    camera.vertical_fov = 1.3F;
    return camera;
}

}  // namespace

PhotometryFolder::PhotometryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "photometry-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
    std::filesystem::create_directories(path_ / "photometry");
    std::ofstream(path_ / "photometry" / "wide.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0 0 0\n1 1 10\n0 30 60 90\n0\n"
           "100 90 50 0\n";
    std::ofstream(path_ / "photometry" / "narrow.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0 0 0\n1 1 10\n0 10 20 90\n0\n"
           "900 500 0 0\n";
    std::ofstream(path_ / "photometry" / "panel.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0.3 0.6 0\n1 1 10\n0 30 60 90\n0\n"
           "100 90 50 0\n";
    std::ofstream(path_ / "photometry" / "disc.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 -0.4 -0.4 0\n1 1 10\n0 10 20 90\n0\n"
           "500 500 500 0\n";
}

PhotometryFolder::~PhotometryFolder() {
    std::filesystem::remove_all(path_);
}

std::shared_ptr<const SceneFolder> PhotometryFolder::open() const {
    return std::make_shared<const SceneFolder>(path_);
}

GrowingRoom::GrowingRoom(SceneBuilder builder, std::uint64_t seed)
    : b(std::move(builder)), seed_(seed) {
    plan(seed);
    programs = std::make_unique<ViewPrograms>(solver->scene());
    image = std::make_unique<ViewerImage>(solver->scene(), solver->store(), *programs,
                                          glm::uvec2(40, 30));
    image->set_camera(into_the_room());
}

void GrowingRoom::plan(std::uint64_t seed) {
    solver = std::make_unique<Solver>(b.scene, b.mesh, quick(seed));
}

void GrowingRoom::iterate(std::uint64_t count) {
    BundleReceiver* const receivers[] = {image.get()};
    for (const std::uint64_t end = solver->iterations() + count; solver->iterations() < end;) {
        solver->step(receivers);
    }
}

void GrowingRoom::settle() {
    BundleReceiver* const receivers[] = {image.get()};
    while (solver->correcting()) {
        solver->step(receivers);
    }
}

void GrowingRoom::change_lights() {
    if (solver->covers_lights(b.scene)) {
        BundleReceiver* const receivers[] = {image.get()};
        solver->change_surfaces(b.scene, b.mesh, {}, {}, receivers);
        settle();
        return;
    }
    ++planned_anew;
    const std::unique_ptr<Solver> before = std::move(solver);
    plan(++seed_);
    auto next = std::make_unique<ViewPrograms>(solver->scene());
    image =
        std::make_unique<ViewerImage>(solver->scene(), solver->store(), *next, glm::uvec2(40, 30));
    image->set_camera(into_the_room());
    programs = std::move(next);
    BundleReceiver* const receivers[] = {image.get()};
    solver->take_over(*before, {}, receivers);
    settle();
}

std::uint32_t GrowingRoom::add_light(const std::string& photometry, const glm::vec3& position) {
    AddedLuminaire luminaire;
    luminaire.number = next_luminaire(b.scene);
    luminaire.photometry = photometry;
    luminaire.position = position;
    EXPECT_EQ(problem_of(b.scene, luminaire), "");
    add_luminaire(b.scene, luminaire);
    change_lights();
    return luminaire.number;
}

void GrowingRoom::remove_light(std::uint32_t light, bool removed) {
    set_light_removed(b.scene, light, removed);
    change_lights();
}

void GrowingRoom::set_photometry(std::uint32_t light, const std::string& photometry) {
    LightEdit edit;
    edit.light = light;
    edit.photometry = photometry;
    ASSERT_EQ(problem_of(b.scene, edit), "");
    apply(b.scene, edit);
    change_lights();
}

void GrowingRoom::remove_object(std::uint32_t object, bool removed) {
    b.scene.objects[object].removed = removed;
    BundleReceiver* const receivers[] = {image.get()};
    solver->move_object(object, b.scene.objects[object].world_from_object(), receivers);
    settle();
}

std::uint32_t GrowingRoom::grow(std::uint32_t object, const glm::vec3& translation) {
    AddedObject added;
    added.copy_of = object + 1;
    added.transform.translation = translation;
    EXPECT_EQ(addition_problem(b.scene, b.mesh, added), "");
    add_object(b.scene, b.mesh, added);
    ++planned_anew;
    const std::unique_ptr<Solver> before = std::move(solver);
    plan(++seed_);
    auto next = std::make_unique<ViewPrograms>(solver->scene());
    image =
        std::make_unique<ViewerImage>(solver->scene(), solver->store(), *next, glm::uvec2(40, 30));
    image->set_camera(into_the_room());
    programs = std::move(next);
    solver->continue_from(*before, b.scene, b.mesh);
    return static_cast<std::uint32_t>(b.scene.objects.size()) - 1;
}

void GrowingRoom::expect_fresh(std::uint64_t iterations, const char* what) {
    GrowingRoom fresh(b, 77);
    fresh.iterate(iterations);
    const auto [level, difference] = compared(light(), fresh.light());
    // Over seeds the levels of two such solves differ with a standard deviation of 0.7 %, those of
    // their pictures of 1 %: three of them.
    EXPECT_NEAR(level, 1.0, 0.021) << what;
    EXPECT_LT(difference, 0.05) << what;
    const auto [shown, apart] = compared(image->read_radiance(), fresh.image->read_radiance());
    EXPECT_NEAR(shown, 1.0, 0.03) << what;
    EXPECT_LT(apart, 0.08) << what;
}

SceneBuilder room_to_furnish(bool open) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(60.0F));
    b.add_quad({0, 0, 0}, {0, 0, 4}, {6, 0, 0}, 6, 6, wall);
    b.add_quad({0, 3, 0}, {6, 0, 0}, {0, 0, 4}, 6, 6, wall);
    b.add_quad({0, 0, 4}, {0, 3, 0}, {6, 0, 0}, 6, 6, wall);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 6, 6, wall);
    b.add_quad({6, 0, 0}, {0, 0, 4}, {0, 3, 0}, 6, 6, wall);
    if (!open) {
        b.add_quad({0, 0, 0}, {6, 0, 0}, {0, 3, 0}, 6, 6, wall);
    }
    b.add_quad({2.6F, 2.98F, 1.5F}, {0.8F, 0, 0}, {0, 0, 0.8F}, 2, 2, lamp);
    b.add_object("box");
    b.add_box({1.0F, 0.01F, 1.5F}, {2.0F, 1.2F, 2.3F}, false, 3, wall);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {4.8F, 2.0F, 2.0F}, {0, -1, 0},
                       {10.0F, 20.0F, 15.0F});
    return b;
}

}  // namespace raybundle
