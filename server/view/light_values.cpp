// SPDX-License-Identifier: Apache-2.0
#include "view/light_values.h"

#include <glm/gtc/constants.hpp>

#include "view/view_programs.h"

namespace raybundle {

namespace {

constexpr std::size_t vertex_bytes = 16;  // of both sides, half floats

}  // namespace

LightValues::LightValues(const GpuScene& scene, const RadianceStore& store,
                         std::span<const std::uint32_t> sources, float unit)
    : scene_(scene),
      store_(store),
      unit_(unit),
      count_(static_cast<std::uint32_t>(sources.size())),
      interpolate_({"view_vertex_irradiance.comp"}, patch_light_defines(scene)),
      pack_({"view_light_values.comp"}),
      vertex_irradiance_("light of vertices", vertex_bytes * scene.vertex_count()),
      sources_(Buffer::from<std::uint32_t>("sources of light values", sources)),
      values_("light values", sources.size_bytes()),
      readback_("light values", sources.size_bytes()) {}

void LightValues::request() {
    store_.bind();
    store_.bind_caustics_of_patches();
    vertex_irradiance_.bind_storage(BINDING_VERTEX_IRRADIANCE);
    interpolate_.set("vertex_count", scene_.vertex_count());
    interpolate_.dispatch(scene_.vertex_count());
    storage_barrier();
    sources_.bind_storage(BINDING_LIGHT_SOURCES);
    values_.bind_storage(BINDING_LIGHT_VALUES);
    pack_.set("value_count", count_);
    pack_.set("scale", glm::one_over_pi<float>() * scene_.radiance_unit() / unit_);
    pack_.dispatch(count_);
    storage_barrier();
    readback_.request(values_, values_.bytes());
    store_.bind();
}

std::size_t LightValues::bytes() const {
    return vertex_irradiance_.bytes() + sources_.bytes() + 2 * values_.bytes();
}

}  // namespace raybundle
