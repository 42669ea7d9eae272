// SPDX-License-Identifier: Apache-2.0
// glTF and GLB files with all they need in themselves, as uploads are: an error that names the
// file, or a scene whose numbers are finite and whose indices lead somewhere.
#include <algorithm>
#include <cmath>
#include <span>

#include "fuzz_target.h"
#include "scene/gltf/gltf_loader.h"

namespace {

using namespace raybundle;

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const Scene& scene) {
    FUZZ_REQUIRE(!scene.triangles.empty() && !scene.objects.empty() && !scene.materials.empty() &&
                 !scene.cameras.empty());
    for (const Triangle& triangle : scene.triangles) {
        FUZZ_REQUIRE(triangle.material < scene.materials.size() &&
                     triangle.object < scene.objects.size());
        for (const std::uint32_t vertex : triangle.vertex) {
            FUZZ_REQUIRE(vertex < scene.vertices.size());
        }
    }
    for (const Vertex& vertex : scene.vertices) {
        FUZZ_REQUIRE(finite(vertex.position) && finite(vertex.normal));
    }
    for (const Camera& camera : scene.cameras) {
        FUZZ_REQUIRE(finite(camera.eye) && finite(camera.target) && camera.vertical_fov > 0.0F);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // No such folder: nothing that a mutation names is read.
    const std::string path = "/nonexistent/f.gltf";
    try {
        check(load_gltf(path, std::span(data, size)));
    } catch (const SceneError& error) {
        FUZZ_REQUIRE(error.file() == path && !error.reason().empty());
    }
    return 0;
}
