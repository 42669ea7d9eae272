// SPDX-License-Identifier: Apache-2.0
// IES and EULUMDAT files: an error that names the file and a line, or intensities that are finite
// in every direction.
#include <cmath>
#include <string_view>

#include "fuzz_target.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/photometry/ies_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raybundle;
    try {
        const IesProfile profile =
            parse_photometry("f", {reinterpret_cast<const char*>(data), size});
        FUZZ_REQUIRE(profile.flux() > 0.0 && std::isfinite(profile.flux()));
        for (const glm::dvec3& d : {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0),
                                    glm::dvec3(0, -1, 0), glm::dvec3(-0.6, 0.48, 0.64)}) {
            const double candela = profile.candela(d);
            FUZZ_REQUIRE(candela >= 0.0 && std::isfinite(candela));
        }
    } catch (const SceneError& error) {
        FUZZ_REQUIRE(error.file() == "f" && error.json_path().starts_with("line "));
        FUZZ_REQUIRE(!error.reason().empty());
    }
    return 0;
}
