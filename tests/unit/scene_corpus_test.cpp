// SPDX-License-Identifier: Apache-2.0
// Third-party files from ../shared/data: all that are valid load, all that are not are rejected,
// and nothing crashes. Skipped where that folder is absent. The shipped scenes are always checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "gltf_builder.h"
#include "scene/light/environment.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

namespace fs = std::filesystem;

const fs::path shared_data = RAYBUNDLE_SHARED_DATA;

#define SKIP_WITHOUT_SHARED_DATA()                                                       \
    if (!fs::is_directory(shared_data)) {                                                \
        GTEST_SKIP() << "skipped: the test data folder " << shared_data << " is absent"; \
    }

bool is_gltf(const fs::path& path) {
    return path.extension() == ".gltf" || path.extension() == ".glb";
}

std::vector<fs::path> files_in(const fs::path& folder, bool (*wanted)(const fs::path&)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && wanted(entry.path())) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// What every loaded scene promises.
void check_scene(const Scene& scene) {
    EXPECT_FALSE(scene.triangles.empty());
    EXPECT_FALSE(scene.objects.empty());
    EXPECT_FALSE(scene.materials.empty());
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_TRUE(has_emitter(scene) || has_sky(scene));
    for (const Triangle& triangle : scene.triangles) {
        ASSERT_LT(triangle.material, scene.materials.size());
        ASSERT_LT(triangle.object, scene.objects.size());
        for (const std::uint32_t vertex : triangle.vertex) {
            ASSERT_LT(vertex, scene.vertices.size());
            ASSERT_NEAR(glm::length(scene.vertices[vertex].normal), 1.0F, 1e-3F);
        }
    }
}

/// The error, if a file is rejected.
std::optional<SceneError> try_load(const fs::path& file) {
    try {
        check_scene(load_gltf(file.string()));
        return std::nullopt;
    } catch (const SceneError& error) {
        EXPECT_EQ(error.file(), file.string());
        EXPECT_FALSE(error.reason().empty());
        return error;
    }
}

TEST(SceneCorpus, ShippedScenesLoad) {
    for (const fs::path& file : files_in(RAYBUNDLE_SCENES, is_gltf)) {
        const auto error = try_load(file);
        EXPECT_FALSE(error) << error->what();
    }
}

TEST(SceneCorpus, CornellBoxIsAsDesigned) {
    const Scene scene = load_gltf((fs::path(RAYBUNDLE_SCENES) / "cornell_box.gltf").string());
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_LT(glm::distance(scene.cameras[0].eye, glm::vec3(2.75F, 2.75F, -7.5F)), 1e-4F);
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].name, "ceiling");
    EXPECT_LT(glm::distance(scene.lights[0].radiance, glm::vec3(1800, 1300, 600)), 0.1F);
    std::set<std::string> movable;
    for (const Object& object : scene.objects) {
        if (object.movable) {
            movable.insert(object.name);
        }
    }
    EXPECT_TRUE(movable.contains("short box"));
    EXPECT_TRUE(movable.contains("tall box"));
}

TEST(SceneCorpus, ScenesAndObjectsLoadAndTessellate) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const char* folder : {"scenes", "objects", "animation"}) {
        for (const fs::path& file : files_in(shared_data / folder, is_gltf)) {
            Scene scene = load_gltf(file.string());
            check_scene(scene);
            const PatchMesh mesh = tessellate(scene);
            EXPECT_GT(mesh.patch_count(), 0U) << file;
            for (std::size_t p = 0; p < mesh.patch_count(); ++p) {
                ASSERT_TRUE(glm::all(glm::lessThanEqual(mesh.base_colour[p], glm::vec3(0.999F))));
                ASSERT_TRUE(glm::all(glm::greaterThanEqual(mesh.base_colour[p], glm::vec3(0))));
            }
        }
    }
}

/// Triangles that the index promises for a file, none where it says nothing.
std::optional<int> promised_triangles(const fs::path& file) {
    std::ifstream index(shared_data / "INDEX.tsv");
    const std::string name = fs::relative(file, shared_data).generic_string();
    for (std::string line; std::getline(index, line);) {
        std::istringstream fields(line);
        std::string path, bytes, triangles;
        std::getline(fields, path, '\t');
        std::getline(fields, bytes, '\t');
        std::getline(fields, triangles, '\t');
        if (path == name && !triangles.empty()) {
            return std::stoi(triangles);
        }
    }
    return std::nullopt;
}

TEST(SceneCorpus, ConformanceFilesLoadUnlessTheyHaveNoTriangles) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const fs::path& file : files_in(shared_data / "conformance", is_gltf)) {
        const auto error = try_load(file);
        const std::optional<int> triangles = promised_triangles(file);
        ASSERT_TRUE(triangles) << file << " is not in INDEX.tsv";
        if (*triangles == 0) {
            ASSERT_TRUE(error) << file;
            EXPECT_EQ(error->reason(), "the scene has no triangles") << file;
        } else if (file.filename() == "24_gpu_instancing.gltf") {
            // Its instances add up to 7.7 million triangles.
            ASSERT_TRUE(error) << file;
            EXPECT_NE(error->reason().find("more than"), std::string::npos) << error->what();
        } else {
            EXPECT_FALSE(error) << error->what();
        }
    }
}

TEST(SceneCorpus, MalformedFilesAreRejected) {
    SKIP_WITHOUT_SHARED_DATA();
    // What these break is not geometry: a scene can be had from them.
    const std::set<std::string> harmless = {"BoxBadNormals.glb", "badExtension.gltf",
                                            "badNumber.gltf",    "badString.gltf",
                                            "test.gltf",         "texcoord_crash.gltf"};
    for (const fs::path& file : files_in(shared_data / "malformed", is_gltf)) {
        if (file.generic_string().find("gltf_validator") != std::string::npos) {
            continue;
        }
        const auto error = try_load(file);
        if (!harmless.contains(file.filename().string())) {
            EXPECT_TRUE(error) << file << " was not rejected";
        }
    }
}

/// What the validator complains about and would make geometry, materials or hierarchy wrong.
const std::set<std::string> fatal_codes = {"ACCESSOR_INDEX_OOB",
                                           "ACCESSOR_INDEX_PRIMITIVE_RESTART",
                                           "ACCESSOR_OFFSET_ALIGNMENT",
                                           "ACCESSOR_SMALL_BYTESTRIDE",
                                           "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
                                           "ACCESSOR_TOO_LONG",
                                           "ACCESSOR_TOTAL_OFFSET_ALIGNMENT",
                                           "BUFFER_BYTE_LENGTH_MISMATCH",
                                           "BUFFER_VIEW_TOO_LONG",
                                           "INVALID_JSON",
                                           "IO_ERROR",
                                           "NODE_LOOP",
                                           "NODE_PARENT_OVERRIDE",
                                           "SCENE_NON_ROOT_NODE",
                                           "UNKNOWN_ASSET_MAJOR_VERSION",
                                           "ASSET_MIN_VERSION_GREATER_THAN_VERSION"};

bool shows_nothing(const SceneError& error) {
    return error.reason().find("no triangles") != std::string::npos;
}

/// Valid in the validator's eyes, but nothing that can be read.
bool is_beyond_support(const SceneError& error) {
    for (const char* reason : {"not supported", "only 2.0 is supported", "only data URIs",
                               "no GLB binary chunk", "is not one of SCALAR"}) {
        if (error.reason().find(reason) != std::string::npos) {
            return true;
        }
    }
    return false;
}

TEST(SceneCorpus, ValidatorFilesAreRejectedAsReported) {
    SKIP_WITHOUT_SHARED_DATA();
    int fatal = 0;
    for (const fs::path& file : files_in(shared_data / "malformed" / "gltf_validator", is_gltf)) {
        const auto error = try_load(file);
        std::ifstream report_file(file.string() + ".report.json");
        if (!report_file) {
            continue;
        }
        const Json report = Json::parse(report_file);
        bool is_fatal = false;
        for (const Json& message : report["issues"]["messages"]) {
            is_fatal = is_fatal || fatal_codes.contains(message["code"].get<std::string>());
        }
        // A byte order mark in front of the JSON harms nobody.
        if (is_fatal && file.filename() != "bom.gltf") {
            ++fatal;
            ASSERT_TRUE(error) << file << " was not rejected";
            EXPECT_FALSE(shows_nothing(*error))
                << file << " was rejected for another reason than its report: " << error->what();
        } else if (report["issues"]["numErrors"] == 0) {
            // Valid, but most of these files show nothing, and some ask for what is not supported.
            EXPECT_TRUE(!error || shows_nothing(*error) || is_beyond_support(*error))
                << error->what();
        }
    }
    EXPECT_GE(fatal, 15);
}

TEST(SceneCorpus, JsonParsingCasesNeverCrash) {
    SKIP_WITHOUT_SHARED_DATA();
    const auto any_file = [](const fs::path&) { return true; };
    const TemporaryFolder folder;
    for (const fs::path& file : files_in(shared_data / "json", any_file)) {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        // As a whole file none is glTF; inside of extras, valid ones do no harm.
        (void)load_error(folder.write("case.gltf", text));
        (void)load_error(
            folder.write("case.gltf", R"({"asset":{"version":"2.0"},"extras":)" + text + "}"));
    }
}

}  // namespace
}  // namespace raybundle::test
