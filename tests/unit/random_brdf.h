// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "scene/material/brdf.h"

namespace raybundle::test {

/// Random materials of every kind, and directions above the horizon. Equal seeds give equal ones.
class RandomBrdfs {
  public:
    explicit RandomBrdfs(unsigned seed) : generator_(seed) {}

    float uniform() {
        // Not std::uniform_real_distribution, which libraries implement differently.
        return static_cast<float>(generator_() >> 8U) / 16777216.0F;
    }

    glm::vec3 colour() {
        const float r = uniform();
        const float g = uniform();
        return {r, g, uniform()};
    }

    /// Half of them even over the hemisphere, half even in the cube root of the cosine: grazing.
    glm::vec3 direction() {
        const float u = 1.0F - uniform();  // never 0
        const float z = uniform() < 0.5F ? u : u * u * u;
        const float phi = 2.0F * glm::pi<float>() * uniform();
        const float sine = std::sqrt(1.0F - z * z);
        return {sine * std::cos(phi), sine * std::sin(phi), z};
    }

    Material material() {
        Material result;
        result.roughness = uniform();
        const float kind = uniform();
        result.metallic = kind < 0.4F ? 0.0F : kind < 0.7F ? 1.0F : uniform();
        result.specular = uniform() < 0.6F ? 1.0F : uniform();
        if (uniform() < 0.3F) {
            result.specular_colour = 4.0F * colour();
        }
        if (uniform() < 0.2F) {
            result.max_phong = MaxPhong{colour(), std::pow(1000.0F, uniform())};
        }
        result.base_colour = colour();
        return result;
    }

    const Brdf& next() {
        const Material drawn = material();
        last_ = make_brdf(drawn, drawn.base_colour);
        return last_;
    }
    [[nodiscard]] const Brdf& last() const { return last_; }

  private:
    std::mt19937 generator_;
    Brdf last_;
};

}  // namespace raybundle::test
