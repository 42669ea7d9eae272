// SPDX-License-Identifier: Apache-2.0
// Rays instead of the rasteriser.
#include "gpu/egl_context.h"
#include "solution/geometry/gpu_scene.h"
#include "trace/bundle_builder.h"
#include "trace/facet_tracer.h"

namespace raybundle {

GpuScene::~GpuScene() = default;
GpuScene::GpuScene(GpuScene&&) noexcept = default;

void GpuScene::make_tracer(const Scene& scene, const PatchMesh& mesh) {
    always_traces_ = bundle_builder() == BundleBuilder::trace;
    traces_bundles_ =
        always_traces_ || (bundle_builder() == BundleBuilder::automatic && is_software_renderer());
    if (traces_bundles_ || many_lamps() || reflectance_.draws_lobes()) {
        tracer_ = std::make_unique<FacetTracer>(scene, mesh,
                                                std::span(world_from_object_).first(object_count_));
    }
}

void GpuScene::settle_tracer() {
    if (tracer_) {
        tracer_->settle();
    }
}

std::size_t GpuScene::tracer_bytes() const {
    return tracer_ ? tracer_->bytes() : 0;
}

bool GpuScene::traces(SeenAs kind, std::size_t pixels) const {
    if (!traces_bundles_ || always_traces_) {
        return traces_bundles_;
    }
    // Rasterising costs so much a facet, tracing so much more a pixel.
    const double share = kind == SeenAs::layers || kind == SeenAs::planes ? 0.0 : 0.08;
    return static_cast<double>(facets_.count()) >= share * static_cast<double>(pixels);
}

TraceRules GpuScene::trace_rules(Place place) const {
    TraceRules rules;
    rules.place = static_cast<unsigned>(place);
    rules.tie = thin_walls_ ? static_cast<float>(TIE_SHARE) * diameter_ : 0.0F;
    return rules;
}

}  // namespace raybundle
