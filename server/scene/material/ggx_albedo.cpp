// SPDX-License-Identifier: Apache-2.0
#include "scene/material/ggx_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/material/reflectance_nodes.h"

namespace raybundle {
namespace {

constexpr int roughness_rows = 48;

LobeAlbedo mix(const LobeAlbedo& a, const LobeAlbedo& b, float t) {
    return {a.scale + (b.scale - a.scale) * t, a.bias + (b.bias - a.bias) * t};
}

/// Row (fractional) of the table for an alpha.
float row_of_alpha(float alpha) {
    const float share = (std::sqrt(alpha) - min_roughness) / (1.0F - min_roughness);
    return std::clamp(share, 0.0F, 1.0F) * static_cast<float>(roughness_rows - 1);
}

float alpha_of_row(int row) {
    const float share = static_cast<float>(row) / static_cast<float>(roughness_rows - 1);
    const float roughness = min_roughness + (1.0F - min_roughness) * share;
    return roughness * roughness;
}

class Table {
  public:
    Table() {
        for (int row = 0; row < roughness_rows; ++row) {
            SpecularLobe lobe;
            lobe.kind = LobeKind::ggx;
            lobe.alpha = alpha_of_row(row);
            for (int node = 0; node < reflectance_nodes; ++node) {
                const float cosine =
                    cosine_of_node(static_cast<float>(node), grazing_scale(lobe.alpha));
                at(row, node) = integrate_albedo(lobe, cosine);
            }
        }
    }

    [[nodiscard]] LobeAlbedo at_node(float row, int node) const {
        const int first = std::min(static_cast<int>(row), roughness_rows - 2);
        return mix(at(first, node), at(first + 1, node), row - static_cast<float>(first));
    }

  private:
    [[nodiscard]] static std::size_t index(int row, int node) {
        return static_cast<std::size_t>(row) * reflectance_nodes + static_cast<std::size_t>(node);
    }
    [[nodiscard]] const LobeAlbedo& at(int row, int node) const {
        return values_[index(row, node)];
    }
    LobeAlbedo& at(int row, int node) { return values_[index(row, node)]; }

    std::array<LobeAlbedo, std::size_t{roughness_rows} * reflectance_nodes> values_;
};

const Table& table() {
    static const Table the_table;
    return the_table;
}

}  // namespace

LobeAlbedo ggx_albedo_at_node(float alpha, int node) {
    return table().at_node(row_of_alpha(alpha), node);
}

LobeAlbedo ggx_albedo(float alpha, float cosine) {
    const float row = row_of_alpha(alpha);
    const float node = node_of_cosine(cosine, grazing_scale(alpha));
    const int first = std::min(static_cast<int>(node), reflectance_nodes - 2);
    return mix(table().at_node(row, first), table().at_node(row, first + 1),
               node - static_cast<float>(first));
}

LobeAlbedo ggx_mean_albedo(float alpha) {
    // Gauss-Legendre, three points a cell: the interpolant is smooth between nodes.
    constexpr std::array<double, 3> position = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array<double, 3> weight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double scale = 0.0;
    double bias = 0.0;
    double low = 0.0;
    for (int node = 1; node < reflectance_nodes; ++node) {
        const double high = cosine_of_node(static_cast<float>(node), grazing_scale(alpha));
        for (std::size_t k = 0; k < position.size(); ++k) {
            const double c = low + (high - low) * position[k];
            const double w = 2.0 * c * (high - low) * weight[k];
            const LobeAlbedo albedo = ggx_albedo(alpha, static_cast<float>(c));
            scale += w * static_cast<double>(albedo.scale);
            bias += w * static_cast<double>(albedo.bias);
        }
        low = high;
    }
    return {static_cast<float>(scale), static_cast<float>(bias)};
}

}  // namespace raybundle
