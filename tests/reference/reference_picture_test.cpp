// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/reference_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "reference/measures/emitter_pixels.h"
#include "reference/measures/image_metrics.h"
#include "research/accuracy/reference_cache.h"
#include "research/accuracy/scene_fingerprint.h"
#include "rooms.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// A room with a lamp in its ceiling, seen from a corner at a low resolution.
class ReferenceTest : public testing::Test {
  protected:
    ReferenceTest()
        : builder_(enclosure(0.5F)),
          scene_(builder_.scene, builder_.mesh),
          lights_(scene_),
          camera_(make_camera(builder_.scene)),
          rays_(scene_, camera_, size),
          measured_(measured_pixels(scene_, rays_)) {}

    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / (std::string("raybundle_") + test->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static Camera make_camera(const Scene& scene) {
        Camera camera;
        camera.eye = scene.bounds.centre();
        camera.target = camera.eye + glm::vec3(0.3F, -0.2F, 1.0F);
        camera.vertical_fov = 1.4F;
        return camera;
    }
    [[nodiscard]] ReferencePicture made(PixelFilter filter, std::uint64_t seed, unsigned passes,
                                        std::optional<ReferencePicture> earlier = {}) const {
        ReferenceMaker maker(scene_, lights_, rays_, measured_, filter, seed, std::move(earlier));
        for (unsigned i = 0; i < passes; ++i) {
            maker.add_pass();
        }
        return maker.result();
    }
    [[nodiscard]] ReferenceKey key() const { return {"0123", camera_, size, PixelFilter::centre}; }
    [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }

    static constexpr glm::uvec2 size{40, 30};
    SceneBuilder builder_;
    RayScene scene_;
    LightSampling lights_;
    Camera camera_;
    CameraRays rays_;
    std::vector<bool> measured_;
    fs::path folder_;
};

/// Two references differ by what their noises say. Pixels of a tile differ together: twelve pairs
/// of 20 tiles give the squared noise within some 7 %, so 20 % is outside of chance (fixed seeds).
TEST_F(ReferenceTest, HeavyKnowsItsNoise) {
    for (const PixelFilter filter : {PixelFilter::centre, PixelFilter::box}) {
        ReferenceNoise found;
        ReferenceNoise expected;  // relative_rmse: sums of squares
        for (std::uint64_t seed = 1; seed <= 12; ++seed) {
            const ReferencePicture a = made(filter, 2 * seed, 8);
            const ReferencePicture b = made(filter, 2 * seed + 1, 16);
            const ImageMetrics difference = compare_images(a.radiance, b.radiance, measured_);
            found.relative_rmse += difference.relative_rmse * difference.relative_rmse;
            found.mrse += difference.mrse;
            for (const auto& noise : {*a.noise, *b.noise}) {
                expected.relative_rmse += noise.relative_rmse * noise.relative_rmse;
                expected.mrse += noise.mrse;
            }
        }
        EXPECT_NEAR(std::sqrt(found.relative_rmse / expected.relative_rmse), 1.0, 0.1);
        EXPECT_NEAR(found.mrse / expected.mrse, 1.0, 0.2);
    }
}

TEST_F(ReferenceTest, GoesOnFromAnEarlierOne) {
    const ReferencePicture first = made(PixelFilter::centre, 1, 32);
    const ReferencePicture second = made(PixelFilter::centre, 1, 32, first);
    EXPECT_EQ(second.samples, 64U);
    EXPECT_NE(second.seed, first.seed);
    EXPECT_GE(second.seconds, first.seconds);
    // Independent halves of the same accuracy: the noise falls by sqrt(2), not by repeating itself.
    EXPECT_NEAR(second.noise->relative_rmse / first.noise->relative_rmse, std::sqrt(0.5), 0.05);
    const ReferencePicture truth = made(PixelFilter::centre, 99, 192);
    // The truth has noise, too: errors are as sqrt(1/64 + 1/192) to sqrt(1/32 + 1/192), 0.76.
    const double before = compare_images(first.radiance, truth.radiance, measured_).relative_rmse;
    const double after = compare_images(second.radiance, truth.radiance, measured_).relative_rmse;
    EXPECT_LT(after, 0.85 * before);
    // With nothing added it is the earlier one.
    EXPECT_EQ(made(PixelFilter::centre, 1, 0, first).samples, 32U);
}

TEST_F(ReferenceTest, IsKeptAndFoundAgain) {
    const ReferencePicture reference = made(PixelFilter::centre, 1, 16);
    save_reference(file("r.exr"), key(), reference);
    const auto found = load_cached_reference(file("r.exr"), key());
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->samples, 16U);
    EXPECT_EQ(found->seed, reference.seed);
    EXPECT_EQ(found->noise->relative_rmse, reference.noise->relative_rmse);
    for (std::size_t i = 0; i < found->radiance.size(); ++i) {
        ASSERT_NEAR(found->radiance[i].g, reference.radiance[i].g,
                    1e-6 * std::abs(reference.radiance[i].g));
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

TEST_F(ReferenceTest, OfSomethingElseIsNotTaken) {
    save_reference(file("r.exr"), key(), made(PixelFilter::centre, 1, 16));
    ReferenceKey other = key();
    other.scene = "4567";
    EXPECT_FALSE(load_cached_reference(file("r.exr"), other).has_value());
    EXPECT_THROW((void)load_named_reference(file("r.exr"), other), std::runtime_error);
    other = key();
    other.camera.eye.x += 0.01F;
    EXPECT_FALSE(load_cached_reference(file("r.exr"), other).has_value());
    other = key();
    other.filter = PixelFilter::box;
    EXPECT_FALSE(load_cached_reference(file("r.exr"), other).has_value());
    // A named one brings its own filter.
    EXPECT_EQ(load_named_reference(file("r.exr"), other).filter, PixelFilter::centre);
    EXPECT_FALSE(load_cached_reference(file("absent.exr"), key()).has_value());
    EXPECT_THROW((void)load_named_reference(file("absent.exr"), key()), std::runtime_error);
}

TEST_F(ReferenceTest, FromElsewhereHasNoKnownNoise) {
    save_reference(file("r.exr"), key(), made(PixelFilter::centre, 1, 16));
    fs::remove(file("r.json"));
    EXPECT_FALSE(load_cached_reference(file("r.exr"), key()).has_value());
    EXPECT_FALSE(load_named_reference(file("r.exr"), key()).noise.has_value());
    ReferenceKey larger = key();
    larger.size.x += 1;
    EXPECT_THROW((void)load_named_reference(file("r.exr"), larger), std::runtime_error);
    std::ofstream(file("r.json")) << "{\"of\": 1";
    EXPECT_FALSE(load_named_reference(file("r.exr"), key()).noise.has_value());
}

class FingerprintTest : public ReferenceTest {
  protected:
    [[nodiscard]] std::string scene_in(const char* name, const std::string& gltf,
                                       const std::string& binary) const {
        fs::create_directories(folder_ / name);
        std::ofstream(folder_ / name / "scene.gltf") << gltf;
        std::ofstream(folder_ / name / "a b.bin") << binary;
        return (folder_ / name / "scene.gltf").string();
    }
};

TEST_F(FingerprintTest, IsOfTheContentAndNotOfThePlace) {
    const std::string gltf = R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin"}]})";
    const std::string print = scene_fingerprint(scene_in("one", gltf, "bytes"), "m");
    EXPECT_EQ(print.size(), 16U);
    EXPECT_EQ(print, scene_fingerprint(scene_in("two", gltf, "bytes"), "m"));
    EXPECT_NE(print, scene_fingerprint(scene_in("three", gltf, "other"), "m"));
    EXPECT_NE(print, scene_fingerprint(scene_in("four", gltf + " ", "bytes"), "m"));
    EXPECT_NE(print, scene_fingerprint(scene_in("one", gltf, "bytes"), "cm"));
}

}  // namespace
}  // namespace raybundle
