// SPDX-License-Identifier: Apache-2.0
#include "view/specular/gloss_rays.h"

#include <tbb/parallel_for.h>

#include <span>

#include "bundle/parallel_window.h"
#include "gpu/gl_scope.h"
#include "gpu/layouts.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

std::size_t most_rays(std::size_t pixels) {
    const std::size_t groups = (pixels + SPECULAR_GROUP - 1) / SPECULAR_GROUP;
    return groups * GLOSS_RAYS_OF_GROUP;
}

}  // namespace

GlossRays::GlossRays(std::size_t pixels)
    : buffer_("gloss rays", most_rays(pixels) * sizeof(GlossRay)), rays_(most_rays(pixels)) {}

/// What rays meet, and the sky where they meet nothing.
void GlossRays::follow(const GpuScene& scene, std::size_t count) {
    const std::span<GlossRay> rays = std::span(rays_).first(count);
    if (count == 0) {
        return;
    }
    buffer_.read(rays);
    TraceRules rules = scene.trace_rules(Place::now);
    rules.bundle = samples_;
    scene.tracer()->follow(rays, rules, static_cast<float>(TIE_SHARE) * scene.diameter());
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        if (rays[i].facet != GlossRay::unused && rays[i].surface == FacetTracer::no_hit) {
            rays[i].origin = scene.sky_towards(rays[i].direction);
        }
    });
    buffer_.write<GlossRay>(rays, 0);
}

void GlossRays::run(const GpuScene& scene, const GlossRayPrograms& programs,
                    const SpecularGroups& groups, const Pass& pass) {
    const std::size_t count = std::size_t{groups.count()} * GLOSS_RAYS_OF_GROUP;
    const GlScope scope("gloss rays");
    buffer_.bind_storage(BINDING_GLOSS_RAYS);
    for (const ShaderProgram* program : {&programs.make, &programs.land}) {
        program->set("ray_phase", pass.phase);
        program->set("ray_count", static_cast<unsigned>(count));
    }
    programs.make.set("ray_number", pass.number);
    programs.make.set("ray_seed", seed_);
    programs.make.dispatch(count);
    follow(scene, count);
    programs.land.set("layered", pass.layered);
    programs.land.set("first_look", pass.first_look);
    programs.land.set("look_weight", weight_);
    programs.land.set("ray_share", share());
    const glm::vec4 slab(scene.bounds().centre(), parallel_depth(scene.diameter()));
    programs.land.set("slab", std::span(&slab, 1));
    programs.land.dispatch(count);
}

void GlossRays::begin(const GpuScene& scene, const GlossRayPrograms& programs,
                      const SpecularGroups& groups) {
    samples_ = 0;
    for (std::uint32_t phase = 0; phase < GLOSS_RAY_STRIDE && weight_ > 0.0F; ++phase) {
        run(scene, programs, groups, {phase, 0, true, false});
    }
}

void GlossRays::trace(const GpuScene& scene, const GlossRayPrograms& programs,
                      const SpecularGroups& groups, const BundleReceiver::Context& context,
                      bool layered) {
    seed_ = context.seed;
    weight_ = context.sample_weight;
    run(scene, programs, groups,
        {samples_ % GLOSS_RAY_STRIDE, 1 + samples_ / GLOSS_RAY_STRIDE, false, layered});
    ++samples_;
}

}  // namespace raybundle
