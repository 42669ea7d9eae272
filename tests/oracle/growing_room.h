// SPDX-License-Identifier: Apache-2.0
// A room that things and luminaires are added to and removed from while its solution is there, as
// a session does it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "oracle/scene_builder.h"
#include "scene/edit/luminaire_edit.h"
#include "scene/mesh/mesh_growth.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Names a test by its parameter, whether the room is open.
inline constexpr auto room_name = [](const auto& test) {
    return std::string(test.param ? "Open" : "Closed");
};

/// A folder of photometric files, removed with it: wide.ies and narrow.ies without a size,
/// panel.ies of 0.3 m x 0.6 m, 100 cd straight down, and disc.ies of 0.4 m, 500 cd.
class PhotometryFolder {
  public:
    PhotometryFolder();
    ~PhotometryFolder();
    PhotometryFolder(const PhotometryFolder&) = delete;
    PhotometryFolder& operator=(const PhotometryFolder&) = delete;

    [[nodiscard]] std::shared_ptr<const class SceneFolder> open() const;

  private:
    std::filesystem::path path_;
};

class GrowingRoom {
  public:
    explicit GrowingRoom(SceneBuilder builder, std::uint64_t seed = 1);

    void iterate(std::uint64_t count);
    /// Lights have changed in the scene.
    void change_lights();
    /// Adds a luminaire that shines down; returns its number.
    std::uint32_t add_light(const std::string& photometry, const glm::vec3& position);
    void remove_light(std::uint32_t light, bool removed = true);
    void set_photometry(std::uint32_t light, const std::string& photometry);
    /// An object goes, or comes back.
    void remove_object(std::uint32_t object, bool removed = true);
    /// Adds a copy of an object (index), at a translation, but removed; returns its index.
    std::uint32_t grow(std::uint32_t object, const glm::vec3& translation);

    [[nodiscard]] std::vector<glm::vec4> light() const { return solver->store().read_irradiance(); }
    /// The solution and the picture are those of a fresh solve of the scene as it is now.
    void expect_fresh(std::uint64_t iterations, const char* what);

    SceneBuilder b;
    std::unique_ptr<Solver> solver;
    std::unique_ptr<ViewPrograms> programs;
    std::unique_ptr<ViewerImage> image;
    unsigned planned_anew = 0;

  private:
    void plan(std::uint64_t seed);
    void settle();

    std::uint64_t seed_;
};

/// 6 x 3 x 4 m with a dim lamp below its ceiling, a box (object 1) that can be moved, and a point
/// light. open: without its front.
SceneBuilder room_to_furnish(bool open);

}  // namespace raybundle
