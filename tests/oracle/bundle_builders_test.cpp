// SPDX-License-Identifier: Apache-2.0
// The two builders of bundles, rasteriser and rays, find the same surfaces.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bundle/hemicube.h"
#include "bundle/layered_window.h"
#include "bundle/low_discrepancy.h"
#include "bundle/plane_window.h"
#include "hard_rooms.h"
#include "oracle/scene_builder.h"
#include "trace/bundle_builder.h"
#include "transport/transfer.h"

namespace raybundle::bundle_builders_test {
namespace {

constexpr int bundles = 6;
constexpr int hemicube_size = 128;
constexpr int window_size = 200;
constexpr std::uint32_t room_for = 128;  // surfaces of a line

/// Scenes that are made while it lives use one builder.
class BuilderScope {
  public:
    explicit BuilderScope(BundleBuilder builder) : before_(bundle_builder()) {
        set_bundle_builder(builder);
    }
    ~BuilderScope() { set_bundle_builder(before_); }
    BuilderScope(const BuilderScope&) = delete;
    BuilderScope& operator=(const BuilderScope&) = delete;

  private:
    BundleBuilder before_;
};

std::vector<std::uint32_t> texture_of_unit(GLuint unit, std::size_t texels) {
    GLint name = 0;
    glActiveTexture(GL_TEXTURE0 + unit);
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &name);
    std::vector<std::uint32_t> result(texels);
    glGetTextureImage(static_cast<GLuint>(name), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      static_cast<GLsizei>(texels * 4), result.data());
    return result;
}

std::vector<std::uint32_t> bound_buffer(GLuint binding, std::size_t values) {
    GLint name = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &name);
    std::vector<std::uint32_t> result(values);
    glGetNamedBufferSubData(static_cast<GLuint>(name), 0, static_cast<GLsizeiptr>(values * 4),
                            result.data());
    return result;
}

/// Frames of shooters above triangles of a mesh.
BundleFrame frame_above(const GpuScene& scene, const PatchMesh& mesh, unsigned number) {
    const RandomisedHalton numbers(3);
    const auto triangle = static_cast<std::size_t>(numbers.sample(0, number + 1) *
                                                   static_cast<double>(mesh.triangle_count()));
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::mat4 world = scene.world_from_object(mesh.vertex_object[t.x], Place::now);
    const auto corner = [&](std::uint32_t vertex) {
        return glm::vec3(world * glm::vec4(mesh.positions[vertex], 1.0F));
    };
    const glm::vec3 a = corner(t.x);
    const glm::vec3 normal = glm::normalize(glm::cross(corner(t.y) - a, corner(t.z) - a));
    const glm::vec3 lift = normal * (static_cast<float>(SHOOTER_LIFT) * scene.diameter());
    BundleFrame frame = make_frame((a + corner(t.y) + corner(t.z)) / 3.0F + lift, normal,
                                   static_cast<float>(6.28 * numbers.sample(1, number + 1)));
    frame.pixel_shift = {numbers.sample(2, number + 1) - 0.5, numbers.sample(3, number + 1) - 0.5};
    return frame;
}

ParallelWindow window_of(const GpuScene& scene, unsigned number) {
    const RandomisedHalton numbers(5);
    const auto n = [&](unsigned dimension) { return numbers.sample(dimension, number + 1); };
    ParallelWindow window = make_parallel_window(
        window_size, uniform_direction(n(0), n(1)), static_cast<float>(6.28 * n(2)),
        glm::vec2(n(3), n(4)), scene.bounds().centre(), scene.diameter());
    window.plane_depth = static_cast<float>(n(5)) * window.depth;
    return window;
}

layout::BundleParameters parameters_of(const GpuScene& scene, const ParallelWindow& window) {
    layout::BundleParameters p{};
    p.origin = glm::vec4(window.frame.origin, static_cast<float>(NEAR_SHARE) * scene.diameter());
    p.axis_x = glm::vec4(window.frame.x, window.plane_depth);
    p.axis_y = glm::vec4(window.frame.y, window.depth);
    p.axis_z = glm::vec4(window.frame.z, 0.0F);
    p.weights.z = window.pixel_size;
    p.sky.w = static_cast<float>(TIE_SHARE) * scene.diameter();
    p.resolution = {window.size, window.size, room_for, 0};
    return p;
}

/// What the bundles of a scene see: ids of hemicubes and planes; of layered windows a sorted list
/// for each line.
struct Seen {
    std::vector<std::vector<std::uint32_t>> hemicubes, planes;
    std::vector<std::vector<std::vector<std::uint32_t>>> lines;
};

Seen look(const GpuScene& scene, const PatchMesh& mesh, bool traced, Place place) {
    Seen seen;
    Buffer uniforms("bundle parameters", sizeof(layout::BundleParameters));
    Buffer counters("counters", sizeof(layout::Counters));
    Hemicube hemicube(hemicube_size, scene.defines(), traced);
    LayeredWindow layers(window_size, scene.defines(), traced);
    layers.grow(room_for);
    PlaneWindow planes(window_size, scene.defines(), traced);
    constexpr std::size_t pixels = std::size_t{window_size} * window_size;
    for (unsigned i = 0; i < bundles; ++i) {
        scene.bind();
        counters.bind_storage(BINDING_COUNTERS);
        const ParallelWindow window = window_of(scene, i);
        const BundleFrame frame = frame_above(scene, mesh, i);
        layout::BundleParameters p = parameters_of(scene, window);
        uniforms.write<layout::BundleParameters>(std::span(&p, 1), 0);
        uniforms.bind_uniform(BINDING_BUNDLE);
        planes.draw(scene, window, place);
        planes.bind_textures();
        seen.planes.push_back(texture_of_unit(UNIT_SURFACE_IDS, 2 * pixels));
        layers.draw(scene, window, place, window.full(), counters);
        layers.bind();
        const auto counts = bound_buffer(BINDING_LAYER_COUNTS, pixels);
        const auto surfaces = bound_buffer(BINDING_LAYER_SURFACES, pixels * room_for);
        std::vector<std::vector<std::uint32_t>> lines(pixels);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            EXPECT_LE(counts[pixel], room_for);
            for (std::size_t k = 0; k < std::min(counts[pixel], room_for); ++k) {
                lines[pixel].push_back(surfaces[k < 4 ? 4 * pixel + k : k * pixels + pixel]);
            }
            std::sort(lines[pixel].begin(), lines[pixel].end());
        }
        seen.lines.push_back(std::move(lines));
        p.origin = glm::vec4(frame.origin, p.origin.w);
        p.axis_x = glm::vec4(frame.x, frame.pixel_shift.x);
        p.axis_y = glm::vec4(frame.y, frame.pixel_shift.y);
        p.axis_z = glm::vec4(frame.z, 0.0F);
        p.resolution.x = hemicube_size;
        uniforms.write<layout::BundleParameters>(std::span(&p, 1), 0);
        hemicube.draw(scene, frame, p.origin.w, place, hemicube.full());
        hemicube.bind_textures();
        seen.hemicubes.push_back(
            texture_of_unit(UNIT_SURFACE_IDS, std::size_t{3} * hemicube_size * hemicube_size));
    }
    return seen;
}

template <typename Values>
double share_different(const std::vector<Values>& a, const std::vector<Values>& b) {
    std::size_t all = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < a[i].size(); ++k) {
            ++all;
            different += a[i][k] != b[i][k] ? 1 : 0;
        }
    }
    return static_cast<double>(different) / static_cast<double>(all);
}

std::size_t met(const Seen& seen) {
    std::size_t count = 0;
    for (const auto& ids : seen.hemicubes) {
        count += static_cast<std::size_t>(
            std::count_if(ids.begin(), ids.end(), [](std::uint32_t id) { return id != NO_HIT; }));
    }
    return count;
}

/// The rasteriser rounds corners to 1/256 pixel: a pixel whose centre is that close to an edge may
/// fall to either side. edges: length of all edges that bundles see, in sides of a bundle; so many
/// pixels beside them may differ.
void expect_same(const Seen& raster, const Seen& rays, double edges) {
    EXPECT_GT(met(raster), 10'000U) << "nothing that could differ";
    const double beside = 2.0 / 256.0 * edges;
    EXPECT_LT(share_different(raster.hemicubes, rays.hemicubes), beside / hemicube_size);
    EXPECT_LT(share_different(raster.planes, rays.planes), beside / window_size);
    EXPECT_LT(share_different(raster.lines, rays.lines), beside / window_size);
}

SceneBuilder furnished_room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    Material cloth;
    cloth.base_colour = glm::vec3(0.5F);
    cloth.metallic = 0.0F;
    cloth.specular = 0.0F;
    cloth.double_sided = true;
    const auto curtain = b.add_material(cloth);
    b.add_box({0, 0, 0}, {4, 3, 4.5F}, true, 2, wall);
    b.add_quad({0.5F, 0.5F, 4}, {1.5F, 0, 0.1F}, {0, 2, 0}, 4, 4, curtain);
    b.add_object("block");
    b.add_box({1, 0.01F, 1}, {1.7F, 1.1F, 2.2F}, false, 3, wall);
    return b;
}

struct Builders {
    explicit Builders(const SceneBuilder& b) : Builders(b.scene, b.mesh) {}
    Builders(const Scene& scene, const PatchMesh& mesh) : raster(scene, mesh) {
        const BuilderScope scope(BundleBuilder::trace);
        rays.emplace(scene, mesh);
    }

  private:
    BuilderScope only_raster_{BundleBuilder::raster};

  public:
    GpuScene raster;
    std::optional<GpuScene> rays;
};

TEST(BundleBuilders, SeeTheSameInAFurnishedRoom) {
    const SceneBuilder b = furnished_room();
    const Builders builders(b);
    ASSERT_NE(builders.rays->tracer(), nullptr);
    expect_same(look(builders.raster, b.mesh, false, Place::now),
                look(*builders.rays, b.mesh, true, Place::now), 40.0);
}

TEST(BundleBuilders, SeeTheSameOfAMovedAndScaledObjectAtBothPlaces) {
    const SceneBuilder b = furnished_room();
    Builders builders(b);
    const glm::mat4 shift = glm::translate(glm::mat4(1.0F), glm::vec3(0.9F, 0.2F, 0.7F));
    const ObjectMove move{1, glm::scale(shift, glm::vec3(0.8F, 1.3F, 1.0F))};
    for (int turn = 0; turn < 2; ++turn) {
        builders.raster.move_objects(std::span(&move, 1));
        builders.rays->move_objects(std::span(&move, 1));
        for (const Place place : {Place::now, Place::before}) {
            expect_same(look(builders.raster, b.mesh, false, place),
                        look(*builders.rays, b.mesh, true, place), 40.0);
        }
    }
    builders.raster.settle();
    builders.rays->settle();
    expect_same(look(builders.raster, b.mesh, false, Place::before),
                look(*builders.rays, b.mesh, true, Place::before), 40.0);
}

TEST(BundleBuilders, SeeTheSameThroughGlassThatAbsorbs) {
    SceneBuilder b = furnished_room();
    Material pane;
    pane.transmission = 1.0F;
    pane.metallic = 0.0F;
    pane.base_colour = glm::vec3(0.5F);
    const auto glass = b.add_material(pane);
    b.add_quad({2.5F, 0.2F, 0.3F}, {0, 0, 3}, {0, 2, 0}, 2, 2, glass);
    const Builders builders(b);
    const Seen raster = look(builders.raster, b.mesh, false, Place::now);
    const Seen rays = look(*builders.rays, b.mesh, true, Place::now);
    // Half of the lines through the pane are absorbed by it, by the same numbers but for rounding.
    expect_same(raster, rays, 48.0);
    std::size_t absorbed = 0;
    for (const auto& ids : rays.hemicubes) {
        for (const std::uint32_t id : ids) {
            absorbed += id != NO_HIT && b.mesh.triangle_material[id >> 1U] == glass ? 1 : 0;
        }
    }
    EXPECT_GT(absorbed, 1000U);
}

/// A wall of strips that are narrower than pixels: the rasteriser turns some over and leaves some
/// out.
TEST(BundleBuilders, RaysMeetNoStripFromBehind) {
    const StripedWall wall = striped_wall(0.0F, 1500);
    const BuilderScope scope(BundleBuilder::trace);
    const GpuScene scene(wall.builder.scene, wall.builder.mesh);
    for (const auto& ids : look(scene, wall.builder.mesh, true, Place::now).hemicubes) {
        EXPECT_TRUE(std::none_of(ids.begin(), ids.end(),
                                 [](std::uint32_t id) { return id != NO_HIT && (id & 1U) != 0; }));
    }
}

TEST(BundleBuilders, ResultsDoNotDependOnTheNumberOfThreads) {
    const BuilderScope scope(BundleBuilder::trace);
    const SceneBuilder b = furnished_room();
    const auto seen_by = [&](int threads) {
        Seen seen;
        tbb::task_arena(threads).execute([&] {
            const GpuScene scene(b.scene, b.mesh);
            seen = look(scene, b.mesh, true, Place::now);
        });
        return seen;
    };
    const Seen one = seen_by(1);
    const Seen two = seen_by(2);
    EXPECT_EQ(one.hemicubes, two.hemicubes);
    EXPECT_EQ(one.planes, two.planes);
    EXPECT_EQ(one.lines, two.lines);
}

}  // namespace
}  // namespace raybundle::bundle_builders_test
