// SPDX-License-Identifier: Apache-2.0
#include "scene/material/reflectance_table.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/material/ggx_albedo.h"

namespace raybundle {
namespace {

float cosine_of(const SpecularLobe& lobe, int node) {
    return cosine_of_node(static_cast<float>(node), grazing_scale(lobe.alpha));
}

glm::vec3 albedo_of(const Brdf& brdf, const ReflectanceNode& node) {
    return brdf.lambert * node.transmission + brdf.f0 * node.scale + brdf.lobe.f90 * node.bias;
}

}  // namespace

ReflectanceTable::ReflectanceTable(const Brdf& brdf) : brdf_(brdf) {
    if (brdf.lobe.kind == LobeKind::none) {
        return;
    }
    tabulate_albedo();
    for (int i = 0; i < reflectance_nodes; ++i) {
        nodes_[static_cast<std::size_t>(i)].importance = integrate_importance(i);
    }
    mean_ = integrate_mean();
}

ReflectanceTable::ReflectanceTable(const Brdf& brdf, const ReflectanceTable& similar)
    : brdf_(brdf) {
    if (brdf.lobe.kind == LobeKind::none) {
        return;
    }
    tabulate_albedo();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        nodes_[i].importance = similar.nodes_[i].importance;
    }
    mean_ = integrate_mean();
}

void ReflectanceTable::tabulate_albedo() {
    const SpecularLobe& lobe = brdf_.lobe;
    for (int i = 0; i < reflectance_nodes; ++i) {
        const LobeAlbedo albedo = lobe.kind == LobeKind::ggx
                                      ? ggx_albedo_at_node(lobe.alpha, i)
                                      : integrate_albedo(lobe, cosine_of(lobe, i));
        const LobeAlbedo left =
            lobe.coat.factor > 0.0F ? integrate_albedo(lobe, cosine_of(lobe, i)) : albedo;
        ReflectanceNode& node = nodes_[static_cast<std::size_t>(i)];
        node.scale = left.scale;
        node.bias = left.bias;
        node.transmission = 1.0F - lobe.coating.x * albedo.scale - lobe.coating.y * albedo.bias;
    }
}

ReflectanceNode ReflectanceTable::integrate_mean() {
    constexpr int steps = 1024;
    glm::dvec4 sum(0.0);
    double coat = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const ReflectanceNode node = at(static_cast<float>(cosine));
        const double weight = 2.0 * cosine / steps;
        sum += weight * glm::dvec4(node.scale, node.bias, node.transmission, node.importance);
        coat +=
            weight * static_cast<double>(coat_albedo(brdf_.lobe.coat, static_cast<float>(cosine)));
    }
    mean_coat_ = static_cast<float>(coat);
    const glm::vec4 mean(sum);
    return {mean.x, mean.y, mean.z, mean.w};
}

glm::vec3 ReflectanceTable::mean_albedo(const Brdf& recoloured) const {
    return albedo_of(recoloured, mean_) + mean_coat_;
}

/// S, by a lattice where each lobe is and one over the hemisphere, weighted by the balance
/// heuristic.
float ReflectanceTable::integrate_importance(int index) const {
    const ReflectanceNode& node = nodes_[static_cast<std::size_t>(index)];
    const glm::vec3 w_in = direction_at(cosine_of(brdf_.lobe, index));
    const ClearCoat& coat = brdf_.lobe.coat;
    const float transmission = node.transmission * coat_transmission(coat, w_in.z);
    const glm::vec3 mean = (brdf_.lambert * transmission + brdf_.f0 * node.scale +
                            brdf_.lobe.f90 * node.bias + coat_albedo(coat, w_in.z)) /
                           glm::pi<float>();
    double sum = 0.0;
    const auto add = [&](const glm::vec3& w, float weight) {
        if (w.z > 0.0F) {
            const float passed = transmission * at(w.z).transmission;
            const glm::vec3 df = glm::abs(evaluate(brdf_, w_in, w, passed) - mean);
            float density = lobe_density(brdf_.lobe, w, w_in) + w.z / glm::pi<float>();
            if (coat.strength > 0.0F) {
                density += coat_density(coat, w, w_in);
            }
            sum += static_cast<double>(weight * std::max({df.r, df.g, df.b}) * w.z / density);
        }
    };
    for (const auto& [disc, weight] : half_disc_lattice()) {
        add(lobe_direction(brdf_.lobe, w_in, disc), weight);
        add(cosine_direction(disc), weight);
        if (coat.strength > 0.0F) {
            add(coat_direction(coat, w_in, disc), weight);
        }
    }
    return static_cast<float>(sum);
}

ReflectanceNode ReflectanceTable::at(float cosine) const {
    const float position = node_of_cosine(cosine, grazing_scale(brdf_.lobe.alpha));
    const int first = std::min(static_cast<int>(position), reflectance_nodes - 2);
    const ReflectanceNode& a = nodes_[static_cast<std::size_t>(first)];
    const ReflectanceNode& b = nodes_[static_cast<std::size_t>(first) + 1];
    const float t = position - static_cast<float>(first);
    return {
        glm::mix(a.scale, b.scale, t), glm::mix(a.bias, b.bias, t),
        glm::mix(a.transmission, b.transmission, t) * coat_transmission(brdf_.lobe.coat, cosine),
        glm::mix(a.importance, b.importance, t)};
}

glm::vec3 ReflectanceTable::albedo(const Brdf& recoloured, float cosine) const {
    return albedo_of(recoloured, at(cosine)) + coat_albedo(recoloured.lobe.coat, cosine);
}

}  // namespace raybundle
