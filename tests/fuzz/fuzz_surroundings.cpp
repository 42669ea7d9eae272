// SPDX-License-Identifier: Apache-2.0
// Images of the surroundings: an error that names the file, or pixels that are finite and not
// negative.
#include <cmath>

#include "fuzz_target.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/light/environment_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raybundle;
    try {
        const EquirectangularImage image = read_equirectangular("f", {data, size});
        FUZZ_REQUIRE(image.pixels.size() == image.index(0, image.height));
        for (const glm::vec3& pixel : image.pixels) {
            for (int c = 0; c < 3; ++c) {
                FUZZ_REQUIRE(std::isfinite(pixel[c]) && pixel[c] >= 0.0F);
            }
        }
    } catch (const SceneError& error) {
        FUZZ_REQUIRE(error.file() == "f" && !error.reason().empty());
    }
    return 0;
}
