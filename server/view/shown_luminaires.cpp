// SPDX-License-Identifier: Apache-2.0
#include "view/shown_luminaires.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>

#include "scene/photometry/luminaire_body.h"

namespace raybundle {

namespace {

using layout::LuminaireData;

/// The whole of a light that is here by a quarter of its opening.
PlacedLight whole_of(PlacedLight placed, const PunctualLight& light) {
    if (light.part != PunctualLight::whole) {
        const LuminousOpening opening = opening_of(light.profile.get());
        const glm::dvec2 aside = part_of(opening, static_cast<unsigned>(light.part)).seen_from;
        placed.position -= placed.axes[0] * aside.x + placed.axes[1] * aside.y;
        placed.intensity *= static_cast<double>(LuminousOpening::parts);
        placed.opening = opening;
    }
    return placed;
}

/// Whether a light is to be seen, and has not been found by another part of it.
bool is_shown(const GpuScene& scene, const PunctualLight& light, const Camera& camera) {
    if (!light.profile || light.removed || light.part > 0) {
        return false;
    }
    if (light.object == PunctualLight::no_object) {
        return true;
    }
    const auto object = static_cast<std::uint32_t>(light.object);
    const bool hidden =
        std::find(camera.hidden.begin(), camera.hidden.end(), object) != camera.hidden.end();
    // What has been removed has no size.
    return !hidden && glm::mat3(scene.world_from_object(object, Place::now)) != glm::mat3(0.0F);
}

LuminaireData data_of(const LuminaireBody& body, std::uint32_t profile, float unit) {
    const IesProfile::Opening& opening = body.profile->data().opening;
    LuminaireData data{};
    data.position = glm::vec4(glm::vec3(body.position), body.radius());
    data.axis_x = glm::vec4(glm::vec3(body.axes[0]), body.half.x);
    data.axis_y = glm::vec4(glm::vec3(body.axes[1]), body.half.y);
    data.axis_z = glm::vec4(glm::vec3(body.axes[2]), body.high);
    data.intensity = glm::vec4(glm::vec3(body.intensity) / unit, body.low);
    for (int side = 0; side < 4; ++side) {
        data.heights[side] = static_cast<float>(opening.heights[static_cast<std::size_t>(side)]);
    }
    data.profile = {profile, opening.round ? 1U : 0U, 0U, 0U};
    return data;
}

Bounds positions_of(std::span<const LuminaireData> luminaires) {
    Bounds bounds;
    for (const LuminaireData& luminaire : luminaires) {
        bounds.add(glm::vec3(luminaire.position));
    }
    return bounds;
}

glm::vec4 ball_round(std::span<const LuminaireData> luminaires) {
    const glm::vec3 middle = positions_of(luminaires).centre();
    float radius = 0.0F;
    for (const LuminaireData& luminaire : luminaires) {
        const glm::vec3 position(luminaire.position);
        radius = std::max(radius, glm::distance(middle, position) + luminaire.position.w);
    }
    constexpr float rounding = 1.0F + 1e-5F;
    return {middle, rounding * radius};
}

/// Sorts luminaires into so many groups of neighbours, each half of them on one side of a plane.
void make_groups(std::span<LuminaireData> luminaires, std::size_t first, unsigned groups,
                 layout::LuminaireHead& head) {
    if (groups == 1) {
        layout::LuminaireGroup& group = head.groups[head.counts.y++];
        group.ball = ball_round(luminaires);
        group.range = {static_cast<unsigned>(first),
                       static_cast<unsigned>(first + luminaires.size()), 0U, 0U};
        return;
    }
    const glm::vec3 extent = positions_of(luminaires).extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t half = luminaires.size() * (groups / 2) / groups;
    std::nth_element(luminaires.begin(), luminaires.begin() + static_cast<std::ptrdiff_t>(half),
                     luminaires.end(), [axis](const LuminaireData& a, const LuminaireData& b) {
                         return a.position[axis] < b.position[axis];
                     });
    make_groups(luminaires.first(half), first, groups / 2, head);
    make_groups(luminaires.subspan(half), first + half, groups - groups / 2, head);
}

/// Leaves the nearest to a place.
void keep_nearest(std::vector<LuminaireData>& luminaires, const glm::vec3& eye) {
    constexpr std::size_t most = MOST_LUMINAIRES;
    if (luminaires.size() <= most) {
        return;
    }
    const auto distance = [&](const LuminaireData& luminaire) {
        return glm::distance(eye, glm::vec3(luminaire.position));
    };
    std::nth_element(
        luminaires.begin(), luminaires.begin() + most, luminaires.end(),
        [&](const LuminaireData& a, const LuminaireData& b) { return distance(a) < distance(b); });
    luminaires.resize(most);
}

bool same(const layout::LuminaireHead& a, const layout::LuminaireHead& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

}  // namespace

ShownLuminaires::ShownLuminaires()
    : buffer_("luminaires",
              sizeof(layout::LuminaireHead) + MOST_LUMINAIRES * sizeof(LuminaireData)) {
    buffer_.clear();
}

bool ShownLuminaires::possible(const GpuScene& scene) {
    const std::vector<std::string>& defines = scene.defines();
    return std::find(defines.begin(), defines.end(), "IES 1") != defines.end();
}

void ShownLuminaires::update(const GpuScene& scene, const FirstShot& shot, const Look& look) {
    std::vector<LuminaireData> found;
    const std::vector<PunctualLight>& lights = scene.punctual_lights();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!is_shown(scene, lights[i], look.camera)) {
            continue;
        }
        const std::optional<std::uint32_t> profile = shot.profile_number(lights[i].profile.get());
        const auto body = body_of(whole_of(scene.placed_light(i), lights[i]));
        if (profile && body) {
            found.push_back(data_of(*body, *profile, scene.radiance_unit()));
        }
    }
    keep_nearest(found, look.camera.eye - scene.origin());
    layout::LuminaireHead head{};
    if (!found.empty()) {
        make_groups(
            found, 0,
            static_cast<unsigned>((found.size() + LUMINAIRES_IN_GROUP - 1) / LUMINAIRES_IN_GROUP),
            head);
    }
    head.counts.x = static_cast<unsigned>(found.size());
    head.counts.z = look.rays_per_edge;
    head.cut.x = look.near;
    const bool unchanged =
        same(head, head_) && found.size() == luminaires_.size() &&
        std::memcmp(found.data(), luminaires_.data(), found.size() * sizeof(LuminaireData)) == 0;
    if (unchanged) {
        return;
    }
    head_ = head;
    luminaires_ = std::move(found);
    buffer_.write<layout::LuminaireHead>(std::span(&head_, 1), 0);
    if (!luminaires_.empty()) {
        buffer_.write<LuminaireData>(luminaires_, sizeof(head_));
    }
}

}  // namespace raybundle
