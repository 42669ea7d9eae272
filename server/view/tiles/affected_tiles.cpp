// SPDX-License-Identifier: Apache-2.0
#include "view/tiles/affected_tiles.h"

#include <algorithm>
#include <vector>

namespace raybundle {

namespace {

/// Lower and upper corners; what there is no room for shares the last box.
std::vector<glm::vec4> corners_of(std::span<const Bounds> boxes) {
    std::vector<glm::vec4> corners;
    for (const Bounds& box : boxes) {
        const glm::vec4 low(box.min, 0.0F);
        const glm::vec4 high(box.max, 0.0F);
        if (box.empty()) {
            continue;
        }
        if (corners.size() < std::size_t{2 * MOST_BOXES}) {
            corners.push_back(low);
            corners.push_back(high);
        } else {
            glm::vec4* const last = &corners.back();
            last[-1] = glm::min(last[-1], low);
            last[0] = glm::max(last[0], high);
        }
    }
    return corners;
}

}  // namespace

AffectedTilePrograms::AffectedTilePrograms(const GpuScene& scene)
    : find({"view_affected_tiles.comp"}, scene.defines()), finish({"view_tile_commands.comp"}) {}

AffectedTiles::AffectedTiles(glm::uvec2 size)
    : tiles_("affected tiles", size, 2 * MOST_DIFFERENCES) {}

void AffectedTiles::find(const AffectedTilePrograms& programs, std::span<const BundleRays> bundles,
                         std::span<const Bounds> boxes) const {
    bundles = bundles.first(std::min(bundles.size(), std::size_t{MOST_DIFFERENCES}));
    std::vector<glm::vec4> rays;
    for (const BundleRays& bundle : bundles) {
        rays.emplace_back(bundle.source, bundle.perspective ? 1.0F : 0.0F);
        rays.emplace_back(bundle.spread, 0.0F, 0.0F, 0.0F);
    }
    const std::vector<glm::vec4> corners = corners_of(boxes);
    tiles_.begin();
    if (!rays.empty() && !corners.empty()) {
        programs.find.set("bundle_count", static_cast<unsigned>(bundles.size()));
        programs.find.set("box_count", static_cast<unsigned>(corners.size() / 2));
        programs.find.set("bundle_rays", rays);
        programs.find.set("boxes", corners);
        programs.find.dispatch(tiles_.tile_count());
    }
    tiles_.end(programs.finish);
}

void AffectedTiles::dispatch(const ShaderProgram& program, unsigned bundles, bool glossy) const {
    program.set("listed_tiles", true);
    program.set("tile_list", bundles + (glossy ? MOST_DIFFERENCES : 0U));
    tiles_.dispatch(program, bundles + (glossy ? MOST_DIFFERENCES : 0U));
}

void AffectedTiles::dispatch_all(const ShaderProgram& program) const {
    program.set("listed_tiles", false);
    tiles_.dispatch_all(program);
}

}  // namespace raybundle
